//! One-sided scattering made two-sided: the same on both sides, or the second nested BSDF on the back.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::{Bsdf, BsdfSample, BsdfValue};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::node::Kind;
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "twosided", build };

/// What is seen from the front and from the back.
pub struct TwoSided {
    front: Arc<dyn Bsdf>,
    back: Arc<dyn Bsdf>,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let (front, back) = match properties.children(Kind::Bsdf)[..] {
        [both] => (builder.bsdf(&both.node)?, builder.bsdf(&both.node)?),
        [front, back] => (builder.bsdf(&front.node)?, builder.bsdf(&back.node)?),
        ref all => {
            return Err(properties.error(format_args!("needs one or two nested bsdfs, has {}", all.len())));
        }
    };
    if front.transmits() || back.transmits() {
        return Err(properties.error("nested bsdfs must not transmit light"));
    }
    Ok(Arc::new(TwoSided { front, back }))
}

const MIRROR: Vec3 = Vec3::new(1.0, 1.0, -1.0);

impl Bsdf for TwoSided {
    #[inline]
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z >= 0.0 {
            return self.front.sample(surface, wo, lobe, u);
        }
        let sample = self.back.sample(surface, wo * MIRROR, lobe, u)?;
        Some(BsdfSample { wi: sample.wi * MIRROR, ..sample })
    }

    #[inline]
    fn evaluate(&self, surface: &Surface, wo: Vec3, wi: Vec3) -> BsdfValue {
        if wo.z >= 0.0 {
            self.front.evaluate(surface, wo, wi)
        } else {
            self.back.evaluate(surface, wo * MIRROR, wi * MIRROR)
        }
    }

    fn has_smooth_lobe(&self) -> bool {
        self.front.has_smooth_lobe() || self.back.has_smooth_lobe()
    }

    fn needs_tangents(&self) -> bool {
        self.front.needs_tangents() || self.back.needs_tangents()
    }

    fn albedo(&self, surface: &Surface) -> Rgb {
        self.front.albedo(surface)
    }
}
