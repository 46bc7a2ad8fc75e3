//! `cylinder`: an open cylinder from `p0` to `p1`, facing outwards; `to_world` may scale its axis by another factor.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::DVec3;

use crate::Result;
use crate::geometry::{Frame, Ray, Surface, Vec2, Vec3, sin_cos_turns};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::shape::{Analytic, Entry, Geometry, LightGeometry, LightPoint, area_to_solid_angle, to_world};

pub(crate) const ENTRY: Entry = Entry { name: "cylinder", build };

struct Cylinder {
    base: Vec3,
    /// `n` is the axis; `s` is where u begins. Left-handed in a mirroring transform.
    frame: Frame,
    length: f32,
    radius: f32,
    side: f32,
}

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let to_world = to_world(properties)?;
    let p0 = DVec3::from(properties.optional_vector("p0")?.unwrap_or_default());
    let p1 = DVec3::from(properties.optional_vector("p1")?.unwrap_or([0.0, 0.0, 1.0]));
    let radius = f64::from(properties.float("radius", 1.0)?);
    let axis = (p1 - p0).try_normalize();
    let refusal = || properties.error("radius and length must be positive");
    let axis = axis.ok_or_else(refusal)?;

    // The frame is chosen before the transform, and goes with it.
    let local = Frame::from_normal(axis.as_vec3().into());
    let [s, t, n] = [local.s, local.t, local.n].map(|side| to_world.matrix3 * side.as_dvec3());
    let scale = s.length();
    let skew = [s.dot(t), t.dot(n), n.dot(s)].map(|dot| dot.abs() / (scale * scale.max(n.length())));
    if (t.length() - scale).abs() > 1e-4 * scale || skew.iter().any(|skew| *skew > 1e-4) {
        return Err(properties.error("to_world must keep the cylinder round and straight"));
    }
    let side = if properties.boolean("flip_normals", false)? { -1.0 } else { 1.0 };
    let [s, t, n] = [s, t, n].map(|side| side.normalize().as_vec3().into());
    let end = to_world.transform_point3(p1);
    let base = to_world.transform_point3(p0);
    let (length, radius) = (base.distance(end) as f32, (radius * scale) as f32);
    if !(radius > 0.0 && length > 0.0 && (radius * length).is_finite()) {
        return Err(refusal());
    }
    Ok(Geometry::Analytic(Arc::new(Cylinder {
        base: base.as_vec3().into(),
        frame: Frame { s, t, n },
        length,
        radius,
        side,
    })))
}

impl Cylinder {
    fn local(&self, position: Vec3) -> Vec3 {
        self.frame.to_local(position - self.base)
    }
}

impl Analytic for Cylinder {
    fn bounds(&self) -> [Vec3; 2] {
        let axis = self.frame.n;
        let squared = (Vec3::ONE - axis * axis).max(Vec3::ZERO);
        let reach = Vec3::new(squared.x.sqrt(), squared.y.sqrt(), squared.z.sqrt()) * self.radius;
        let top = self.base + axis * self.length;
        [self.base.min(top) - reach, self.base.max(top) + reach]
    }

    fn intersect(&self, ray: &Ray) -> Option<f32> {
        let origin = self.local(ray.origin).as_dvec3();
        let direction = self.frame.to_local(ray.direction).as_dvec3();
        let a = direction.x * direction.x + direction.y * direction.y;
        let half_b = origin.x * direction.x + origin.y * direction.y;
        let radius = f64::from(self.radius);
        let closest = origin - direction * (half_b / a);
        let discriminant = radius * radius - closest.x * closest.x - closest.y * closest.y;
        if a == 0.0 || discriminant < 0.0 {
            return None;
        }
        let root = (discriminant / a).sqrt();
        let length = f64::from(self.length);
        let within = |t: f64| (0.0..=length).contains(&(origin.z + t * direction.z));
        [-half_b / a - root, -half_b / a + root]
            .into_iter()
            .find(|&t| t > 0.0 && t < f64::from(ray.t_max) && within(t))
            .map(|t| t as f32)
    }

    fn surface(&self, position: Vec3) -> Surface {
        let local = self.local(position);
        let ring = (local.x * local.x + local.y * local.y).sqrt();
        let outward = self.frame.to_world(Vec3::new(local.x / ring, local.y / ring, 0.0));
        let phi = local.y.atan2(local.x);
        let phi = if phi < 0.0 { phi + 2.0 * PI } else { phi };
        let normal = outward * self.side;
        let dp_du = self.frame.to_world(Vec3::new(-local.y, local.x, 0.0) / ring) * (2.0 * PI * self.radius);
        Surface {
            position: self.base + self.frame.n * local.z + outward * self.radius,
            geometric_normal: normal,
            shading: Frame::from_normal_and_tangent(normal, dp_du),
            uv: Vec2::new(phi / (2.0 * PI), local.z / self.length),
            dp_du,
            dp_dv: self.frame.n * self.length,
        }
    }
}

impl LightGeometry for Cylinder {
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<LightPoint> {
        let (sin_phi, cos_phi) = sin_cos_turns(u[0]);
        let outward = self.frame.to_world(Vec3::new(cos_phi, sin_phi, 0.0));
        let position = self.base + outward * self.radius + self.frame.n * (u[1] * self.length);
        let normal = outward * self.side;
        LightPoint::by_area(self.area(), from, position, normal, Vec2::from(u))
    }

    fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        area_to_solid_angle(self.area(), from, position, normal)
    }

    fn area(&self) -> f32 {
        2.0 * PI * self.radius * self.length
    }
}
