//! Latin hypercube samples: every coordinate alone is spread as evenly as n points can be.
//!
//! One point in each of n equal slices of every axis, the slices of different axes matched at random.
//! All main effects are removed from the error, whatever the dimension and n: choose it for few and
//! costly evaluations of functions that are nearly sums. Interactions keep the error of independent
//! points (M. Stein, *Large sample properties of simulations using Latin hypercube sampling*, 1987).
//!
//! The place within a slice is a hash of a counter that takes odd steps of its own in each coordinate, which are different
//! generators (G. Steele, D. Lea and C. Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014). The permutations are
//! computed, so that n points take no memory and any of them costs the same.

use std::ops::Range;

use super::Entry;
use crate::cells::Cells;
use crate::convert::unit_f64;
use crate::counts::counted_points;
use crate::instruction_sets::for_this_machine;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::seed::mix;
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
    /// The words whose hash is the place within a slice, for the first rows.
    places: Vec<u64>,
    /// What they grow by from one row to the next: an odd number for each coordinate.
    strides: Vec<u64>,
}

impl LatinHypercube {
    /// `n` points of `dims` coordinates, both at least 1, n at most 2^31.
    pub fn new(dims: usize, n: u64, seed: Seed) -> Self {
        let rows = PERIOD.div_ceil(dims);
        let key = |dim: usize, which| seed.dimension(dim as u64).split(0, which).bits64();
        let words = |which| (0..dims).map(|dim| key(dim, which)).collect::<Vec<_>>().repeat(rows);
        let strides: Vec<_> = words(2).into_iter().map(|word| word | 1).collect();
        let later = |(at, (word, stride)): (usize, (u64, &u64))| {
            word.wrapping_add(stride.wrapping_mul((at / dims) as u64))
        };
        let keys: Vec<_> = words(0).into_iter().map(shuffle::keys).collect();
        Self {
            dims,
            n,
            shuffle: Shuffle::new(n),
            cells: Cells::new(n),
            permutations: [0, 1].map(|half| keys.iter().map(|key| key[half]).collect()),
            places: words(1).into_iter().zip(&strides).enumerate().map(later).collect(),
            strides,
        }
    }

    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        check_length(&rows, self.dims, out.len());
        let [first, step] = &self.permutations;
        let period = first.len();
        let (mut left, mut right) = (vec![0; period], vec![0; period]);
        let (mut words, steps) = (self.words(rows.start), self.steps((period / self.dims) as u64));
        let mut digits = self.shuffle.digits(rows.start);
        for out in out.chunks_mut(period) {
            let places = out.len();
            for at in (0..places).step_by(self.dims) {
                left[at..at + self.dims].fill(digits[0]);
                right[at..at + self.dims].fill(digits[1]);
                digits = self.shuffle.next(digits);
            }
            let (left, right) = (&mut left[..places], &mut right[..places]);
            self.shuffle.images(left, right, [&first[..places], &step[..places]]);
            place(self.cells, &mut words, &steps, left, out);
        }
    }

    /// The words of some rows from `start` on.
    fn words(&self, start: u64) -> Vec<u64> {
        let word = |(place, stride): (&u64, &u64)| place.wrapping_add(stride.wrapping_mul(start));
        self.places.iter().zip(&self.strides).map(word).collect()
    }

    /// What the words grow by in some rows.
    fn steps(&self, rows: u64) -> Vec<u64> {
        self.strides.iter().map(|stride| stride.wrapping_mul(rows)).collect()
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
        let word = self.places[dim].wrapping_add(self.strides[dim].wrapping_mul(index));
        unit_f64(self.cells.place(cell as u32, mix(word)))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}

for_this_machine! {
    /// Slices to coordinates; the words move on.
    place = place_body<T: Unit>(cells: Cells, words: &mut [u64], steps: &[u64], slices: &[u32], out: &mut [T])
}

#[inline(always)]
fn place_body<T: Unit>(cells: Cells, words: &mut [u64], steps: &[u64], slices: &[u32], out: &mut [T]) {
    for (((x, &slice), word), &step) in out.iter_mut().zip(slices).zip(words).zip(steps) {
        *x = T::from_word(cells.place(slice, mix(*word)));
        *word = word.wrapping_add(step);
    }
}
