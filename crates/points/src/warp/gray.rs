//! The Gray-code curve in d dimensions: the Morton curve of the reflected Gray code of the index.
//!
//! One coordinate changes at a time, by one digit: steps are along axes, but not always short. Between Morton and Hilbert in cost and in
//! how near neighbors are.

use super::curve::{Curve, Grid, UnitCurve, each_cell, each_index, to_changes, to_sums};
use super::{Entry, options};
use crate::instruction_sets::for_this_machine;

pub(super) const ENTRY: Entry = Entry {
    name: "gray",
    cite: "C. Faloutsos, Gray codes for partial match and range queries, IEEE Trans. Softw. Eng. 14(10), 1381-1393 (1988)",
    takes: &["dims"],
    folds: false,
    build: |given| Ok(Box::new(UnitCurve::new(&CURVE, options::curve_dims("gray", given.dims)?))),
};

/// The curve on grids.
pub(super) static CURVE: Curve = Curve { name: "gray", cells, indices };

for_this_machine! {
    cells = cells_body(grid: Grid, indices: &[u64], cells: &mut [u32])
}

#[inline(always)]
fn cells_body(grid: Grid, indices: &[u64], cells: &mut [u32]) {
    each_cell(grid, indices, cells, to_changes);
}

for_this_machine! {
    indices = indices_body(grid: Grid, cells: &[u32], indices: &mut [u64])
}

#[inline(always)]
fn indices_body(grid: Grid, cells: &[u32], indices: &mut [u64]) {
    each_index(grid, cells, indices, to_sums);
}
