//! Cosine-weighted directions: how every diffuse lobe is sampled.

use evenlight_points::warp::Warp;
use evenlight_points::warp::hemisphere_cosine::HemisphereCosine;

use crate::geometry::Vec3;

/// A point of the unit square to a direction of the upper hemisphere with density `cos θ / π` (Malley's method).
#[inline]
pub(crate) fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    Vec3::from(HemisphereCosine.map(u))
}
