//! The square to a triangle by reflecting its upper half in the center.
//!
//! Linear, without roots; but two points of the square go to each point of the triangle, so that well-spread points need not stay so:
//! the two halves are two point sets that know nothing of each other. `invert` gives the lower of the two.

use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "triangle_mirror",
    cite: "T. Pillards and R. Cools, Transforming low-discrepancy sequences from a cube to a simplex, \
           J. Comput. Appl. Math. 174, 29-42 (2005)",
    takes: &[],
    folds: true,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(TriangleMirror))),
};

/// The reflection of one half of the square.
#[derive(Clone, Copy, Debug)]
pub struct TriangleMirror;

impl<T: Real> Warp<T, 2> for TriangleMirror {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let one = T::of(1.0);
        let (u, v) = if u + v > one { (one - u, one - v) } else { (u, v) };
        [one - u - v, u, v]
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        super::triangle::density(x)
    }

    #[inline]
    fn invert(&self, &[_, u, v]: &[T; 3]) -> [T; 2] {
        [u, v]
    }
}
