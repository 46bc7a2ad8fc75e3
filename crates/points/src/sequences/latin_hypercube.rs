//! Latin hypercube samples: every coordinate alone is spread as evenly as n points can be.
//!
//! One point in each of n equal slices of every axis, the slices of different axes matched at random.
//! All main effects are removed from the error, whatever the dimension and n: choose it for few and
//! costly evaluations of functions that are nearly sums. Interactions keep the error of independent
//! points (M. Stein, *Large sample properties of simulations using Latin hypercube sampling*, 1987).
//!
//! The permutations are computed, so that n points take no memory and any of them costs the same.

use std::ops::Range;

use super::Entry;
use crate::cells::Cells;
use crate::convert::unit_f64;
use crate::counts::counted_points;
use crate::instruction_sets::for_this_machine;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::seed::counted;
use crate::shuffle::{self, Shuffle};
use crate::unit::Unit;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "latin_hypercube",
    cite: "M. D. McKay, R. J. Beckman and W. J. Conover, A comparison of three methods for selecting values of input \
           variables, Technometrics 21, 239-245 (1979)",
    accepts: &[Randomization::None],
    takes: &["n"],
    most_dims: 1 << 20,
    build: |spec| {
        Ok(Box::new(LatinHypercube::new(spec.dims, counted_points("latin_hypercube", spec)?, spec.seed)))
    },
};

/// Coordinates that are made in one go at least, so that vector loops are long even if d is 1.
const PERIOD: usize = 256;

/// A Latin hypercube sample.
#[derive(Debug)]
pub struct LatinHypercube {
    dims: usize,
    n: u64,
    shuffle: Shuffle,
    cells: Cells,
    /// The keys of the permutations, for some rows.
    permutations: [Vec<u32>; 2],
    /// The two keys of the place within a slice, for some rows.
    places: [Vec<u64>; 2],
}

impl LatinHypercube {
    /// `n` points of `dims` coordinates, both at least 1, n at most 2^31.
    pub fn new(dims: usize, n: u64, seed: Seed) -> Self {
        let rows = PERIOD.div_ceil(dims);
        let key = |dim: usize, which| seed.dimension(dim as u64).split(0, which).bits64();
        let words = |which| (0..dims).map(|dim| key(dim, which)).collect::<Vec<_>>().repeat(rows);
        let keys: Vec<_> = words(0).into_iter().map(shuffle::keys).collect();
        Self {
            dims,
            n,
            shuffle: Shuffle::new(n),
            cells: Cells::new(n),
            permutations: [0, 1].map(|half| keys.iter().map(|key| key[half]).collect()),
            places: [words(1), words(2)],
        }
    }

    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        check_length(&rows, self.dims, out.len());
        let [first, step] = &self.permutations;
        let period = first.len();
        let (mut left, mut right, mut indices) = (vec![0; period], vec![0; period], vec![0; period]);
        let mut index = rows.start;
        let mut digits = self.shuffle.digits(index);
        for out in out.chunks_mut(period) {
            let places = out.len();
            for at in (0..places).step_by(self.dims) {
                left[at..at + self.dims].fill(digits[0]);
                right[at..at + self.dims].fill(digits[1]);
                indices[at..at + self.dims].fill(index);
                digits = self.shuffle.next(digits);
                index += 1;
            }
            let (left, right) = (&mut left[..places], &mut right[..places]);
            self.shuffle.images(left, right, [&first[..places], &step[..places]]);
            place(self.cells, [&indices, &self.places[0], &self.places[1]], left, out);
        }
    }
}

impl PointSet for LatinHypercube {
    fn dims(&self) -> usize {
        self.dims
    }

    fn len(&self) -> Option<u64> {
        Some(self.n)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims, self.n, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        assert!(dim < self.dims, "dimension {dim} of {}", self.dims);
        let keys = [self.permutations[0][dim], self.permutations[1][dim]];
        let cell = self.shuffle.image(index, keys);
        unit_f64(self.cells.place(cell as u32, counted(index, self.places[0][dim], self.places[1][dim])))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}

for_this_machine! {
    /// Slices to coordinates. `keys` are the index and the two keys of each place.
    place = place_body<T: Unit>(cells: Cells, keys: [&[u64]; 3], slices: &[u32], out: &mut [T])
}

#[inline(always)]
fn place_body<T: Unit>(cells: Cells, [indices, first, second]: [&[u64]; 3], slices: &[u32], out: &mut [T]) {
    for ((((x, &slice), &index), &first), &second) in
        out.iter_mut().zip(slices).zip(indices).zip(first).zip(second)
    {
        *x = T::from_word(cells.place(slice, counted(index, first, second)));
    }
}
