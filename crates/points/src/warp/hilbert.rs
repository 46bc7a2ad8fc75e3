//! The Hilbert curve in d dimensions: neighbors on the line are neighbors in the cube.
//!
//! Choose it to make one-dimensional points multi-dimensional, or to sort clouds of points so that neighbors in the list are near.
//! n stratified points along it have discrepancy O(n^(-1/d)), and means of Lipschitz functions a variance of
//! O(n^(-1 - 2/d)), for any n (Z. He and A. B. Owen, *Extensible grids: uniform sampling on a space filling curve*,
//! J. R. Stat. Soc. B 78(4), 917–931, 2016).
//!
//! The digits of all axes are exchanged and inverted level by level, in whole words (J. Skilling, *Programming the Hilbert curve*,
//! AIP Conf. Proc. 707, 381–387, 2004).

use super::curve::{Axes, Curve, Grid, UnitCurve, each_cell, each_index, to_changes, to_sums};
use super::{Entry, options};
use crate::instruction_sets::for_this_machine;

pub(super) const ENTRY: Entry = Entry {
    name: "hilbert",
    cite: "J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707, 381-387 (2004)",
    takes: &["dims"],
    folds: false,
    build: |given| Ok(Box::new(UnitCurve::new(&CURVE, options::curve_dims("hilbert", given.dims)?))),
};

/// The curve on grids.
pub(super) static CURVE: Curve = Curve { name: "hilbert", cells, indices };

for_this_machine! {
    cells = cells_body(grid: Grid, indices: &[u64], cells: &mut [u32])
}

#[inline(always)]
fn cells_body(grid: Grid, indices: &[u64], cells: &mut [u32]) {
    each_cell(grid, indices, cells, |grid, axes| {
        to_changes(grid, axes);
        for q in 1..grid.bits {
            for i in (0..grid.dims).rev() {
                exchange(axes, i, q);
            }
        }
    });
}

for_this_machine! {
    indices = indices_body(grid: Grid, cells: &[u32], indices: &mut [u64])
}

#[inline(always)]
fn indices_body(grid: Grid, cells: &[u32], indices: &mut [u64]) {
    if grid.dims == 1 {
        // along a line, the curve goes straight on
        return indices.iter_mut().zip(cells).for_each(|(index, &cell)| *index = cell.into());
    }
    each_index(grid, cells, indices, |grid, axes| {
        for q in (1..grid.bits).rev() {
            for i in 0..grid.dims {
                exchange(axes, i, q);
            }
        }
        to_sums(grid, axes);
    });
}

/// The bits of axis 0 below bit q are inverted where bit q of axis i is set, and exchanged with those of axis i elsewhere.
#[inline(always)]
fn exchange(axes: &mut Axes, i: usize, q: u32) {
    let below = (1_u32 << q) - 1;
    let (first, rest) = axes.split_at_mut(1);
    if i == 0 {
        for x in &mut first[0] {
            *x ^= below & (*x >> q & 1).wrapping_neg();
        }
        return;
    }
    for (x, y) in first[0].iter_mut().zip(&mut rest[i - 1]) {
        let inverted = (*y >> q & 1).wrapping_neg();
        *x ^= below & inverted;
        let change = (*x ^ *y) & below & !inverted;
        *x ^= change;
        *y ^= change;
    }
}
