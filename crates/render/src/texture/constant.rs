//! The same color everywhere.

use crate::geometry::{Rgb, Vec2, luminance};
use crate::texture::Texture;

/// A constant color.
pub struct Constant(pub Rgb);

impl Texture for Constant {
    fn evaluate(&self, _: Vec2) -> Rgb {
        self.0
    }

    fn evaluate_scalar(&self, _: Vec2) -> f32 {
        luminance(self.0)
    }

    fn gradient(&self, _: Vec2) -> Vec2 {
        Vec2::ZERO
    }

    fn mean(&self) -> Rgb {
        self.0
    }

    fn is_constant(&self) -> bool {
        true
    }
}
