//! The engine of all base-2 digital nets and sequences: generating matrices in, scrambled points out.
//!
//! A net is one 64×64 matrix over {0, 1} for each coordinate; digit vector of point i = matrix · digits
//! of i. A single coordinate costs one exclusive-or for each 1 in the index. [`PointSet::fill`] is
//! faster: the words of the first rows are tabulated as a *tile* that stays in cache, and every
//! aligned block of rows is the tile plus one offset for each coordinate, so that whole vectors of
//! coordinates can be scrambled and converted at a time, whatever the dimension.

mod kernels;

use std::ops::Range;
use std::sync::Arc;

use crate::convert::{Unit, unit_f64};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

/// The digits of a coordinate, and of an index.
pub const BITS: usize = 64;

/// Words of a tile: 16 KiB, half of a first-level cache.
const TILE_WORDS: usize = 2048;

/// Rows of a tile at least, which bounds the cost of moving on to the next block.
const TILE_ROWS: usize = 4;

/// Words over which offsets and keys repeat at least, so that vector loops are long even if d is 1.
const PERIOD_WORDS: usize = 256;

/// A base-2 digital net, randomized.
#[derive(Debug)]
pub struct DigitalNet {
    dims: usize,
    randomization: Randomization,
    /// Column k of the matrix of coordinate j at `k * dims + j`, before any randomization.
    plain: Arc<[u64]>,
    /// The same with the linear part of an affine randomization built in.
    columns: Arc<[u64]>,
    /// The words of index 0: the shift of an affine randomization.
    origin: Vec<u64>,
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
    pub fn new(matrices: &[[u64; BITS]], randomization: Randomization, seed: Seed) -> Self {
        assert!(!matrices.is_empty(), "a net has at least one coordinate");
        let columns = (0..BITS).flat_map(|k| matrices.iter().map(move |matrix| matrix[k])).collect();
        Self::randomized(columns, matrices.len(), randomization, seed)
    }

    fn randomized(plain: Arc<[u64]>, dims: usize, randomization: Randomization, seed: Seed) -> Self {
        let keys: Vec<_> = (0..dims as u64).map(|dim| seed.dimension(dim)).collect();
        let (columns, origin) = if randomization.entry().affine {
            built_in(&plain, &keys, randomization.entry().apply)
        } else {
            (plain.clone(), vec![0; dims])
        };
        let period_rows = PERIOD_WORDS.div_ceil(dims).next_power_of_two();
        let period_keys = keys.iter().map(|key| key.bits64()).collect::<Vec<_>>().repeat(period_rows);
        let tile_bits = (TILE_WORDS / dims).max(TILE_ROWS).ilog2();
        let tile = Vec::new();
        let mut net =
            Self { dims, randomization, plain, columns, origin, keys, tile, tile_bits, period_keys };
        net.tile = net.first_rows(1 << tile_bits);
        net
    }

    /// The digits of a coordinate before randomization.
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn word(&self, index: u64, dim: usize) -> u64 {
        self.product(&self.plain, index, dim)
    }

    fn product(&self, columns: &[u64], mut index: u64, dim: usize) -> u64 {
        assert!(dim < self.dims, "dimension {dim} of {}", self.dims);
        let mut word = 0;
        while index != 0 {
            word ^= columns[index.trailing_zeros() as usize * self.dims + dim];
            index &= index - 1;
        }
        word
    }

    fn first_rows(&self, rows: u64) -> Vec<u64> {
        let words = (0..rows).flat_map(|index| (0..self.dims).map(move |dim| (index, dim)));
        words.map(|(index, dim)| self.kernel_form(self.product(&self.columns, index, dim))).collect()
    }

    /// The Owen hash works on reversed words; reversing the tables saves doing it for each point.
    fn kernel_form(&self, word: u64) -> u64 {
        if self.randomization == Randomization::Owen { word.reverse_bits() } else { word }
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
        let mut offset = self.origin.clone();
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
            match self.randomization {
                Randomization::Owen => kernels::owen(tile, &period, &self.period_keys, part),
                Randomization::OwenExact => kernels::owen_exact(tile, &period, &self.period_keys, part),
                Randomization::Shift => kernels::added(tile, &period, &self.period_keys, part),
                _ => kernels::shifted(tile, &period, part),
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
        unit_f64((self.randomization.entry().apply)(self.word(index, dim), self.keys[dim]))
    }

    fn base(&self) -> Option<u64> {
        Some(2)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::randomized(self.plain.clone(), self.dims, self.randomization, seed))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}

/// Columns with the linear part of an affine randomization applied, and its shifts.
fn built_in(plain: &[u64], keys: &[Seed], apply: fn(u64, Seed) -> u64) -> (Arc<[u64]>, Vec<u64>) {
    let origin: Vec<_> = keys.iter().map(|&key| apply(0, key)).collect();
    let rows = plain.chunks_exact(keys.len());
    let columns = rows.flat_map(|row| {
        row.iter().zip(keys).zip(&origin).map(|((&word, &key), shift)| apply(word, key) ^ shift)
    });
    (columns.collect(), origin)
}
