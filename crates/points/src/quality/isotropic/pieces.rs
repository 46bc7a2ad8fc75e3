//! What a polygon around few points is made of: pieces between one side and the next.
//!
//! Each side of the polygon has an *anchor*: a point on it that must not get inside. From anchor to anchor there goes a chord, and
//! beyond it is a triangle that ends at the corner where the two sides meet. The area less the part of the points is a sum over
//! such pieces (for a chord, of all that is below it, with the sign of its direction). When of the two sides only ranges
//! of directions are known, the piece has at most the area of the largest triangle and at least the points of the smallest.
//!
//! A side of the square has its end as an anchor for the piece before and its start for the piece after; both chords
//! together have the side itself too much. Where it is left must not be before where it is met.

use std::f64::consts::{FRAC_PI_2, PI};

use super::polygon::{Cloud, Line, Point, SQUARE, TIE, area, cut, turn};

/// No such piece.
pub(super) const NEVER: f64 = f64::NEG_INFINITY;

/// Directions that differ by less may be the same.
const SAME: f64 = 1e-12;

/// Sides through a point, with directions (as angles) of a closed range.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangents {
    pub(super) at: Point,
    pub(super) range: [f64; 2],
}

/// The direction of a side of the square: bottom, right, top, left.
pub(super) fn square_angle(side: usize) -> f64 {
    side as f64 * FRAC_PI_2
}

/// A side of the square, for the piece that ends at it.
pub(super) fn arrival(side: usize) -> Tangents {
    Tangents { at: SQUARE[(side + 1) % 4], range: [square_angle(side); 2] }
}

/// A side of the square, for the piece that starts from it; with the angle of the left side below those of all chords.
pub(super) fn departure(side: usize) -> Tangents {
    let angle = if side == 3 { -FRAC_PI_2 } else { square_angle(side) };
    Tangents { at: SQUARE[side], range: [angle; 2] }
}

/// From one anchor to another.
pub(super) struct Chord {
    ends: [Point; 2],
    /// Its direction, in (−π/2, 3π/2].
    pub(super) angle: f64,
    /// What it adds: the area less the part of the points below, with a sign.
    value: f64,
    /// The points on it and to its right, with their parts of all, where corners may be.
    beyond: Vec<(Point, f64)>,
}

impl Chord {
    pub(super) fn new(cloud: &Cloud, a: Point, b: Point) -> Self {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let angle = (b[1] - a[1]).atan2(b[0] - a[0]);
        let angle = if angle <= -FRAC_PI_2 { angle + 2.0 * PI } else { angle };
        let mut value = (a[0] - b[0]) * (a[1] + b[1]) * 0.5;
        let mut beyond = Vec::new();
        for (&z, &share) in cloud.x.iter().zip(&cloud.share) {
            let left = turn(a, b, z);
            // what is on the chord counts as beyond; in the order of the points a leftmost anchor comes out as −1
            if b <= z && z < a && left > TIE * length {
                value -= share;
            } else if a <= z && z < b && left <= TIE * length {
                value += share;
            }
            if left <= TIE * length {
                beyond.push((z, share));
            }
        }
        Self { ends: [a, b], angle, value, beyond }
    }

    /// The most that the piece between two sides can be worth.
    pub(super) fn piece(&self, from: [f64; 2], to: [f64; 2], rooms: &mut [Vec<Point>; 2]) -> f64 {
        if from[0] > self.angle + SAME || to[1] < self.angle - SAME || to[0] - from[1] >= PI {
            return NEVER;
        }
        let [a, b] = self.ends;
        cut(&SQUARE, &Line::through(b, a), &mut rooms[0]);
        for (at, angle) in [(a, from[0]), (b, to[1])] {
            // a side that could be more than half a turn from the chord says nothing
            if (angle - self.angle).abs() < PI {
                let [whole, part] = rooms;
                cut(whole, &Line::new(at, angle), part);
                rooms.swap(0, 1);
            }
        }
        self.value + area(&rooms[0]) - self.certain(from[1], to[0])
    }

    /// The part of the points that is inside for sure: beyond the chord, but within the smallest triangle.
    fn certain(&self, from: f64, to: f64) -> f64 {
        if from >= self.angle - SAME || to <= self.angle + SAME {
            return 0.0;
        }
        let lines = [Line::new(self.ends[0], from), Line::new(self.ends[1], to)];
        let inside = |z: Point| lines.iter().all(|line| line.left(z) > TIE);
        self.beyond.iter().filter(|(z, _)| inside(*z)).map(|(_, share)| share).sum()
    }
}

/// A piece between a side of the square and one through a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub(super) piece: f64,
    /// Where the corner is on the side of the square, from 0 to 1: at the earliest before the side, at the latest after it.
    pub(super) place: f64,
}

/// All pieces between a side of the square and a point.
pub(super) struct Meetings {
    anchor: Point,
    before: Chord,
    after: Chord,
    to: Tangents,
    from: Tangents,
    /// What the side itself is worth.
    value: f64,
}

impl Meetings {
    pub(super) fn new(cloud: &Cloud, anchor: Point, side: usize) -> Self {
        let (to, from) = (arrival(side), departure(side));
        let (before, after) = (Chord::new(cloud, anchor, to.at), Chord::new(cloud, from.at, anchor));
        Self { anchor, before, after, to, from, value: square_value(cloud, side) }
    }

    /// From a side through the point to the side of the square.
    pub(super) fn arrival(&self, range: [f64; 2], rooms: &mut [Vec<Point>; 2]) -> Meeting {
        let piece = self.before.piece(range, self.to.range, rooms);
        Meeting { piece, place: if self.to.range[0] - range[0] < PI { self.place(range[0]) } else { 0.0 } }
    }

    /// From the side of the square to a side through the point.
    pub(super) fn departure(&self, range: [f64; 2], rooms: &mut [Vec<Point>; 2]) -> Meeting {
        let piece = self.after.piece(self.from.range, range, rooms) - self.value;
        Meeting { piece, place: if range[1] - self.from.range[0] < PI { self.place(range[1]) } else { 1.0 } }
    }

    /// Where the line through the point meets the side, from its start.
    fn place(&self, angle: f64) -> f64 {
        let (line, side) = (Line::new(self.anchor, angle), Line::through(self.from.at, self.to.at));
        let place = -line.left(side.at) / (line.left(self.to.at) - line.left(side.at));
        if place.is_nan() { 0.5 } else { place.clamp(0.0, 1.0) }
    }
}

/// What a side of the square itself is worth: all below the top, nothing below the others.
pub(super) fn square_value(cloud: &Cloud, side: usize) -> f64 {
    if side == 2 { 1.0 - cloud.share.iter().sum::<f64>() } else { 0.0 }
}
