//! What plastics are made of: a diffuse base and a clear coat. Not a scattering function by itself.

use crate::Result;
use crate::bsdf::fresnel;
use crate::geometry::{Rgb, Vec2};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::texture::slot::ColorSlot;

/// Parameters common to smooth and rough plastic.
pub(crate) struct Coat {
    /// Index of the coat over the index outside.
    pub eta: f32,
    /// Color of the base.
    pub diffuse: ColorSlot,
    /// Tint of the reflection by the coat.
    pub reflectance: ColorSlot,
    nonlinear: bool,
    /// How often the coat is preferred to the base, apart from Fresnel's equations: its share of the mean colors.
    specular_weight: f32,
}

impl Coat {
    /// Read `int_ior`, `ext_ior`, `diffuse_reflectance`, `specular_reflectance` and `nonlinear`.
    pub(crate) fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Self> {
        let diffuse = ColorSlot::build(properties, builder, "diffuse_reflectance", 0.5)?;
        let reflectance = ColorSlot::build(properties, builder, "specular_reflectance", 1.0)?;
        let (d, s) = (diffuse.mean(), reflectance.mean());
        Ok(Self {
            eta: fresnel::relative_ior(properties, "polypropylene")?,
            diffuse,
            reflectance,
            nonlinear: properties.boolean("nonlinear", false)?,
            specular_weight: if d + s > 0.0 { s / (d + s) } else { 0.0 },
        })
    }

    /// Probability of sampling the coat, given the shares it reflects and transmits.
    #[inline]
    pub(crate) fn specular_probability(&self, reflected: f32, transmitted: f32) -> f32 {
        let specular = reflected * self.specular_weight;
        let diffuse = transmitted * (1.0 - self.specular_weight);
        if specular + diffuse > 0.0 { specular / (specular + diffuse) } else { 1.0 }
    }

    /// The base's color after any number of reflections by the coat from within, `internal` each time; `nonlinear`
    /// shifts the color by absorbing anew each time.
    #[inline]
    pub(crate) fn base(&self, uv: Vec2, internal: f32) -> Rgb {
        let diffuse = self.diffuse.evaluate(uv);
        let scale = 1.0 / (self.eta * self.eta);
        if self.nonlinear {
            diffuse * scale / (Rgb::ONE - diffuse * internal)
        } else {
            diffuse * (scale / (1.0 - internal))
        }
    }
}
