//! A checkerboard of two colors, 2 × 2 squares over the unit square. For floors and for seeing texture coordinates.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Rgb, Vec2};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::Texture;
use crate::texture::coordinates::Coordinates;

pub(crate) const ENTRY: Entry<dyn Texture> = Entry { name: "checkerboard", build };

/// Two textures in alternation.
pub struct Checkerboard {
    colors: [Arc<dyn Texture>; 2],
    coordinates: Coordinates,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Texture>> {
    let colors = [
        builder.texture(properties, "color0", Rgb::splat(0.4))?,
        builder.texture(properties, "color1", Rgb::splat(0.2))?,
    ];
    Ok(Arc::new(Checkerboard { colors, coordinates: Coordinates::build(properties)? }))
}

impl Checkerboard {
    fn at(&self, uv: Vec2) -> &dyn Texture {
        let uv = self.coordinates.map(uv);
        let (x, y) = (uv.x - uv.x.floor() > 0.5, uv.y - uv.y.floor() > 0.5);
        &*self.colors[usize::from(x != y)]
    }
}

impl Texture for Checkerboard {
    fn evaluate(&self, uv: Vec2) -> Rgb {
        self.at(uv).evaluate(uv)
    }

    fn evaluate_scalar(&self, uv: Vec2) -> f32 {
        self.at(uv).evaluate_scalar(uv)
    }

    fn gradient(&self, uv: Vec2) -> Vec2 {
        self.at(uv).gradient(uv)
    }

    fn mean(&self) -> Rgb {
        0.5 * (self.colors[0].mean() + self.colors[1].mean())
    }
}
