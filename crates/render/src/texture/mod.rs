//! Textures: colors and numbers that vary over a surface.
//!
//! Plugin names, parameters and defaults are those of Mitsuba 3.

use crate::geometry::{Rgb, Vec2};

/// A function of texture coordinates.
pub trait Texture: Send + Sync {
    /// The color at `uv`.
    fn evaluate(&self, uv: Vec2) -> Rgb;

    /// One number at `uv`: the luminance of a color, the value of a gray one.
    fn evaluate_scalar(&self, uv: Vec2) -> f32;

    /// Derivative of [`Texture::evaluate_scalar`] along u and v.
    fn gradient(&self, uv: Vec2) -> Vec2;

    /// The mean color over the unit square.
    fn mean(&self) -> Rgb;

    /// Whether the color is the same everywhere.
    fn is_constant(&self) -> bool {
        false
    }
}

pub mod bitmap;
pub mod checkerboard;
pub mod constant;
mod coordinates;
mod exr;
pub mod image;
pub(crate) mod slot;
mod texels;

/// The textures there are.
pub static ALL: &[crate::scene::build::Entry<dyn Texture>] = &[bitmap::ENTRY, checkerboard::ENTRY];
