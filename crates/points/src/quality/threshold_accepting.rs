//! Lower bounds of the star discrepancy where the exact one is out of reach: a walk among critical boxes.
//!
//! The walk accepts a neighbor unless it is better by far than where it would lead; the threshold falls, and so does the
//! size of the neighborhood, from all of the grid to the next lines. Every candidate is first snapped to a box that no larger
//! box with the same points beats (open ones, with too few points) or no smaller one (closed ones), in both ways. What it
//! returns is the discrepancy of a real box, a bound from below. O(n d) for a step.
//!
//! M. Gnewuch, M. Wahlström and C. Winzen, *A new randomized algorithm to approximate the star discrepancy based on threshold
//! accepting*, SIAM J. Numer. Anal. 50, 2012. Thresholds come from the differences on a random walk, as there; a trial is
//! one walk, and steps are shared among trials.

use super::Rows;
use super::cuts::Cuts;
use super::sweep::Extremum;
use crate::Seed;
use crate::convert::unit_f64;

/// How long to walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Independent walks, half of them for open boxes.
    pub trials: u32,
    /// Steps of each.
    pub steps: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { trials: 10, steps: 4096 }
    }
}

/// The worst box that was met; the same for the same seed.
pub fn threshold_accepting(rows: &Rows<'_>, effort: Effort, seed: Seed) -> Extremum {
    let cuts = Cuts::new(rows);
    let walks = (0..effort.trials).map(|trial| {
        Walk { cuts: &cuts, closed: trial % 2 == 1, seed: seed.replicate(u64::from(trial)), drawn: 0 }
            .run(effort.steps)
    });
    let best = walks.fold(Extremum::none(cuts.dims), Extremum::or);
    // counted anew, so that it is what anyone finds who counts
    Extremum::at(rows, best.corner, best.closed)
}

/// One walk.
struct Walk<'a> {
    cuts: &'a Cuts,
    closed: bool,
    seed: Seed,
    drawn: u64,
}

/// Where the walk is, the box it was snapped to, and the discrepancy of that.
#[derive(Clone)]
struct Place {
    cuts: Vec<u32>,
    snapped: Vec<u32>,
    value: f64,
}

impl Walk<'_> {
    fn run(&mut self, steps: u32) -> Extremum {
        let thresholds = self.thresholds(f64::from(steps).sqrt().ceil() as u32);
        let mut here = self.random_place();
        let mut best = here.clone();
        let rounds = thresholds.len() as u32;
        for (round, threshold) in thresholds.into_iter().enumerate() {
            for step in 0..steps / rounds {
                let done = f64::from(round as u32 * (steps / rounds) + step) / f64::from(steps);
                let there = self.neighbor(&here, done);
                if there.value - here.value >= threshold {
                    here = there;
                }
                if here.value > best.value {
                    best = here.clone();
                }
            }
        }
        let corner = best.snapped.iter().enumerate().map(|(dim, &cut)| self.face(dim, cut)).collect();
        Extremum { value: best.value, corner, closed: self.closed }
    }

    /// Losses between neighbors, the largest first: what the walk may lose in each of its rounds.
    fn thresholds(&mut self, rounds: u32) -> Vec<f64> {
        let loss = |walk: &mut Self| {
            let place = walk.random_place();
            let there = walk.neighbor(&place, 0.5);
            -(there.value - place.value).abs()
        };
        let mut found: Vec<f64> = (0..rounds.max(1)).map(|_| loss(self)).collect();
        found.sort_unstable_by(f64::total_cmp);
        found
    }

    /// A uniform number.
    fn draw(&mut self) -> f64 {
        self.drawn += 1;
        unit_f64(self.seed.split(16, self.drawn).bits64())
    }

    /// The d-th root of a uniform number is the side of a box as likely small as large by volume.
    fn random_side(&mut self) -> f64 {
        let dims = self.cuts.dims as f64;
        self.draw().powf(1.0 / dims)
    }

    fn random_place(&mut self) -> Place {
        let cuts = (0..self.cuts.dims)
            .map(|dim| {
                let side = self.random_side();
                self.cuts.cut_at(dim, side)
            })
            .collect();
        self.snap(cuts)
    }

    /// A box that differs in more and more coordinates, by less and less.
    fn neighbor(&mut self, place: &Place, done: f64) -> Place {
        let dims = self.cuts.dims;
        let power = dims as f64;
        let moving = (2.0 + done * (power - 2.0)).min(power).round() as usize;
        let mut cuts = place.cuts.clone();
        for _ in 0..moving {
            let dim = (self.draw() * power) as usize;
            let most = self.cuts.most(dim);
            let reach = 1 + (f64::from(most) * 0.5 * (1.0 - done)) as u32;
            let (least, most) = (cuts[dim].saturating_sub(reach).max(1), (cuts[dim] + reach).min(most));
            cuts[dim] = if self.draw() < 0.5 {
                // by volume, as the boxes are distributed that matter in general position
                let (low, high) =
                    (self.cuts.shrunk(dim, least).powf(power), self.cuts.grown(dim, most).powf(power));
                let side = (low + (high - low) * self.draw()).powf(power.recip());
                self.cuts.cut_at(dim, side).clamp(least, most)
            } else {
                // by rank, which finds the faces of tied points
                (least + (self.draw() * f64::from(most - least + 1)) as u32).min(most)
            };
        }
        self.snap(cuts)
    }

    /// Where the face of a box is.
    fn face(&self, dim: usize, cut: u32) -> f64 {
        if self.closed { self.cuts.shrunk(dim, cut) } else { self.cuts.grown(dim, cut) }
    }

    /// Moves all faces as far as they may with the same points inside, one after the other from a random one on.
    fn snap(&mut self, cuts: Vec<u32>) -> Place {
        let mut snapped = cuts.clone();
        let dims = self.cuts.dims;
        let first = (self.draw() * dims as f64) as usize;
        let mut points = 0;
        if self.closed {
            let mut reached = vec![0; dims];
            for ranks in (0..self.cuts.n).map(|point| self.cuts.ranks(point)) {
                if ranks.iter().zip(&cuts).all(|(rank, cut)| rank < cut) {
                    points += 1;
                    reached
                        .iter_mut()
                        .zip(ranks)
                        .for_each(|(reached, rank)| *reached = (rank + 1).max(*reached));
                }
            }
            snapped = reached;
        } else {
            points = self.grow(&mut snapped, first);
        }
        let volume: f64 = snapped.iter().enumerate().map(|(dim, &cut)| self.face(dim, cut)).product();
        let share = points as f64 / self.cuts.n as f64;
        let value = if !self.closed {
            volume - share
        } else if points == 0 {
            f64::MIN
        } else {
            share - volume
        };
        Place { cuts, snapped, value }
    }

    /// Moves the faces out until each is stopped by a point. Returns the points inside.
    fn grow(&self, cuts: &mut [u32], first: usize) -> usize {
        let dims = self.cuts.dims;
        let before = cuts.to_vec();
        // points that are beyond one face only stop that face; those beyond several do when only one is left
        let mut stops: Vec<u32> = Vec::new();
        let mut points = 0;
        for point in 0..self.cuts.n {
            let beyond = self.cuts.ranks(point).iter().zip(&before).filter(|(rank, cut)| rank >= cut).count();
            points += usize::from(beyond == 0);
            if beyond > 0 {
                stops.push(point as u32);
            }
        }
        for dim in (0..dims).map(|step| (first + step) % dims) {
            let only_here = |&point: &u32| {
                let ranks = self.cuts.ranks(point as usize);
                (ranks.iter().zip(&*cuts).enumerate())
                    .all(|(other, (rank, cut))| other == dim || rank < cut)
                    .then(|| ranks[dim])
            };
            let stop = stops.iter().filter_map(only_here).min();
            cuts[dim] = stop.unwrap_or(self.cuts.most(dim)).max(cuts[dim]);
        }
        points
    }
}
