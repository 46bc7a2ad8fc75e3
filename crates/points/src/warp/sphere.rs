//! The square to the unit sphere, all directions alike.

use super::round::{depth_and_turns, direction};
use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "sphere",
    cite: "Archimedes, On the sphere and cylinder",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(Sphere))),
};

/// Equal areas: (1 − z)/2 is uniform.
#[derive(Clone, Copy, Debug)]
pub struct Sphere;

impl<T: Real> Warp<T, 2> for Sphere {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        direction(u + u, v)
    }

    #[inline]
    fn density(&self, _: &[T; 3]) -> T {
        T::of(0.25 / std::f64::consts::PI)
    }

    #[inline]
    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let [depth, turns] = depth_and_turns(x);
        [depth * T::of(0.5), turns]
    }
}
