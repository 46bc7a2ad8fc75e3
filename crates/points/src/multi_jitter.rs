//! Multi-jittered pairs of coordinates: n points that are stratified on a grid and on both axes.
//!
//! With n = columns · rows, point (c, r) lies in that cell of the grid. Its column is cut into `rows`
//! slices, of which it takes one, and its row into `columns` slices, so that each of the n slices of
//! either axis holds one point. Correlated: all columns use the same permutation of their slices, and
//! all rows (A. Kensler, *Correlated multi-jittered sampling*, 2013). Otherwise each has its own
//! (K. Chiu, P. Shirley and C. Wang, *Multi-jittered sampling*, 1994).

use std::ops::Range;

use crate::cells::{Cells, place_points};
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::seed::counted;
use crate::shuffle::{self, BLOCK, Keys, Shuffle, divide, keys_for};
use crate::{PointSet, Seed};

/// Independent multi-jittered pairs; an odd last coordinate is the first of a pair.
#[derive(Debug)]
pub struct MultiJitter {
    dims: usize,
    n: u64,
    correlated: bool,
    /// Of all points, of the slices of a column, and of the slices of a row.
    shuffles: [Shuffle; 3],
    columns: u64,
    rows: u64,
    cells: Cells,
    pairs: Vec<Pair>,
}

/// The keys of a pair of coordinates.
#[derive(Debug)]
struct Pair {
    order: Keys,
    /// The words that permute slices, for each coordinate.
    slices: [u64; 2],
    /// The keys of the place within a slice, for each coordinate.
    places: [[u64; 2]; 2],
}

impl MultiJitter {
    /// `n` points of `dims` coordinates, both at least 1, n at most 2^31.
    pub(crate) fn new(dims: usize, n: u64, correlated: bool, seed: Seed) -> Self {
        let (columns, rows) = factors(n);
        let key = |pair: u64, half: u64, which| seed.dimension(2 * pair + half).split(0, which).bits64();
        let pair = |pair| Pair {
            order: shuffle::keys(key(pair, 0, 0)),
            slices: [key(pair, 0, 1), key(pair, 1, 1)],
            places: [0, 1].map(|half| [key(pair, half, 2), key(pair, half, 3)]),
        };
        Self {
            dims,
            n,
            correlated,
            shuffles: [n, rows, columns].map(Shuffle::new),
            columns,
            rows,
            cells: Cells::new(n),
            pairs: (0..dims.div_ceil(2) as u64).map(pair).collect(),
        }
    }

    /// One coordinate of a pair: that of the point in cell (column, row) of the grid.
    fn coordinate(&self, index: u64, cell: [u64; 2], pair: &Pair, half: usize) -> f64 {
        let (major, minor, slices) =
            if half == 0 { (cell[0], cell[1], self.rows) } else { (cell[1], cell[0], self.columns) };
        let keys = keys_for(pair.slices[half], if self.correlated { 0 } else { major });
        let slice = self.shuffles[1 + half].image(minor, keys);
        let [first, second] = pair.places[half];
        unit_f64(self.cells.place((major * slices + slice) as u32, counted(index, first, second)))
    }

    /// A pair of coordinates of some consecutive points, as columns.
    fn block(&self, start: u64, count: usize, pair: &Pair) -> [[f64; BLOCK]; 2] {
        let mut cells = [[0; BLOCK], std::array::from_fn(|i| start as u32 + i as u32)];
        let [column, row] = &mut cells;
        self.shuffles[0].permute_alike(&mut row[..count], pair.order);
        divide(self.columns as u32, row, column);
        [0, 1].map(|half| {
            let (major, mut slices) = (&cells[half], cells[1 - half]);
            let (shuffle, word) = (&self.shuffles[1 + half], pair.slices[half]);
            if self.correlated {
                shuffle.permute_alike(&mut slices[..count], keys_for(word, 0));
            } else {
                shuffle.permute_apart(&mut slices[..count], word, &major[..count]);
            }
            let each = if half == 0 { self.rows } else { self.columns } as u32;
            slices.iter_mut().zip(major).take(count).for_each(|(slice, major)| *slice += major * each);
            let mut out = [0.0; BLOCK];
            place_points(self.cells, start, pair.places[half], &slices[..count], &mut out);
            out
        })
    }

    /// The cell of the grid that a point is in.
    fn cell(&self, index: u64, pair: &Pair) -> [u64; 2] {
        let number = self.shuffles[0].image(index, pair.order);
        [number % self.columns, number / self.columns]
    }
}

/// The two factors of n that are nearest to each other, the larger first.
fn factors(n: u64) -> (u64, u64) {
    let rows = (1..=n.isqrt()).rev().find(|rows| n.is_multiple_of(*rows)).unwrap_or(1);
    (n / rows, rows)
}

impl PointSet for MultiJitter {
    fn dims(&self) -> usize {
        self.dims
    }

    fn len(&self) -> Option<u64> {
        Some(self.n)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims, self.n, self.correlated, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        assert!(dim < self.dims, "dimension {dim} of {}", self.dims);
        let pair = &self.pairs[dim / 2];
        self.coordinate(index, self.cell(index, pair), pair, dim % 2)
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims, out.len());
        for (start, part) in rows.step_by(BLOCK).zip(out.chunks_mut(BLOCK * self.dims)) {
            for (pair, first) in self.pairs.iter().zip((0..).step_by(2)) {
                let columns = self.block(start, part.len() / self.dims, pair);
                for (dim, column) in (first..self.dims).zip(&columns) {
                    part.iter_mut()
                        .skip(dim)
                        .step_by(self.dims)
                        .zip(column)
                        .for_each(|(x, value)| *x = *value);
                }
            }
        }
    }
}
