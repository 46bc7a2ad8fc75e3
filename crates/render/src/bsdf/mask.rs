//! Cut-outs: where `opacity` is below 1, light passes straight through. For leaves, fences and curtains.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;

use crate::texture::slot::NumberSlot;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "mask", build };

/// A scattering function with holes.
pub struct Mask {
    nested: Arc<dyn Bsdf>,
    opacity: NumberSlot,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let opacity = NumberSlot::build(properties, builder, "opacity", 0.5)?;
    Ok(Arc::new(Mask { nested: builder.only_bsdf(properties)?, opacity }))
}

impl Mask {
    #[inline]
    fn opacity(&self, surface: &Surface) -> f32 {
        self.opacity.evaluate(surface.uv).clamp(0.0, 1.0)
    }
}

impl Bsdf for Mask {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        let opacity = self.opacity(surface);
        if lobe >= opacity {
            return Some(BsdfSample::pass_through(wo, Rgb::ONE, 1.0 - opacity));
        }
        let sample = self.nested.sample(surface, wo, lobe / opacity, u)?;
        Some(BsdfSample { density: sample.density * opacity, ..sample })
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        let opacity = self.opacity(surface);
        let BsdfValue { value, density } = self.nested.evaluate(surface, wo, wi);
        BsdfValue { value: value * opacity, density: density * opacity }
    }

    fn has_smooth_lobe(&self) -> bool {
        self.nested.has_smooth_lobe()
    }

    fn needs_tangents(&self) -> bool {
        self.nested.needs_tangents()
    }

    fn transmits(&self) -> bool {
        true
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        let opacity = self.opacity(surface);
        self.nested.albedo(surface) * opacity + Rgb::splat(1.0 - opacity)
    }
}
