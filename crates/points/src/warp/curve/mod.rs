//! Space-filling curves: whole numbers on a line to cells of a cube and back, sixteen at a time.
//!
//! A curve of `dims` dimensions and `bits` bits goes through the 2^(dims · bits) cells of a grid; both together have at most 64 bits.
//! Its digits are dealt to the axes in turn, first digit first, and then turned: by nothing (Morton), by the Gray code, or so
//! that neighbors on the line are neighbors in the cube (Hilbert).
//!
//! * [`points`]: along the curve from stratified or van der Corput numbers;
//! * [`sort`]: clouds of points in the order of a curve;
//! * [`cloud`]: those that have no bounds.

pub mod cloud;
pub mod points;
pub mod sort;
mod unit;

pub(crate) use unit::UnitCurve;

use super::{gray, hilbert, morton};

/// Numbers that are worked on at a time, so that they become vectors.
pub(crate) const LANES: usize = 16;

/// The most dimensions.
pub const MOST_DIMS: usize = 32;

/// Coordinates of [`LANES`] cells, axis by axis.
pub(crate) type Axes = [[u32; LANES]; MOST_DIMS];

/// The grid that a curve goes through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Axes, 1 to [`MOST_DIMS`].
    pub dims: usize,
    /// Binary digits of each coordinate, 1 to 32 and at most 64 on all axes together.
    pub bits: u32,
}

impl Grid {
    /// The finest grid with this many axes.
    pub fn finest(dims: usize) -> Self {
        Self { dims, bits: (64 / dims as u32).min(32) }
    }

    /// A grid, if there is such a one.
    pub fn new(dims: usize, bits: u32) -> Option<Self> {
        let fits = (1..=MOST_DIMS).contains(&dims) && (1..=32).contains(&bits) && dims as u32 * bits <= 64;
        fits.then_some(Self { dims, bits })
    }

    /// Binary digits of an index.
    pub fn digits(self) -> u32 {
        self.dims as u32 * self.bits
    }
}

/// A curve: indices to row-major cells and back.
#[derive(Debug)]
pub struct Curve {
    /// Its name everywhere.
    pub name: &'static str,
    /// The cells of indices below 2^(dims · bits).
    pub cells: fn(Grid, &[u64], &mut [u32]),
    /// The indices of cells.
    pub indices: fn(Grid, &[u32], &mut [u64]),
}

/// All curves.
pub static CURVES: &[&Curve] = &[&hilbert::CURVE, &morton::CURVE, &gray::CURVE];

/// The curve of this name.
pub fn named(name: &str) -> Option<&'static Curve> {
    CURVES.iter().copied().find(|curve| curve.name == name)
}

/// Deals the digits of indices to the axes, turns them, and writes the cells.
#[inline(always)]
pub(crate) fn each_cell(grid: Grid, indices: &[u64], cells: &mut [u32], turn: impl Fn(Grid, &mut Axes)) {
    let mut axes = [[0; LANES]; MOST_DIMS];
    for (indices, cells) in indices.chunks(LANES).zip(cells.chunks_mut(LANES * grid.dims)) {
        let mut block = [0; LANES];
        block[..indices.len()].copy_from_slice(indices);
        deal(grid, &block, &mut axes);
        turn(grid, &mut axes);
        for (lane, cell) in cells.chunks_exact_mut(grid.dims).enumerate() {
            cell.iter_mut().zip(&axes).for_each(|(cell, axis)| *cell = axis[lane]);
        }
    }
}

/// Turns the coordinates of cells back and writes the indices that their digits make.
#[inline(always)]
pub(crate) fn each_index(grid: Grid, cells: &[u32], indices: &mut [u64], turn: impl Fn(Grid, &mut Axes)) {
    let mut axes = [[0; LANES]; MOST_DIMS];
    for (cells, indices) in cells.chunks(LANES * grid.dims).zip(indices.chunks_mut(LANES)) {
        for (lane, cell) in cells.chunks_exact(grid.dims).enumerate() {
            cell.iter().zip(&mut axes).for_each(|(&cell, axis)| axis[lane] = cell);
        }
        turn(grid, &mut axes);
        let mut block = [0; LANES];
        gather(grid, &axes, &mut block);
        indices.copy_from_slice(&block[..indices.len()]);
    }
}

/// Digit (bits − 1 − q) · dims + i of an index, first digit first, becomes bit q of axis i.
#[inline(always)]
fn deal(grid: Grid, indices: &[u64; LANES], axes: &mut Axes) {
    for (i, axis) in axes[..grid.dims].iter_mut().enumerate() {
        *axis = [0; LANES];
        for q in 0..grid.bits {
            let place = q * grid.dims as u32 + (grid.dims - 1 - i) as u32;
            for lane in 0..LANES {
                axis[lane] |= ((indices[lane] >> place) as u32 & 1) << q;
            }
        }
    }
}

/// The inverse of [`deal`].
#[inline(always)]
fn gather(grid: Grid, axes: &Axes, indices: &mut [u64; LANES]) {
    for q in (0..grid.bits).rev() {
        for axis in &axes[..grid.dims] {
            for lane in 0..LANES {
                indices[lane] = indices[lane] << 1 | u64::from(axis[lane] >> q & 1);
            }
        }
    }
}

/// Replaces each digit by its change from the digit before: that of the axis before, or one level up that of the last axis.
#[inline(always)]
pub(crate) fn to_changes(grid: Grid, axes: &mut Axes) {
    let last = axes[grid.dims - 1].map(|x| x >> 1);
    for i in (1..grid.dims).rev() {
        let before = axes[i - 1];
        axes[i].iter_mut().zip(&before).for_each(|(x, before)| *x ^= before);
    }
    axes[0].iter_mut().zip(&last).for_each(|(x, last)| *x ^= last);
}

/// The inverse of [`to_changes`]: the sum of all changes up to each digit.
#[inline(always)]
pub(crate) fn to_sums(grid: Grid, axes: &mut Axes) {
    for i in 1..grid.dims {
        let before = axes[i - 1];
        axes[i].iter_mut().zip(&before).for_each(|(x, before)| *x ^= before);
    }
    // The last axis has the sums of whole levels; those of all levels before go to every axis.
    let mut levels = axes[grid.dims - 1].map(|x| x >> 1);
    for shift in [1, 2, 4, 8, 16] {
        levels = levels.map(|x| x ^ x >> shift);
    }
    for axis in &mut axes[..grid.dims] {
        axis.iter_mut().zip(&levels).for_each(|(x, levels)| *x ^= levels);
    }
}
