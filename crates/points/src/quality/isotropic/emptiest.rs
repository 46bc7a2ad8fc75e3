//! The convex set that has the fewest points for its area, between two bounds.
//!
//! The best open set is a polygon. For each point that is outside some half-plane has it on its edge, and contains the set; the
//! intersection of these and of the square has no further point and at least the area; and where it has the most, each of its sides
//! touches its point. So a polygon is a chain of anchored sides once around, and its value a sum over [`super::pieces`].
//! The directions of the sides are divided into equal sectors; a sweep over them finds the best chain of (anchor, sector), in which
//! each side may be bent within its sector: an upper bound. Its directions, improved one by one, give a real polygon: a lower bound.
//! Only chains that start and end at one anchor in one range of directions are closed; ranges are halved while
//! their bound is above what is known to be attained.

use std::f64::consts::{FRAC_PI_2, PI};
use std::num::NonZeroUsize;

use super::Convex;
use super::ascent::ascend;
use super::pieces::{Chord, Meeting, Meetings, NEVER, arrival, departure, square_value};
use super::polygon::{Cloud, Line, Point};

/// Both bounds.
pub(super) struct Bracket {
    pub(super) lower: Convex,
    pub(super) upper: f64,
}

/// Where a chain starts and ends.
#[derive(Clone, Copy, Debug)]
enum Start {
    /// At the left side of the square, with a range of places on it, from 0 at the top to 1.
    Left([f64; 2]),
    /// At a point, with a range of directions.
    Anchor(usize, [f64; 2]),
}

/// Bounds for the emptiest set; an upper bound below `known` need not be close.
pub(super) fn emptiest(cloud: &Cloud, sectors: usize, known: f64, workers: NonZeroUsize) -> Bracket {
    let anchors = cloud.within();
    let mut lower = ascend(&anchors, Vec::new());
    let quarters = (0..4).map(|quarter| f64::from(quarter - 3) * FRAC_PI_2);
    let ranges: Vec<_> = quarters.map(|low| [low, low + FRAC_PI_2]).collect();
    let each = |anchor: usize| ranges.iter().map(move |&range| Start::Anchor(anchor, range));
    let mut open: Vec<_> = (0..anchors.x.len()).flat_map(each).chain([Start::Left([0.0, 1.0])]).collect();
    let (mut upper, mut count) = (1.0, 8.min(sectors));
    while !open.is_empty() {
        let sweep = Sweep::new(&anchors, count);
        let mut leaves = Vec::new();
        while !open.is_empty() {
            let bounds = sweep.bounds(&open, workers);
            let mut order: Vec<_> = bounds.iter().zip(&open).collect();
            order.sort_by(|a, b| b.0.total_cmp(a.0));
            for (bound, start) in order.iter().take(TRIED) {
                if **bound > known.max(lower.value) {
                    let found = ascend(&anchors, sweep.chain(**start));
                    lower = if found.value > lower.value { found } else { lower };
                }
            }
            let least = known.max(lower.value) + TOLERANCE;
            let left = order.into_iter().filter(|(bound, _)| **bound > least);
            let (whole, halves): (Vec<_>, Vec<_>) = left.partition(|(_, start)| sweep.is_narrow(start));
            leaves.extend(whole.into_iter().map(|(&bound, &start)| (bound, start)));
            open = halves.into_iter().flat_map(|(_, &start)| halved(start)).collect();
        }
        let least = known.max(lower.value) + TOLERANCE;
        leaves.retain(|(bound, _)| *bound > least);
        upper = leaves.iter().map(|(bound, _)| *bound).fold(known.max(lower.value), f64::max);
        open = leaves.into_iter().map(|(_, start)| start).collect();
        count *= 2;
        if count > sectors {
            break;
        }
    }
    Bracket { lower, upper }
}

/// Chains of a round that are improved.
const TRIED: usize = 8;

/// Bounds closer than this are the same up to rounding.
const TOLERANCE: f64 = 1e-12;

fn halved(start: Start) -> [Start; 2] {
    let halves = |[low, high]: [f64; 2]| {
        let middle = 0.5 * (low + high);
        [[low, middle], [middle, high]]
    };
    match start {
        Start::Left(range) => halves(range).map(Start::Left),
        Start::Anchor(anchor, range) => halves(range).map(|range| Start::Anchor(anchor, range)),
    }
}

/// All pieces between points in one number of sectors, which go once around from straight down.
struct Sweep<'a> {
    anchors: &'a Cloud,
    count: usize,
    /// Of each pair of points, the sector of the chord, and where its pieces begin.
    pairs: Vec<(usize, usize)>,
    /// Piece by piece: for each sector of the first side back from that of the chord, those of the second from there on.
    pieces: Vec<f64>,
    /// Pieces to and from the sides of the square, and between these.
    arrivals: [Vec<Meeting>; 4],
    departures: [Vec<Meeting>; 4],
    corners: [f64; 4],
    /// Of each sector, the points along its direction.
    orders: Vec<Vec<usize>>,
}

impl<'a> Sweep<'a> {
    fn new(anchors: &'a Cloud, count: usize) -> Self {
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

    fn range(&self, sector: usize) -> [f64; 2] {
        [self.angle(sector), self.angle(sector + 1)]
    }

    fn sector(&self, angle: f64) -> usize {
        (((angle + FRAC_PI_2) / (2.0 * PI) * self.count as f64) as usize).min(self.count - 1)
    }

    fn is_narrow(&self, start: &Start) -> bool {
        match start {
            Start::Left([low, high]) => (high - low) * self.cells() as f64 <= 1.0 + 1e-9,
            Start::Anchor(_, [low, high]) => (high - low) * self.count as f64 <= 2.0 * PI * (1.0 + 1e-9),
        }
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
    fn cells(&self) -> usize {
        4 * self.count
    }

    fn cell(&self, place: f64) -> usize {
        ((place * self.cells() as f64) as usize).min(self.cells() - 1)
    }

    /// The number of a chain to a side of the square and a cell in which the corner before is, or later.
    fn at_cell(&self, side: usize, cell: usize) -> usize {
        self.anchors.x.len() * self.count + side * self.cells() + cell
    }

    /// The pieces from a side through i to sides through j, from the sector of the chord on.
    fn pieces(&self, i: usize, sector: usize, j: usize) -> (usize, &[f64]) {
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

    fn bounds(&self, starts: &[Start], workers: NonZeroUsize) -> Vec<f64> {
        let share = starts.len().div_ceil(workers.get()).max(1);
        let part =
            |starts: &[Start]| starts.iter().map(|&start| Run::new(self, start).value).collect::<Vec<_>>();
        std::thread::scope(|scope| {
            let threads: Vec<_> =
                starts.chunks(share).map(|starts| scope.spawn(move || part(starts))).collect();
            threads.into_iter().flat_map(|thread| thread.join().expect("sweeping does not fail")).collect()
        })
    }
}

/// The best chains from one start.
struct Run<'a> {
    sweep: &'a Sweep<'a>,
    /// The first pieces, and the best chains, to each side of a polygon: n · count through points, then those of the square.
    first: Vec<f64>,
    best: Vec<f64>,
    /// The last pieces.
    last: Vec<f64>,
    /// Of the best closed chain.
    value: f64,
}

impl<'a> Run<'a> {
    fn new(sweep: &'a Sweep<'a>, start: Start) -> Self {
        let (first, last) = match start {
            Start::Left(places) => sweep.at_left(places),
            Start::Anchor(anchor, range) => sweep.at_anchor(anchor, range),
        };
        let mut run = Self { sweep, best: first.clone(), first, last, value: NEVER };
        for sector in 0..sweep.count {
            if sector > 0 && (4 * sector).is_multiple_of(sweep.count) {
                run.leave_square(4 * sector / sweep.count - 1);
            }
            for &i in &sweep.orders[sector] {
                run.leave_point(i, sector);
            }
        }
        // the leftmost anchor has been counted as −1
        let correction = match start {
            Start::Left(_) => 0.0,
            Start::Anchor(anchor, _) => sweep.anchors.share[anchor],
        };
        run.value = -correction + run.best.iter().zip(&run.last).map(|(a, b)| a + b).fold(NEVER, f64::max);
        run
    }

    fn leave_point(&mut self, i: usize, sector: usize) {
        let (n, count) = (self.sweep.anchors.x.len(), self.sweep.count);
        let value = self.best[i * count + sector];
        if value == NEVER {
            return;
        }
        for j in 0..n {
            let (begin, pieces) = self.sweep.pieces(i, sector, j);
            let reached = &mut self.best[j * count + begin..][..pieces.len()];
            reached.iter_mut().zip(pieces).for_each(|(best, piece)| *best = best.max(value + piece));
        }
        for side in 0..3 {
            if sector < (side + 1) * count / 4 {
                let meeting = self.sweep.arrivals[side][i * count + sector];
                let reached = &mut self.best[self.sweep.at_cell(side, self.sweep.cell(meeting.place))];
                *reached = reached.max(value + meeting.piece);
            }
        }
    }

    fn leave_square(&mut self, side: usize) {
        let (count, cells) = (self.sweep.count, self.sweep.cells());
        let begin = self.sweep.at_cell(side, 0);
        for at in begin + 1..begin + cells {
            self.best[at] = self.best[at].max(self.best[at - 1]);
        }
        for (number, meeting) in self.sweep.departures[side].iter().enumerate() {
            if number % count >= (side + 1) * count / 4 {
                let value = self.best[begin + self.sweep.cell(meeting.place)];
                self.best[number] = self.best[number].max(value + meeting.piece);
            }
        }
        if side < 2 {
            let value = self.best[begin + cells - 1] + self.sweep.corners[side];
            self.best[begin + cells] = self.best[begin + cells].max(value);
        }
    }

    /// The sides of the best closed chain that are not those of the square, last to first.
    fn sides(&self) -> Vec<(usize, usize)> {
        let count = self.sweep.count;
        let total = |number: usize| self.best[number] + self.last[number];
        let Some(mut at) = (0..self.best.len()).max_by(|&a, &b| total(a).total_cmp(&total(b))) else {
            return Vec::new();
        };
        let mut found = Vec::new();
        loop {
            if at < self.sweep.anchors.x.len() * count {
                found.push((at / count, at % count));
            }
            match self.before(at) {
                Some(before) if self.first[at] != self.best[at] => at = before,
                _ => return found,
            }
        }
    }

    /// The side before, whose chain and piece make exactly this chain's value.
    fn before(&self, at: usize) -> Option<usize> {
        (0..self.best.len())
            .find(|&from| from != at && self.best[at] == self.best[from] + self.piece(from, at))
    }

    /// The piece between two numbered sides; nought from a cell to the next.
    fn piece(&self, from: usize, at: usize) -> f64 {
        let (sweep, count) = (self.sweep, self.sweep.count);
        let points = sweep.anchors.x.len() * count;
        let cell = |number: usize| {
            number.checked_sub(points).map(|cell| (cell / sweep.cells(), cell % sweep.cells()))
        };
        let meets = |meeting: Meeting, cell: usize| sweep.cell(meeting.place) == cell;
        match (cell(from), cell(at)) {
            (None, None) => {
                let (begin, pieces) = sweep.pieces(from / count, from % count, at / count);
                (at % count).checked_sub(begin).and_then(|later| pieces.get(later)).copied().unwrap_or(NEVER)
            }
            (None, Some((side, cell))) => {
                let meeting = sweep.arrivals[side][from];
                if meets(meeting, cell) { meeting.piece } else { NEVER }
            }
            (Some((side, cell)), None) => {
                let meeting = sweep.departures[side][at];
                if meets(meeting, cell) { meeting.piece } else { NEVER }
            }
            (Some((side, _)), Some((next, 0))) if next == side + 1 && at == from + 1 => sweep.corners[side],
            (Some((side, _)), Some((same, _))) if same == side && at == from + 1 => 0.0,
            (Some(_), Some(_)) => NEVER,
        }
    }
}

impl Sweep<'_> {
    /// No first or last pieces.
    fn no_ends(&self) -> [Vec<f64>; 2] {
        let length = self.at_cell(3, 0);
        [vec![NEVER; length], vec![NEVER; length]]
    }

    /// First and last pieces of chains that touch the left side of the square, and leave it at one of these places.
    fn at_left(&self, [low, high]: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
        let [mut first, mut last] = self.no_ends();
        for (number, meeting) in self.departures[3].iter().enumerate() {
            first[number] = if meeting.place >= low { meeting.piece } else { NEVER };
        }
        for (number, meeting) in self.arrivals[3].iter().enumerate() {
            last[number] = if meeting.place <= high { meeting.piece } else { NEVER };
        }
        if high >= 1.0 {
            first[self.at_cell(0, 0)] = self.corners[3];
        }
        last[self.at_cell(2, self.cells() - 1)] = self.corners[2];
        (first, last)
    }

    /// First and last pieces of chains whose leftmost anchor this is: chords go from it to the right, and come from there.
    fn at_anchor(&self, anchor: usize, range: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
        let (x, again) = (&self.anchors.x, range.map(|angle| angle + 2.0 * PI));
        let [mut first, mut last] = self.no_ends();
        let mut rooms = [Vec::new(), Vec::new()];
        for (j, &other) in x.iter().enumerate().skip(anchor + 1) {
            let [there, back] =
                [(x[anchor], other), (other, x[anchor])].map(|(a, b)| Chord::new(self.anchors, a, b));
            for sector in 0..self.count {
                let (number, own) = (j * self.count + sector, self.range(sector));
                first[number] = there.piece(range, own, &mut rooms);
                last[number] = back.piece(own, again, &mut rooms);
            }
        }
        for side in 0..2 {
            let meeting = Meetings::new(self.anchors, x[anchor], side).arrival(range, &mut rooms);
            first[self.at_cell(side, self.cell(meeting.place))] = meeting.piece;
            let meeting = Meetings::new(self.anchors, x[anchor], side + 1).departure(again, &mut rooms);
            last[self.at_cell(side + 1, self.cell(meeting.place))] = meeting.piece;
        }
        (first, last)
    }

    /// The sides of the best closed chain as lines, each in the middle of its sector.
    fn chain(&self, start: Start) -> Vec<Line> {
        let line =
            |anchor: usize, [low, high]: [f64; 2]| Line::new(self.anchors.x[anchor], 0.5 * (low + high));
        let between = Run::new(self, start).sides().into_iter();
        let mut lines: Vec<_> = between.map(|(anchor, sector)| line(anchor, self.range(sector))).collect();
        if let Start::Anchor(anchor, range) = start {
            lines.push(line(anchor, range));
        }
        lines
    }
}
