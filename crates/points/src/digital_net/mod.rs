//! The engine of all base-2 digital nets and sequences: generating matrices in, scrambled points out.
//!
//! A net is one 64×64 matrix over {0, 1} for each coordinate; digit vector of point i = matrix · digits
//! of i. A single coordinate costs one exclusive-or for each 1 in the index. [`PointSet::fill`] is
//! faster: the words of the first rows are tabulated as a *tile* that stays in cache, and every
//! aligned block of rows is the tile plus one offset for each coordinate, so that whole vectors of
//! coordinates can be scrambled and converted at a time, whatever the dimension.

mod kernels;

use std::ops::Range;

use crate::convert::{Unit, unit_f64};
use crate::point_set::check_length;
use crate::scramble::Scrambling;
use crate::{PointSet, Seed};

/// The digits of a coordinate, and of an index.
pub const BITS: usize = 64;

/// Words of a tile: 16 KiB, half of a first-level cache.
const TILE_WORDS: usize = 2048;

/// Rows of a tile at least, which bounds the cost of moving on to the next block.
const TILE_ROWS: usize = 4;

/// Words over which offsets and keys repeat at least, so that vector loops are long even if d is 1.
const PERIOD_WORDS: usize = 256;

/// A base-2 digital net, scrambled.
#[derive(Debug)]
pub struct DigitalNet {
    dims: usize,
    scramble: Scrambling,
    /// Column k of the matrix of coordinate j at `k * dims + j`.
    columns: Vec<u64>,
    /// One key for each coordinate.
    keys: Vec<Seed>,
    /// The words of the first rows, in the form that the kernel wants.
    tile: Vec<u64>,
    /// The binary logarithm of the number of rows of the tile.
    tile_bits: u32,
    /// The keys of as many rows as make up a period.
    period_keys: Vec<u64>,
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
        let period_rows = PERIOD_WORDS.div_ceil(dims).next_power_of_two();
        let period_keys = keys.iter().map(|key| key.bits64()).collect::<Vec<_>>().repeat(period_rows);
        let tile_bits = (TILE_WORDS / dims).max(TILE_ROWS).ilog2();
        let mut net = Self { dims, scramble, columns, keys, tile: Vec::new(), tile_bits, period_keys };
        net.tile = net.first_rows(1 << tile_bits);
        net
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

    fn first_rows(&self, rows: u64) -> Vec<u64> {
        let words = (0..rows).flat_map(|index| (0..self.dims).map(move |dim| (index, dim)));
        words.map(|(index, dim)| self.kernel_form(self.word(index, dim))).collect()
    }

    /// The Owen hash works on reversed words; reversing the tables saves doing it for each point.
    fn kernel_form(&self, word: u64) -> u64 {
        if self.scramble == Scrambling::Owen { word.reverse_bits() } else { word }
    }

    /// The words of index 0, which the digital shift moves away from 0.
    fn origin(&self) -> Vec<u64> {
        match self.scramble {
            Scrambling::DigitalShift => self.keys.iter().map(|key| key.bits64()).collect(),
            Scrambling::None | Scrambling::Owen => vec![0; self.dims],
        }
    }

    /// Moves a row of words to another index, given the bits in which the two indices differ.
    fn toggle(&self, row: &mut [u64], mut changed: u64) {
        while changed != 0 {
            let column = &self.columns[changed.trailing_zeros() as usize * self.dims..][..self.dims];
            row.iter_mut().zip(column).for_each(|(word, column)| *word ^= column);
            changed &= changed - 1;
        }
    }

    /// [`PointSet::fill`] in either precision.
    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        check_length(&rows, self.dims, out.len());
        let mut block = rows.start >> self.tile_bits;
        let mut offset = self.origin();
        self.toggle(&mut offset, block << self.tile_bits);
        let mut period = vec![0; self.period_keys.len()];
        // The first block may begin in the middle of the tile.
        let skipped = (rows.start - (block << self.tile_bits)) as usize;
        let mut tile = &self.tile[skipped * self.dims..];
        let mut rest = out;
        while !rest.is_empty() {
            let (part, later) = rest.split_at_mut(tile.len().min(rest.len()));
            for row in period.chunks_exact_mut(self.dims) {
                row.iter_mut().zip(&offset).for_each(|(word, &offset)| *word = self.kernel_form(offset));
            }
            if self.scramble == Scrambling::Owen {
                kernels::owen(tile, &period, &self.period_keys, part);
            } else {
                kernels::shifted(tile, &period, part);
            }
            let next = block.wrapping_add(1);
            self.toggle(&mut offset, (block ^ next) << self.tile_bits);
            (block, tile, rest) = (next, &self.tile, later);
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
