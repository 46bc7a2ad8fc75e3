//! Cosine-weighted directions: how every diffuse lobe is sampled.

use crate::geometry::{Vec3, sin_cos_turns};

/// A point of the unit square to a direction of the upper hemisphere with density `cos θ / π` (Malley's method).
#[inline]
pub(crate) fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let (sin_phi, cos_phi) = sin_cos_turns(u[0]);
    let radius = u[1].sqrt();
    Vec3::new(radius * cos_phi, radius * sin_phi, (1.0 - u[1]).sqrt())
}
