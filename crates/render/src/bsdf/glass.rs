//! What the scene file says of glass, smooth, thin or rough: two indices of refraction and two tints. Not a member by itself.

use crate::Result;
use crate::bsdf::fresnel;
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::texture::slot::ColorSlot;

/// An interface between two dielectrics.
pub(crate) struct Glass {
    /// The interior index of refraction over the exterior one.
    pub(crate) eta: f32,
    /// The tint of what is reflected.
    pub(crate) reflectance: ColorSlot,
    /// The tint of what passes.
    pub(crate) transmittance: ColorSlot,
}

impl Glass {
    /// Read `int_ior`, `ext_ior`, `specular_reflectance` and `specular_transmittance`.
    pub(crate) fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Self> {
        Ok(Self {
            eta: fresnel::relative_ior(properties, "bk7")?,
            reflectance: ColorSlot::build(properties, builder, "specular_reflectance", 1.0)?,
            transmittance: ColorSlot::build(properties, builder, "specular_transmittance", 1.0)?,
        })
    }
}
