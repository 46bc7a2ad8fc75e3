//! `disk`: the unit disk in the xy plane, facing +z.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::Result;
use crate::geometry::{Affine3A, Frame, Ray, Surface, Vec2, Vec3, sin_cos_turns};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::shape::{Analytic, Entry, Geometry, LightGeometry, LightPoint, area_to_solid_angle, to_world};

pub(crate) const ENTRY: Entry = Entry { name: "disk", build };

struct Disk {
    to_world: Affine3A,
    to_local: Affine3A,
    normal: Vec3,
    area: f32,
}

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let to_world = to_world(properties)?;
    let (x, y) = (to_world.matrix3.x_axis, to_world.matrix3.y_axis);
    let normal = (to_world.matrix3.inverse().transpose() * DVec3::Z).normalize();
    let side = if properties.boolean("flip_normals", false)? { -1.0 } else { 1.0 };
    Ok(Geometry::Analytic(Arc::new(Disk {
        to_world: to_world.as_affine3a(),
        to_local: to_world.inverse().as_affine3a(),
        normal: (normal * side).as_vec3().into(),
        area: (std::f64::consts::PI * x.cross(y).length()) as f32,
    })))
}

impl Disk {
    fn uv(local: DVec2) -> Vec2 {
        let phi = local.y.atan2(local.x);
        let phi = if phi < 0.0 { phi + 2.0 * std::f64::consts::PI } else { phi };
        DVec2::new(local.length(), phi / (2.0 * std::f64::consts::PI)).as_vec2()
    }

    fn local(&self, position: Vec3) -> DVec2 {
        let p = self.to_local.transform_point3a(position);
        DVec2::new(f64::from(p.x), f64::from(p.y))
    }
}

impl Analytic for Disk {
    fn bounds(&self) -> [Vec3; 2] {
        let m = self.to_world.matrix3;
        let reach = (m.x_axis * m.x_axis + m.y_axis * m.y_axis).max(Vec3::ZERO);
        let reach = Vec3::new(reach.x.sqrt(), reach.y.sqrt(), reach.z.sqrt());
        let center = Vec3::from(self.to_world.translation);
        [center - reach, center + reach]
    }

    fn intersect(&self, ray: &Ray) -> Option<f32> {
        let origin = self.to_local.transform_point3a(ray.origin);
        let direction = self.to_local.transform_vector3a(ray.direction);
        let t = -origin.z / direction.z;
        let hit = origin + direction * t;
        (t > 0.0 && t < ray.t_max && hit.x * hit.x + hit.y * hit.y <= 1.0).then_some(t)
    }

    fn surface(&self, position: Vec3) -> Surface {
        let local = self.local(position);
        let radius = local.length();
        let m = self.to_world.matrix3;
        let (cos_phi, sin_phi) =
            if radius > 0.0 { ((local.x / radius) as f32, (local.y / radius) as f32) } else { (1.0, 0.0) };
        let dp_du = m.x_axis * cos_phi + m.y_axis * sin_phi;
        let dp_dv = (m.y_axis * cos_phi - m.x_axis * sin_phi) * (2.0 * PI * radius as f32);
        Surface {
            position: self.to_world.transform_point3a(Vec3::new(local.x as f32, local.y as f32, 0.0)),
            geometric_normal: self.normal,
            shading: Frame::from_normal_and_tangent(self.normal, dp_du),
            uv: Self::uv(local),
            dp_du,
            dp_dv,
        }
    }
}

impl LightGeometry for Disk {
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<LightPoint> {
        let radius = u[0].sqrt();
        let (sin_phi, cos_phi) = sin_cos_turns(u[1]);
        let local = Vec3::new(radius * cos_phi, radius * sin_phi, 0.0);
        let position = self.to_world.transform_point3a(local);
        LightPoint::by_area(self.area, from, position, self.normal, Vec2::new(radius, u[1]))
    }

    fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        area_to_solid_angle(self.area, from, position, normal)
    }

    fn area(&self) -> f32 {
        self.area
    }
}
