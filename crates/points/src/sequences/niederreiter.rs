//! Niederreiter points: a (t, s)-sequence in any prime base.
//!
//! The matrices hold the digits of x^k / p(x)^q for irreducible polynomials p, one for each coordinate, and t is at most the
//! sum of their degrees less 1: 0 for bases of at least s, as with `faure`. In base 2 the same idea as `sobol`, whose
//! direction numbers were chosen for good pairs of coordinates; choose it for bases between 2 and the dimension.

use super::Entry;
use crate::Error;
use crate::generating_matrices::{Matrix, sequence};
use crate::polynomials::{Monic, irreducible, product, reciprocal};
use crate::primes::{MOST_BASE, is_prime};
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "niederreiter",
    cite: "H. Niederreiter, Low-discrepancy and low-dispersion sequences, J. Number Theory 30, 51-70 (1988); P. Bratley, \
           B. L. Fox and H. Niederreiter, ACM TOMACS 2, 195-213 (1992)",
    accepts: Randomization::ANY_BASE,
    takes: &["base"],
    most_dims: 1024,
    build: |spec| {
        let base = u64::from(spec.options.base.unwrap_or(2));
        if base >= MOST_BASE || !is_prime(base) {
            let allowed = "a prime from 2 to 65521".into();
            return Err(Error::Option {
                sequence: ENTRY.name,
                option: "base",
                asked: base.to_string(),
                allowed,
            });
        }
        let matrices =
            irreducible(base, spec.dims).into_iter().map(|polynomial| Laurent::new(&polynomial, base));
        Ok(sequence(base, matrices, spec.randomization, spec.seed))
    },
};

/// Digits of an index or a coordinate at most.
const SIZE: usize = 64;

/// The digits of x^k / p(x)^q.
struct Laurent {
    degree: usize,
    /// The digits of 1 / p(x)^q for q = 1, 2, ….
    reciprocals: Vec<Vec<u64>>,
}

impl Laurent {
    fn new(polynomial: &Monic, prime: u64) -> Self {
        let degree = polynomial.len() - 1;
        let powers =
            std::iter::successors(Some(polynomial.clone()), |power| Some(product(power, polynomial, prime)));
        let reciprocals = powers
            .take(SIZE.div_ceil(degree))
            .map(|power| reciprocal(&power, SIZE + degree, prime))
            .collect();
        Self { degree, reciprocals }
    }
}

impl Matrix for Laurent {
    fn entry(&self, row: usize, column: usize) -> u64 {
        self.reciprocals[row / self.degree][column + row % self.degree]
    }

    fn group(&self) -> usize {
        self.degree
    }
}
