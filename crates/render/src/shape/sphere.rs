//! `sphere`: a sphere given by center and radius, or by a transform of the unit sphere; a mirroring one turns it inside out.
//!
//! As a light it is sampled by the solid angle of its visible cap (Shirley, Wang & Zimmerman 1996).

use std::f32::consts::PI;
use std::sync::Arc;

use glam::DVec3;

use crate::Result;
use crate::geometry::{Frame, Mat3A, Ray, Surface, Vec2, Vec3, sin_cos_turns};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::shape::{Analytic, Entry, Geometry, LightGeometry, LightPoint, to_world, uniform_scale};

pub(crate) const ENTRY: Entry = Entry { name: "sphere", build };

struct Sphere {
    center: Vec3,
    radius: f32,
    /// World to local directions, without scale.
    to_local: Mat3A,
    /// −1 when the normal points inwards.
    side: f32,
}

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let to_world = to_world(properties)?;
    let scale = uniform_scale(properties, &to_world)?;
    let center = properties.optional_vector("center")?.unwrap_or_default();
    let radius = f64::from(properties.float("radius", 1.0)?) * scale;
    if radius <= 0.0 || !radius.is_finite() {
        return Err(properties.error("radius must be positive"));
    }
    let mirrored = to_world.matrix3.determinant() < 0.0;
    let side = if properties.boolean("flip_normals", false)? == mirrored { 1.0 } else { -1.0 };
    let rotation = to_world.matrix3 * (1.0 / scale);
    Ok(Geometry::Analytic(Arc::new(Sphere {
        center: to_world.transform_point3(DVec3::from(center)).as_vec3().into(),
        radius: radius as f32,
        to_local: Mat3A::from(rotation.transpose().as_mat3()),
        side,
    })))
}

impl Sphere {
    /// 1 − cos of the half angle of the cone in which `from` sees the sphere; `None` from inside or on it.
    /// Not the cosine itself: small cones keep their precision.
    fn cone(&self, from: Vec3) -> Option<f32> {
        let distance_squared = (self.center - from).length_squared();
        let sin2 = self.radius * self.radius / distance_squared;
        (sin2 < 0.9999).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
    }

    fn uv(&self, outward: Vec3) -> Vec2 {
        let local = self.to_local * outward;
        let phi = local.y.atan2(local.x);
        let phi = if phi < 0.0 { phi + 2.0 * PI } else { phi };
        Vec2::new(phi / (2.0 * PI), local.z.clamp(-1.0, 1.0).acos() / PI)
    }
}

impl Analytic for Sphere {
    fn bounds(&self) -> [Vec3; 2] {
        [self.center - self.radius, self.center + self.radius]
    }

    fn intersect(&self, ray: &Ray) -> Option<f32> {
        // In double precision: from afar, the discriminant is a small difference of large numbers.
        let to_origin = (ray.origin - self.center).as_dvec3();
        let direction = ray.direction.as_dvec3();
        let a = direction.length_squared();
        let half_b = to_origin.dot(direction);
        let closest = to_origin - direction * (half_b / a);
        let radius = f64::from(self.radius);
        let discriminant = radius * radius - closest.length_squared();
        if discriminant < 0.0 {
            return None;
        }
        let root = (discriminant / a).sqrt();
        let (near, far) = ((-half_b / a - root) as f32, (-half_b / a + root) as f32);
        [near, far].into_iter().find(|&t| t > 0.0 && t < ray.t_max)
    }

    fn surface(&self, position: Vec3) -> Surface {
        let outward = (position - self.center).normalize();
        let normal = outward * self.side;
        let local = self.to_local * outward;
        let to_world = self.to_local.transpose();
        let ring = (local.x * local.x + local.y * local.y).sqrt();
        let dp_du = to_world * Vec3::new(-local.y, local.x, 0.0) * (2.0 * PI * self.radius);
        let (cos_phi, sin_phi) = if ring > 0.0 { (local.x / ring, local.y / ring) } else { (1.0, 0.0) };
        let dp_dv = to_world * Vec3::new(local.z * cos_phi, local.z * sin_phi, -ring) * (PI * self.radius);
        Surface {
            position: self.center + outward * self.radius,
            geometric_normal: normal,
            shading: Frame::from_normal_and_tangent(normal, dp_du),
            uv: self.uv(outward),
            dp_du,
            dp_dv,
        }
    }
}

impl LightGeometry for Sphere {
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<LightPoint> {
        let (sin_phi, cos_phi) = sin_cos_turns(u[1]);
        let Some(one_minus_cos_max) = self.cone(from) else {
            let z = 1.0 - 2.0 * u[0];
            let ring = (1.0 - z * z).max(0.0).sqrt();
            let outward = Vec3::new(ring * cos_phi, ring * sin_phi, z);
            let (position, normal) = (self.center + outward * self.radius, outward * self.side);
            return LightPoint::by_area(self.area(), from, position, normal, self.uv(outward));
        };
        let to_center = self.center - from;
        let distance = to_center.length();
        let one_minus_cos = u[0] * one_minus_cos_max;
        let cos_theta = 1.0 - one_minus_cos;
        let sin2_theta = one_minus_cos * (2.0 - one_minus_cos);
        // angle at the center between the receiver and the point (law of sines)
        let along = distance * cos_theta
            - (self.radius * self.radius - distance * distance * sin2_theta).max(0.0).sqrt();
        let cos_alpha = ((distance * distance + self.radius * self.radius - along * along)
            / (2.0 * distance * self.radius))
            .clamp(-1.0, 1.0);
        let sin_alpha = (1.0 - cos_alpha * cos_alpha).max(0.0).sqrt();
        let frame = Frame::from_normal(-to_center / distance);
        let outward = frame.to_world(Vec3::new(sin_alpha * cos_phi, sin_alpha * sin_phi, cos_alpha));
        let position = self.center + outward * self.radius;
        let (normal, to_point) = (outward * self.side, position - from);
        let distance = to_point.length();
        let direction = to_point / distance;
        let density = 1.0 / (2.0 * PI * one_minus_cos_max);
        let seen = distance > 0.0 && normal.dot(direction) < 0.0;
        seen.then(|| LightPoint { position, normal, uv: self.uv(outward), direction, distance, density })
    }

    fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        match self.cone(from) {
            Some(one_minus_cos_max) => 1.0 / (2.0 * PI * one_minus_cos_max),
            None => super::area_to_solid_angle(self.area(), from, position, normal),
        }
    }

    fn area(&self) -> f32 {
        4.0 * PI * self.radius * self.radius
    }
}
