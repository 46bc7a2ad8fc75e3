//! Smooth plastic: a diffuse base below a clear dielectric coat, with all internal reflections. For varnish, glazed
//! ceramics and polished plastic; `roughplastic` for satin finishes.

use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use crate::Result;
use crate::bsdf::coat::Coat;
use crate::bsdf::fresnel;
use crate::bsdf::warp::cosine_hemisphere;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "plastic", build };

/// A diffuse base below a smooth coat.
pub struct Plastic {
    coat: Coat,
    internal: f32,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let coat = Coat::build(properties, builder)?;
    let internal = fresnel::diffuse_reflectance(1.0 / coat.eta);
    Ok(Arc::new(Plastic { coat, internal }))
}

impl Plastic {
    /// Diffuse color seen from below one side of the coat, and the share of transmitted light.
    #[inline]
    fn base(&self, surface: &Surface, transmitted: f32, cos_i: f32) -> Rgb {
        let leaving = 1.0 - fresnel::dielectric(cos_i, self.coat.eta).reflectance;
        self.coat.base(surface.uv, self.internal) * (transmitted * leaving)
    }
}

impl Bsdf for Plastic {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let reflected = fresnel::dielectric(wo.z, self.coat.eta).reflectance;
        let specular = self.coat.specular_probability(reflected, 1.0 - reflected);
        if lobe < specular {
            let weight = self.coat.reflectance.evaluate(surface.uv) * (reflected / specular);
            return Some(BsdfSample::mirror(wo, weight, specular));
        }
        let wi = cosine_hemisphere(u);
        let probability = 1.0 - specular;
        let weight = self.base(surface, 1.0 - reflected, wi.z) / probability;
        Some(BsdfSample { wi, weight, density: wi.z * FRAC_1_PI * probability, delta: false, eta: 1.0 })
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfValue::ZERO;
        }
        let reflected = fresnel::dielectric(wo.z, self.coat.eta).reflectance;
        let probability = 1.0 - self.coat.specular_probability(reflected, 1.0 - reflected);
        let cosine = wi.z * FRAC_1_PI;
        let value = self.base(surface, 1.0 - reflected, wi.z) * cosine;
        BsdfValue { value, density: cosine * probability }
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.coat.diffuse.evaluate(surface.uv)
    }
}
