//! The watertight ray–triangle test of Woop, Benthin and Wald 2013 ("Watertight Ray/Triangle Intersection", JCGT 2(1)).
//!
//! The scalar form: the reference for the tests, the exact fallback on edges, and the last step that turns the winning
//! triangle into barycentric coordinates. The wide form in [`super::leaf`] repeats its arithmetic operation by operation.

use crate::geometry::Ray;

/// A ray sheared so that it runs along one axis (section 3.1 of the paper).
#[derive(Clone, Copy, Debug)]
pub(super) struct Shear {
    /// The permuted axes; `axes[2]` is the one along which the ray is steepest.
    pub(super) axes: [usize; 3],
    /// Shear constants `Sx`, `Sy` and scale `Sz`.
    pub(super) scale: [f32; 3],
    /// The ray's origin in permuted order.
    pub(super) origin: [f32; 3],
}

/// Where a line meets a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// Ray parameter.
    pub(super) t: f32,
    /// Edge functions: barycentric weights of the second and third vertex, times the determinant.
    pub(super) v: f32,
    pub(super) w: f32,
    pub(super) determinant: f32,
}

impl Shear {
    /// Both faces count, so the permutation need not keep the winding.
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> Self {
        let d = ray.direction.to_array();
        let o = ray.origin.to_array();
        let [x, y, z] = ray.direction.abs().to_array();
        let kz = if z >= x && z >= y { 2 } else { usize::from(y >= x) };
        let kx = if kz == 2 { 0 } else { kz + 1 };
        let ky = 3 - kx - kz;
        Self {
            axes: [kx, ky, kz],
            scale: [d[kx] / d[kz], d[ky] / d[kz], 1.0 / d[kz]],
            origin: [o[kx], o[ky], o[kz]],
        }
    }

    /// A vertex relative to the origin: `x` and `y` sheared, `z` not yet scaled.
    #[inline(always)]
    fn apply(&self, vertex: [f32; 3]) -> [f32; 3] {
        let [kx, ky, kz] = self.axes;
        let z = vertex[kz] - self.origin[2];
        let x = (vertex[kx] - self.origin[0]) - self.scale[0] * z;
        let y = (vertex[ky] - self.origin[1]) - self.scale[1] * z;
        [x, y, z]
    }

    /// Where the whole line meets a triangle, if it does.
    pub(super) fn meet(&self, triangle: [[f32; 3]; 3]) -> Option<Meeting> {
        let (a, b, c) = (self.apply(triangle[0]), self.apply(triangle[1]), self.apply(triangle[2]));
        let mut edges = [c[0] * b[1] - c[1] * b[0], a[0] * c[1] - a[1] * c[0], b[0] * a[1] - b[1] * a[0]];
        if edges.contains(&0.0) {
            // Products of two f32 are exact in f64, so these signs are too; neighbors see exactly opposite ones.
            let exact = |p: [f32; 3], q: [f32; 3]| {
                f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0])
            };
            edges = [exact(c, b) as f32, exact(a, c) as f32, exact(b, a) as f32];
        }
        let [u, v, w] = edges;
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let determinant = (u + v) + w;
        if !inside || determinant == 0.0 {
            return None;
        }
        let depth = (u * (self.scale[2] * a[2]) + v * (self.scale[2] * b[2])) + w * (self.scale[2] * c[2]);
        Some(Meeting { t: depth / determinant, v, w, determinant })
    }
}
