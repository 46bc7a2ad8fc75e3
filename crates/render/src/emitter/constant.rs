//! `constant`: the same radiance from all directions.

use std::f32::consts::PI;
use std::sync::Arc;

use crate::Result;
use crate::emitter::{Aim, Emitter, EmitterHit, LightSample, SceneSphere};
use crate::geometry::{Rgb, Vec3, luminance, sin_cos_turns};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Emitter> = Entry { name: "constant", build };

struct Constant {
    radiance: Rgb,
}

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Arc<dyn Emitter>> {
    Ok(Arc::new(Constant { radiance: properties.optional_rgb("radiance")?.unwrap_or(Rgb::ONE) }))
}

impl Emitter for Constant {
    fn sample(&self, _: Vec3, aim: Aim) -> Option<LightSample> {
        let [u, v] = aim.u;
        let z = 1.0 - 2.0 * u;
        let ring = (1.0 - z * z).max(0.0).sqrt();
        let (sin_phi, cos_phi) = sin_cos_turns(v);
        Some(LightSample {
            direction: Vec3::new(ring * cos_phi, ring * sin_phi, z),
            distance: f32::INFINITY,
            radiance: self.radiance,
            density: 1.0 / (4.0 * PI),
            delta: false,
        })
    }

    fn radiance(&self, _: &EmitterHit) -> Rgb {
        self.radiance
    }

    fn density(&self, _: Vec3, _: &EmitterHit) -> f32 {
        1.0 / (4.0 * PI)
    }

    fn power(&self, scene: &SceneSphere) -> f32 {
        luminance(self.radiance) * 4.0 * PI * PI * scene.radius * scene.radius
    }

    fn is_environment(&self) -> bool {
        true
    }
}
