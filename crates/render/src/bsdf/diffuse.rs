//! Lambert's ideal diffuse reflection: one-sided.

use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use crate::Result;
use crate::bsdf::warp::cosine_hemisphere;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::slot::ColorSlot;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "diffuse", build };

/// Light leaves in all directions alike.
pub struct Diffuse {
    reflectance: ColorSlot,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let reflectance = ColorSlot::build(properties, builder, "reflectance", 0.5)?;
    Ok(Arc::new(Diffuse { reflectance }))
}

impl Diffuse {
    /// The same reflectance everywhere and for all colors.
    pub fn gray(reflectance: f32) -> Self {
        Self { reflectance: ColorSlot::Constant(Rgb::splat(reflectance)) }
    }
}

impl Bsdf for Diffuse {
    #[inline]
    fn sample(&self, surface: &Surface, wo: Vec3, _lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let wi = cosine_hemisphere(u);
        let weight = self.reflectance.evaluate(surface.uv);
        Some(BsdfSample { wi, weight, density: wi.z * FRAC_1_PI, delta: false, eta: 1.0 })
    }

    #[inline]
    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfValue::ZERO;
        }
        let density = wi.z * FRAC_1_PI;
        BsdfValue { value: self.reflectance.evaluate(surface.uv) * density, density }
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.reflectance.evaluate(surface.uv)
    }
}
