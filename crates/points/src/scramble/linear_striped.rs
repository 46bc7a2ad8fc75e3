//! Striped matrix scramble with a digital shift: one random digit for each column of the matrix, so all below the diagonal of
//! column k are equal to that on it.
//!
//! In base 2 that digit is 1, the matrix is the same for all, and only the shift is random. The last cells of a net are then paired
//! antithetically: in one dimension the variance of a smooth mean falls as n^-4, and that of f(x) = x vanishes; in more
//! dimensions the pairing is lost.

use super::matrix::multiply;
use super::{Entry, Randomization};

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::LinearStriped,
    name: "linear_striped",
    cite: "A. B. Owen, Variance with alternative scramblings of digital nets, ACM TOMACS 13(4), 363-378 (2003)",
    apply: |word, key| multiply(word, key, |_, _| u64::MAX),
    affine: true,
    nested: true,
};
