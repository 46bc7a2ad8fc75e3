//! `point`: the same intensity in all directions, from one point.

use std::f32::consts::PI;
use std::sync::Arc;

use crate::Result;
use crate::emitter::placement::vector_or_transform;
use crate::emitter::{Aim, Emitter, LightSample, SceneSphere};
use crate::geometry::{Rgb, Vec3, luminance};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Emitter> = Entry { name: "point", build };

struct Point {
    position: Vec3,
    intensity: Rgb,
}

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Arc<dyn Emitter>> {
    let position = vector_or_transform(properties, "position", |to_world| to_world.translation)?;
    let intensity = properties.optional_rgb("intensity")?.unwrap_or(Rgb::ONE);
    Ok(Arc::new(Point { position: position.as_vec3().into(), intensity }))
}

impl Emitter for Point {
    fn sample(&self, from: Vec3, _: Aim) -> Option<LightSample> {
        let to_light = self.position - from;
        let distance_squared = to_light.length_squared();
        let distance = distance_squared.sqrt();
        (distance > 0.0).then(|| LightSample {
            direction: to_light / distance,
            distance,
            radiance: self.intensity / distance_squared,
            density: 1.0,
            delta: true,
        })
    }

    fn power(&self, _: &SceneSphere) -> f32 {
        luminance(self.intensity) * 4.0 * PI
    }
}
