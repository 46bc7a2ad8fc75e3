//! A thin pane with two parallel interfaces: light passes unbent. For windows modeled as one surface.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::fresnel;
use crate::bsdf::glass::Glass;
use crate::bsdf::{Bsdf, BsdfSample};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "thindielectric", build };

/// A window pane.
pub struct ThinDielectric(Glass);

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    Ok(Arc::new(ThinDielectric(Glass::build(properties, builder)?)))
}

impl Bsdf for ThinDielectric {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, _: [f32; 2]) -> Option<BsdfSample> {
        let single = fresnel::dielectric(wo.z.abs(), self.0.eta).reflectance;
        // All internal reflections: R + T R T + T R³ T + … = 2 R / (1 + R).
        let reflected = 2.0 * single / (1.0 + single);
        if lobe < reflected {
            return Some(BsdfSample::mirror(wo, self.0.reflectance.evaluate(surface.uv), reflected));
        }
        Some(BsdfSample::pass_through(wo, self.0.transmittance.evaluate(surface.uv), 1.0 - reflected))
    }

    fn has_smooth_lobe(&self) -> bool {
        false
    }

    fn transmits(&self) -> bool {
        true
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.0.transmittance.evaluate(surface.uv)
    }
}
