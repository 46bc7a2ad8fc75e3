//! What conductors are made of: their complex index and a tint. Not a scattering function by itself.

use crate::Result;
use crate::bsdf::fresnel;
use crate::geometry::{Rgb, Vec2};
use crate::scene::build::Builder;
use crate::scene::materials;
use crate::scene::properties::Properties;
use crate::texture::slot::ColorSlot;

/// A metal.
pub(crate) struct Metal {
    eta: ColorSlot,
    k: ColorSlot,
    tint: ColorSlot,
    /// `material` "none": reflects everything, without any Fresnel term.
    perfect: bool,
}

impl Metal {
    /// Read `material` or `eta` and `k`, and `specular_reflectance`.
    pub(crate) fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Self> {
        let tint = ColorSlot::build(properties, builder, "specular_reflectance", 1.0)?;
        let (has_eta, has_k) = (properties.has("eta"), properties.has("k"));
        let name = properties.optional_string("material")?;
        if has_eta != has_k || (has_eta && name.is_some()) {
            return Err(properties.error("give either material or both eta and k"));
        }
        if has_eta {
            let eta = ColorSlot::build(properties, builder, "eta", 0.0)?;
            let k = ColorSlot::build(properties, builder, "k", 1.0)?;
            return Ok(Self { eta, k, tint, perfect: false });
        }
        let name = name.unwrap_or("none");
        let Some((eta, k)) = materials::conductor(name) else {
            return Err(properties.error(format_args!("unknown conductor '{name}'")));
        };
        let (eta, k) = (Rgb::from_array(eta), Rgb::from_array(k));
        let perfect = eta == Rgb::ZERO;
        Ok(Self { eta: ColorSlot::Constant(eta), k: ColorSlot::Constant(k), tint, perfect })
    }

    /// Reflectance under an angle.
    #[inline]
    pub(crate) fn reflectance(&self, uv: Vec2, cos_i: f32) -> Rgb {
        let tint = self.tint.evaluate(uv);
        if self.perfect {
            return tint;
        }
        tint * fresnel::conductor(cos_i, self.eta.evaluate(uv), self.k.evaluate(uv))
    }
}
