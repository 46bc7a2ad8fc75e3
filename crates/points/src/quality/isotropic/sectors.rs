//! All pieces of polygons whose sides have their directions in equal sectors, which go once around from straight down.

use std::f64::consts::{FRAC_PI_2, PI};

use super::pieces::{Chord, Meeting, Meetings, NEVER, arrival, departure, square_value};
use super::polygon::{Cloud, Point};

/// All pieces between points in one number of sectors, which go once around from straight down.
pub(super) struct Sweep<'a> {
    pub(super) anchors: &'a Cloud,
    pub(super) count: usize,
    /// Of each pair of points, the sector of the chord, and where its pieces begin.
    pairs: Vec<(usize, usize)>,
    /// Piece by piece: for each sector of the first side back from that of the chord, those of the second from there on.
    pieces: Vec<f64>,
    /// Pieces to and from the sides of the square, and between these.
    pub(super) arrivals: [Vec<Meeting>; 4],
    pub(super) departures: [Vec<Meeting>; 4],
    pub(super) corners: [f64; 4],
    /// Of each sector, the points along its direction.
    pub(super) orders: Vec<Vec<usize>>,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(anchors: &'a Cloud, count: usize) -> Self {
        let n = anchors.x.len();
        let none = || std::array::from_fn(|_| Vec::with_capacity(n * count));
        let mut made = Self {
            anchors,
            count,
            pairs: Vec::with_capacity(n * n),
            pieces: Vec::new(),
            arrivals: none(),
            departures: none(),
            corners: [NEVER; 4],
            orders: Vec::with_capacity(count),
        };
        let mut rooms = [Vec::new(), Vec::new()];
        made.between_points(&mut rooms);
        made.at_square(&mut rooms);
        for sector in 0..count {
            let [low, high] = made.range(sector);
            let (sine, cosine) = (0.5 * (low + high)).sin_cos();
            let along = |i: usize| cosine * anchors.x[i][0] + sine * anchors.x[i][1];
            let mut order: Vec<_> = (0..n).collect();
            order.sort_by(|&a, &b| along(a).total_cmp(&along(b)));
            made.orders.push(order);
        }
        made
    }

    fn angle(&self, boundary: usize) -> f64 {
        boundary as f64 / self.count as f64 * (2.0 * PI) - FRAC_PI_2
    }

    pub(super) fn range(&self, sector: usize) -> [f64; 2] {
        [self.angle(sector), self.angle(sector + 1)]
    }

    fn sector(&self, angle: f64) -> usize {
        (((angle + FRAC_PI_2) / (2.0 * PI) * self.count as f64) as usize).min(self.count - 1)
    }

    fn between_points(&mut self, rooms: &mut [Vec<Point>; 2]) {
        let half = self.count / 2;
        for (i, &a) in self.anchors.x.iter().enumerate() {
            for (j, &b) in self.anchors.x.iter().enumerate() {
                if i == j {
                    self.pairs.push((0, 0));
                    continue;
                }
                let chord = Chord::new(self.anchors, a, b);
                let middle = self.sector(chord.angle);
                self.pairs.push((middle, self.pieces.len()));
                for first in (middle.saturating_sub(half)..=middle).rev() {
                    for second in middle..=first + half {
                        let (from, to) = (self.range(first), self.range(second));
                        let exists = second < self.count;
                        self.pieces.push(if exists { chord.piece(from, to, rooms) } else { NEVER });
                    }
                }
            }
        }
    }

    fn at_square(&mut self, rooms: &mut [Vec<Point>; 2]) {
        let ranges: Vec<_> = (0..self.count).map(|sector| self.range(sector)).collect();
        for side in 0..4 {
            for &x in &self.anchors.x {
                let meetings = Meetings::new(self.anchors, x, side);
                for range in ranges.iter().copied() {
                    self.arrivals[side].push(meetings.arrival(range, rooms));
                    self.departures[side].push(meetings.departure(range, rooms));
                }
            }
            let (from, next) = (departure(side), arrival((side + 1) % 4));
            let chord = Chord::new(self.anchors, from.at, next.at);
            self.corners[side] =
                chord.piece(from.range, next.range, rooms) - square_value(self.anchors, side);
        }
    }

    /// Cells of each side of the square.
    pub(super) fn cells(&self) -> usize {
        4 * self.count
    }

    pub(super) fn cell(&self, place: f64) -> usize {
        ((place * self.cells() as f64) as usize).min(self.cells() - 1)
    }

    /// The number of a chain to a side of the square and a cell in which the corner before is, or later.
    pub(super) fn at_cell(&self, side: usize, cell: usize) -> usize {
        self.anchors.x.len() * self.count + side * self.cells() + cell
    }

    /// The pieces from a side through i to sides through j, from the sector of the chord on.
    pub(super) fn pieces(&self, i: usize, sector: usize, j: usize) -> (usize, &[f64]) {
        let half = self.count / 2;
        let (middle, begin) = self.pairs[i * self.anchors.x.len() + j];
        if i == j || sector > middle || middle - sector > half {
            return (0, &[]);
        }
        let back = middle - sector;
        let skipped = back * (half + 1) - back * back.saturating_sub(1) / 2;
        let length = (half + 1 - back).min(self.count - middle);
        (middle, &self.pieces[begin + skipped..][..length])
    }
}
