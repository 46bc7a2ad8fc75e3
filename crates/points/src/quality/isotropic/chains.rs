//! Chains of sides once around, from a start back to it: a sweep over the sectors, each side after the one before it.

use std::f64::consts::PI;
use std::num::NonZeroUsize;

use super::pieces::{Chord, Meeting, Meetings, NEVER};
use super::polygon::Line;
use super::sectors::Sweep;

/// Where a chain starts and ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start {
    /// At the left side of the square, with a range of places on it, from 0 at the top to 1.
    Left([f64; 2]),
    /// At a point, with a range of directions.
    Anchor(usize, [f64; 2]),
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
    pub(super) fn chain(&self, start: Start) -> Vec<Line> {
        let line =
            |anchor: usize, [low, high]: [f64; 2]| Line::new(self.anchors.x[anchor], 0.5 * (low + high));
        let between = Run::new(self, start).sides().into_iter();
        let mut lines: Vec<_> = between.map(|(anchor, sector)| line(anchor, self.range(sector))).collect();
        if let Start::Anchor(anchor, range) = start {
            lines.push(line(anchor, range));
        }
        lines
    }

    /// The most that closed chains from each start can be worth.
    pub(super) fn bounds(&self, starts: &[Start], workers: NonZeroUsize) -> Vec<f64> {
        let share = starts.len().div_ceil(workers.get()).max(1);
        let part =
            |starts: &[Start]| starts.iter().map(|&start| Run::new(self, start).value).collect::<Vec<_>>();
        std::thread::scope(|scope| {
            let threads: Vec<_> =
                starts.chunks(share).map(|starts| scope.spawn(move || part(starts))).collect();
            threads.into_iter().flat_map(|thread| thread.join().expect("sweeping does not fail")).collect()
        })
    }

    /// Whether a start needs not be divided further in this number of sectors.
    pub(super) fn is_narrow(&self, start: &Start) -> bool {
        match start {
            Start::Left([low, high]) => (high - low) * self.cells() as f64 <= 1.0 + 1e-9,
            Start::Anchor(_, [low, high]) => (high - low) * self.count as f64 <= 2.0 * PI * (1.0 + 1e-9),
        }
    }
}
