//! The engine of all base-2 digital nets and sequences: generating matrices in, scrambled points out.
//!
//! A net is one 64×64 matrix over {0, 1} for each coordinate; digit vector of point i = matrix · digits
//! of i. A single coordinate costs one exclusive-or for each 1 in the index. [`PointSet::fill`] is
//! faster: the words of the first rows are tabulated as a *tile* that stays in cache, and every
//! aligned block of rows is the tile plus one offset for each coordinate, so that whole vectors of
//! coordinates can be scrambled and converted at a time, whatever the dimension.

pub mod interlaced;
pub(crate) mod kernels;
mod tables;

use std::ops::Range;
use std::sync::Arc;

use self::kernels::{Added, Owen, Shifted};
use self::tables::Tables;
use crate::convert::{Digits, Unit, unit_f64};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::streaming::{LANES, Stream};
use crate::tiles::{Combine, write};
use crate::{PointSet, Seed};

/// The digits of a coordinate, and of an index.
pub const BITS: usize = 64;

/// A base-2 digital net, randomized.
#[derive(Debug)]
pub struct DigitalNet {
    dims: usize,
    /// The columns of a matrix: the digits of an index that matter.
    depth: usize,
    randomization: Randomization,
    /// Column k of the matrix of coordinate j at `k * dims + j`, before any randomization.
    plain: Arc<[u64]>,
    /// The same with the linear part of an affine randomization built in.
    columns: Arc<[u64]>,
    /// The words of index 0: the shift of an affine randomization.
    origin: Vec<u64>,
    /// One key for each coordinate.
    keys: Vec<Seed>,
}

impl DigitalNet {
    /// A net from the columns of its generating matrices, first digit in the most significant bit.
    ///
    /// # Panics
    /// If there are no matrices.
    pub fn new(matrices: &[[u64; BITS]], randomization: Randomization, seed: Seed) -> Self {
        Self::finite(matrices, randomization, seed)
    }

    /// A net of 2^m points from the m columns of each of its generating matrices.
    ///
    /// ```
    /// use evenlight_points::{PointSet, Seed, digital_net::DigitalNet, scramble::Randomization};
    /// let hammersley = [vec![1 << 63, 1 << 62, 1 << 61], vec![1 << 61, 1 << 62, 1 << 63]];
    /// let net = DigitalNet::finite(&hammersley, Randomization::None, Seed::new(0));
    /// assert_eq!((net.len(), net.coord(6, 0), net.coord(6, 1)), (Some(8), 0.375, 0.75));
    /// ```
    ///
    /// # Panics
    /// If there are no matrices, or they have not all the same number of columns from 1 to 64.
    pub fn finite<M: AsRef<[u64]>>(matrices: &[M], randomization: Randomization, seed: Seed) -> Self {
        let depth = matrices.first().expect("a net has at least one coordinate").as_ref().len();
        assert!((1..=BITS).contains(&depth), "a matrix has 1 to 64 columns, not {depth}");
        assert!(matrices.iter().all(|matrix| matrix.as_ref().len() == depth), "all have {depth} columns");
        let entry = |k, matrix: &M| matrix.as_ref().get(k).copied().unwrap_or(0);
        let columns = (0..BITS).flat_map(|k| matrices.iter().map(move |matrix| entry(k, matrix))).collect();
        Self::randomized(columns, depth, randomization, seed, matrices.len())
    }

    fn randomized(
        plain: Arc<[u64]>,
        depth: usize,
        randomization: Randomization,
        seed: Seed,
        dims: usize,
    ) -> Self {
        let keys: Vec<_> = (0..dims as u64).map(|dim| seed.dimension(dim)).collect();
        let (columns, origin) = if randomization.entry().affine {
            built_in(&plain, &keys, randomization.entry().apply)
        } else {
            (plain.clone(), vec![0; dims])
        };
        Self { dims, depth, randomization, plain, columns, origin, keys }
    }

    /// The digits of a coordinate before randomization.
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn word(&self, mut index: u64, dim: usize) -> u64 {
        assert!(dim < self.dims, "dimension {dim} of {}", self.dims);
        let mut word = 0;
        while index != 0 {
            word ^= self.plain[index.trailing_zeros() as usize * self.dims + dim];
            index &= index - 1;
        }
        word
    }

    /// The digits of a coordinate, randomized.
    fn randomized_word(&self, index: u64, dim: usize) -> u64 {
        (self.randomization.entry().apply)(self.word(index, dim), self.keys[dim])
    }

    /// The words of a row, with no other than an affine randomization.
    fn row(&self, mut index: u64) -> Vec<u64> {
        let mut row = self.origin.clone();
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
        match self.randomization {
            Randomization::Owen => self.fill_with::<Owen<T>>(rows, out),
            Randomization::OwenExact => self.fill_node_by_node(rows, out),
            Randomization::Shift => self.fill_with::<Added<T>>(rows, out),
            _ => self.fill_with::<Shifted<T>>(rows, out),
        }
    }

    fn fill_with<C: Combine<Word: Digits>>(&self, rows: Range<u64>, out: &mut [C::Number]) {
        let mut out = Stream::new(out);
        let tables = Tables::<C::Word>::new(self, &rows);
        tables.for_each_block(rows, |tile, period| write::<C>(tile, period, &mut out));
    }

    fn fill_node_by_node<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        let mut rest = out;
        Tables::<u64>::new(self, &rows).for_each_block(rows, |tile, period| {
            let words = (tile.len() - LANES).min(rest.len());
            let (part, later) = std::mem::take(&mut rest).split_at_mut(words);
            kernels::owen_exact(tile, period, part);
            rest = later;
        });
    }

    /// Gives the first 32 digits of all coordinates of some rows after the other to `take`.
    fn for_each_leading_words(&self, rows: Range<u64>, mut take: impl FnMut(&[u32])) {
        if rows.is_empty() {
            return;
        }
        let (mut words_left, mut made) = ((rows.end - rows.start) as usize * self.dims, vec![]);
        let mut places = |tile: usize, made: &mut Vec<u32>| {
            made.resize((tile - LANES).min(words_left), 0);
            words_left -= made.len();
        };
        if self.randomization == Randomization::OwenExact {
            Tables::<u64>::new(self, &rows).for_each_block(rows, |tile, period| {
                places(tile.len(), &mut made);
                kernels::owen_exact(tile, period, &mut made);
                take(&made);
            });
        } else {
            Tables::<u32>::new(self, &rows).for_each_block(rows, |tile, period| {
                places(tile.len(), &mut made);
                write::<Owen<u32>>(tile, period, &mut Stream::new(&mut made));
                take(&made);
            });
        }
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

impl PointSet for DigitalNet {
    fn dims(&self) -> usize {
        self.dims
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        unit_f64(self.randomized_word(index, dim))
    }

    fn len(&self) -> Option<u64> {
        1_u64.checked_shl(self.depth as u32)
    }

    fn base(&self) -> Option<u64> {
        Some(2)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::randomized(self.plain.clone(), self.depth, self.randomization, seed, self.dims))
    }

    fn generating_matrices(&self) -> Option<Vec<Vec<u64>>> {
        let matrix = |dim| (0..self.depth).map(|k| self.plain[k * self.dims + dim]).collect();
        Some((0..self.dims).map(matrix).collect())
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}
