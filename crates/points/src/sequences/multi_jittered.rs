//! Multi-jittered points in pairs of coordinates: stratified on a grid and on both axes at once.
//!
//! With n = columns · rows, as near to a square as n allows, each pair has one point in each cell of the grid, and
//! each coordinate one in each of n slices. For smooth functions of a pair the variance falls as n^(-2),
//! as for `stratified`, and for functions of one coordinate as n^(-3). A prime n has
//! a single row, which leaves a Latin hypercube. Every column and row permutes its slices on its own;
//! `correlated_multi_jittered` does not, which keeps points farther apart.

use super::Entry;
use crate::Seed;
use crate::counts::counted_points;
use crate::multi_jitter::MultiJitter;
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "multi_jittered",
    cite: "K. Chiu, P. Shirley and C. Wang, Multi-jittered sampling, in Graphics Gems IV, 370-374 (1994)",
    accepts: &[Randomization::None],
    takes: &["n"],
    most_dims: 1 << 20,
    build: |spec| Ok(Box::new(multi_jittered(spec.dims, counted_points("multi_jittered", spec)?, spec.seed))),
};

/// `n` points of `dims` coordinates in independent pairs; n is at most 2^31.
pub fn multi_jittered(dims: usize, n: u64, seed: Seed) -> MultiJitter {
    MultiJitter::new(dims, n, false, seed)
}
