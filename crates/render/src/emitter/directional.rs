//! `directional`: parallel light from infinitely far away.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::DVec3;

use crate::Result;
use crate::emitter::placement::vector_or_transform;
use crate::emitter::{Aim, Emitter, LightSample, SceneSphere};
use crate::geometry::{Rgb, Vec3, luminance};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Emitter> = Entry { name: "directional", build };

struct Directional {
    /// Where the light travels to.
    direction: Vec3,
    irradiance: Rgb,
}

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Arc<dyn Emitter>> {
    let direction = vector_or_transform(properties, "direction", |to_world| to_world.matrix3 * DVec3::Z)?;
    let direction = direction.try_normalize().ok_or_else(|| properties.error("direction must not vanish"))?;
    let irradiance = properties.optional_rgb("irradiance")?.unwrap_or(Rgb::ONE);
    Ok(Arc::new(Directional { direction: direction.as_vec3().into(), irradiance }))
}

impl Emitter for Directional {
    fn sample(&self, _: Vec3, _: Aim) -> Option<LightSample> {
        Some(LightSample {
            direction: -self.direction,
            distance: f32::INFINITY,
            radiance: self.irradiance,
            density: 1.0,
            delta: true,
        })
    }

    fn power(&self, scene: &SceneSphere) -> f32 {
        luminance(self.irradiance) * PI * scene.radius * scene.radius
    }
}
