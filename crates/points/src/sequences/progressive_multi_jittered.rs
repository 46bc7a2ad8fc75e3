//! Progressive multi-jittered (0, 2) sequences ("pmj02"), in pairs of coordinates.
//!
//! Of the first 2^m points, for every m, each pair has one point in every elementary interval of area
//! 2^-m, and the first 4^k are jittered on the 2^k × 2^k grid; points are random within these limits. P.
//! Christensen, A. Kensler and C. Kilpatrick (*Progressive multi-jittered sample sequences*, 2018) search for
//! each point among those generated before. Nested uniform scrambling of a (0, 2)-sequence makes such sequences
//! without a search or a table (A. Helmer, P. Christensen and A. Kensler, *Stochastic generation of (t, s)
//! sample sequences*, 2021): this is `dyadic` with an Owen scramble, under the name that renderers know.

use super::Entry;
use crate::Seed;
use crate::digital_net::DigitalNet;
use crate::dyadic_pairs::matrices;
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "progressive_multi_jittered",
    cite: "P. Christensen, A. Kensler and C. Kilpatrick, Progressive multi-jittered sample sequences, Computer Graphics \
           Forum 37(4), 21-33 (2018), made as in A. Helmer, P. Christensen and A. Kensler, EGSR (2021)",
    accepts: &[Randomization::Owen, Randomization::OwenExact],
    takes: &[],
    most_dims: 1 << 16,
    build: |spec| Ok(Box::new(progressive_multi_jittered(spec.dims, spec.randomization, spec.seed))),
};

/// The first `dims` coordinates; the last may be half of a pair.
pub fn progressive_multi_jittered(dims: usize, randomization: Randomization, seed: Seed) -> DigitalNet {
    DigitalNet::new(&matrices(dims), randomization, seed)
}
