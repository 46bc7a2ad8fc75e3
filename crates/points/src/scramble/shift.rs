//! Random shift modulo 1: every point gets the same random vector added.
//!
//! Made for lattices, whose structure it keeps. Any other points become uniform too, so that replicates
//! give honest errors, but a net is no net afterwards: prefer `digital_shift` there, or better `owen`.

use super::{Entry, Randomization};

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::Shift,
    name: "shift",
    cite: "R. Cranley and T. N. L. Patterson, Randomization of number theoretic methods for multiple integration, SIAM \
           J. Numer. Anal. 13(6), 904-914 (1976)",
    apply: |word, key| word.wrapping_add(key.bits64()),
    affine: false,
    nested: false,
};
