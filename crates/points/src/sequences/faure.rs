//! Faure points: a (0, s)-sequence in a prime base of at least s, the best quality that there is.
//!
//! Any p^m points that begin at a multiple of p^m have one point in each elementary interval in base p of volume p^-m, in
//! all coordinates at once. The matrices are the powers of Pascal's. The price is that large bases need many points: below
//! p² of them, pairs of coordinates are no better than Halton's. In few dimensions a rival of `sobol`.

use super::Entry;
use crate::Error;
use crate::generating_matrices::{Matrix, sequence};
use crate::primes::{MOST_BASE, is_prime};
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "faure",
    cite: "H. Faure, Discrepance de suites associees a un systeme de numeration (en dimension s), Acta Arith. 41, 337-351 \
           (1982)",
    accepts: Randomization::ANY_BASE,
    takes: &["base"],
    most_dims: 65_521, // the largest prime below 2^16
    build: |spec| {
        let least = spec.dims as u64;
        let base = match spec.options.base {
            Some(base) => u64::from(base),
            None => {
                (least.max(2)..MOST_BASE).find(|&base| is_prime(base)).expect("dimensions end at a prime")
            }
        };
        if !(least..MOST_BASE).contains(&base) || !is_prime(base) {
            let allowed = format!("a prime from {least} to {}", ENTRY.most_dims);
            return Err(Error::Option {
                sequence: ENTRY.name,
                option: "base",
                asked: base.to_string(),
                allowed,
            });
        }
        let binomials = binomials(base);
        let matrices = (0..least).map(|power| Pascal { binomials: &binomials, power, prime: base });
        Ok(sequence(base, matrices, spec.randomization, spec.seed))
    },
};

/// Digits of an index or a coordinate at most.
const SIZE: usize = 64;

/// Pascal's triangle modulo a prime: the binomial coefficient (column over row).
type Binomials = Vec<[u64; SIZE]>;

fn binomials(prime: u64) -> Binomials {
    let mut binomials = vec![[0; SIZE]; SIZE];
    for column in 0..SIZE {
        binomials[0][column] = 1;
        for row in 1..=column {
            binomials[row][column] = (binomials[row - 1][column - 1] + binomials[row][column - 1]) % prime;
        }
    }
    binomials
}

/// A power of Pascal's matrix.
struct Pascal<'a> {
    binomials: &'a Binomials,
    power: u64,
    prime: u64,
}

impl Matrix for Pascal<'_> {
    fn entry(&self, row: usize, column: usize) -> u64 {
        let Some(exponent) = column.checked_sub(row) else { return 0 };
        (0..exponent).fold(self.binomials[row][column], |entry, _| entry * self.power % self.prime)
    }
}
