//! The engine of all base-2 digital nets and sequences: generating matrices in, scrambled points out.
//!
//! A net is one 64×64 matrix over {0, 1} for each coordinate; digit vector of point i = matrix · digits
//! of i. A single coordinate costs one exclusive-or for each 1 in the index. [`PointSet::fill`] is
//! faster: the words of the first rows are tabulated as a *tile* that stays in cache, and every
//! aligned block of rows is the tile plus one offset for each coordinate, so that whole vectors of
//! coordinates can be scrambled and converted at a time, whatever the dimension.

mod kernels;
mod tables;

use std::ops::Range;

use self::tables::Tables;
use crate::convert::{Unit, unit_f64};
use crate::point_set::check_length;
use crate::scramble::Scrambling;
use crate::streaming::{self, LANES, Stream};
use crate::{PointSet, Seed};

/// The digits of a coordinate, and of an index.
pub const BITS: usize = 64;

/// A base-2 digital net, scrambled.
#[derive(Debug)]
pub struct DigitalNet {
    dims: usize,
    scramble: Scrambling,
    /// Column k of the matrix of coordinate j at `k * dims + j`.
    columns: Vec<u64>,
    /// One key for each coordinate.
    keys: Vec<Seed>,
}

impl DigitalNet {
    /// A net from the columns of its generating matrices, first digit in the most significant bit.
    ///
    /// # Panics
    /// If there are no matrices.
    pub fn new(matrices: &[[u64; BITS]], scramble: Scrambling, seed: Seed) -> Self {
        let dims = matrices.len();
        assert!(dims > 0, "a net has at least one coordinate");
        let columns = (0..BITS).flat_map(|k| matrices.iter().map(move |matrix| matrix[k])).collect();
        let keys: Vec<_> = (0..dims as u64).map(|dim| seed.dimension(dim)).collect();
        Self { dims, scramble, columns, keys }
    }

    /// The digits of a coordinate before scrambling.
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn word(&self, mut index: u64, dim: usize) -> u64 {
        assert!(dim < self.dims, "dimension {dim} of {}", self.dims);
        let mut word = 0;
        while index != 0 {
            word ^= self.columns[index.trailing_zeros() as usize * self.dims + dim];
            index &= index - 1;
        }
        word
    }

    /// The words of a row: shifted, but not Owen-scrambled.
    fn row(&self, mut index: u64) -> Vec<u64> {
        let mut row: Vec<_> = match self.scramble {
            Scrambling::DigitalShift => self.keys.iter().map(|key| key.bits64()).collect(),
            Scrambling::None | Scrambling::Owen => vec![0; self.dims],
        };
        while index != 0 {
            let column = self.column(index.trailing_zeros());
            row.iter_mut().zip(column).for_each(|(word, column)| *word ^= column);
            index &= index - 1;
        }
        row
    }

    /// Column k of all matrices.
    fn column(&self, k: u32) -> &[u64] {
        &self.columns[k as usize * self.dims..][..self.dims]
    }

    /// [`PointSet::fill`] in either precision.
    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        check_length(&rows, self.dims, out.len());
        if out.is_empty() {
            return;
        }
        let tables = Tables::<T::Digits>::new(self, &rows);
        let owen = self.scramble == Scrambling::Owen;
        if streaming::pays(out) {
            let kernel = if owen { kernels::owen_past } else { kernels::shifted_past };
            let mut out = Stream::new(out);
            tables.for_each_block(rows, |tile, period| kernel(tile, period, &mut out));
        } else {
            let kernel = if owen { kernels::owen } else { kernels::shifted };
            let mut rest = out;
            tables.for_each_block(rows, |tile, period| {
                let words = (tile.len() - LANES).min(rest.len());
                let (part, later) = std::mem::take(&mut rest).split_at_mut(words);
                kernel(tile, period, part);
                rest = later;
            });
        }
    }
}

impl PointSet for DigitalNet {
    fn dims(&self) -> usize {
        self.dims
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        unit_f64((self.scramble.entry().apply)(self.word(index, dim), self.keys[dim]))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}
