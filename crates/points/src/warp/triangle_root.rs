//! The square to a triangle by a square root: the standard map, continuous and one to one.
//!
//! Choose it where points of the square must go to neighbors in the triangle; it squeezes one side of the square into a corner.
//! All triangle warps give barycentric coordinates; their density is with respect to two of them, whose triangle has area 1/2.

use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "triangle_root",
    cite: "G. Turk, Generating random points in triangles, Graphics Gems, 24-28 (1990)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(TriangleRoot))),
};

/// The square root map.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRoot;

impl<T: Real> Warp<T, 2> for TriangleRoot {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let root = u.sqrt();
        [T::of(1.0) - root, root * (T::of(1.0) - v), root * v]
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        super::triangle::density(x)
    }

    #[inline]
    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let root = x[1] + x[2];
        [root * root, if root > T::of(0.0) { x[2] / root } else { T::of(0.0) }]
    }
}
