//! Stratified ("jittered") points: one in each cell of a regular grid.
//!
//! n = k^d points in cells of side 1/k. For smooth functions the variance falls as n^(-1 - 2/d): better
//! than independent points in few dimensions, and hardly in many, where the grid is also out of reach.
//! Cells are visited in random order, so that the first points are spread over the cube as well.

use std::ops::Range;

use super::{Entry, Spec};
use crate::cells::{Cells, place_points};
use crate::convert::unit_f64;
use crate::counts::{counted_points, root, wrong_count};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::seed::counted;
use crate::shuffle::{self, BLOCK, Keys, Shuffle, divide};
use crate::{Error, PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "stratified",
    cite: "R. L. Cook, Stochastic sampling in computer graphics, ACM Trans. Graph. 5(1), 51-72 (1986)",
    accepts: &[Randomization::None],
    takes: &["n"],
    most_dims: 1 << 20,
    build,
};

/// Jittered points.
#[derive(Debug)]
pub struct Stratified {
    n: u64,
    shuffle: Shuffle,
    order: Keys,
    /// The cells of one axis, and their number.
    cells: Cells,
    side: u64,
    /// The keys of the place within a cell, for each axis.
    places: Vec<[u64; 2]>,
}

impl Stratified {
    /// `n` points of `dims` coordinates, where n is at most 2^31 and a perfect power: 1, 2^d, 3^d, …
    pub fn new(dims: usize, n: u64, seed: Seed) -> Self {
        let side = root(n, dims);
        let place = |dim, which| seed.dimension(dim).split(0, which).bits64();
        Self {
            n,
            shuffle: Shuffle::new(n),
            order: shuffle::keys(seed.split(0, 0).bits64()),
            cells: Cells::new(side),
            side,
            places: (0..dims as u64).map(|dim| [place(dim, 1), place(dim, 2)]).collect(),
        }
    }
}

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let n = counted_points("stratified", spec)?;
    let side = root(n, spec.dims);
    let power = |side: u64| side.checked_pow(u32::try_from(spec.dims).ok()?);
    if power(side) == Some(n) {
        return Ok(Box::new(Stratified::new(spec.dims, n, spec.seed)));
    }
    let allowed = format!("the {}th power of a whole number", spec.dims);
    Err(wrong_count("stratified", n, &allowed, [power(side), power(side + 1)], shuffle::MOST))
}

impl PointSet for Stratified {
    fn dims(&self) -> usize {
        self.places.len()
    }

    fn len(&self) -> Option<u64> {
        Some(self.n)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims(), self.n, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        let cell = self.shuffle.image(index, self.order);
        // Where the power does not fit, there is a single cell.
        let place = self.side.checked_pow(dim as u32).unwrap_or(u64::MAX);
        let [first, second] = self.places[dim];
        unit_f64(self.cells.place((cell / place % self.side) as u32, counted(index, first, second)))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        let (mut column, mut digits) = ([0.0; BLOCK], [0; BLOCK]);
        for (start, part) in rows.step_by(BLOCK).zip(out.chunks_mut(BLOCK * self.dims())) {
            let count = part.len() / self.dims();
            let mut cells: [u32; BLOCK] = std::array::from_fn(|i| start as u32 + i as u32);
            self.shuffle.permute_alike(&mut cells[..count], self.order);
            for (dim, &keys) in self.places.iter().enumerate() {
                divide(self.side as u32, &mut cells, &mut digits);
                place_points(self.cells, start, keys, &digits[..count], &mut column);
                part.iter_mut()
                    .skip(dim)
                    .step_by(self.dims())
                    .zip(&column)
                    .for_each(|(x, value)| *x = *value);
            }
        }
    }
}
