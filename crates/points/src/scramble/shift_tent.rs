//! Random shift, then the tent 1 − |2x − 1| in every coordinate: for lattices and smooth integrands.
//!
//! Lattices are at their best for periodic functions. The tent (or baker's) transformation makes a function of every
//! coordinate that goes up and comes back, and is periodic without a jump: the error of a shifted lattice then falls as
//! n⁻² up to logarithms for any smooth integrand, where without it falls as n⁻¹. Points lose nothing: the map keeps the
//! uniform distribution. It folds the unit interval on itself, so that points are no lattice afterwards.

use super::{Entry, Randomization};

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::ShiftTent,
    name: "shift_tent",
    cite: "F. J. Hickernell, Obtaining O(N^(-2+eps)) convergence for lattice quadrature rules, in MCQMC 2000, 274-289, \
           Springer (2002)",
    apply: |word, key| fold(word.wrapping_add(key.bits64())),
    affine: false,
    nested: false,
};

/// The tent: a word of the lower half doubled, one of the upper half doubled and reflected. Its last digit is lost.
#[inline(always)]
pub(crate) fn fold(word: u64) -> u64 {
    (word << 1) ^ (word.cast_signed() >> 63).cast_unsigned()
}
