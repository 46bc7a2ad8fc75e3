//! The Morton (Z) curve in d dimensions: the digits of the line are dealt to the axes in turn.
//!
//! Cheaper than the Hilbert curve, but it jumps: stratified points along it behave as if the dimension were larger. Choose it where the
//! cost of the key matters more than the nearness of neighbors.

use super::curve::{Curve, Grid, UnitCurve, each_cell, each_index};
use super::{Entry, options};
use crate::instruction_sets::for_this_machine;

pub(super) const ENTRY: Entry = Entry {
    name: "morton",
    cite: "G. M. Morton, A computer oriented geodetic data base, IBM (1966)",
    takes: &["dims"],
    folds: false,
    build: |given| Ok(Box::new(UnitCurve::new(&CURVE, options::curve_dims("morton", given.dims)?))),
};

/// The curve on grids.
pub(super) static CURVE: Curve = Curve { name: "morton", cells, indices };

for_this_machine! {
    cells = cells_body(grid: Grid, indices: &[u64], cells: &mut [u32])
}

#[inline(always)]
fn cells_body(grid: Grid, indices: &[u64], cells: &mut [u32]) {
    each_cell(grid, indices, cells, |_, _| {});
}

for_this_machine! {
    indices = indices_body(grid: Grid, cells: &[u32], indices: &mut [u64])
}

#[inline(always)]
fn indices_body(grid: Grid, cells: &[u32], indices: &mut [u64]) {
    each_index(grid, cells, indices, |_, _| {});
}
