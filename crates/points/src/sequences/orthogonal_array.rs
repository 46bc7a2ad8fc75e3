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
use crate::cells::Cells;
use crate::convert::unit_f64;
use crate::counts::{counted_points, root, wrong_count};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::seed::{counted, mix};
use crate::shuffle::{self, Keys, Shuffle};
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
        let slice = self.shuffles[2].image(rank, shuffle::keys(mix(axis.slices.wrapping_add(level))));
        let cell = level * (self.n / p) + slice;
        unit_f64(self.cells.place(cell as u32, counted(index, axis.place[0], axis.place[1])))
    }
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
    Err(wrong_count(sequence, n, &allowed, [below, above]))
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
        for (index, point) in rows.zip(out.chunks_exact_mut(self.dims())) {
            let coefficients = self.coefficients(index);
            for (dim, x) in point.iter_mut().enumerate() {
                *x = self.coordinate(index, dim, coefficients);
            }
        }
    }
}
