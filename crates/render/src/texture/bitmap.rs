//! An image on a surface.
//!
//! Conventions of Mitsuba 3: the first row is at v = 0, and texel centers are at half-integers.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Rgb, Vec2};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::Texture;
use crate::texture::coordinates::Coordinates;
use crate::texture::texels::{Texels, with_texels};

pub(crate) const ENTRY: Entry<dyn Texture> = Entry { name: "bitmap", build };

/// What lies between the centers of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// A bilinear mixture of four texels.
    Bilinear,
    /// The nearest texel.
    Nearest,
}

/// What lies outside the unit square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The image mirrored, then again.
    Mirror,
    /// The image's border.
    Clamp,
}

/// An image as a texture.
pub struct Bitmap {
    width: usize,
    height: usize,
    texels: Texels,
    mean: Rgb,
    filter: Filter,
    wrap: Wrap,
    coordinates: Coordinates,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Texture>> {
    let raw = properties.boolean("raw", false)?;
    let filter =
        [Filter::Bilinear, Filter::Nearest][properties.choice("filter_type", &["bilinear", "nearest"])?];
    let wrap = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp]
        [properties.choice("wrap_mode", &["repeat", "mirror", "clamp"])?];
    // Storage is chosen by what the values need; the parameter only has to be legal.
    properties.choice("format", &["variant", "auto", "float16", "fp16", "uint8"])?;
    let coordinates = Coordinates::build(properties)?;
    let Some(path) = properties.path("filename")? else {
        return Err(properties.error("needs a filename"));
    };
    let image = builder.image(path, raw)?;
    let bitmap = Bitmap::new(image.width, &image.pixels, filter, wrap);
    Ok(Arc::new(Bitmap { coordinates, ..bitmap }))
}

impl Bitmap {
    /// A texture from linear RGB in memory, in rows of `width` texels.
    pub fn new(width: usize, pixels: &[[f32; 3]], filter: Filter, wrap: Wrap) -> Self {
        let sum = pixels.iter().fold([0.0_f64; 3], |sum, pixel| {
            [sum[0] + f64::from(pixel[0]), sum[1] + f64::from(pixel[1]), sum[2] + f64::from(pixel[2])]
        });
        let mean = sum.map(|channel| (channel / pixels.len() as f64) as f32);
        Self {
            width,
            height: pixels.len() / width,
            texels: Texels::new(pixels),
            mean: Rgb::from_array(mean),
            filter,
            wrap,
            coordinates: Coordinates::IDENTITY,
        }
    }

    /// Memory of the texels, in bytes.
    pub fn bytes(&self) -> usize {
        self.texels.bytes()
    }

    #[inline]
    fn nearest(&self, uv: Vec2) -> usize {
        let uv = self.coordinates.map(uv);
        let column = ((self.fold(uv.x).0 * self.width as f32) as usize).min(self.width - 1);
        let row = ((self.fold(uv.y).0 * self.height as f32) as usize).min(self.height - 1);
        row * self.width + column
    }

    /// A coordinate brought into the unit interval, and the sign of this map's derivative.
    #[inline]
    fn fold(&self, x: f32) -> (f32, f32) {
        match self.wrap {
            Wrap::Repeat => (fraction(x), 1.0),
            Wrap::Clamp => (x.clamp(0.0, 1.0), 1.0),
            Wrap::Mirror => {
                let x = 2.0 * fraction(0.5 * x);
                if x > 1.0 { (2.0 - x, -1.0) } else { (x, 1.0) }
            }
        }
    }

    /// The two texels around a coordinate, the position between them, and the sign of the folding.
    #[inline]
    fn neighbors(&self, x: f32, count: usize) -> (usize, usize, f32, f32) {
        let (x, sign) = self.fold(x);
        let x = x * count as f32 - 0.5;
        let (low, high) = (floor(x), floor(x) + 1);
        let (below, last) = (low as f32, count as i32 - 1);
        let (low, high) = if self.wrap == Wrap::Repeat {
            (if low < 0 { last } else { low }, if high > last { 0 } else { high })
        } else {
            (low.max(0), high.min(last))
        };
        (low as usize, (high as usize).min(count - 1), x - below, sign)
    }

    #[inline]
    fn quad(&self, uv: Vec2) -> Quad {
        let uv = self.coordinates.map(uv);
        let (left, right, x, sign_x) = self.neighbors(uv.x, self.width);
        let (top, bottom, y, sign_y) = self.neighbors(uv.y, self.height);
        let (top, bottom) = (top * self.width, bottom * self.width);
        let corners = [top + left, top + right, bottom + left, bottom + right];
        Quad { corners, x, y, signs: Vec2::new(sign_x, sign_y) }
    }
}

/// Rounded down; `f32::floor` is a function call on x86-64 without SSE 4.1. The largest numbers saturate.
#[inline]
fn floor(x: f32) -> i32 {
    let truncated = x as i32;
    truncated.saturating_sub(i32::from((truncated as f32) > x))
}

/// The fractional part, from 0 to 1.
#[inline]
fn fraction(x: f32) -> f32 {
    (x - floor(x) as f32).clamp(0.0, 1.0)
}

/// The four texels around a point.
struct Quad {
    corners: [usize; 4],
    x: f32,
    y: f32,
    signs: Vec2,
}

impl Quad {
    #[inline]
    fn weights(&self) -> [f32; 4] {
        let (x, y) = (self.x, self.y);
        [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y]
    }
}

impl Texture for Bitmap {
    fn evaluate(&self, uv: Vec2) -> Rgb {
        if self.filter == Filter::Nearest {
            let index = self.nearest(uv);
            return with_texels!(&self.texels, texels => texels.color(index));
        }
        let quad = self.quad(uv);
        let [w0, w1, w2, w3] = quad.weights();
        let [i0, i1, i2, i3] = quad.corners;
        with_texels!(&self.texels, texels => {
            texels.color(i0) * w0 + texels.color(i1) * w1 + texels.color(i2) * w2 + texels.color(i3) * w3
        })
    }

    fn evaluate_scalar(&self, uv: Vec2) -> f32 {
        if self.filter == Filter::Nearest {
            let index = self.nearest(uv);
            return with_texels!(&self.texels, texels => texels.number(index));
        }
        let quad = self.quad(uv);
        let [w0, w1, w2, w3] = quad.weights();
        let [i0, i1, i2, i3] = quad.corners;
        with_texels!(&self.texels, texels => {
            texels.number(i0) * w0 + texels.number(i1) * w1 + texels.number(i2) * w2 + texels.number(i3) * w3
        })
    }

    fn gradient(&self, uv: Vec2) -> Vec2 {
        if self.filter == Filter::Nearest {
            return Vec2::ZERO;
        }
        let quad = self.quad(uv);
        let [f00, f10, f01, f11] = with_texels!(&self.texels, texels => {
            quad.corners.map(|index| texels.number(index))
        });
        let along_x = (f10 - f00) * (1.0 - quad.y) + (f11 - f01) * quad.y;
        let along_y = (f01 - f00) * (1.0 - quad.x) + (f11 - f10) * quad.x;
        let size = Vec2::new(self.width as f32, self.height as f32);
        self.coordinates.pull_back(Vec2::new(along_x, along_y) * size * quad.signs)
    }

    fn mean(&self) -> Rgb {
        self.mean
    }
}
