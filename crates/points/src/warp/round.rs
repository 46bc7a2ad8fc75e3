//! What warps to disks, spheres and balls share.

use super::Real;

/// The unit direction at a depth 1 − z below the pole, in [0, 2], and an angle in turns.
#[inline]
pub(crate) fn direction<T: Real>(depth: T, turns: T) -> [T; 3] {
    let (sin, cos) = turns.sin_cos_turns();
    let radius = (depth * (T::of(2.0) - depth)).at_least(T::of(0.0)).sqrt();
    [radius * cos, radius * sin, T::of(1.0) - depth]
}

/// The inverse of [`direction`], precise near the pole, where 1 − z is not.
#[inline]
pub(crate) fn depth_and_turns<T: Real>(&[x, y, z]: &[T; 3]) -> [T; 2] {
    let one = T::of(1.0);
    let depth = if z > T::of(0.0) { (x * x + y * y) / (one + z) } else { one - z };
    [depth.at_most(T::of(2.0)), T::turns(y, x)]
}

/// The density of uniform points of the unit disk.
#[inline]
pub(crate) fn disk_density<T: Real>(&[x, y]: &[T; 2]) -> T {
    let inside = x * x + y * y <= T::of(1.0) + T::of(4.0) * T::EPSILON;
    T::of(if inside { 1.0 / std::f64::consts::PI } else { 0.0 })
}
