//! Vectors, frames and rays in the renderer's conventions.
//!
//! Directions point *away* from the surface; in a local [`Frame`] the shading normal is `(0, 0, 1)`.

pub use evenlight_points::warp::sin_cos_turns;
pub use glam::{Affine3A, Mat3A, Vec2};

/// A point, a direction or a normal in world or local coordinates.
pub type Vec3 = glam::Vec3A;

/// A color or radiance in linear RGB with sRGB (ITU-R BT.709) primaries.
pub type Rgb = glam::Vec3A;

/// Relative luminance of a linear color (ITU-R BT.709).
pub fn luminance(color: Rgb) -> f32 {
    color.dot(Rgb::new(0.212671, 0.715160, 0.072169))
}

/// An orthonormal frame; `n` is the local z axis.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The local x axis.
    pub s: Vec3,
    /// The local y axis.
    pub t: Vec3,
    /// The local z axis: the normal.
    pub n: Vec3,
}

impl Frame {
    /// Some frame around a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1)).
    #[inline]
    pub fn from_normal(n: Vec3) -> Self {
        let sign = 1.0_f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// The frame around unit normal `n` whose `s` lies along the tangent `dp_du` (Gram–Schmidt);
    /// falls back to [`Frame::from_normal`] when the tangent vanishes or is parallel to `n`.
    #[inline]
    pub fn from_normal_and_tangent(n: Vec3, dp_du: Vec3) -> Self {
        let s = dp_du - n * n.dot(dp_du);
        let length_squared = s.length_squared();
        if length_squared > 1e-20 * dp_du.length_squared() && length_squared.is_normal() {
            let s = s / length_squared.sqrt();
            Self { s, t: n.cross(s), n }
        } else {
            Self::from_normal(n)
        }
    }

    /// World to local.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }

    /// Local to world.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

/// A ray with `0 < t < t_max`; directions need not be unit vectors in the kernel, but are everywhere else.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
    /// How far it goes, in units of `direction`; may be infinite.
    pub t_max: f32,
}

/// What scattering and textures may ask about a point on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// World position.
    pub position: Vec3,
    /// Unit geometric normal, on the side of the shading normal.
    pub geometric_normal: Vec3,
    /// Shading frame: its `n` is the interpolated normal. Its `s` follows `dp_du` where the BSDF asks for tangents.
    pub shading: Frame,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Derivative of the position along u.
    pub dp_du: Vec3,
    /// Derivative of the position along v.
    pub dp_dv: Vec3,
}
