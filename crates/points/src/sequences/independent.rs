//! Independent uniform points: plain Monte Carlo, the yardstick for all other sequences.
//!
//! Counter-based: a coordinate is a hash of (seed, dimension, index), so that random access costs no
//! more than the next point. Choose it to judge the others, or where independence itself is needed.

use std::ops::Range;

use super::Entry;
use crate::convert::{Unit, unit_f64};
use crate::instruction_sets::for_this_machine;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::seed::counted;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "independent",
    cite: "J. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC'11 (2011), with the hash of G. Steele, \
           D. Lea and C. Flood, Fast splittable pseudorandom number generators, OOPSLA (2014)",
    accepts: &[Randomization::None],
    takes: &[],
    most_dims: 1 << 24,
    build: |spec| Ok(Box::new(Independent::new(spec.dims, spec.seed))),
};

/// Coordinates that are made in one go at least, so that vector loops are long even if d is 1.
const PERIOD: usize = 256;

/// Independent uniform points.
#[derive(Debug)]
pub struct Independent {
    dims: usize,
    /// The two keys of each coordinate, for some rows: the row is added to the first of them.
    keys: [Vec<u64>; 2],
}

impl Independent {
    /// Points of `dims` coordinates.
    ///
    /// # Panics
    /// If `dims` is 0.
    pub fn new(dims: usize, seed: Seed) -> Self {
        let rows = PERIOD.div_ceil(dims) as u64;
        let key = |dim, which| seed.dimension(dim).split(0, which).bits64();
        let first: Vec<_> = (0..dims as u64).map(|dim| key(dim, 0)).collect();
        let first = (0..rows).flat_map(|row| first.iter().map(move |key| key.wrapping_add(row))).collect();
        let second: Vec<_> = (0..dims as u64).map(|dim| key(dim, 1)).collect();
        Self { dims, keys: [first, second.repeat(rows as usize)] }
    }

    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        check_length(&rows, self.dims, out.len());
        let [first, second] = &self.keys;
        let starts = rows.step_by(first.len() / self.dims);
        starts
            .zip(out.chunks_mut(first.len()))
            .for_each(|(start, out)| uniform_rows(start, first, second, out));
    }
}

impl PointSet for Independent {
    fn dims(&self) -> usize {
        self.dims
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        assert!(dim < self.dims, "dimension {dim} of {}", self.dims);
        unit_f64(counted(index, self.keys[0][dim], self.keys[1][dim]))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}

for_this_machine! {
    /// Rows from `start` on, as many as there are keys for.
    uniform_rows = uniform_rows_body<T: Unit>(start: u64, first: &[u64], second: &[u64], out: &mut [T])
}

#[inline(always)]
fn uniform_rows_body<T: Unit>(start: u64, first: &[u64], second: &[u64], out: &mut [T]) {
    for ((x, &first), &second) in out.iter_mut().zip(first).zip(second) {
        *x = T::from_word(counted(start, first, second));
    }
}
