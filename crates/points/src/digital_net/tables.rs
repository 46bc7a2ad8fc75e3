//! What [`DigitalNet`] tabulates before it fills an array, in the words of its precision.

use std::ops::Range;

use super::{DigitalNet, PERIOD_WORDS, TILE_ROWS, TILE_WORDS, kernels};
use crate::convert::{Digits, Unit};
use crate::scramble::Scrambling;

/// Tables for one range of rows. All words have the form that the kernel wants.
pub(super) struct Tables<'a, D> {
    net: &'a DigitalNet,
    /// The words of the first rows, before any shift.
    pub(super) tile: Vec<D>,
    /// The binary logarithm of the number of rows of the tile.
    pub(super) tile_bits: u32,
    /// What the words of a block change by when the next block follows a block that ends in k ones.
    steps: Vec<D>,
    /// What the Owen hash adds and multiplies with, for the rows of a period.
    keys: [Vec<D>; 2],
    /// The number of rows of a period.
    period_rows: usize,
}

impl<'a, D: Digits> Tables<'a, D> {
    pub(super) fn new(net: &'a DigitalNet, rows: &Range<u64>) -> Self {
        let count = rows.end - rows.start;
        let tile_bits = ((TILE_WORDS / net.dims).max(TILE_ROWS) as u64).min(count).ilog2();
        let period_rows = PERIOD_WORDS.div_ceil(net.dims).next_power_of_two().min(1 << tile_bits);
        let blocks = (rows.start >> tile_bits)..=((rows.end - 1) >> tile_bits);
        let mut tables = Self { net, tile: vec![], tile_bits, steps: vec![], keys: [vec![], vec![]], period_rows };
        tables.tile = tables.first_rows();
        tables.steps = tables.steps_within(blocks.start() ^ blocks.end());
        if net.scramble == Scrambling::Owen {
            let (addends, multipliers): (Vec<D>, Vec<D>) = net.keys.iter().map(|key| D::owen_key(key.bits64())).unzip();
            tables.keys = [addends.repeat(period_rows), multipliers.repeat(period_rows)];
        }
        tables
    }

    /// The Owen hash works on reversed words; reversing the tables saves doing it for each point.
    fn kernel_form(&self, word: u64) -> D {
        let digits = D::leading(word);
        if self.net.scramble == Scrambling::Owen { digits.reversed() } else { digits }
    }

    /// Every bit of the index doubles the rows: the later half is the earlier half plus a column.
    fn first_rows(&self) -> Vec<D> {
        let mut tile = Vec::with_capacity(self.net.dims << self.tile_bits);
        tile.resize(self.net.dims, D::default());
        for k in 0..self.tile_bits {
            let column: Vec<D> = self.net.column(k).iter().map(|&word| self.kernel_form(word)).collect();
            let half = tile.len();
            tile.extend_from_within(..);
            for row in tile[half..].chunks_exact_mut(column.len()) {
                row.iter_mut().zip(&column).for_each(|(word, &column)| *word ^= column);
            }
        }
        tile
    }

    /// The steps between blocks that differ in no other bits than these.
    fn steps_within(&self, changing: u64) -> Vec<D> {
        let mut sum = vec![0; self.net.dims];
        let mut steps = Vec::new();
        for k in 0..u64::BITS - changing.leading_zeros() {
            sum.iter_mut().zip(self.net.column(self.tile_bits + k)).for_each(|(sum, column)| *sum ^= column);
            steps.extend(sum.iter().map(|&word| self.kernel_form(word)));
        }
        steps
    }

    /// The offsets of a block, for the rows of a period.
    pub(super) fn period(&self, block: u64) -> Vec<D> {
        let row: Vec<D> = self.net.row(block << self.tile_bits).iter().map(|&word| self.kernel_form(word)).collect();
        row.repeat(self.period_rows)
    }

    /// Moves the offsets of `block` on to the next block.
    pub(super) fn advance(&self, period: &mut [D], block: u64) {
        let step = &self.steps[block.trailing_ones() as usize * self.net.dims..][..self.net.dims];
        for row in period.chunks_exact_mut(step.len()) {
            row.iter_mut().zip(step).for_each(|(word, &step)| *word ^= step);
        }
    }

    /// Scrambles and converts words of the tile, moved by the offsets of a block.
    pub(super) fn scramble<T: Unit<Digits = D>>(&self, tile: &[D], period: &[D], out: &mut [T]) {
        if self.net.scramble == Scrambling::Owen {
            kernels::owen(tile, period, self.keys.each_ref().map(Vec::as_slice), out);
        } else {
            kernels::shifted(tile, period, out);
        }
    }
}
