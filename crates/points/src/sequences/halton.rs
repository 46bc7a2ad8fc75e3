//! Halton points: the radical inverse of the index in the j-th prime.
//!
//! Good at any number of points, not only powers of 2; weak in high dimensions unless scrambled, since
//! the first rows of two large neighboring primes lie on a diagonal. Slower than Sobol'.
//!
//! `owen` permutes each digit by an affine map `a·digit + b` modulo p that is drawn anew, by hashing,
//! for every (seed, dimension, level, prefix). The affine maps with a ≠ 0 carry each pair of different
//! digits to each such pair equally often, and the variance of a nested scramble depends on pairs
//! only, so that mean and variance are those of uniform permutations (J. Matoušek, *On the
//! L2-discrepancy for anchored boxes*, 1998). Digits after the first 2^40 cells are independent for each index.

use super::Entry;
use crate::convert::unit_f64;
use crate::scramble::Scrambling;
use crate::seed::mix;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "halton",
    cite: "J. H. Halton, Numer. Math. 2, 84-90 (1960), scrambled as in A. B. Owen, LNS 106, 299-317 (1995) and \
           J. Matousek, J. Complexity 14, 527-556 (1998)",
    accepts: &[Scrambling::Owen, Scrambling::None],
    most_dims: 6_542, // the primes below 2^16, whose products fit 32 bits
    build: |dims, scramble, seed| Box::new(Halton::new(dims, scramble, seed)),
};

/// Digits are permuted one by one until at least this many cells are told apart.
const CELLS: u64 = 1 << 40;

/// The Halton sequence.
#[derive(Debug)]
pub struct Halton {
    axes: Vec<Axis>,
    scramble: Scrambling,
}

impl Halton {
    /// The Halton sequence of the first `dims` primes, with `Scrambling::Owen` or `Scrambling::None`.
    pub fn new(dims: usize, scramble: Scrambling, seed: Seed) -> Self {
        let keyed = primes(dims).into_iter().zip(0..);
        Self { axes: keyed.map(|(base, dim)| Axis::new(base, seed.dimension(dim))).collect(), scramble }
    }
}

impl PointSet for Halton {
    fn dims(&self) -> usize {
        self.axes.len()
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        let axis = &self.axes[dim];
        unit_f64(if self.scramble == Scrambling::Owen { axis.scrambled(index) } else { axis.plain(index) })
    }
}

/// One coordinate of the sequence.
#[derive(Debug)]
struct Axis {
    base: u64,
    /// 2^128 divided by the number of cells, `base^levels`, rounded down.
    cell: u128,
    /// The key of the digits after the last level.
    tail: u64,
    /// One key for each level.
    levels: Vec<u64>,
}

impl Axis {
    fn new(base: u64, key: Seed) -> Self {
        let (mut count, mut cells) = (0, 1);
        while cells < u128::from(CELLS) {
            cells *= u128::from(base);
            count += 1;
        }
        Self {
            base,
            // floor((2^128 − 1) / cells) = floor(2^128 / cells), except that 2^40 divides exactly.
            cell: u128::MAX / cells + u128::from(cells.is_power_of_two()),
            tail: key.split(0, 0).bits64(),
            levels: (1..=count).map(|level| key.split(0, level).bits64()).collect(),
        }
    }

    /// The radical inverse of the index as a word, cut off after 64 binary digits.
    fn plain(&self, index: u64) -> u64 {
        if index == 0 {
            return 0;
        }
        let (mut inverse, mut rest) = (0, index);
        for _ in &self.levels {
            inverse = inverse * self.base + rest % self.base;
            rest /= self.base;
        }
        self.word(inverse, self.plain(rest))
    }

    /// The radical inverse of the index with its digits scrambled.
    fn scrambled(&self, index: u64) -> u64 {
        let (mut inverse, mut rest, mut prefix, mut place) = (0, index, 0_u64, 1_u64);
        for key in &self.levels {
            let digit = rest % self.base;
            rest /= self.base;
            let hash = mix(key ^ prefix);
            // Two 32-bit halves choose 1 ≤ a < base and 0 ≤ b < base, each as evenly as 2^32 allows.
            let factor = 1 + (((hash >> 32) * (self.base - 1)) >> 32);
            let term = ((hash & 0xffff_ffff) * self.base) >> 32;
            inverse = inverse * self.base + (factor * digit + term) % self.base;
            prefix += digit * place;
            place = place.wrapping_mul(self.base);
        }
        self.word(inverse, mix(self.tail ^ index))
    }

    /// The point at `tail` (in units of 2^-64) of cell number `inverse`.
    fn word(&self, inverse: u64, tail: u64) -> u64 {
        let within = (u128::from(tail >> 24) * self.cell) >> 40;
        ((u128::from(inverse) * self.cell + within) >> 64) as u64
    }
}

/// The first `count` primes, by the sieve of Eratosthenes.
fn primes(count: usize) -> Vec<u64> {
    let mut composite = vec![false; 1 << 16];
    let mut found = Vec::with_capacity(count);
    for candidate in 2..composite.len() {
        if found.len() == count {
            break;
        }
        if !composite[candidate] {
            found.push(candidate as u64);
            composite.iter_mut().skip(candidate * candidate).step_by(candidate).for_each(|c| *c = true);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_as_many_primes_as_dimensions() {
        let primes = primes(ENTRY.most_dims);
        assert_eq!((primes.len(), primes[1], primes.last()), (ENTRY.most_dims, 3, Some(&65_521)));
    }
}
