//! Rough plastic: a diffuse base below a rough dielectric coat. For satin paint, unpolished plastic and wood lacquer.
//!
//! What passes the coat towards the base is tabulated over the angle when the scene is built.

use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use crate::Result;
use crate::bsdf::coat::Coat;
use crate::bsdf::fresnel;
use crate::bsdf::interface::{self, GaussLegendre};
use crate::bsdf::microfacet::{Microfacets, Roughness};
use crate::bsdf::warp::cosine_hemisphere;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "roughplastic", build };

/// Nodes of the table, evenly spaced in the cosine: as many as Mitsuba 3 has, so that values agree.
const NODES: usize = 64;

/// A diffuse base below a rough coat.
pub struct RoughPlastic {
    coat: Coat,
    facets: Microfacets,
    /// Transmittance of the coat from outside, over the cosine.
    transmittance: Box<[f32; NODES]>,
    internal: f32,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let coat = Coat::build(properties, builder)?;
    if coat.eta == 1.0 {
        return Err(properties.error("the interior and exterior indices of refraction must differ"));
    }
    let roughness = Roughness::build(properties, builder)?;
    let Some(facets) = roughness.uniform() else {
        return Err(properties.error("alpha must be one number"));
    };
    let node = |i: usize| (i as f32 / (NODES - 1) as f32).max(1e-6);
    let (all, rule) = (facets.of_visible_normals(), GaussLegendre::new(32));
    let transmittance =
        Box::new(std::array::from_fn(|i| interface::albedo(&all, node(i), coat.eta, true, &rule)));
    // Mitsuba's estimate of the cosine-weighted mean: that of the nodes, ends counted in full.
    let reflected = |i: usize| interface::albedo(&all, node(i), 1.0 / coat.eta, false, &rule) * node(i);
    let internal = 2.0 * (0..NODES).map(reflected).sum::<f32>() / NODES as f32;
    Ok(Arc::new(RoughPlastic { coat, facets, transmittance, internal }))
}

impl RoughPlastic {
    #[inline]
    fn transmittance(&self, cosine: f32) -> f32 {
        let x = cosine * (NODES - 1) as f32;
        let i = (x as usize).min(NODES - 2);
        let (low, high) = (self.transmittance[i], self.transmittance[i + 1]);
        low + (high - low) * (x - i as f32)
    }

    /// Both lobes, given the coat's transmittance towards the viewer.
    #[inline]
    fn both(&self, surface: &Surface, transmitted: f32, wo: Vec3, wi: Vec3) -> BsdfValue {
        let specular = self.coat.specular_probability(1.0 - transmitted, transmitted);
        let cosine = wi.z * FRAC_1_PI;
        let leaving = self.transmittance(wi.z);
        let mut value = self.coat.base(surface.uv, self.internal) * (cosine * transmitted * leaving);
        let mut density = (1.0 - specular) * cosine;

        let m = (wo + wi).normalize();
        let cos_m = wo.dot(m);
        let area = self.facets.area(m);
        if area > 0.0 && cos_m > 0.0 {
            let reflected = fresnel::dielectric(cos_m, self.coat.eta).reflectance;
            let glossy = reflected * area * self.facets.shadowing(wi, wo, m) / (4.0 * wo.z);
            value += self.coat.reflectance.evaluate(surface.uv) * glossy;
            density += specular * self.facets.density_of(area, wo, m) / (4.0 * cos_m);
        }
        BsdfValue { value, density }
    }
}

impl Bsdf for RoughPlastic {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let transmitted = self.transmittance(wo.z);
        let wi = if lobe < self.coat.specular_probability(1.0 - transmitted, transmitted) {
            let m = self.facets.sample(wo, u);
            2.0 * wo.dot(m) * m - wo
        } else {
            cosine_hemisphere(u)
        };
        if wi.z <= 0.0 {
            return None;
        }
        BsdfSample::smooth(wi, self.both(surface, transmitted, wo, wi))
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfValue::ZERO;
        }
        self.both(surface, self.transmittance(wo.z), wo, wi)
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.coat.diffuse.evaluate(surface.uv)
    }
}
