//! Pairs of (0, 2)-sequences: every two consecutive coordinates are as even as base 2 allows.
//!
//! Any 2^m points that begin at a multiple of 2^m have one point of each pair in every rectangle of
//! area 2^-m with sides 1/2^k; different pairs are matched as if at random. Choose it for chains of
//! two-dimensional problems, as in rendering, in any number of dimensions. `sobol` is as good in its
//! first pair, worse in later ones and better across pairs.

use super::Entry;
use crate::Seed;
use crate::digital_net::DigitalNet;
use crate::dyadic_pairs::matrices;
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "dyadic",
    cite: "I. M. Sobol', USSR Comput. Math. Math. Phys. 7(4), 86-112 (1967), in pairs as in T. Kollig and A. Keller, \
           Efficient multidimensional sampling, Computer Graphics Forum 21, 557-563 (2002)",
    accepts: Randomization::BASE_2,
    takes: &[],
    most_dims: 1 << 16,
    build: |spec| Ok(Box::new(dyadic(spec.dims, spec.randomization, spec.seed))),
};

/// The first `dims` coordinates; the last may be half of a pair.
pub fn dyadic(dims: usize, randomization: Randomization, seed: Seed) -> DigitalNet {
    DigitalNet::new(&matrices(dims), randomization, seed)
}
