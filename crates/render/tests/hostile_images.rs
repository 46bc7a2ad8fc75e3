//! Images from nobody's friend: a clear error, soon, and never a panic.

mod fixture;

use std::time::Instant;

use evenlight_render::texture::image::Image;
use fixture::{Folder, SOON, mangle};

fn encoded(format: image::ImageFormat, image: &image::DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("memory");
    bytes.into_inner()
}

fn images() -> Vec<(&'static str, Vec<u8>)> {
    use image::{DynamicImage, GrayAlphaImage, ImageFormat, Rgb32FImage, RgbImage};
    let rgb = RgbImage::from_fn(6, 4, |x, y| image::Rgb([x as u8 * 40, y as u8 * 60, 188]));
    let gray = GrayAlphaImage::from_fn(6, 4, |x, _| image::LumaA([x as u8 * 40, 51]));
    let float = Rgb32FImage::from_fn(6, 4, |x, y| image::Rgb([x as f32, y as f32, 0.5]));
    vec![
        ("a.png", encoded(ImageFormat::Png, &DynamicImage::ImageRgb8(rgb.clone()))),
        ("gray.png", encoded(ImageFormat::Png, &DynamicImage::ImageLumaA8(gray))),
        ("a.jpg", encoded(ImageFormat::Jpeg, &DynamicImage::ImageRgb8(rgb.clone()))),
        ("a.bmp", encoded(ImageFormat::Bmp, &DynamicImage::ImageRgb8(rgb.clone()))),
        ("a.tga", encoded(ImageFormat::Tga, &DynamicImage::ImageRgb8(rgb))),
        ("a.hdr", encoded(ImageFormat::Hdr, &DynamicImage::ImageRgb32F(float.clone()))),
        ("a.exr", encoded(ImageFormat::OpenExr, &DynamicImage::ImageRgb32F(float))),
        ("y.exr", exr_with(&["Y"])),
        ("layer.exr", exr_with(&["diffuse.B", "diffuse.G", "diffuse.R", "depth.Z"])),
    ]
}

/// An EXR of half floats with these channels; each holds its place in the list plus 1.
fn exr_with(names: &[&str]) -> Vec<u8> {
    use exr::prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage, f16,
    };
    let channel = |(i, name): (usize, &&str)| {
        AnyChannel::new(*name, FlatSamples::F16(vec![f16::from_f32(i as f32 + 1.0); 24]))
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let layer = Layer::new((6, 4), LayerAttributes::named("main"), Encoding::FAST_LOSSLESS, channels);
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).expect("memory");
    bytes.into_inner()
}

#[test]
fn images_are_read() {
    let folder = Folder::new();
    for (name, bytes) in images() {
        let image = Image::read(&folder.write(name, bytes), false).expect(name);
        assert_eq!((image.width, image.height, image.pixels.len()), (6, 4, 24), "{name}");
        let pixel = image.pixels[6 + 3];
        let wanted = match name {
            "a.hdr" | "a.exr" => [3.0, 1.0, 0.5],
            "y.exr" => [1.0; 3],
            "layer.exr" => [3.0, 2.0, 1.0],
            // sRGB 120, 60, 188.
            "gray.png" => [0.187821; 3],
            _ => [0.187821, 0.045186, 0.502887],
        };
        let near = if name == "a.jpg" { 0.1 } else { 1e-5 };
        assert!(pixel.iter().zip(wanted).all(|(a, b)| (a - b).abs() < near), "{name}: {pixel:?}");
        assert_eq!(image.channels, if matches!(name, "gray.png" | "y.exr") { 1 } else { 3 }, "{name}");
        assert_eq!(image.alpha.map(|alpha| alpha[0]), (name == "gray.png").then_some(0.2), "{name}");
    }
    let raw = Image::read(&folder.path().join("a.png"), true).expect("raw");
    assert!((raw.pixels[6 + 3][2] - 188.0 / 255.0).abs() < 1e-6);
}

#[test]
fn images_survive_cuts_and_flips() {
    let folder = Folder::new();
    let start = Instant::now();
    for (name, bytes) in images() {
        mangle(&bytes, 1500, |mangled| {
            if let Err(error) = Image::read(&folder.write(name, mangled), false) {
                assert!(error.to_string().contains(name), "{error} does not name the file");
            }
        });
    }
    assert!(start.elapsed() < 6 * SOON);
}

#[test]
fn absurd_images_are_refused() {
    let folder = Folder::new();
    let error = |name: &str, bytes: &[u8]| {
        let start = Instant::now();
        let error = Image::read(&folder.write(name, bytes), false).expect_err(name).to_string();
        assert!(start.elapsed() < SOON && error.contains(name), "{error}");
        error
    };
    // The data window of a small EXR, made large: box2i after its name and type.
    let mut wide = exr_with(&["R", "G", "B"]);
    let key = b"dataWindow\0box2i\0";
    let at =
        wide.windows(key.len()).position(|bytes| bytes == key).expect("every EXR has one") + key.len() + 4;
    wide[at + 8..at + 12].copy_from_slice(&2_000_000_000_i32.to_le_bytes());
    wide[at + 12..at + 16].copy_from_slice(&2_000_000_000_i32.to_le_bytes());
    assert!(!error("wide.exr", &wide).is_empty());
    wide[at + 8..at + 12].copy_from_slice(&16000_i32.to_le_bytes());
    wide[at + 12..at + 16].copy_from_slice(&16000_i32.to_le_bytes());
    assert!(error("large.exr", &wide).contains("too many"));
    assert!(error("none.exr", &exr_with(&["depth.Z", "id"])).contains("needs channels R, G, B or Y"));
    assert!(error("text.png", b"hello").contains("cannot be decoded"));
    assert!(error("text.xyz", b"hello").contains("known: PNG, JPEG"));
    let header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n";
    assert!(!error("huge.hdr", header.as_bytes()).is_empty());
    let infinite = image::Rgb32FImage::from_pixel(2, 2, image::Rgb([0.0, f32::INFINITY, 0.0]));
    let bytes = encoded(image::ImageFormat::OpenExr, &image::DynamicImage::ImageRgb32F(infinite));
    assert!(error("inf.exr", &bytes).contains("column 0, row 0 is not finite"));
}
