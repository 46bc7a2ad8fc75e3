//! Random linear matrix scramble with a digital shift: digits are multiplied by a random lower triangular matrix.
//!
//! The mean and the variance of `owen_exact` for a handful of random digits, and points cost nothing more, since the matrix is
//! built into the net. Replicates have heavier tails, which makes the median of many of them interesting (Pan & Owen 2023).
//! All 64 rows are random, not only as many as a net has columns: stopping there would leave the points of a net
//! in the corners of their cells.

use super::matrix::multiply;
use super::{Entry, Randomization};

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::Linear,
    name: "linear",
    cite: "J. Matousek, On the L2-discrepancy for anchored boxes, J. Complexity 14, 527-556 (1998)",
    apply: |word, key| multiply(word, key, |random, place| random.split(0, place.into()).bits64()),
    affine: true,
    nested: true,
};
