//! Hammersley points: i / n, then the first coordinates of Halton's sequence.
//!
//! When the number of points is known, one coordinate can be perfectly even, and the others are those of one dimension
//! fewer: the discrepancy loses a factor log n. For n = 2^m, the first two coordinates are a (0, m, 2)-net in base 2.
//! The first coordinate is scrambled in base 2, whatever n is.

use super::Entry;
use crate::counts::counted_points;
use crate::primes::{COUNT, primes};
use crate::radix::{Coordinate, RadixNet};
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "hammersley",
    cite: "J. M. Hammersley, Monte Carlo methods for solving multivariable problems, Ann. New York Acad. Sci. 86, 844-874 \
           (1960)",
    accepts: Randomization::ANY_BASE,
    takes: &["n"],
    most_dims: COUNT + 1,
    build: |spec| {
        let n = counted_points("hammersley", spec)?;
        let coordinates: Vec<_> =
            primes(spec.dims - 1).into_iter().map(Coordinate::radical_inverse).collect();
        Ok(Box::new(RadixNet::finite(n, &coordinates, spec.randomization, spec.seed)))
    },
};
