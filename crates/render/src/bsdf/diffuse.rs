//! Lambert's ideal diffuse reflection: one-sided.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::Arc;

use crate::Result;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::{Texture, constant::Constant};

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "diffuse", build };

/// Light leaves in all directions alike.
pub struct Diffuse {
    reflectance: Arc<dyn Texture>,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    Ok(Arc::new(Diffuse { reflectance: builder.texture(properties, "reflectance", Rgb::splat(0.5))? }))
}

impl Diffuse {
    /// The same reflectance everywhere and for all colors.
    pub fn gray(reflectance: f32) -> Self {
        Self { reflectance: Arc::new(Constant(Rgb::splat(reflectance))) }
    }
}

impl Bsdf for Diffuse {
    fn sample(&self, surface: &Surface, wo: Vec3, _lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let (sin_phi, cos_phi) = (2.0 * PI * u[0]).sin_cos();
        let radius = u[1].sqrt();
        let wi = Vec3::new(radius * cos_phi, radius * sin_phi, (1.0 - u[1]).sqrt());
        let weight = self.reflectance.evaluate(surface.uv);
        Some(BsdfSample { wi, weight, density: wi.z * FRAC_1_PI, delta: false, eta: 1.0 })
    }

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
