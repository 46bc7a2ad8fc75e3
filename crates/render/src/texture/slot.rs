//! A texture parameter with its most frequent case inlined: a constant costs a load instead of a virtual call.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Rgb, Vec2, luminance};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::texture::Texture;

/// A color parameter.
#[derive(Clone)]
pub(crate) enum ColorSlot {
    /// The same everywhere.
    Constant(Rgb),
    /// Anything else.
    Varying(Arc<dyn Texture>),
}

impl ColorSlot {
    /// Read the parameter `name`: a nested texture, a color or a number; `default` is gray.
    pub(crate) fn build(
        properties: &Properties<'_>,
        builder: &mut Builder,
        name: &str,
        default: f32,
    ) -> Result<Self> {
        Ok(Self::new(&builder.texture(properties, name, Rgb::splat(default))?))
    }

    fn new(texture: &Arc<dyn Texture>) -> Self {
        if texture.is_constant() {
            Self::Constant(texture.evaluate(Vec2::ZERO))
        } else {
            Self::Varying(texture.clone())
        }
    }

    #[inline]
    pub(crate) fn evaluate(&self, uv: Vec2) -> Rgb {
        match self {
            Self::Constant(color) => *color,
            Self::Varying(texture) => texture.evaluate(uv),
        }
    }

    /// One number for the mean over the unit square, as Mitsuba 3 takes it: of the channels of a constant, else luminance.
    pub(crate) fn mean(&self) -> f32 {
        match self {
            Self::Constant(color) => color.element_sum() / 3.0,
            Self::Varying(texture) => luminance(texture.mean()),
        }
    }
}

/// A number that may vary.
#[derive(Clone)]
pub(crate) enum NumberSlot {
    /// The same everywhere.
    Constant(f32),
    /// Anything else.
    Varying(Arc<dyn Texture>),
}

impl NumberSlot {
    /// Read the parameter `name`: a nested texture, a color or a number; `default` is gray.
    pub(crate) fn build(
        properties: &Properties<'_>,
        builder: &mut Builder,
        name: &str,
        default: f32,
    ) -> Result<Self> {
        Ok(Self::new(&builder.texture(properties, name, Rgb::splat(default))?))
    }

    fn new(texture: &Arc<dyn Texture>) -> Self {
        if texture.is_constant() {
            Self::Constant(texture.evaluate_scalar(Vec2::ZERO))
        } else {
            Self::Varying(texture.clone())
        }
    }

    #[inline]
    pub(crate) fn evaluate(&self, uv: Vec2) -> f32 {
        match self {
            Self::Constant(number) => *number,
            Self::Varying(texture) => texture.evaluate_scalar(uv),
        }
    }
}
