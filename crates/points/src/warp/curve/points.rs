//! Points of the unit cube along a curve: what one-dimensional points become.
//!
//! Z. He and A. B. Owen, *Extensible grids: uniform sampling on a space filling curve*, J. R. Stat. Soc. B 78(4), 917–931 (2016).

use super::{Curve, Grid};
use crate::Seed;
use crate::convert::unit_f64;
use crate::scramble::owen::nested_uniform_scramble_64;
use crate::seed::counted;

/// The points on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The middles of n equal intervals.
    Centered(u64),
    /// One random point in each of n equal intervals.
    Stratified(u64),
    /// The van der Corput sequence in base 2: no end, deterministic.
    VanDerCorput,
    /// The same, Owen-scrambled: each point is uniform.
    Owen,
}

/// Points along a curve.
#[derive(Debug)]
pub struct CurvePoints {
    curve: &'static Curve,
    grid: Grid,
    source: Source,
    key: Seed,
}

/// Points at a time.
const BLOCK: usize = 256;

impl CurvePoints {
    /// Points of `dims` coordinates, 1 to [`MOST_DIMS`](super::MOST_DIMS).
    pub fn new(curve: &'static Curve, dims: usize, source: Source, seed: Seed) -> Self {
        Self { curve, grid: Grid::finest(dims), source, key: seed }
    }

    /// Writes points from index `start` on, row by row.
    ///
    /// # Panics
    /// If `out` does not have places for whole points.
    pub fn fill(&self, start: u64, out: &mut [f64]) {
        let (dims, bits) = (self.grid.dims, self.grid.bits);
        assert!(out.len().is_multiple_of(dims), "whole points");
        let random = matches!(self.source, Source::Stratified(_) | Source::Owen);
        let keys: Vec<_> = (0..dims as u64).map(|dim| self.key.dimension(dim)).collect();
        let (mut indices, mut cells) = ([0; BLOCK], vec![0; BLOCK * dims]);
        let mut first = start;
        for part in out.chunks_mut(BLOCK * dims) {
            let count = part.len() / dims;
            for (index, place) in indices[..count].iter_mut().zip(first..) {
                *index = self.word(place) >> (64 - self.grid.digits());
            }
            (self.curve.cells)(self.grid, &indices[..count], &mut cells[..part.len()]);
            for ((row, cells), place) in part.chunks_mut(dims).zip(cells.chunks(dims)).zip(first..) {
                for ((x, &cell), key) in row.iter_mut().zip(cells).zip(&keys) {
                    // uniform in the cell, or its center
                    let within =
                        if random { counted(place, key.bits64(), key.split(0, 0).bits64()) } else { 1 << 63 };
                    *x = unit_f64(u64::from(cell) << (64 - bits) | within >> bits);
                }
            }
            first = first.wrapping_add(count as u64);
        }
    }

    /// The point on the line, as a word.
    fn word(&self, index: u64) -> u64 {
        let fraction =
            |within: u64, n: u64| ((u128::from(index) << 64 | u128::from(within)) / u128::from(n)) as u64;
        match self.source {
            Source::Centered(n) => fraction(1 << 63, n),
            Source::Stratified(n) => {
                fraction(counted(index, self.key.bits64(), self.key.split(0, 1).bits64()), n)
            }
            Source::VanDerCorput => index.reverse_bits(),
            Source::Owen => nested_uniform_scramble_64(index.reverse_bits(), self.key.bits64()),
        }
    }
}
