//! The cube to the unit ball: the radius is a cube root.

use super::round::{depth_and_turns, direction};
use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "ball",
    cite: "L. Devroye, Non-uniform random variate generation, chapter V.4 (1986)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 3, 3>(Ball))),
};

/// A direction and a radius, whose cube is the third number.
#[derive(Clone, Copy, Debug)]
pub struct Ball;

impl<T: Real> Warp<T, 3> for Ball {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v, w]: [T; 3]) -> [T; 3] {
        let radius = w.cbrt();
        direction(u + u, v).map(|x| x * radius)
    }

    #[inline]
    fn density(&self, &[x, y, z]: &[T; 3]) -> T {
        let inside = x * x + y * y + z * z <= T::of(1.0) + T::of(8.0) * T::EPSILON;
        T::of(if inside { 0.75 / std::f64::consts::PI } else { 0.0 })
    }

    #[inline]
    fn invert(&self, x: &[T; 3]) -> [T; 3] {
        let radius = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        if radius == T::of(0.0) {
            return [T::of(0.0); 3];
        }
        let [depth, turns] = depth_and_turns(&x.map(|x| x / radius));
        [depth * T::of(0.5), turns, (radius * radius * radius).at_most(T::of(1.0))]
    }
}
