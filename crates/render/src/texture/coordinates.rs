//! The `to_uv` transform of texture coordinates. Not a texture by itself.

use glam::Affine2;

use crate::Result;
use crate::geometry::Vec2;
use crate::scene::properties::Properties;

/// From a surface's texture coordinates to a texture's own.
pub(crate) struct Coordinates(Option<Affine2>);

impl Coordinates {
    pub(crate) const IDENTITY: Self = Self(None);

    /// Read `to_uv`.
    pub(crate) fn build(properties: &Properties<'_>) -> Result<Self> {
        let matrix = properties.uv_transform("to_uv")?.as_mat3();
        let map = Affine2::from_mat3(matrix);
        Ok(Self((map != Affine2::IDENTITY).then_some(map)))
    }

    #[inline]
    pub(crate) fn map(&self, uv: Vec2) -> Vec2 {
        self.0.map_or(uv, |map| map.transform_point2(uv))
    }

    /// A gradient with respect to the texture's own coordinates to one with respect to the surface's.
    #[inline]
    pub(crate) fn pull_back(&self, gradient: Vec2) -> Vec2 {
        self.0.map_or(gradient, |map| map.matrix2.transpose() * gradient)
    }
}
