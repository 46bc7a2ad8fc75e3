//! A smooth interface between two dielectrics: reflection and refraction. For solid glass and water; `thindielectric`
//! for window panes, `roughdielectric` for ground glass.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::fresnel;
use crate::bsdf::glass::Glass;
use crate::bsdf::{Bsdf, BsdfSample};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "dielectric", build };

/// Clear glass.
pub struct Dielectric(Glass);

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    Ok(Arc::new(Dielectric(Glass::build(properties, builder)?)))
}

impl Bsdf for Dielectric {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, _: [f32; 2]) -> Option<BsdfSample> {
        if wo.z == 0.0 {
            return None;
        }
        let interface = fresnel::dielectric(wo.z, self.0.eta);
        if lobe < interface.reflectance {
            let weight = self.0.reflectance.evaluate(surface.uv);
            return Some(BsdfSample::mirror(wo, weight, interface.reflectance));
        }
        // Radiance is compressed into a narrower cone: eta_ti² (Veach 1997, section 5.2).
        Some(BsdfSample {
            wi: Vec3::new(-interface.eta_ti * wo.x, -interface.eta_ti * wo.y, interface.cos_t),
            weight: self.0.transmittance.evaluate(surface.uv) * (interface.eta_ti * interface.eta_ti),
            density: 1.0 - interface.reflectance,
            delta: true,
            eta: interface.eta_it,
        })
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
