//! I-binomial matrix scramble with a digital shift: one random digit for each diagonal of a lower triangular matrix.
//!
//! As good as `linear` for many purposes with 64 random digits instead of 2,016.

use super::matrix::multiply;
use super::{Entry, Randomization};

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::LinearIBinomial,
    name: "linear_i_binomial",
    cite: "S. Tezuka and H. Faure, I-binomial scrambling of digital nets and sequences, J. Complexity 19, 744-757 (2003)",
    apply: |word, key| multiply(word, key, |random, place| random.bits64() >> place),
    affine: true,
    nested: true,
};
