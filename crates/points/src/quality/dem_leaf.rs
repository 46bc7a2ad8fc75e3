//! A cell of boxes in which every point is open in one coordinate at the most: dynamic programming.
//!
//! A box of the cell has the points that all its boxes have, and of each coordinate's open points those below its
//! cut. For too few points: the largest volume for every number of open points, one coordinate after the other;
//! for too many: the least volume for every number of open points left out. Only as many are tried as could
//! beat the box that is known.

use super::cuts::Cuts;
use super::dem::Live;
use super::sweep::Extremum;

/// The boxes of a cell.
pub(super) struct Leaf<'a> {
    pub(super) cuts: &'a Cuts,
    /// The least and the largest cut of each coordinate.
    pub(super) ranges: &'a [(u32, u32)],
    /// The points that some box contains, in the order of the last coordinate.
    pub(super) live: &'a [Live],
    /// From where on they are open in the last coordinate, whatever `open` says.
    pub(super) first_open: usize,
    /// How many of them all boxes contain.
    pub(super) below: usize,
    /// The largest volume of an open, the least of a closed box.
    pub(super) grown: f64,
    pub(super) shrunk: f64,
}

/// What a coordinate may choose: so many points, this factor of the volume, by this cut.
type Choice = (usize, f64, u32);

impl Leaf<'_> {
    /// How many of the open points a box may have that has too few of them; None if none can beat `known`.
    fn may_have(&self, known: f64) -> Option<usize> {
        self.affordable((self.grown - known) * self.cuts.n as f64 - self.below as f64)
    }

    /// How many of the open points a box may lack that has too many of them.
    fn may_lack(&self, known: f64) -> Option<usize> {
        self.affordable(self.live.len() as f64 - (self.shrunk + known) * self.cuts.n as f64)
    }

    /// Whole points, rounded such that no box is lost.
    fn affordable(&self, points: f64) -> Option<usize> {
        (points >= -1e-9).then(|| ((points + 1e-9).max(0.0) as usize).min(self.live.len() - self.below))
    }

    /// About how many steps [`Leaf::search`] takes.
    pub(super) fn steps(&self, known: f64) -> f64 {
        let sides = [self.may_have(known), self.may_lack(known)];
        let one = |most: usize| self.live.len() as f64 + ((self.live.len() - self.below) * (most + 1)) as f64;
        8.0 + sides.into_iter().flatten().map(one).sum::<f64>()
    }

    /// Replaces `best` by a worse box of this cell, if there is one.
    pub(super) fn search(&self, best: &mut Extremum) {
        let (few, many) = (self.may_have(best.value), self.may_lack(best.value));
        if few.is_none() && many.is_none() {
            return;
        }
        let open = self.open_ranks();
        for (closed, most) in [(false, few), (true, many)] {
            if let Some(most) = most {
                let choices: Vec<_> =
                    (0..self.ranges.len()).map(|dim| self.choices(dim, &open[dim], closed, most)).collect();
                self.combine(&choices, closed, most, best);
            }
        }
    }

    /// The ranks of the points that each coordinate leaves open, ascending.
    fn open_ranks(&self) -> Vec<Vec<u32>> {
        let last = self.ranges.len() - 1;
        let mut open = vec![Vec::new(); self.ranges.len()];
        for (at, live) in self.live.iter().enumerate() {
            let dim = if at >= self.first_open { last } else { usize::from(live.open) };
            if dim <= last {
                open[dim].push(self.cuts.ranks(live.point as usize)[dim]);
            }
        }
        open[..last].iter_mut().for_each(|ranks| ranks.sort_unstable());
        open
    }

    /// The cuts of one coordinate that no other beats, fewest points (had or left out) first.
    fn choices(&self, dim: usize, open: &[u32], closed: bool, most: usize) -> Vec<Choice> {
        let (least, largest) = self.ranges[dim];
        let mut found = Vec::with_capacity(most.min(open.len()) + 1);
        if closed {
            for (lacking, &rank) in open.iter().rev().enumerate().take(most + 1) {
                // all points of the same rank are inside together
                if lacking == 0 || open[open.len() - lacking] != rank {
                    found.push((lacking, self.cuts.shrunk(dim, rank + 1), rank + 1));
                }
            }
            found.push((open.len(), self.cuts.shrunk(dim, least), least.max(1)));
        } else {
            for (having, &rank) in open.iter().enumerate().take(most + 1) {
                if having == 0 || open[having - 1] != rank {
                    found.push((having, self.cuts.grown(dim, rank), rank));
                }
            }
            found.push((open.len(), self.cuts.grown(dim, largest), largest));
        }
        found
    }

    /// One choice of each coordinate, such that the box is worst.
    fn combine(&self, choices: &[Vec<Choice>], closed: bool, most: usize, best: &mut Extremum) {
        let better = |new: f64, old: f64| if closed { new < old } else { new > old };
        let hopeless = if closed { f64::INFINITY } else { f64::NEG_INFINITY };
        let mut tables = vec![hopeless; (choices.len() + 1) * (most + 1)];
        tables[0] = 1.0;
        for (dim, choices) in choices.iter().enumerate() {
            let (before, after) = tables[dim * (most + 1)..][..2 * (most + 1)].split_at_mut(most + 1);
            for &(points, factor, _) in choices.iter().filter(|choice| choice.0 <= most) {
                for (new, &old) in after[points..].iter_mut().zip(&*before) {
                    // an infinite entry stays infinite unless the factor is 0
                    let volume = if old == hopeless { hopeless } else { old * factor };
                    *new = if better(volume, *new) { volume } else { *new };
                }
            }
        }
        let n = self.cuts.n as f64;
        for (points, &volume) in tables[choices.len() * (most + 1)..].iter().enumerate() {
            let value = if closed {
                (self.live.len() - points) as f64 / n - volume
            } else {
                volume - (self.below + points) as f64 / n
            };
            if value > best.value {
                let corner = Self::trace(choices, &tables, points);
                *best = Extremum { value, corner, closed };
            }
        }
    }

    /// The corner of the box behind an entry of the last table.
    fn trace(choices: &[Vec<Choice>], tables: &[f64], mut points: usize) -> Vec<f64> {
        let width = tables.len() / (choices.len() + 1);
        let mut corner = vec![0.0; choices.len()];
        for (dim, choices) in choices.iter().enumerate().rev() {
            let volume = tables[(dim + 1) * width + points];
            let made = |choice: &&Choice| {
                choice.0 <= points && tables[dim * width + points - choice.0] * choice.1 == volume
            };
            let &(own, factor, _) = choices.iter().find(made).expect("an entry was made by a choice");
            (corner[dim], points) = (factor, points - own);
        }
        corner
    }
}
