//! A texture parameter with its most frequent case inlined: a constant costs a load instead of a virtual call.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Rgb, Vec2, luminance};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::texture::Texture;

/// What a texture is read as.
pub(crate) trait Reading: Copy {
    /// The texture's value at `uv`.
    fn of(texture: &dyn Texture, uv: Vec2) -> Self;
}

impl Reading for Rgb {
    #[inline]
    fn of(texture: &dyn Texture, uv: Vec2) -> Self {
        texture.evaluate(uv)
    }
}

impl Reading for f32 {
    #[inline]
    fn of(texture: &dyn Texture, uv: Vec2) -> Self {
        texture.evaluate_scalar(uv)
    }
}

/// A parameter that may vary.
#[derive(Clone)]
pub(crate) enum Slot<T> {
    /// The same everywhere.
    Constant(T),
    /// Anything else.
    Varying(Arc<dyn Texture>),
}

/// A color parameter.
pub(crate) type ColorSlot = Slot<Rgb>;

/// A number that may vary.
pub(crate) type NumberSlot = Slot<f32>;

impl<T: Reading> Slot<T> {
    /// Read the parameter `name`: a nested texture, a color or a number; `default` is gray.
    pub(crate) fn build(
        properties: &Properties<'_>,
        builder: &mut Builder,
        name: &str,
        default: f32,
    ) -> Result<Self> {
        let texture = builder.texture(properties, name, Rgb::splat(default))?;
        Ok(if texture.is_constant() {
            Self::Constant(T::of(&*texture, Vec2::ZERO))
        } else {
            Self::Varying(texture)
        })
    }

    #[inline]
    pub(crate) fn evaluate(&self, uv: Vec2) -> T {
        match self {
            Self::Constant(value) => *value,
            Self::Varying(texture) => T::of(&**texture, uv),
        }
    }
}

impl ColorSlot {
    /// One number for the mean over the unit square, as Mitsuba 3 takes it: of the channels of a constant, else luminance.
    pub(crate) fn mean(&self) -> f32 {
        match self {
            Self::Constant(color) => color.element_sum() / 3.0,
            Self::Varying(texture) => luminance(texture.mean()),
        }
    }
}
