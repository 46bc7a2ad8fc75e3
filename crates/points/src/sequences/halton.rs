//! Halton points: the radical inverse of the index in the j-th prime.
//!
//! Good at any number of points, not only powers of 2; weak in high dimensions unless scrambled, since
//! the first rows of two large neighboring primes lie on a diagonal. Slower than Sobol'.
//!
//! With `owen`, every digit is permuted according to all digits before it.

use std::ops::Range;

use super::Entry;
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::radical_inverse::{BLOCK, RadicalInverse};
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "halton",
    cite: "J. H. Halton, Numer. Math. 2, 84-90 (1960), scrambled as in A. B. Owen, LNS 106, 299-317 (1995) and \
           J. Matousek, J. Complexity 14, 527-556 (1998)",
    accepts: &[Randomization::Owen, Randomization::None],
    takes: &[],
    most_dims: 6_542, // the primes below 2^16, whose products fit 32 bits
    build: |spec| Ok(Box::new(Halton::new(spec.dims, spec.randomization, spec.seed))),
};

/// The Halton sequence.
#[derive(Debug)]
pub struct Halton {
    axes: Vec<RadicalInverse>,
    randomization: Randomization,
}

impl Halton {
    /// The Halton sequence of the first `dims` primes, with `Randomization::Owen` or `Randomization::None`.
    pub fn new(dims: usize, randomization: Randomization, seed: Seed) -> Self {
        let keyed = primes(dims).into_iter().zip(0..);
        Self {
            axes: keyed.map(|(base, dim)| RadicalInverse::new(base, seed.dimension(dim))).collect(),
            randomization,
        }
    }
}

impl PointSet for Halton {
    fn dims(&self) -> usize {
        self.axes.len()
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.axes.len(), self.randomization, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        let axis = &self.axes[dim];
        unit_f64(if self.randomization == Randomization::Owen {
            axis.scrambled(index)
        } else {
            axis.plain(index)
        })
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        let mut words = [0; BLOCK];
        for (start, part) in rows.step_by(BLOCK).zip(out.chunks_mut(BLOCK * self.dims())) {
            for (dim, axis) in self.axes.iter().enumerate() {
                if self.randomization == Randomization::Owen {
                    axis.scrambled_block(start, &mut words);
                } else {
                    (0..).zip(&mut words).for_each(|(i, word)| *word = axis.plain(start.wrapping_add(i)));
                }
                let column = part.iter_mut().skip(dim).step_by(self.axes.len());
                column.zip(&words).for_each(|(x, &word)| *x = unit_f64(word));
            }
        }
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
