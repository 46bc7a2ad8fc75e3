//! The square to a triangle with little distortion: two linear maps that meet on the diagonal.
//!
//! Choose it before the square root map: it needs no root, and squares become parallelograms that are at most
//! twice as long as wide. (0, 0) goes to the last corner, and the opposite corner of the square into the opposite side.

use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "triangle_heitz",
    cite: "E. Heitz, A low-distortion map between triangle and square, hal-02073696 (2019)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(TriangleHeitz))),
};

/// The low-distortion map.
#[derive(Clone, Copy, Debug)]
pub struct TriangleHeitz;

impl<T: Real> Warp<T, 2> for TriangleHeitz {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let half = T::of(0.5);
        let (a, b) = if v > u { (u * half, v - u * half) } else { (u - v * half, v * half) };
        [a, b, T::of(1.0) - u.at_least(v)]
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        super::triangle::density(x)
    }

    #[inline]
    fn invert(&self, &[a, b, _]: &[T; 3]) -> [T; 2] {
        if b > a { [a + a, a + b] } else { [a + b, b + b] }
    }
}
