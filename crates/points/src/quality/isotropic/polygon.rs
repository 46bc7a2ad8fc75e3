//! Convex polygons in the unit square, by half-planes; the points that are judged, with their multiplicities.

use crate::quality::Rows;

pub(super) type Point = [f64; 2];

/// What rounding can make of nought: points closer than this to a line are on it.
pub(super) const TIE: f64 = 1e-13;

/// The unit square, counterclockwise.
pub(super) const SQUARE: [Point; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// Twice the area of a triangle, positive if it goes counterclockwise: if z is to the left of the way from a to b.
#[inline(always)]
pub(super) fn turn(a: Point, b: Point, z: Point) -> f64 {
    (b[0] - a[0]) * (z[1] - a[1]) - (b[1] - a[1]) * (z[0] - a[0])
}

/// A directed line: what is to its left is inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) at: Point,
    /// Of length 1.
    pub(super) along: Point,
}

impl Line {
    pub(super) fn new(at: Point, angle: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self { at, along: [cosine, sine] }
    }

    /// From a to another point.
    pub(super) fn through(a: Point, b: Point) -> Self {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        Self { at: a, along: [(b[0] - a[0]) / length, (b[1] - a[1]) / length] }
    }

    /// How far z is to the left.
    #[inline(always)]
    pub(super) fn left(&self, z: Point) -> f64 {
        self.along[0] * (z[1] - self.at[1]) - self.along[1] * (z[0] - self.at[0])
    }
}

/// Writes to `out` what of a convex polygon is to the left of a line.
pub(super) fn cut(polygon: &[Point], line: &Line, out: &mut Vec<Point>) {
    out.clear();
    let Some(&last) = polygon.last() else { return };
    let (mut a, mut left) = (last, line.left(last));
    for &b in polygon {
        let next = line.left(b);
        if (left > 0.0 && next < 0.0) || (left < 0.0 && next > 0.0) {
            let t = left / (left - next);
            out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        }
        if next >= 0.0 {
            out.push(b);
        }
        (a, left) = (b, next);
    }
}

pub(super) fn area(polygon: &[Point]) -> f64 {
    let Some((&first, rest)) = polygon.split_first() else { return 0.0 };
    0.5 * rest.windows(2).map(|edge| turn(first, edge[0], edge[1])).sum::<f64>()
}

/// The different points in the order of their coordinates, and how many there are of each.
#[derive(Debug)]
pub(super) struct Cloud {
    pub(super) x: Vec<Point>,
    /// Their numbers, as parts of all.
    pub(super) share: Vec<f64>,
}

impl Cloud {
    pub(super) fn new(rows: &Rows<'_>) -> Self {
        // adding 0 makes -0 the same as 0
        let mut sorted: Vec<Point> = rows.iter().map(|row| [row[0] + 0.0, row[1] + 0.0]).collect();
        sorted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let n = sorted.len() as f64;
        let groups = sorted.chunk_by(|a, b| a == b).map(|group| (group[0], group.len() as f64 / n));
        let (x, share) = groups.unzip();
        Self { x, share }
    }

    /// The points that an open set can have.
    pub(super) fn within(&self) -> Self {
        let inside = |x: &Point| x.iter().all(|&x| 0.0 < x && x < 1.0);
        let kept = self.x.iter().zip(&self.share).filter(|(x, _)| inside(x));
        let (x, share) = kept.map(|(&x, &share)| (x, share)).unzip();
        Self { x, share }
    }

    /// The part of the points that is in a convex polygon, perhaps one without area; on its sides too if it is closed.
    pub(super) fn part(&self, polygon: &[Point], closed: bool) -> f64 {
        let least = if closed { -TIE } else { TIE };
        let sorted = |a: &&Point, b: &&Point| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
        let ends = polygon.iter().min_by(sorted).zip(polygon.iter().max_by(sorted));
        let next = |i: usize| polygon[(i + 1) % polygon.len()];
        let inside = |z: Point| {
            ends.is_some_and(|(&first, &last)| first <= z && z <= last)
                && (0..polygon.len()).all(|i| is_left(polygon[i], next(i), z, least))
        };
        self.x.iter().zip(&self.share).filter(|(x, _)| inside(**x)).map(|(_, share)| share).sum()
    }
}

/// Whether z is to the left of a side by at least a distance; sides without length do not matter.
fn is_left(a: Point, b: Point, z: Point, least: f64) -> bool {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    length < TIE || turn(a, b, z) >= least * length
}
