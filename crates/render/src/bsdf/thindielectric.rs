//! A thin pane with two parallel interfaces: light passes unbent. For windows modeled as one surface.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::fresnel;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

use crate::texture::slot::ColorSlot;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "thindielectric", build };

/// A window pane.
pub struct ThinDielectric {
    eta: f32,
    reflectance: ColorSlot,
    transmittance: ColorSlot,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    Ok(Arc::new(ThinDielectric {
        eta: fresnel::relative_ior(properties, "bk7")?,
        reflectance: ColorSlot::build(properties, builder, "specular_reflectance", 1.0)?,
        transmittance: ColorSlot::build(properties, builder, "specular_transmittance", 1.0)?,
    }))
}

impl Bsdf for ThinDielectric {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, _: [f32; 2]) -> Option<BsdfSample> {
        let single = fresnel::dielectric(wo.z.abs(), self.eta).reflectance;
        // All internal reflections: R + T R T + T R³ T + … = 2 R / (1 + R).
        let reflected = 2.0 * single / (1.0 + single);
        if lobe < reflected {
            return Some(BsdfSample::mirror(wo, self.reflectance.evaluate(surface.uv), reflected));
        }
        Some(BsdfSample::pass_through(wo, self.transmittance.evaluate(surface.uv), 1.0 - reflected))
    }

    fn evaluate(&self, _: &Surface, _: Vec3, _: Vec3) -> BsdfValue {
        BsdfValue::ZERO
    }

    fn has_smooth_lobe(&self) -> bool {
        false
    }

    fn transmits(&self) -> bool {
        true
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.transmittance.evaluate(surface.uv)
    }
}
