//! No scramble: for looking at a construction itself, and for the classical deterministic bounds.
//! Without randomness there is no error estimate, and the first Sobol' point is the corner 0.

use super::{Entry, Scrambling};

pub(super) const ENTRY: Entry =
    Entry { scramble: Scrambling::None, name: "none", cite: "-", apply: |word, _| word };
