//! Shading about another normal than the surface's: what bump maps and normal maps share.
//!
//! Two documented features of Mitsuba 3 (3.7.1 and later) are on by default: `flip_invalid_normals` mirrors a normal that
//! faces away from the viewer (Schüßler et al. 2017, "Microfacet-based Normal Mapping for Robust Monte Carlo Path
//! Tracing"), and `use_shadowing_function` softens the shadow's edge (Conty Estevez, Lecocq & Stein 2019, "A
//! Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem", Ray Tracing Gems). Not a member by itself.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Frame, Rgb, Surface, Vec3};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;

/// Where the other normal comes from.
pub(crate) trait Normals: Send + Sync {
    /// The unit normal in the shading frame.
    fn normal(&self, surface: &Surface) -> Vec3;
}

/// A scattering function about a perturbed normal.
pub(crate) struct Perturbed<N> {
    normals: N,
    nested: Arc<dyn Bsdf>,
    flip: bool,
    shadowing: bool,
}

impl<N: Normals> Perturbed<N> {
    /// Read the nested BSDF, `flip_invalid_normals` and `use_shadowing_function`.
    pub(crate) fn build(normals: N, properties: &Properties<'_>, builder: &mut Builder) -> Result<Self> {
        Ok(Self {
            normals,
            flip: properties.boolean("flip_invalid_normals", true)?,
            shadowing: properties.boolean("use_shadowing_function", true)?,
            nested: builder.only_bsdf(properties)?,
        })
    }

    /// The perturbed frame in local coordinates, its tangent as near to the old one as can be, and the surface as the nested BSDF sees it.
    #[inline]
    fn frame(&self, surface: &Surface, wo: Vec3) -> (Frame, Surface) {
        let n = self.normals.normal(surface);
        let n = if self.flip && n.dot(wo) * wo.z <= 0.0 { Vec3::new(-n.x, -n.y, n.z) } else { n };
        let local = Frame::from_normal_and_tangent(n, Vec3::X);
        let world = |v: Vec3| surface.shading.to_world(v);
        let shading = Frame { s: world(local.s), t: world(local.t), n: world(local.n) };
        (local, Surface { shading, ..*surface })
    }

    /// G1 of a GGX surface with α² = tan²θ / 8 but at most 1, where θ is between the two normals.
    #[inline]
    fn shadow(&self, n: Vec3, wi: Vec3) -> f32 {
        if !self.shadowing {
            return 1.0;
        }
        let tangent_squared = |v: Vec3| (v.x * v.x + v.y * v.y) / (v.z * v.z);
        let alpha_squared = (0.125 * tangent_squared(n)).min(1.0);
        2.0 / (1.0 + (1.0 + alpha_squared * tangent_squared(wi)).sqrt())
    }
}

impl<N: Normals> Bsdf for Perturbed<N> {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        let (frame, perturbed) = self.frame(surface, wo);
        let sample = self.nested.sample(&perturbed, frame.to_local(wo), lobe, u)?;
        let wi = frame.to_world(sample.wi);
        if wi.z * sample.wi.z <= 0.0 {
            return None;
        }
        Some(BsdfSample { wi, weight: sample.weight * self.shadow(frame.n, wi), ..sample })
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        let (frame, perturbed) = self.frame(surface, wo);
        let bent = frame.to_local(wi);
        if wi.z * bent.z <= 0.0 {
            return BsdfValue::ZERO;
        }
        let result = self.nested.evaluate(&perturbed, frame.to_local(wo), bent);
        BsdfValue { value: result.value * self.shadow(frame.n, wi), ..result }
    }

    fn has_smooth_lobe(&self) -> bool {
        self.nested.has_smooth_lobe()
    }

    fn needs_tangents(&self) -> bool {
        true
    }

    fn transmits(&self) -> bool {
        self.nested.transmits()
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.nested.albedo(surface)
    }
}
