//! Images read from files: PNG, JPEG, BMP, TGA, Radiance HDR and `OpenEXR`.
//!
//! 8- and 16-bit images are taken as sRGB and made linear unless read raw; HDR and EXR are linear already. Gray images,
//! palettes and alpha are understood. Files are not trusted: sizes are limited before anything is allocated.

use std::io::Cursor;
use std::path::Path;

use image::{ColorType, DynamicImage, ImageFormat, ImageReader, Limits};

use crate::scene::folder;
use crate::{Error, Result};

/// The largest image file that is read, in bytes.
const FILE_LIMIT: u64 = 1 << 30;
/// The most columns or rows.
const MAX_SIDE: u32 = 16384;
/// The most memory a decoder may take, in bytes.
const MAX_ALLOCATION: u64 = 1 << 30;
/// The formats there are.
const FORMATS: [ImageFormat; 6] = [
    ImageFormat::Png,
    ImageFormat::Jpeg,
    ImageFormat::Bmp,
    ImageFormat::Tga,
    ImageFormat::Hdr,
    ImageFormat::OpenExr,
];

/// A decoded image in linear RGB (or raw values), top row first.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row-major RGB; gray images repeat their value.
    pub pixels: Vec<[f32; 3]>,
    /// Row-major coverage from 0 to 1, never made linear, if the file has it.
    pub alpha: Option<Vec<f32>>,
    /// The file holds 1 (gray) or 3 color channels.
    pub channels: usize,
}

impl Image {
    /// Decode a file; `raw` keeps 8- and 16-bit values as they are, else they are taken as sRGB and made linear.
    pub fn read(path: &Path, raw: bool) -> Result<Self> {
        let bytes = folder::read(path, FILE_LIMIT)?;
        let format = format_of(path, &bytes)?;
        // Decoders of others are careful, but not free of assertions that a broken file can meet.
        let decoded = std::panic::catch_unwind(|| decode(&bytes, format));
        let decoded = decoded.unwrap_or_else(|_| Err("cannot be decoded: the decoder gave up".into()));
        let (decoded, channels) = decoded.map_err(|message| Error::file(path, message))?;
        let image = Self::from_decoded(&decoded, channels, raw);
        let finite = |pixel: &[f32; 3]| pixel.iter().all(|c| c.is_finite());
        match image.pixels.iter().position(|pixel| !finite(pixel)) {
            None => Ok(image),
            Some(at) => {
                let (x, y) = (at % image.width, at / image.width);
                Err(Error::file(path, format_args!("the pixel in column {x}, row {y} is not finite")))
            }
        }
    }

    fn from_decoded(decoded: &DynamicImage, channels: usize, raw: bool) -> Self {
        let (width, height) = (decoded.width() as usize, decoded.height() as usize);
        let color = decoded.color();
        let encoded = !raw && !matches!(color, ColorType::Rgb32F | ColorType::Rgba32F);
        let (pixels, alpha) = match decoded {
            DynamicImage::ImageLuma8(image) => (bytes_to_rgb(image.as_raw(), 1, encoded), None),
            DynamicImage::ImageLumaA8(image) => split_bytes(image.as_raw(), 2, encoded),
            DynamicImage::ImageRgb8(image) => (bytes_to_rgb(image.as_raw(), 3, encoded), None),
            DynamicImage::ImageRgba8(image) => split_bytes(image.as_raw(), 4, encoded),
            other => split_floats(other, encoded),
        };
        Self { width, height, pixels, alpha, channels }
    }
}

/// The format by content, else by name (TGA has no signature).
fn format_of(path: &Path, bytes: &[u8]) -> Result<ImageFormat> {
    let guess = image::guess_format(bytes).ok().or_else(|| ImageFormat::from_path(path).ok());
    guess.filter(|format| FORMATS.contains(format)).ok_or_else(|| {
        Error::file(path, "not an image of a known format; known: PNG, JPEG, BMP, TGA, Radiance HDR, OpenEXR")
    })
}

/// The image and its number of color channels.
fn decode(bytes: &[u8], format: ImageFormat) -> std::result::Result<(DynamicImage, usize), String> {
    if format == ImageFormat::OpenExr {
        return super::exr::decode(bytes, MAX_SIDE, MAX_ALLOCATION);
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_ALLOCATION);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let decoded = reader.decode().map_err(|error| format!("cannot be decoded: {error}"))?;
    let channels = if decoded.color().has_color() { 3 } else { 1 };
    Ok((decoded, channels))
}

/// The transfer function of sRGB (IEC 61966-2-1), inverted.
pub fn srgb_to_linear(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// 8-bit values through a table: large photographs are common.
fn table(encoded: bool) -> [f32; 256] {
    std::array::from_fn(|i| {
        let x = i as f32 / 255.0;
        if encoded { srgb_to_linear(x) } else { x }
    })
}

fn bytes_to_rgb(bytes: &[u8], channels: usize, encoded: bool) -> Vec<[f32; 3]> {
    let table = table(encoded);
    let pixels = bytes.chunks_exact(channels);
    pixels.map(|pixel| rgb_of(pixel).map(|byte| table[usize::from(byte)])).collect()
}

fn split_bytes(bytes: &[u8], channels: usize, encoded: bool) -> (Vec<[f32; 3]>, Option<Vec<f32>>) {
    let alpha = bytes.chunks_exact(channels).map(|pixel| f32::from(pixel[channels - 1]) / 255.0).collect();
    (bytes_to_rgb(bytes, channels, encoded), Some(alpha))
}

/// The color of a pixel of 1 to 4 channels, of which an even number includes alpha.
fn rgb_of<T: Copy>(pixel: &[T]) -> [T; 3] {
    if pixel.len() < 3 { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] }
}

fn split_floats(image: &DynamicImage, encoded: bool) -> (Vec<[f32; 3]>, Option<Vec<f32>>) {
    let alpha = image.color().has_alpha();
    let rgba = image.to_rgba32f();
    let color = |c: f32| if encoded { srgb_to_linear(c) } else { c };
    let pixels = rgba.pixels().map(|p| [color(p[0]), color(p[1]), color(p[2])]).collect();
    (pixels, alpha.then(|| rgba.pixels().map(|p| p[3]).collect()))
}
