//! Orthogonal-array Latin hypercubes: even in all pairs, or triples, of coordinates.
//!
//! n = p^t points, p prime. Any t coordinates have exactly one point in each of the p^t cells of a
//! regular grid, and every coordinate alone has one in each of its n slices. Main effects and all
//! interactions of up to t coordinates leave the error, in up to p + 1 dimensions: choose it where
//! a Latin hypercube is not enough and the dimension too high for a net.
//!
//! The arrays are those of R. C. Bose (1938, t = 2) and K. A. Bush (1952): point `c` is a polynomial of
//! degree t − 1 over the field of p elements, coordinate j is its value at j, and the last one its
//! leading coefficient. Slices come from the other coefficients (B. Tang, *Orthogonal array-based Latin
//! hypercubes*, 1993), all computed in place (W. Jarosz et al., *Orthogonal array sampling for Monte
//! Carlo rendering*, 2019).

use std::ops::Range;

use super::{Entry, Spec};
use crate::cells::{Cells, place_points};
use crate::convert::unit_f64;
use crate::counts::{counted_points, root, wrong_count};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::seed::counted;
use crate::shuffle::{self, BLOCK, Keys, Shuffle, divide, keys_for};
use crate::{Error, PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "orthogonal_array",
    cite: "A. B. Owen, Orthogonal arrays for computer experiments, integration and visualization, Statistica Sinica 2, \
           439-452 (1992), as Latin hypercubes after B. Tang, J. Amer. Statist. Assoc. 88, 1392-1397 (1993)",
    accepts: &[Randomization::None],
    takes: &["n", "strength"],
    most_dims: 46_338,
    build,
};

/// The largest strength.
pub const STRENGTH: usize = 3;

/// A randomized orthogonal array.
#[derive(Debug)]
pub struct OrthogonalArray {
    n: u64,
    levels: u64,
    strength: usize,
    /// Of all points, of the levels of a coordinate, and of the slices of a level.
    shuffles: [Shuffle; 3],
    order: Keys,
    cells: Cells,
    axes: Vec<Axis>,
}

/// The keys of a coordinate.
#[derive(Debug)]
struct Axis {
    levels: Keys,
    /// The word that permutes slices, to be mixed with the level.
    slices: u64,
    place: [u64; 2],
}

impl OrthogonalArray {
    /// `levels`^`strength` points of `dims` coordinates: a prime at least `dims` − 1, and 2 or 3.
    pub fn new(dims: usize, levels: u64, strength: usize, seed: Seed) -> Self {
        let n = levels.pow(strength as u32);
        let key = |dim, which| seed.dimension(dim).split(0, which).bits64();
        let axis = |dim| Axis {
            levels: shuffle::keys(key(dim, 0)),
            slices: key(dim, 1),
            place: [key(dim, 2), key(dim, 3)],
        };
        Self {
            n,
            levels,
            strength,
            shuffles: [n, levels, n / levels].map(Shuffle::new),
            order: shuffle::keys(seed.split(0, 0).bits64()),
            cells: Cells::new(n),
            axes: (0..dims as u64).map(axis).collect(),
        }
    }

    /// The coefficients of the polynomial of a point, constant first.
    fn coefficients(&self, index: u64) -> [u64; STRENGTH] {
        let number = self.shuffles[0].image(index, self.order);
        [number % self.levels, number / self.levels % self.levels, number / self.levels / self.levels]
    }

    fn coordinate(&self, index: u64, dim: usize, [a, b, c]: [u64; STRENGTH]) -> f64 {
        let (p, at) = (self.levels, dim as u64);
        // The value, and the number of the point among those with the same value.
        let (value, rank) = match (at == p, self.strength) {
            (false, _) => (((c * at + b) % p * at + a) % p, c * p + b),
            (true, 2) => (b, a),
            (true, _) => (c, b * p + a),
        };
        let axis = &self.axes[dim];
        let level = self.shuffles[1].image(value, axis.levels);
        let slice = self.shuffles[2].image(rank, keys_for(axis.slices, level));
        let cell = level * (self.n / p) + slice;
        unit_f64(self.cells.place(cell as u32, counted(index, axis.place[0], axis.place[1])))
    }
}

/// The same for blocks of consecutive points.
impl OrthogonalArray {
    fn block_coefficients(&self, start: u64, count: usize) -> [[u32; BLOCK]; STRENGTH] {
        let [mut a, mut b] = [[0; BLOCK]; 2];
        let mut rest = std::array::from_fn(|i| start as u32 + i as u32);
        self.shuffles[0].permute_alike(&mut rest[..count], self.order);
        divide(self.levels as u32, &mut rest, &mut a);
        divide(self.levels as u32, &mut rest, &mut b);
        [a, b, rest]
    }

    fn block(&self, start: u64, dim: usize, [a, b, c]: &[[u32; BLOCK]; STRENGTH], out: &mut [f64]) {
        let (p, at, count) = (self.levels as u32, dim as u32, out.len());
        let (mut levels, mut cells) = match (at == p, self.strength) {
            (false, _) => (polynomial(p, at, [a, b, c]), std::array::from_fn(|i| c[i] * p + b[i])),
            (true, 2) => (*b, *a),
            (true, _) => (*c, std::array::from_fn(|i| b[i] * p + a[i])),
        };
        let axis = &self.axes[dim];
        self.shuffles[1].permute_alike(&mut levels[..count], axis.levels);
        self.shuffles[2].permute_apart(&mut cells[..count], axis.slices, &levels[..count]);
        let each = (self.n / self.levels) as u32;
        cells.iter_mut().zip(&levels).take(count).for_each(|(cell, level)| *cell += level * each);
        place_points(self.cells, start, axis.place, &cells[..count], out);
    }
}

/// c x² + b x + a modulo p, by Horner's rule.
fn polynomial(p: u32, x: u32, [a, b, c]: [&[u32; BLOCK]; STRENGTH]) -> [u32; BLOCK] {
    [b, a].into_iter().fold(*c, |value, coefficient| {
        let mut sum: [u32; BLOCK] = std::array::from_fn(|i| value[i] * x + coefficient[i]);
        let mut remainder = [0; BLOCK];
        divide(p, &mut sum, &mut remainder);
        remainder
    })
}

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let (sequence, n) = ("orthogonal_array", counted_points("orthogonal_array", spec)?);
    let strength = match spec.options.strength {
        None | Some(2) => 2,
        Some(3) => 3,
        Some(other) => {
            let (asked, allowed) = (other.to_string(), "2 or 3".into());
            return Err(Error::Option { sequence, option: "strength", asked, allowed });
        }
    };
    let (p, least) = (root(n, strength), spec.dims as u64 - 1);
    let power = |p: u64| p.checked_pow(strength as u32);
    if power(p) == Some(n) && is_prime(p) && p >= least {
        return Ok(Box::new(OrthogonalArray::new(spec.dims, p, strength, spec.seed)));
    }
    let below = (least..=p).rev().find(|&p| is_prime(p)).and_then(power);
    let next = least.max(p + 1);
    let above = (next..2 * next).find(|&p| is_prime(p)).and_then(power); // Bertrand: there is one
    let allowed = format!("p^{strength} for a prime p of at least d - 1 = {least}");
    Err(wrong_count(sequence, n, &allowed, [below, above], shuffle::MOST))
}

fn is_prime(p: u64) -> bool {
    p > 1 && (2..=p.isqrt()).all(|divisor| !p.is_multiple_of(divisor))
}

impl PointSet for OrthogonalArray {
    fn dims(&self) -> usize {
        self.axes.len()
    }

    fn len(&self) -> Option<u64> {
        Some(self.n)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims(), self.levels, self.strength, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        self.coordinate(index, dim, self.coefficients(index))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        let mut column = [0.0; BLOCK];
        for (start, part) in rows.step_by(BLOCK).zip(out.chunks_mut(BLOCK * self.dims())) {
            let count = part.len() / self.dims();
            let coefficients = self.block_coefficients(start, count);
            for dim in 0..self.dims() {
                self.block(start, dim, &coefficients, &mut column[..count]);
                part.iter_mut()
                    .skip(dim)
                    .step_by(self.dims())
                    .zip(&column)
                    .for_each(|(x, value)| *x = *value);
            }
        }
    }
}
