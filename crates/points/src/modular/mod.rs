//! The engine of all lattices and Kronecker sequences: one number for each coordinate in, shifted points out.
//!
//! Every bit k of the index adds a word c(k, j) to coordinate j, modulo 2^64, which is addition of coordinates
//! modulo 1. In *natural* order it is {2^k α} and point i is {i α}; in *radical* order it is 2^(63 - k) z and point i is {φ(i) z}, φ the radical inverse in base 2: the first 2^m points are the lattice of 2^m points, whatever
//! m (F. J. Hickernell, H. S. Hong, P. L'Ecuyer and C. Lemieux, *Extensible lattice sequences for quasi-Monte Carlo
//! quadrature*, SIAM J. Sci. Comput. 22, 1117-1138, 2000).
//!
//! All of it is integer arithmetic, so that nothing drifts however large the index. Radical order is exact; in natural
//! order a word is 0 to 65 units of 2^-64 above the exact number, and so a coordinate that 53 digits can show is
//! exact and any other the one below or above.
//!
//! [`PointSet::fill`] tabulates the words of the first rows as a *tile* that stays in cache. Every aligned block of rows
//! is the tile plus one word for each coordinate.

pub(crate) mod kernels;
mod tables;

use std::ops::Range;
use std::sync::Arc;

use self::kernels::{Folded, Summed};
use self::tables::Tables;
use crate::convert::{Unit, unit_f64};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::streaming::Stream;
use crate::tiles::{Combine, write};
use crate::{PointSet, Seed};

/// What the words of natural order are too small by, at most: one unit for each bit of the index.
const ROUNDING: u64 = 64;

/// The most points of a lattice in natural order: rounding up never reaches the next of them.
pub const MOST: u64 = 1 << 48;

/// The numbers that points are multiples of.
#[derive(Clone, Debug)]
pub enum Generator {
    /// Point i is {i α}: each α in units of 2^-128.
    Natural(Arc<[u128]>),
    /// Point i is {φ(i) z}: each z odd.
    Radical(Arc<[u64]>),
}

impl Generator {
    /// The lattice {i z / n} in natural order. Every `n` is at most [`MOST`].
    pub fn lattice(z: &[u64], n: u64) -> Self {
        Self::Natural(z.iter().map(|&z| fraction(z % n, n)).collect())
    }

    fn dims(&self) -> usize {
        match self {
            Self::Natural(alphas) => alphas.len(),
            Self::Radical(numbers) => numbers.len(),
        }
    }

    /// What bit k of the index adds to a coordinate.
    fn column(&self, k: u32, dim: usize) -> u64 {
        match self {
            Self::Natural(alphas) => (alphas[dim] << k >> 64) as u64,
            Self::Radical(numbers) => numbers[dim] << (63 - k),
        }
    }

    /// The word of index 0.
    fn origin(&self) -> u64 {
        match self {
            Self::Natural(_) => ROUNDING,
            Self::Radical(_) => 0,
        }
    }

    fn word(&self, mut index: u64, dim: usize) -> u64 {
        if let Self::Radical(numbers) = self {
            return index.reverse_bits().wrapping_mul(numbers[dim]);
        }
        let mut word = self.origin();
        while index != 0 {
            word = word.wrapping_add(self.column(index.trailing_zeros(), dim));
            index &= index - 1;
        }
        word
    }
}

/// z / n for z < n, in units of 2^-128, rounded up.
fn fraction(z: u64, n: u64) -> u128 {
    let n = u128::from(n);
    let high = u128::from(z) << 64;
    let low = (high % n) << 64;
    ((high / n) << 64) + low.div_ceil(n)
}

/// A lattice or a Kronecker sequence, shifted.
#[derive(Debug)]
pub struct ModularPoints {
    generator: Generator,
    /// The number of points, where there is an end.
    count: Option<u64>,
    randomization: Randomization,
    /// One key for each coordinate.
    keys: Vec<Seed>,
}

impl ModularPoints {
    /// Points with `Randomization::Shift`, `ShiftTent` or `None`.
    ///
    /// # Panics
    /// If there is no coordinate, or with another randomization.
    pub fn new(generator: Generator, count: Option<u64>, randomization: Randomization, seed: Seed) -> Self {
        assert!(generator.dims() > 0, "a lattice has at least one coordinate");
        assert!(Randomization::MODULAR.contains(&randomization), "{}", randomization.name());
        let keys = (0..generator.dims() as u64).map(|dim| seed.dimension(dim)).collect();
        Self { generator, count, randomization, keys }
    }

    /// The words of a row, shifted but not folded.
    fn row(&self, index: u64) -> Vec<u64> {
        let shift = |key: &Seed| if self.randomization == Randomization::None { 0 } else { key.bits64() };
        let shifted = |(dim, key)| self.generator.word(index, dim).wrapping_add(shift(key));
        self.keys.iter().enumerate().map(shifted).collect()
    }

    /// [`PointSet::fill`] in either precision.
    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        check_length(&rows, self.dims(), out.len());
        if out.is_empty() {
            return;
        }
        if self.randomization == Randomization::ShiftTent {
            self.fill_with::<Folded<T>>(rows, out);
        } else {
            self.fill_with::<Summed<T>>(rows, out);
        }
    }

    fn fill_with<C: Combine<Word = u64>>(&self, rows: Range<u64>, out: &mut [C::Number]) {
        let mut out = Stream::new(out);
        Tables::new(self, &rows).for_each_block(rows, |tile, period| write::<C>(tile, period, &mut out));
    }
}

impl PointSet for ModularPoints {
    fn dims(&self) -> usize {
        self.keys.len()
    }

    fn len(&self) -> Option<u64> {
        self.count
    }

    fn base(&self) -> Option<u64> {
        matches!(self.generator, Generator::Radical(_)).then_some(2)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.generator.clone(), self.count, self.randomization, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        assert!(dim < self.dims(), "dimension {dim} of {}", self.dims());
        let word = self.generator.word(index, dim);
        unit_f64((self.randomization.entry().apply)(word, self.keys[dim]))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}
