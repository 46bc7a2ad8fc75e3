//! A curve as a warp: numbers in [0, 1) to the unit cube and back, at the precision of the numbers.

use super::{Curve, Grid};
use crate::warp::Real;
use crate::warp::rows::{Rows, Sizes};

/// Points at a time.
const BLOCK: usize = 256;

/// A curve through the unit cube.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitCurve {
    curve: &'static Curve,
    dims: usize,
}

impl UnitCurve {
    pub(crate) fn new(curve: &'static Curve, dims: usize) -> Self {
        Self { curve, dims }
    }

    /// The finest grid whose centers of cells are exact.
    fn grid<T: Real>(self) -> Grid {
        let finest = Grid::finest(self.dims);
        Grid { bits: finest.bits.min(T::DIGITS - 1), ..finest }
    }
}

impl Sizes for UnitCurve {
    fn inputs(&self) -> usize {
        1
    }
    fn outputs(&self) -> usize {
        self.dims
    }
}

impl<T: Real> Rows<T> for UnitCurve {
    /// The number stands for an interval as wide as its last digit: its point is the center of the cell of the interval's middle.
    fn map(&self, u: &[T], x: &mut [T]) {
        let (grid, unused) = (self.grid::<T>(), 64 - T::DIGITS);
        let scale = 0.5_f64.powi(grid.bits as i32);
        let (mut indices, mut cells) = ([0; BLOCK], vec![0; BLOCK * self.dims]);
        for (u, x) in u.chunks(BLOCK).zip(x.chunks_mut(BLOCK * self.dims)) {
            for (index, u) in indices.iter_mut().zip(u) {
                let word = ((u.wide() * (1_u64 << T::DIGITS) as f64) as u64) << unused | 1 << (unused - 1);
                *index = word >> (64 - grid.digits());
            }
            (self.curve.cells)(grid, &indices[..u.len()], &mut cells[..x.len()]);
            x.iter_mut().zip(&cells).for_each(|(x, &cell)| *x = T::of((f64::from(cell) + 0.5) * scale));
        }
    }

    fn density(&self, x: &[T], density: &mut [T]) {
        let inside = |x: &T| *x >= T::of(0.0) && *x <= T::of(1.0);
        for (x, density) in x.chunks_exact(self.dims).zip(density) {
            *density = T::of(if x.iter().all(inside) { 1.0 } else { 0.0 });
        }
    }

    fn invert(&self, x: &[T], u: &mut [T]) {
        let grid = self.grid::<T>();
        let (scale, last) = (2f64.powi(grid.bits as i32), u32::MAX >> (32 - grid.bits));
        let (mut indices, mut cells) = ([0; BLOCK], vec![0; BLOCK * self.dims]);
        for (u, x) in u.chunks_mut(BLOCK).zip(x.chunks(BLOCK * self.dims)) {
            cells.iter_mut().zip(x).for_each(|(cell, x)| *cell = ((x.wide() * scale) as u32).min(last));
            (self.curve.indices)(grid, &cells[..x.len()], &mut indices[..u.len()]);
            for (index, u) in indices.iter().zip(u) {
                let digits = index << (64 - grid.digits()) >> (64 - T::DIGITS);
                *u = T::of(digits as f64 / (1_u64 << T::DIGITS) as f64);
            }
        }
    }
}
