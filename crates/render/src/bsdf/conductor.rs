//! A perfect metal mirror. For polished metal; `roughconductor` for anything less.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::metal::Metal;
use crate::bsdf::{Bsdf, BsdfSample};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "conductor", build };

/// Specular reflection by a metal.
pub struct Conductor {
    metal: Metal,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    Ok(Arc::new(Conductor { metal: Metal::build(properties, builder)? }))
}

impl Bsdf for Conductor {
    fn sample(&self, surface: &Surface, wo: Vec3, _: f32, _: [f32; 2]) -> Option<BsdfSample> {
        (wo.z > 0.0).then(|| BsdfSample::mirror(wo, self.metal.reflectance(surface.uv, wo.z), 1.0))
    }

    fn has_smooth_lobe(&self) -> bool {
        false
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.metal.reflectance(surface.uv, 1.0)
    }
}
