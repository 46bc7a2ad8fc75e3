//! What a [`DigitalNet`] tabulates before it fills an array, in the words of the array's precision.

use std::ops::Range;

use super::DigitalNet;
use crate::convert::Digits;
use crate::scramble::Randomization;
use crate::streaming::LANES;
use crate::tiles::Period;

/// Words of a tile: at most half of a first-level cache.
const TILE_WORDS: usize = 2048;

/// Rows of a tile at least, which bounds the cost of moving on to the next block.
const TILE_ROWS: usize = 8;

/// Words over which offsets and keys repeat at least, so that vector loops are long even if d is 1.
const PERIOD_WORDS: usize = 256;

/// Tables for one range of rows. All words have the form that the kernel wants.
pub(super) struct Tables<'a, D> {
    net: &'a DigitalNet,
    /// The words of the first rows, before any shift, and [`LANES`] more.
    tile: Vec<D>,
    /// The binary logarithm of the number of rows of the tile.
    tile_bits: u32,
    /// The number of words of a period: whole rows.
    period: usize,
    /// What the offsets change by when a block is left whose number ends in 0, 1, 2, … ones.
    steps: Vec<Vec<D>>,
    /// What the Owen hash adds and multiplies with, or the keys of a randomization by word.
    keys: [Vec<D>; 2],
}

impl<'a, D: Digits> Tables<'a, D> {
    /// Tables for these rows, of which there must be some.
    pub(super) fn new(net: &'a DigitalNet, rows: &Range<u64>) -> Self {
        let tile_bits = ((TILE_WORDS / net.dims).max(TILE_ROWS) as u64).min(rows.end - rows.start).ilog2();
        let changing = (rows.start >> tile_bits) ^ ((rows.end - 1) >> tile_bits);
        let words = (net.dims << tile_bits).clamp(LANES, PERIOD_WORDS);
        let period = net.dims * words.div_ceil(net.dims).next_power_of_two();
        let mut tables = Self { net, tile: vec![], tile_bits, period, steps: vec![], keys: [vec![], vec![]] };
        tables.tile = tables.first_rows();
        tables.steps = tables.steps_within(changing);
        let bits = || net.keys.iter().map(|key| key.bits64());
        match net.randomization {
            Randomization::Owen => {
                let (addends, factors): (Vec<D>, Vec<D>) = bits().map(D::owen_key).unzip();
                tables.keys = [tables.repeated(&addends), tables.repeated(&factors)];
            }
            Randomization::OwenExact | Randomization::Shift => {
                tables.keys[0] = tables.repeated(&bits().map(D::leading).collect::<Vec<_>>());
            }
            _ => {}
        }
        tables
    }

    /// Calls `make` for every block that holds some of the rows: with the words of the block from the first row
    /// on, followed by [`LANES`] more, and with what belongs to them.
    pub(super) fn for_each_block(&self, rows: Range<u64>, mut make: impl FnMut(&[D], Period<'_, D>)) {
        let mut block = rows.start >> self.tile_bits;
        let last = (rows.end - 1) >> self.tile_bits;
        let mut offsets = self.repeated(&self.kernel_row(&self.net.row(block << self.tile_bits)));
        let keys = self.keys.each_ref().map(Vec::as_slice);
        let skipped = (rows.start - (block << self.tile_bits)) as usize;
        let mut tile = &self.tile[skipped * self.net.dims..];
        loop {
            make(tile, Period { words: self.period, offsets: &offsets, keys });
            if block == last {
                return;
            }
            let step = &self.steps[block.trailing_ones() as usize];
            offsets.iter_mut().zip(step).for_each(|(word, &step)| *word ^= step);
            (block, tile) = (block + 1, &self.tile);
        }
    }

    /// The Owen hash works on reversed words; reversing the tables saves doing it for each point.
    fn kernel_row(&self, row: &[u64]) -> Vec<D> {
        let owen = self.net.randomization == Randomization::Owen;
        let form = |&word: &u64| if owen { D::leading(word).reversed() } else { D::leading(word) };
        row.iter().map(form).collect()
    }

    /// A row over and over, for a period and [`LANES`] more words.
    fn repeated(&self, row: &[D]) -> Vec<D> {
        let mut words = row.repeat(self.period / row.len());
        words.extend_from_within(..LANES);
        words
    }

    /// Every bit of the index doubles the rows: the later half is the earlier half plus a column.
    fn first_rows(&self) -> Vec<D> {
        let dims = self.net.dims;
        let mut tile = Vec::with_capacity((dims << self.tile_bits) + LANES);
        tile.resize(dims, D::default());
        for k in 0..self.tile_bits {
            let column = self.kernel_row(self.net.column(k));
            let half = tile.len();
            tile.extend_from_within(..);
            for row in tile[half..].chunks_exact_mut(dims) {
                row.iter_mut().zip(&column).for_each(|(word, &column)| *word ^= column);
            }
        }
        tile.resize(tile.len() + LANES, D::default());
        tile
    }

    /// The steps between blocks whose numbers differ in no other bits than these.
    fn steps_within(&self, changing: u64) -> Vec<Vec<D>> {
        let mut sum = vec![0; self.net.dims];
        let mut step = |k| {
            sum.iter_mut().zip(self.net.column(self.tile_bits + k)).for_each(|(sum, column)| *sum ^= column);
            self.repeated(&self.kernel_row(&sum))
        };
        (0..u64::BITS - changing.leading_zeros()).map(&mut step).collect()
    }
}
