//! Rough metal: microfacets that are perfect mirrors. For brushed, sanded or cast metal; alpha 0.001–0.01 looks polished,
//! 0.1 rough, 0.3–0.7 extremely rough. Torrance & Sparrow 1967; Walter et al. 2007.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::metal::Metal;
use crate::bsdf::microfacet::{Microfacets, Roughness};
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "roughconductor", build };

/// Glossy reflection by a metal.
pub struct RoughConductor {
    metal: Metal,
    roughness: Roughness,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let roughness = Roughness::build(properties, builder)?;
    Ok(Arc::new(RoughConductor { metal: Metal::build(properties, builder)?, roughness }))
}

impl RoughConductor {
    /// Value and density once the facet's normal `m` is known.
    #[inline]
    fn reflect(&self, surface: &Surface, facets: Microfacets, (wo, wi, m): (Vec3, Vec3, Vec3)) -> BsdfValue {
        let cos_m = wo.dot(m);
        let area = facets.area(m);
        if cos_m <= 0.0 || wi.dot(m) <= 0.0 || area == 0.0 {
            return BsdfValue::ZERO;
        }
        let value = area * facets.shadowing(wi, wo, m) / (4.0 * wo.z);
        let density = facets.density_of(area, wo, m) / (4.0 * cos_m);
        BsdfValue { value: self.metal.reflectance(surface.uv, cos_m) * value, density }
    }
}

impl Bsdf for RoughConductor {
    fn sample(&self, surface: &Surface, wo: Vec3, _: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let facets = self.roughness.at(surface.uv);
        let m = facets.sample(wo, u);
        let wi = 2.0 * wo.dot(m) * m - wo;
        if wi.z <= 0.0 {
            return None;
        }
        BsdfSample::smooth(wi, self.reflect(surface, facets, (wo, wi, m)))
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfValue::ZERO;
        }
        let m = (wo + wi).normalize();
        self.reflect(surface, self.roughness.at(surface.uv), (wo, wi, m))
    }

    fn needs_tangents(&self) -> bool {
        self.roughness.is_anisotropic()
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.metal.reflectance(surface.uv, 1.0)
    }
}
