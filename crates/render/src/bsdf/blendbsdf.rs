//! A weighted mean of two scattering functions: `weight` 0 is the first, 1 the second.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::node::Kind;
use crate::scene::properties::Properties;

use crate::texture::slot::NumberSlot;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "blendbsdf", build };

/// A mixture of two scattering functions.
pub struct Blend {
    nested: [Arc<dyn Bsdf>; 2],
    weight: NumberSlot,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let weight = NumberSlot::build(properties, builder, "weight", 0.5)?;
    if !properties.has("weight") {
        return Err(properties.error("needs a weight"));
    }
    match properties.children(Kind::Bsdf)[..] {
        [first, second] => {
            let nested = [builder.bsdf(&first.node)?, builder.bsdf(&second.node)?];
            Ok(Arc::new(Blend { nested, weight }))
        }
        ref all => Err(properties.error(format_args!("needs exactly two nested bsdfs, has {}", all.len()))),
    }
}

impl Blend {
    #[inline]
    fn weight(&self, surface: &Surface) -> f32 {
        self.weight.evaluate(surface.uv).clamp(0.0, 1.0)
    }
}

impl Bsdf for Blend {
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        let weight = self.weight(surface);
        let second = lobe < weight;
        let (chosen, other, share, lobe) = if second {
            (&self.nested[1], &self.nested[0], weight, lobe / weight)
        } else {
            (&self.nested[0], &self.nested[1], 1.0 - weight, (lobe - weight) / (1.0 - weight))
        };
        let sample = chosen.sample(surface, wo, lobe.min(1.0 - f32::EPSILON / 2.0), u)?;
        let density = share * sample.density;
        if sample.delta {
            return Some(BsdfSample { density, ..sample });
        }
        let rest = other.evaluate(surface, wo, sample.wi);
        let value = sample.weight * density + rest.value * (1.0 - share);
        let density = density + rest.density * (1.0 - share);
        Some(BsdfSample { weight: value / density, density, ..sample })
    }

    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        let weight = self.weight(surface);
        let first = self.nested[0].evaluate(surface, wo, wi);
        let second = self.nested[1].evaluate(surface, wo, wi);
        BsdfValue {
            value: first.value * (1.0 - weight) + second.value * weight,
            density: first.density * (1.0 - weight) + second.density * weight,
        }
    }

    fn has_smooth_lobe(&self) -> bool {
        self.nested.iter().any(|nested| nested.has_smooth_lobe())
    }

    fn needs_tangents(&self) -> bool {
        self.nested.iter().any(|nested| nested.needs_tangents())
    }

    fn transmits(&self) -> bool {
        self.nested.iter().any(|nested| nested.transmits())
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.nested[0].albedo(surface).lerp(self.nested[1].albedo(surface), self.weight(surface))
    }
}
