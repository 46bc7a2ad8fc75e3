//! The square to the upper unit hemisphere, all directions alike.

use super::round::{depth_and_turns, direction};
use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "hemisphere_uniform",
    cite: "Archimedes, On the sphere and cylinder",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(HemisphereUniform))),
};

/// Equal areas: 1 − z is uniform.
#[derive(Clone, Copy, Debug)]
pub struct HemisphereUniform;

impl<T: Real> Warp<T, 2> for HemisphereUniform {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        direction(u, v)
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        T::of(if x[2] >= T::of(0.0) { 0.5 / std::f64::consts::PI } else { 0.0 })
    }

    #[inline]
    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let [depth, turns] = depth_and_turns(x);
        [depth.at_most(T::of(1.0)), turns]
    }
}
