//! `perspective`: an ideal pinhole.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Affine3A, Ray, Vec3};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::sensor::{Entry, Sensor};

pub(crate) const ENTRY: Entry = Entry { name: "perspective", build };

/// What all perspective sensors share: from the film to directions.
pub(super) struct Projection {
    pub(super) to_world: Affine3A,
    /// Local x and y at z = 1: `center + slope · film`.
    center: [f32; 2],
    slope: [f32; 2],
    pub(super) near: f32,
    pub(super) far: f32,
}

fn build(properties: &Properties<'_>, _: &mut Builder, aspect: f64) -> Result<Arc<dyn Sensor>> {
    Ok(Arc::new(Perspective(Projection::read(properties, aspect)?)))
}

struct Perspective(Projection);

impl Sensor for Perspective {
    fn ray(&self, film: [f32; 2], _: [f32; 2]) -> Ray {
        let local = self.0.local(film);
        self.0.ray(Vec3::ZERO, local)
    }
}

impl Projection {
    pub(super) fn read(properties: &Properties<'_>, aspect: f64) -> Result<Self> {
        let to_world = crate::shape::to_world(properties)?;
        let tangent = half_width(properties, aspect)?;
        let offset = [
            f64::from(properties.float("principal_point_offset_x", 0.0)?),
            f64::from(properties.float("principal_point_offset_y", 0.0)?),
        ];
        let (near, far) = clip_planes(properties)?;
        let extent = [-2.0 * tangent, -2.0 * tangent / aspect];
        Ok(Self {
            to_world: to_world.as_affine3a(),
            center: [0, 1].map(|axis| (extent[axis] * (offset[axis] - 0.5)) as f32),
            slope: extent.map(|x| x as f32),
            near,
            far,
        })
    }

    /// The local direction with z = 1 through a point of the film.
    pub(super) fn local(&self, film: [f32; 2]) -> Vec3 {
        let along = |axis: usize| self.center[axis] + self.slope[axis] * film[axis];
        Vec3::new(along(0), along(1), 1.0)
    }

    /// The world ray from a local origin on the lens plane along a local direction, between the clip planes.
    pub(super) fn ray(&self, origin: Vec3, local: Vec3) -> Ray {
        let direction = self.to_world.transform_vector3a(local).normalize();
        let per_z = local.length() / local.z;
        let origin = self.to_world.transform_point3a(origin) + direction * (self.near * per_z);
        Ray { origin, direction, t_max: (self.far - self.near) * per_z }
    }
}

/// Near and far clip distances.
pub(super) fn clip_planes(properties: &Properties<'_>) -> Result<(f32, f32)> {
    let near = properties.float("near_clip", 1e-2)?;
    let far = properties.float("far_clip", 1e4)?;
    if near >= 0.0 && near < far {
        return Ok((near, far));
    }
    Err(properties.error(format_args!("needs 0 <= near_clip < far_clip, not {near} and {far}")))
}

/// The tangent of half the horizontal field of view.
fn half_width(properties: &Properties<'_>, aspect: f64) -> Result<f64> {
    let fov = properties.optional_float("fov")?;
    let focal_length = properties.optional_string("focal_length")?;
    let axis = properties.choice("fov_axis", &["x", "y", "diagonal", "smaller", "larger"])?;
    let diagonal = (1.0 + 1.0 / (aspect * aspect)).sqrt();
    match (fov, focal_length) {
        (Some(_), Some(_)) => Err(properties.error("fov and focal_length exclude each other")),
        (Some(fov), None) => {
            if !(fov > 0.0 && fov < 180.0) {
                return Err(properties.error("fov must be between 0 and 180 degrees"));
            }
            let tangent = (f64::from(fov).to_radians() * 0.5).tan();
            Ok(match axis {
                0 => tangent,
                1 => tangent * aspect,
                2 => tangent / diagonal,
                3 => tangent * aspect.max(1.0),
                _ => tangent * aspect.min(1.0),
            })
        }
        (None, given) => {
            // a 36 × 24 mm film, measured along its diagonal
            let text = given.unwrap_or("50mm");
            let length: f64 = text.trim_end_matches("mm").trim().parse().map_err(|_| {
                properties.error(format_args!("focal_length must be like '50mm', not '{text}'"))
            })?;
            if length.is_nan() || length <= 0.0 {
                return Err(properties.error("focal_length must be positive"));
            }
            Ok((36.0_f64 * 36.0 + 24.0 * 24.0).sqrt() / (2.0 * length) / diagonal)
        }
    }
}
