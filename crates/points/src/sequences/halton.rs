//! Halton points: the radical inverse of the index in the j-th prime.
//!
//! Good at any number of points, not only powers of 2; weak in high dimensions unless scrambled, since
//! the first rows of two large neighboring primes lie on a diagonal.
//!
//! All randomizations are those of the bases of the coordinates. `digit_permutation` is what other software calls a scrambled
//! Halton sequence and the fastest; `owen` has the smallest errors.

use super::Entry;
use crate::primes::{COUNT, primes};
use crate::radix::{Coordinate, RadixNet};
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "halton",
    cite: "J. H. Halton, Numer. Math. 2, 84-90 (1960), scrambled as in A. B. Owen, LNS 106, 299-317 (1995) and \
           J. Matousek, J. Complexity 14, 527-556 (1998)",
    accepts: Randomization::ANY_BASE,
    takes: &[],
    most_dims: COUNT,
    build: |spec| {
        let coordinates: Vec<_> = primes(spec.dims).into_iter().map(Coordinate::radical_inverse).collect();
        Ok(Box::new(RadixNet::new(&coordinates, spec.randomization, spec.seed)))
    },
};
