//! A rough interface between two dielectrics: microfacets that reflect and refract. For ground or frosted glass.
//! Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".

use std::sync::Arc;

use crate::Result;
use crate::bsdf::fresnel;
use crate::bsdf::glass::Glass;
use crate::bsdf::microfacet::{Microfacets, Roughness};
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "roughdielectric", build };

/// Ground glass.
pub struct RoughDielectric {
    glass: Glass,
    roughness: Roughness,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let glass = Glass::build(properties, builder)?;
    if glass.eta == 1.0 {
        return Err(properties.error("the interior and exterior indices of refraction must differ"));
    }
    Ok(Arc::new(RoughDielectric { glass, roughness: Roughness::build(properties, builder)? }))
}

impl RoughDielectric {
    /// Value and density once the facet's normal `m` (`m.z > 0`) is known.
    #[inline]
    fn scatter(&self, surface: &Surface, facets: Microfacets, (wo, wi, m): (Vec3, Vec3, Vec3)) -> BsdfValue {
        let (cos_o, cos_i) = (wo.dot(m), wi.dot(m));
        let area = facets.area(m);
        if cos_o * wo.z <= 0.0 || cos_i * wi.z <= 0.0 || area == 0.0 {
            return BsdfValue::ZERO;
        }
        let interface = fresnel::dielectric(cos_o, self.glass.eta);
        let upper = if wo.z < 0.0 { -wo } else { wo };
        let normal_density = facets.widened(wo.z).density(upper, m);
        let common = area * facets.shadowing(wi, wo, m);
        if wo.z * wi.z > 0.0 {
            let value = interface.reflectance * common / (4.0 * wo.z.abs());
            let density = interface.reflectance * normal_density / (4.0 * cos_i.abs());
            return BsdfValue { value: self.glass.reflectance.evaluate(surface.uv) * value, density };
        }
        // Walter et al. 2007, equations 17 and 21; radiance adds eta_ti², which cancels eta_it² in the value.
        let (share, eta) = (1.0 - interface.reflectance, interface.eta_it);
        let denominator = (cos_o + eta * cos_i) * (cos_o + eta * cos_i);
        let value = (share * common * cos_i * cos_o / (wo.z * denominator)).abs();
        let density = share * normal_density * eta * eta * cos_i.abs() / denominator;
        BsdfValue { value: self.glass.transmittance.evaluate(surface.uv) * value, density }
    }
}

impl Bsdf for RoughDielectric {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z == 0.0 {
            return None;
        }
        let facets = self.roughness.at(surface.uv);
        let upper = if wo.z < 0.0 { -wo } else { wo };
        let m = facets.widened(wo.z).sample(upper, u);
        let cos_o = wo.dot(m);
        let interface = fresnel::dielectric(cos_o, self.glass.eta);
        let reflects = lobe < interface.reflectance;
        let (wi, eta) = if reflects {
            (2.0 * cos_o * m - wo, 1.0)
        } else {
            (interface.refract(wo, m, cos_o), interface.eta_it)
        };
        if (wi.z * wo.z > 0.0) != reflects || wi.z == 0.0 {
            return None;
        }
        let sample = BsdfSample::smooth(wi, self.scatter(surface, facets, (wo, wi, m)))?;
        Some(BsdfSample { eta, ..sample })
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        if wo.z == 0.0 || wi.z == 0.0 {
            return BsdfValue::ZERO;
        }
        let ratio = match (wo.z * wi.z > 0.0, wo.z > 0.0) {
            (true, _) => 1.0,
            (false, true) => self.glass.eta,
            (false, false) => 1.0 / self.glass.eta,
        };
        let m = (wo + wi * ratio).normalize();
        let m = if m.z < 0.0 { -m } else { m };
        self.scatter(surface, self.roughness.at(surface.uv), (wo, wi, m))
    }

    fn needs_tangents(&self) -> bool {
        self.roughness.is_anisotropic()
    }

    fn transmits(&self) -> bool {
        true
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.glass.transmittance.evaluate(surface.uv)
    }
}
