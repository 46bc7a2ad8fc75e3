//! Points of triangles and of products of triangles.
//!
//! * [`van_der_corput`]: any number of points from any index on, deterministic or scrambled;
//! * [`kronecker`]: exactly n points of a rotated lattice, the least discrepancy known;
//! * [`product`]: points of Δ × … × Δ, for paths between triangles.

pub mod digits;
pub mod kronecker;
pub mod product;
pub mod scramble;
pub mod van_der_corput;

use super::Real;

/// The density of uniform points of a triangle with respect to two of its barycentric coordinates.
pub(crate) fn density<T: Real>(x: &[T; 3]) -> T {
    let least = -T::of(4.0) * T::EPSILON;
    T::of(if x.iter().all(|&x| x >= least) { 2.0 } else { 0.0 })
}

/// The point with these barycentric coordinates, for corners given one after the other.
#[inline]
pub(crate) fn place([a, b, c]: [f64; 3], corners: &[f64], out: &mut [f64]) {
    let k = out.len();
    for (i, x) in out.iter_mut().enumerate() {
        *x = a * corners[i] + b * corners[k + i] + c * corners[2 * k + i];
    }
}
