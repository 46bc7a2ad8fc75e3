//! The square to a triangle by sorting the two numbers: the barycentric coordinates are the gaps between 0, both and 1.
//!
//! Linear on both sides of the diagonal, in which the square is folded, and continuous. `invert` gives the sorted pair.

use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "triangle_sort",
    cite: "T. Pillards and R. Cools, Transforming low-discrepancy sequences from a cube to a simplex, \
           J. Comput. Appl. Math. 174, 29-42 (2005)",
    takes: &[],
    folds: true,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(TriangleSort))),
};

/// The gaps between sorted numbers.
#[derive(Clone, Copy, Debug)]
pub struct TriangleSort;

impl<T: Real> Warp<T, 2> for TriangleSort {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let (low, high) = if u < v { (u, v) } else { (v, u) };
        [low, high - low, T::of(1.0) - high]
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        super::triangle::density(x)
    }

    #[inline]
    fn invert(&self, &[low, gap, _]: &[T; 3]) -> [T; 2] {
        [low, low + gap]
    }
}
