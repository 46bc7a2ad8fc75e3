//! PNG preview: 8-bit sRGB of a linear image at a given exposure. For eyes; the numbers are in the OpenEXR file.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use png::{BitDepth, ColorType, Encoder, EncodingError, SrgbRenderingIntent};

use super::{Size, write_atomically};
use crate::{Error, Result};

/// Writes linear `pixels` (`height × width × 3`) as sRGB, brightened by `exposure` stops (factors of two).
///
/// Negative and not-a-number show as black, infinity as white. `metadata` become text chunks. The write is atomic.
pub fn write_png(
    path: &Path,
    size: Size,
    pixels: &[f32],
    exposure: f32,
    metadata: &BTreeMap<String, String>,
) -> Result<()> {
    size.check("color", 3, pixels.len())?;
    if !exposure.is_finite() {
        return Err(Error::Settings(format!("exposure is {exposure}; a finite number of stops is allowed")));
    }
    let sides = u32::try_from(size.width).ok().zip(u32::try_from(size.height).ok());
    let (width, height) =
        sides.ok_or_else(|| Error::Settings("a PNG side is less than 2^32 pixels".into()))?;
    let scale = exposure.exp2();
    let bytes: Vec<u8> = pixels.iter().map(|&value| encode_srgb(value * scale)).collect();
    write_atomically(path, |file| {
        let mut encoder = Encoder::new(file, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        let write = move || {
            encoder.add_text_chunk("Software".into(), "evenlight".into())?;
            for (key, value) in metadata {
                encoder.add_itxt_chunk(format!("evenlight:{key}"), value.clone())?;
            }
            let mut writer = encoder.write_header()?;
            writer.write_image_data(&bytes)?;
            writer.finish()
        };
        write().map_err(|error| match error {
            EncodingError::IoError(source) => source,
            other => io::Error::other(other.to_string()),
        })
    })
}

/// The sRGB transfer function of IEC 61966-2-1, rounded to 8 bits.
fn encode_srgb(linear: f32) -> u8 {
    // NaN passes through all of this and becomes 0 as an integer: black.
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use std::fs::File;
    use std::io::BufReader;

    use super::*;
    use crate::output::tests::Folder;

    #[test]
    fn srgb_values_match_the_standard() {
        let linear = [0.0, 0.0031308, 0.18, 0.2158605, 0.5, 1.0];
        assert_eq!(linear.map(encode_srgb), [0, 10, 118, 128, 188, 255]);
        assert_eq!(
            [f32::NAN, -1.0, f32::NEG_INFINITY, f32::INFINITY, 7.0].map(encode_srgb),
            [0, 0, 0, 255, 255]
        );
    }

    #[test]
    fn pixels_and_metadata_come_back() {
        let folder = Folder::new("png");
        let path = folder.0.join("a.png");
        let pixels = [0.0, 0.25, 0.5, f32::NAN, f32::INFINITY, -1.0];
        let metadata = BTreeMap::from([("scene".to_owned(), "Küche".to_owned())]);
        write_png(&path, Size { width: 2, height: 1 }, &pixels, 1.0, &metadata).expect("writable");

        let decoder = png::Decoder::new(BufReader::new(File::open(&path).expect("written")));
        let mut reader = decoder.read_info().expect("valid");
        let mut bytes = vec![0; 6];
        reader.next_frame(&mut bytes).expect("complete");
        assert_eq!(bytes, [0, 188, 255, 0, 255, 0], "one stop doubles");
        let note = &reader.info().utf8_text[0];
        assert_eq!(
            (note.keyword.as_str(), note.get_text().expect("text").as_str()),
            ("evenlight:scene", "Küche")
        );
    }

    #[test]
    fn wrong_input_is_an_error() {
        let folder = Folder::new("png-shape");
        let path = folder.0.join("a.png");
        let size = Size { width: 2, height: 2 };
        assert!(write_png(&path, size, &[0.0; 11], 0.0, &BTreeMap::new()).is_err());
        assert!(write_png(&path, size, &[0.0; 12], f32::NAN, &BTreeMap::new()).is_err());
        assert!(folder.names().is_empty());
    }
}
