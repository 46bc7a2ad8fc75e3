//! Correlated multi-jittered points in pairs of coordinates: the classic of production renderers.
//!
//! As `multi_jittered`, with the same permutation in all columns of the grid and the same in all rows,
//! so that neighbors keep their distance: the points look like a shuffled lattice. Choose it for
//! pixels, lenses and lights at a fixed number of samples with two factors of about the same size.

use crate::Seed;
use crate::multi_jitter::MultiJitter;

/// `n` points of `dims` coordinates in independent pairs; n is at most 2^31.
pub fn correlated_multi_jittered(dims: usize, n: u64, seed: Seed) -> MultiJitter {
    MultiJitter::new(dims, n, true, seed)
}
