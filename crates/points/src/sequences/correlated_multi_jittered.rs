//! Correlated multi-jittered points in pairs of coordinates: the classic of production renderers.
//!
//! As `multi_jittered`, with the same permutation in all columns of the grid and the same in all rows,
//! so that neighbors keep their distance: the points look like a shuffled lattice. Choose it for
//! pixels, lenses and lights at a fixed number of samples with two factors of about the same size.

use super::Entry;
use crate::Seed;
use crate::counts::counted_points;
use crate::multi_jitter::MultiJitter;
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "correlated_multi_jittered",
    cite: "A. Kensler, Correlated multi-jittered sampling, Pixar Technical Memo 13-01 (2013)",
    accepts: &[Randomization::None],
    takes: &["n"],
    most_dims: 1 << 20,
    build: |spec| {
        Ok(Box::new(correlated_multi_jittered(
            spec.dims,
            counted_points("correlated_multi_jittered", spec)?,
            spec.seed,
        )))
    },
};

/// `n` points of `dims` coordinates in independent pairs; n is at most 2^31.
pub fn correlated_multi_jittered(dims: usize, n: u64, seed: Seed) -> MultiJitter {
    MultiJitter::new(dims, n, true, seed)
}
