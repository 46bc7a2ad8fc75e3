//! Normals from a texture: its colors (r, g, b) are `(n + 1) / 2` in the shading frame. The texture must be `raw`.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::Bsdf;
use crate::bsdf::perturbed::{Normals, Perturbed};
use crate::geometry::{Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::slot::ColorSlot;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "normalmap", build };

/// Tabulated normals.
struct NormalMap(ColorSlot);

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    if !properties.has("normalmap") {
        return Err(properties.error("needs a texture named 'normalmap'"));
    }
    let map = ColorSlot::build(properties, builder, "normalmap", 0.5)?;
    Ok(Arc::new(Perturbed::build(NormalMap(map), properties, builder)?))
}

impl Normals for NormalMap {
    #[inline]
    fn normal(&self, surface: &Surface) -> Vec3 {
        (2.0 * self.0.evaluate(surface.uv) - Vec3::ONE).normalize_or(Vec3::Z)
    }
}
