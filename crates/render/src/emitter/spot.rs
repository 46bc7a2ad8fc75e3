//! `spot`: a cone of light from one point along local +z, with a linear falloff of angle at its edge.

use std::f32::consts::PI;
use std::sync::Arc;

use crate::Result;
use crate::emitter::{Aim, Emitter, LightSample, SceneSphere};
use crate::geometry::{Affine3A, Rgb, Vec2, Vec3, luminance};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::Texture;

pub(crate) const ENTRY: Entry<dyn Emitter> = Entry { name: "spot", build };

struct Spot {
    position: Vec3,
    to_local: Affine3A,
    intensity: Rgb,
    texture: Option<Arc<dyn Texture>>,
    cutoff: f32,
    cos_cutoff: f32,
    cos_beam: f32,
    beam: f32,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Emitter>> {
    let to_world = crate::shape::to_world(properties)?;
    let cutoff = properties.float("cutoff_angle", 20.0)?;
    let beam = properties.float("beam_width", cutoff * 0.75)?;
    if !(0.0 < beam && beam <= cutoff && cutoff < 180.0) {
        return Err(properties.error("needs 0 < beam_width <= cutoff_angle < 180 (degrees)"));
    }
    let texture =
        properties.has("texture").then(|| builder.texture(properties, "texture", Rgb::ONE)).transpose()?;
    Ok(Arc::new(Spot {
        position: to_world.translation.as_vec3().into(),
        to_local: to_world.inverse().as_affine3a(),
        intensity: properties.optional_rgb("intensity")?.unwrap_or(Rgb::ONE),
        texture,
        cutoff: cutoff.to_radians(),
        cos_cutoff: cutoff.to_radians().cos(),
        cos_beam: beam.to_radians().cos(),
        beam: beam.to_radians(),
    }))
}

impl Spot {
    /// Intensity along a local unit direction.
    fn intensity(&self, local: Vec3) -> Rgb {
        let cosine = local.z;
        if cosine <= self.cos_cutoff {
            return Rgb::ZERO;
        }
        let falloff = if cosine >= self.cos_beam {
            1.0
        } else {
            (self.cutoff - cosine.acos()) / (self.cutoff - self.beam)
        };
        let image = self.texture.as_ref().map_or(Rgb::ONE, |texture| {
            let scale = 0.5 / (self.cutoff.tan() * local.z);
            texture.evaluate(Vec2::new(0.5 + scale * local.x, 0.5 + scale * local.y))
        });
        self.intensity * image * falloff
    }
}

impl Emitter for Spot {
    fn sample(&self, from: Vec3, _: Aim) -> Option<LightSample> {
        let to_light = self.position - from;
        let distance_squared = to_light.length_squared();
        let distance = distance_squared.sqrt();
        let local = self.to_local.transform_vector3a(-to_light).normalize_or_zero();
        let intensity = self.intensity(local);
        (distance > 0.0 && intensity != Rgb::ZERO).then(|| LightSample {
            direction: to_light / distance,
            distance,
            radiance: intensity / distance_squared,
            density: 1.0,
            delta: true,
        })
    }

    fn power(&self, _: &SceneSphere) -> f32 {
        let image = self.texture.as_ref().map_or(Rgb::ONE, |texture| texture.mean());
        luminance(self.intensity * image) * 2.0 * PI * (1.0 - 0.5 * (self.cos_cutoff + self.cos_beam))
    }
}
