//! The square to the unit disk in polar coordinates: the radius is a root.
//!
//! Continuous across the whole circle of angles, but it stretches: cells near the center are long and thin. Prefer `disk_concentric`
//! for well-spread points.

use super::round::disk_density;
use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "disk_polar",
    cite: "P. Shirley, Nonuniform random point sets via warping, Graphics Gems III, 80-83 (1992)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 2>(DiskPolar))),
};

/// Polar coordinates: u is the squared radius, v the angle in turns.
#[derive(Clone, Copy, Debug)]
pub struct DiskPolar;

impl<T: Real> Warp<T, 2> for DiskPolar {
    type Point = [T; 2];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 2] {
        let (sin, cos) = v.sin_cos_turns();
        let radius = u.sqrt();
        [radius * cos, radius * sin]
    }

    #[inline]
    fn density(&self, x: &[T; 2]) -> T {
        disk_density(x)
    }

    #[inline]
    fn invert(&self, &[x, y]: &[T; 2]) -> [T; 2] {
        [(x * x + y * y).at_most(T::of(1.0)), T::turns(y, x)]
    }
}
