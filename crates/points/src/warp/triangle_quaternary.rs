//! The interval to a triangle: each digit in base 4 chooses one of the four triangles that the midpoints of the sides make.
//!
//! Choose it to place one-dimensional points, or one coordinate of a net in base 4 or 2, in a triangle: intervals
//! [k/4^m, (k + 1)/4^m) become triangles of equal area and the shape of the whole. It is not continuous.

use super::triangle::digits;
use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "triangle_quaternary",
    cite: "K. Basu and A. B. Owen, Low discrepancy constructions in the triangle, SIAM J. Numer. Anal. 53(2), 743-761 (2015)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 1, 3>(TriangleQuaternary))),
};

/// The recursive map of digits to triangles.
#[derive(Clone, Copy, Debug)]
pub struct TriangleQuaternary;

impl<T: Real> Warp<T, 1> for TriangleQuaternary {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u]: [T; 1]) -> [T; 3] {
        let word = (u.wide() * 2f64.powi(53)) as u64;
        digits::barycentric(word << 11).map(T::of)
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        super::triangle::density(x)
    }

    #[inline]
    fn invert(&self, x: &[T; 3]) -> [T; 1] {
        let word = digits::word(x.map(T::wide), T::DIGITS.div_ceil(2));
        [T::of((word >> 11) as f64 / 2f64.powi(53))]
    }
}
