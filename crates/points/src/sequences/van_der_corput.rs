//! The van der Corput sequence: the digits of the index, mirrored at the point, in any base.
//!
//! One dimension only, as even as a sequence can be. Choose it to drive something one-dimensional, in base 2 unless
//! the problem has a base of its own, as a triangle or a space-filling curve has 4.

use super::Entry;
use crate::generating_matrices::{Identity, sequence};
use crate::primes::{MOST_BASE, is_prime};
use crate::radix::{Coordinate, RadixNet};
use crate::scramble::Randomization;
use crate::{Error, PointSet};

pub(super) const ENTRY: Entry = Entry {
    name: "van_der_corput",
    cite: "J. G. van der Corput, Verteilungsfunktionen, Proc. Ned. Akad. Wet. 38, 813-821 (1935)",
    accepts: Randomization::ANY_BASE,
    takes: &["base"],
    most_dims: 1,
    build: |spec| {
        let base = u64::from(spec.options.base.unwrap_or(2));
        let refused = |allowed: String| {
            Err(Error::Option { sequence: ENTRY.name, option: "base", asked: base.to_string(), allowed })
        };
        if !(2..=MOST_BASE).contains(&base) {
            return refused(format!("from 2 to {MOST_BASE}"));
        }
        if LINEAR.contains(&spec.randomization) && !is_prime(base) {
            return refused(format!("a prime with scramble '{}'", spec.randomization.name()));
        }
        if base == 2 {
            return Ok(sequence(base, [Identity].into_iter(), spec.randomization, spec.seed));
        }
        let net = RadixNet::new(&[Coordinate::radical_inverse(base)], spec.randomization, spec.seed);
        Ok(Box::new(net.balanced_in(base)) as Box<dyn PointSet>)
    },
};

/// What needs a field: division by every digit but 0.
const LINEAR: [Randomization; 3] =
    [Randomization::Linear, Randomization::LinearStriped, Randomization::LinearIBinomial];
