//! 0x3fd8ea1f33c3202a (XSL-RR 128/64): small and fast pseudo-random numbers, NumPy's default generator.
//!
//! Every dimension is a stream of its own, by state and increment; skipping ahead takes 128 steps at
//! most. Choose it instead of `independent`, which is faster, where numbers must be those of other
//! software (see [`Pcg::initial`] for the state and stream of each dimension).

use std::ops::Range;

use rand_pcg::Lcg128Xsl64;
use rand_pcg::rand_core::Rng;

use super::Entry;
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "pcg",
    cite: "M. E. O'Neill, PCG: a family of simple fast space-efficient statistically good algorithms for random number \
           generation, HMC-CS-2014-0905 (2014)",
    accepts: &[Randomization::None],
    takes: &[],
    most_dims: 1 << 20,
    build: |spec| Ok(Box::new(Pcg::new(spec.dims, spec.seed))),
};

/// Independent uniform points.
#[derive(Debug)]
pub struct Pcg {
    /// The generator of each dimension, before its first number.
    generators: Vec<Lcg128Xsl64>,
}

impl Pcg {
    /// Points of `dims` coordinates.
    pub fn new(dims: usize, seed: Seed) -> Self {
        let generator = |dim| {
            let [state, stream] = Self::initial(seed, dim);
            Lcg128Xsl64::new(state, stream)
        };
        Self { generators: (0..dims as u64).map(generator).collect() }
    }

    /// The initial state and the stream of a dimension, as in the generator's reference `srandom`.
    pub fn initial(seed: Seed, dim: u64) -> [u128; 2] {
        let word = |number| u128::from(seed.dimension(dim).split(0, number).bits64());
        [word(0) << 64 | word(1), word(2) << 64 | word(3)]
    }

    /// The generator of a dimension before number `index`.
    fn at(&self, index: u64, dim: usize) -> Lcg128Xsl64 {
        let mut generator = self.generators[dim].clone();
        generator.advance(u128::from(index));
        generator
    }
}

impl PointSet for Pcg {
    fn dims(&self) -> usize {
        self.generators.len()
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims(), seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        unit_f64(self.at(index, dim).next_u64())
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        let mut generators: Vec<_> = (0..self.dims()).map(|dim| self.at(rows.start, dim)).collect();
        for point in out.chunks_exact_mut(self.dims()) {
            point
                .iter_mut()
                .zip(&mut generators)
                .for_each(|(x, generator)| *x = unit_f64(generator.next_u64()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `0x3fd8ea1f33c3202a` of NumPy 2 with the state that `srandom(42, 54)` of the reference gives.
    #[test]
    fn numpy_gives_the_same_numbers() {
        let points = Pcg { generators: vec![Lcg128Xsl64::new(42, 54)] };
        for (index, bits) in NUMPY {
            assert_eq!(points.coord(index, 0), f64::from_bits(bits), "number {index}");
        }
    }

    const NUMPY: [(u64, u64); 4] = [
        (0, 0x3fe0d63b43ae40c5),
        (1, 0x3fb304aa46c98538),
        (4, 0x3fe90b73fb06f32d),
        (999, 0x3fc0a5162de19424),
    ];
}
