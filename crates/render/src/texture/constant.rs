//! The same color everywhere.

use crate::geometry::{Rgb, Vec2};
use crate::texture::Texture;

/// A constant color.
pub struct Constant(pub Rgb);

impl Texture for Constant {
    fn evaluate(&self, _: Vec2) -> Rgb {
        self.0
    }

    fn evaluate_scalar(&self, _: Vec2) -> f32 {
        self.0.element_sum() / 3.0 // not luminance: Mitsuba 3 averages the channels of constants
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
