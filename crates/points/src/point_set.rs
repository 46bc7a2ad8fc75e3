//! The contract of all point sets: rows of [0, 1)^d that are a pure function of their index.

use std::ops::Range;

use crate::Seed;
use crate::convert::truncate_to_f32;

/// A finite or endless list of points of the unit cube.
///
/// The laws, which the tests run on every registered sequence: every coordinate is in [0, 1) and never
/// 1.0; the order of access does not matter; asking for more rows never changes the earlier ones; and
/// [`fill`](Self::fill) gives the bits of [`coord`](Self::coord).
pub trait PointSet: Send + Sync {
    /// The number of coordinates of a point.
    fn dims(&self) -> usize;

    /// The number of points, or `None` if there are more than any 64-bit index can name.
    fn len(&self) -> Option<u64> {
        None
    }

    /// True if there are no points at all.
    fn is_empty(&self) -> bool {
        self.len() == Some(0)
    }

    /// The base in which counts of points are balanced: of its powers, from index 0 on. `None` if no count is special.
    fn base(&self) -> Option<u64> {
        None
    }

    /// The generating matrices of a digital net in base 2, before any randomization: for each coordinate the digits of
    /// points 1, 2, 4, 8, …, which are its columns, first digit in the most significant bit. `None` for other points.
    fn generating_matrices(&self) -> Option<Vec<Vec<u64>>> {
        None
    }

    /// The same points randomized anew: what building them with another seed gives, at less cost.
    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet>;

    /// Coordinate `dim` of point `index`.
    ///
    /// # Panics
    /// If `dim` is not below [`dims`](Self::dims).
    fn coord(&self, index: u64, dim: usize) -> f64;

    /// Writes whole points, one after the other.
    ///
    /// # Panics
    /// If `out` does not have `dims()` places for each row.
    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        for (index, point) in rows.zip(out.chunks_exact_mut(self.dims())) {
            for (dim, x) in point.iter_mut().enumerate() {
                *x = self.coord(index, dim);
            }
        }
    }

    /// Writes whole points in single precision: the numbers of [`fill`](Self::fill), truncated.
    ///
    /// # Panics
    /// If `out` does not have `dims()` places for each row.
    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        check_length(&rows, self.dims(), out.len());
        let block = (SCRATCH / self.dims()).max(1);
        let mut scratch = vec![0.0; block * self.dims()];
        let mut start = rows.start;
        for part in out.chunks_mut(scratch.len()) {
            let end = start + (part.len() / self.dims()) as u64;
            let exact = &mut scratch[..part.len()];
            self.fill(start..end, exact);
            part.iter_mut().zip(&*exact).for_each(|(x, &exact)| *x = truncate_to_f32(exact));
            start = end;
        }
    }
}

/// Coordinates converted at a time: 128 KiB, part of a second-level cache, so that beginning a fill costs little.
const SCRATCH: usize = 1 << 14;

/// Panics unless `places` hold exactly the coordinates of `rows`.
pub(crate) fn check_length(rows: &Range<u64>, dims: usize, places: usize) {
    let wanted = u128::from(rows.end.saturating_sub(rows.start)) * dims as u128;
    assert!(places as u128 == wanted, "{rows:?} of {dims} dimensions need {wanted} places, not {places}");
}
