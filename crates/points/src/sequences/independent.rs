//! Independent uniform points: plain Monte Carlo, the yardstick for all other sequences.
//!
//! Counter-based: a coordinate is a hash of (seed, dimension, index), so that random access costs no
//! more than the next point. Choose it to judge the others, or where independence itself is needed.

use std::ops::Range;

use super::Entry;
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::scramble::Scrambling;
use crate::seed::mix;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "independent",
    cite: "J. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC'11 (2011), with the hash of G. Steele, \
           D. Lea and C. Flood, Fast splittable pseudorandom number generators, OOPSLA (2014)",
    accepts: &[Scrambling::None],
    most_dims: 1 << 24,
    build: |dims, _, seed| Box::new(Independent::new(dims, seed)),
};

/// Independent uniform points.
#[derive(Debug)]
pub struct Independent {
    keys: Vec<[u64; 2]>,
}

impl Independent {
    /// Points of `dims` coordinates.
    pub fn new(dims: usize, seed: Seed) -> Self {
        let keys = (0..dims as u64).map(|dim| seed.dimension(dim));
        Self { keys: keys.map(|key| [key.split(0, 0).bits64(), key.split(0, 1).bits64()]).collect() }
    }
}

/// Two rounds with two keys: a single round would be one of `SplitMix64`'s streams, all of which are
/// parts of one cycle, so that two dimensions could overlap.
#[inline]
fn uniform(index: u64, [first, second]: [u64; 2]) -> f64 {
    unit_f64(mix(mix(first.wrapping_add(index)) ^ second))
}

impl PointSet for Independent {
    fn dims(&self) -> usize {
        self.keys.len()
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        uniform(index, self.keys[dim])
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        for (index, point) in rows.zip(out.chunks_exact_mut(self.dims())) {
            for (x, &keys) in point.iter_mut().zip(&self.keys) {
                *x = uniform(index, keys);
            }
        }
    }
}
