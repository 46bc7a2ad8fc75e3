//! Normals from a texture: its colors (r, g, b) are `(n + 1) / 2` in the shading frame. The texture must be `raw`.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::perturbed::Perturbed;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::slot::ColorSlot;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "normalmap", build };

/// A surface with tabulated normals.
pub struct NormalMap {
    map: ColorSlot,
    perturbed: Perturbed,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    if !properties.has("normalmap") {
        return Err(properties.error("needs a texture named 'normalmap'"));
    }
    let map = ColorSlot::build(properties, builder, "normalmap", 0.5)?;
    Ok(Arc::new(NormalMap { map, perturbed: Perturbed::build(properties, builder)? }))
}

impl NormalMap {
    #[inline]
    fn normal(&self, surface: &Surface) -> Vec3 {
        (2.0 * self.map.evaluate(surface.uv) - Vec3::ONE).normalize_or(Vec3::Z)
    }
}

impl Bsdf for NormalMap {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        self.perturbed.sample(surface, (self.normal(surface), wo), lobe, u)
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        self.perturbed.evaluate(surface, self.normal(surface), wo, wi)
    }

    fn has_smooth_lobe(&self) -> bool {
        self.perturbed.nested.has_smooth_lobe()
    }

    fn needs_tangents(&self) -> bool {
        true
    }

    fn transmits(&self) -> bool {
        self.perturbed.nested.transmits()
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.perturbed.nested.albedo(surface)
    }
}
