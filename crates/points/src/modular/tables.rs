//! What [`ModularPoints`] tabulates before it fills an array.

use std::ops::Range;

use super::ModularPoints;
use crate::streaming::LANES;
use crate::tiles::Period;

/// Words of a tile: at most half of a first-level cache.
const TILE_WORDS: usize = 2048;

/// Rows of a tile at least, which bounds the cost of moving on to the next block.
const TILE_ROWS: usize = 8;

/// Words over which offsets repeat at least, so that vector loops are long even if d is 1.
const PERIOD_WORDS: usize = 256;

/// Tables for one range of rows.
pub(super) struct Tables<'a> {
    points: &'a ModularPoints,
    /// The words of the first rows relative to row 0, and [`LANES`] more.
    tile: Vec<u64>,
    /// The binary logarithm of the number of rows of the tile.
    tile_bits: u32,
    /// The number of words of a period: whole rows.
    period: usize,
    /// What the offsets grow by when a block is left whose number ends in 0, 1, 2, … ones.
    steps: Vec<Vec<u64>>,
}

impl<'a> Tables<'a> {
    /// Tables for these rows, of which there must be some.
    pub(super) fn new(points: &'a ModularPoints, rows: &Range<u64>) -> Self {
        let dims = points.keys.len();
        let tile_bits = ((TILE_WORDS / dims).max(TILE_ROWS) as u64).min(rows.end - rows.start).ilog2();
        let changing = (rows.start >> tile_bits) ^ ((rows.end - 1) >> tile_bits);
        let words = (dims << tile_bits).clamp(LANES, PERIOD_WORDS);
        let period = dims * words.div_ceil(dims).next_power_of_two();
        let mut tables = Self { points, tile: vec![], tile_bits, period, steps: vec![] };
        tables.tile = tables.first_rows();
        tables.steps = tables.steps_within(changing);
        tables
    }

    /// Calls `make` for every block that holds some of the rows: with the words of the block from the first row
    /// on, followed by [`LANES`] more, and with what is to be added to them.
    pub(super) fn for_each_block(&self, rows: Range<u64>, mut make: impl FnMut(&[u64], Period<'_, u64>)) {
        let mut block = rows.start >> self.tile_bits;
        let last = (rows.end - 1) >> self.tile_bits;
        let mut offsets = self.repeated(&self.points.row(block << self.tile_bits));
        let skipped = (rows.start - (block << self.tile_bits)) as usize;
        let mut tile = &self.tile[skipped * self.points.keys.len()..];
        loop {
            make(tile, Period { words: self.period, offsets: &offsets, keys: [&[]; 2] });
            if block == last {
                return;
            }
            add(&mut offsets, &self.steps[block.trailing_ones() as usize]);
            (block, tile) = (block + 1, &self.tile);
        }
    }

    /// Column k of all coordinates.
    fn column(&self, k: u32) -> Vec<u64> {
        (0..self.points.keys.len()).map(|dim| self.points.generator.column(k, dim)).collect()
    }

    /// A row over and over, for a period and [`LANES`] more words.
    fn repeated(&self, row: &[u64]) -> Vec<u64> {
        let mut words = row.repeat(self.period / row.len());
        words.extend_from_within(..LANES);
        words
    }

    /// Every bit of the index doubles the rows: the later half is the earlier half plus a column.
    fn first_rows(&self) -> Vec<u64> {
        let dims = self.points.keys.len();
        let mut tile = Vec::with_capacity((dims << self.tile_bits) + LANES);
        tile.resize(dims, 0);
        for k in 0..self.tile_bits {
            let (column, half) = (self.column(k), tile.len());
            tile.extend_from_within(..);
            tile[half..].chunks_exact_mut(dims).for_each(|row| add(row, &column));
        }
        tile.resize(tile.len() + LANES, 0);
        tile
    }

    /// The steps between blocks whose numbers differ in no other bits than these: a bit is set, all below are cleared.
    fn steps_within(&self, changing: u64) -> Vec<Vec<u64>> {
        let mut below = vec![0; self.points.keys.len()];
        let mut step = |k| {
            let column = self.column(self.tile_bits + k);
            let step: Vec<_> = column.iter().zip(&below).map(|(c, below)| c.wrapping_sub(*below)).collect();
            add(&mut below, &column);
            self.repeated(&step)
        };
        (0..u64::BITS - changing.leading_zeros()).map(&mut step).collect()
    }
}

fn add(words: &mut [u64], more: &[u64]) {
    words.iter_mut().zip(more).for_each(|(word, more)| *word = word.wrapping_add(*more));
}
