//! Multi-layer OpenEXR: all numbers of a render in one file, 32-bit and lossless.
//!
//! One part holds all layers, told apart by channel name, because that is what viewers and compositors read best:
//! the layer `color` is the plain `R`, `G`, `B` that every program shows first, and any other layer is `name.channel`
//! (`standard_error.R`, `normal.X`, `depth.Z`). Metadata become string attributes named `evenlight:key`, so that
//! no key can collide with an attribute of the format; `evenlight:layers` lists the layers.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Compression, Encoding, FlatSamples, Image,
    Layer as Part, LayerAttributes, LineOrder, Text, Vec2, WritableImage,
};

use super::{Layer, Size, write_atomically};
use crate::{Error, Result};

/// The layer whose channels carry no prefix.
const DEFAULT_LAYER: &str = "color";

/// Writes `layers` as one OpenEXR file: scan lines, 32-bit floats, lossless ZIP compression.
///
/// Not-a-number and infinity are kept as they are. The write is atomic.
pub fn write_exr(
    path: &Path,
    size: Size,
    layers: &[Layer<'_>],
    metadata: &BTreeMap<String, String>,
) -> Result<()> {
    let mut channels = Vec::new();
    for layer in layers {
        size.check(layer.name, layer.channels.len(), layer.pixels.len())?;
        channels.extend(planes(layer));
    }
    if channels.is_empty() {
        return Err(Error::Settings("an image needs at least one layer".into()));
    }
    let mut attributes =
        LayerAttributes { software_name: Some(text("evenlight")), ..LayerAttributes::default() };
    let names = layers.iter().map(|layer| layer.name).collect::<Vec<_>>().join(" ");
    attributes.other.insert(text("evenlight:layers"), AttributeValue::Text(text(&names)));
    for (key, value) in metadata {
        attributes.other.insert(text(&format!("evenlight:{key}")), AttributeValue::Text(text(value)));
    }
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let channels = AnyChannels::sort(channels.into());
    let image = Image::from_layer(Part::new(Vec2(size.width, size.height), attributes, encoding, channels));
    write_atomically(path, |file| {
        image.write().to_buffered(file).map_err(|error| match error {
            exr::error::Error::Io(source) => source,
            other => io::Error::other(other.to_string()),
        })
    })
}

/// The channels of one layer as separate planes under their full names.
fn planes<'a>(layer: &'a Layer<'_>) -> impl Iterator<Item = AnyChannel<FlatSamples>> + 'a {
    let stride = layer.channels.len();
    layer.channels.iter().enumerate().map(move |(offset, channel)| {
        let name = if layer.name == DEFAULT_LAYER {
            (*channel).to_owned()
        } else {
            format!("{}.{channel}", layer.name)
        };
        let plane = layer.pixels.iter().skip(offset).step_by(stride).copied().collect();
        AnyChannel::new(text(&name), FlatSamples::F32(plane))
    })
}

/// Text of the format is bytes; these are UTF-8.
fn text(content: &str) -> Text {
    Text::from_slice_unchecked(content.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::tests::Folder;

    const SIZE: Size = Size { width: 5, height: 3 };

    #[test]
    fn layers_and_metadata_come_back_to_the_bit() {
        let folder = Folder::new("exr");
        let path = folder.0.join("a.exr");
        let color: Vec<f32> = (0..45).map(|i| i as f32 * 0.37 - 2.0).collect();
        let normal: Vec<f32> = (0..45).map(|i| (i as f32).sin()).collect();
        let mut depth = vec![7.25; 15];
        (depth[3], depth[4]) = (f32::INFINITY, f32::NAN);
        let layers = [
            Layer { name: "color", channels: &["R", "G", "B"], pixels: &color },
            Layer { name: "normal", channels: &["X", "Y", "Z"], pixels: &normal },
            Layer { name: "depth", channels: &["Z"], pixels: &depth },
        ];
        let long = "a key that is much longer than thirty-one bytes";
        let metadata = [("compression", "not the format's own"), ("scene", "Küche – ρ"), (long, "kept")]
            .map(|(key, value)| (key.to_owned(), value.to_owned()));
        write_exr(&path, SIZE, &layers, &metadata.clone().into()).expect("writable");

        let image = exr::prelude::read_all_flat_layers_from_file(&path).expect("valid");
        assert_eq!(image.layer_data.len(), 1, "one part");
        let part = &image.layer_data[0];
        assert_eq!(part.size, Vec2(5, 3));
        let channel = |name: &str| {
            let found = part.channel_data.list.iter().find(|channel| channel.name == text(name));
            found.expect(name).sample_data.values_as_f32().map(f32::to_bits).collect::<Vec<_>>()
        };
        let expected = |pixels: &[f32], offset: usize, stride: usize| {
            pixels.iter().skip(offset).step_by(stride).map(|value| value.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(channel("G"), expected(&color, 1, 3));
        assert_eq!(channel("normal.Z"), expected(&normal, 2, 3));
        assert_eq!(channel("depth.Z"), expected(&depth, 0, 1));
        let names: Vec<_> = part.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R", "depth.Z", "normal.X", "normal.Y", "normal.Z"]);
        for (key, value) in &metadata {
            let found = part.attributes.other.get(&text(&format!("evenlight:{key}")));
            assert_eq!(found, Some(&AttributeValue::Text(text(value))), "{key}");
        }
    }

    #[test]
    fn wrong_shapes_are_errors() {
        let folder = Folder::new("exr-shape");
        let path = folder.0.join("a.exr");
        let pixels = [0.0; 44];
        let layer = Layer { name: "color", channels: &["R", "G", "B"], pixels: &pixels };
        let message = write_exr(&path, SIZE, &[layer], &BTreeMap::new()).expect_err("44 numbers").to_string();
        assert!(message.contains("'color'") && message.contains("5 × 3"), "{message}");
        assert!(write_exr(&path, SIZE, &[], &BTreeMap::new()).is_err(), "no layer");
        let empty = Layer { pixels: &[], ..layer };
        assert!(write_exr(&path, Size { width: 0, height: 3 }, &[empty], &BTreeMap::new()).is_err());
        assert!(folder.names().is_empty());
    }
}
