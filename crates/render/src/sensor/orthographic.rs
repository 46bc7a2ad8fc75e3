//! `orthographic`: parallel rays; the film covers [−1, 1] along x in local coordinates.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Affine3A, Ray, Vec3};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::sensor::perspective::clip_planes;
use crate::sensor::{Entry, Sensor};

pub(crate) const ENTRY: Entry = Entry { name: "orthographic", build };

struct Orthographic {
    to_world: Affine3A,
    aspect: f32,
    near: f32,
    far: f32,
}

fn build(properties: &Properties<'_>, _: &mut Builder, aspect: f64) -> Result<Arc<dyn Sensor>> {
    let to_world = crate::shape::to_world(properties)?.as_affine3a();
    let (near, far) = clip_planes(properties)?;
    Ok(Arc::new(Orthographic { to_world, aspect: aspect as f32, near, far }))
}

impl Sensor for Orthographic {
    fn ray(&self, film: [f32; 2], _: [f32; 2]) -> Ray {
        let local = Vec3::new(1.0 - 2.0 * film[0], (1.0 - 2.0 * film[1]) / self.aspect, self.near);
        Ray {
            origin: self.to_world.transform_point3a(local),
            direction: self.to_world.transform_vector3a(Vec3::Z).normalize(),
            t_max: (self.far - self.near) * self.to_world.matrix3.z_axis.length(),
        }
    }
}
