//! No randomization: for looking at a construction itself, and for the classical deterministic bounds.
//! Without randomness there is no error estimate, and the first Sobol' point is the corner 0.

use super::{Entry, Randomization};

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::None,
    name: "none",
    cite: "-",
    apply: |word, _| word,
    affine: true,
    nested: true,
};
