//! `OpenEXR` by way of the `exr` crate: any channel names, half or float, the largest level of the first flat layer.
//!
//! The `image` crate reads only files whose channels are called R, G and B; environment maps come with layers
//! (`diffuse.R`) or as luminance alone (`Y`).

use std::io::Cursor;

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, Text, read};
use image::{DynamicImage, Rgb32FImage, Rgba32FImage};

type Channel = exr::image::AnyChannel<FlatSamples>;

/// The image and its number of color channels; sides and memory are limited before anything is allocated.
pub(super) fn decode(bytes: &[u8], max_side: u32, max_bytes: u64) -> Result<(DynamicImage, usize), String> {
    check_size(bytes, max_side, max_bytes)?;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel() // a panic in a thread of its pool would end the process
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| format!("cannot be decoded: {error}"))?;
    let layer = image.layer_data;
    let (width, height) = (layer.size.0, layer.size.1);
    let channels = &layer.channel_data.list;
    let ([r, g, b], a) = choose(channels)?;
    let complete = |channel: &&Channel| channel.sample_data.len() == width * height;
    if ![r, g, b].iter().chain(a.iter()).all(complete) {
        return Err("subsampled channels are not supported".into());
    }
    let pixel = |i: usize| [r, g, b].map(|channel| channel.sample_data.value_by_flat_index(i).to_f32());
    let (columns, rows) = (width as u32, height as u32);
    let decoded = match a {
        None => {
            let all = (0..width * height).flat_map(pixel).collect();
            Rgb32FImage::from_raw(columns, rows, all).map(DynamicImage::ImageRgb32F)
        }
        Some(a) => {
            let alpha = |i: usize| a.sample_data.value_by_flat_index(i).to_f32();
            let all = (0..width * height).flat_map(|i| {
                let [r, g, b] = pixel(i);
                [r, g, b, alpha(i)]
            });
            Rgba32FImage::from_raw(columns, rows, all.collect()).map(DynamicImage::ImageRgba32F)
        }
    };
    let color_channels = if std::ptr::eq(r, g) { 1 } else { 3 };
    decoded.map(|image| (image, color_channels)).ok_or_else(|| "has fewer pixels than it says".into())
}

fn check_size(bytes: &[u8], max_side: u32, max_bytes: u64) -> Result<(), String> {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false)
        .map_err(|error| format!("cannot be decoded: {error}"))?;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.0 as u64, header.layer_size.1 as u64);
        let channels = header.channels.list.len() as u64;
        let side = u64::from(max_side);
        if width > side || height > side || width * height * 4 * channels.max(4) > max_bytes {
            return Err(format!(
                "{width} × {height} pixels with {channels} channels are too many; at most {side} × {side} and \
                 {} MiB are read",
                max_bytes >> 20
            ));
        }
    }
    Ok(())
}

/// Red, green and blue of the first group that has all three, with its alpha; else luminance alone.
fn choose(channels: &[Channel]) -> Result<([&Channel; 3], Option<&Channel>), String> {
    let names: Vec<String> = channels.iter().map(|channel| lowercase(&channel.name)).collect();
    let named = |name: &str| names.iter().position(|known| known == name).map(|i| &channels[i]);
    for name in &names {
        let (group, last) = name.rsplit_once('.').map_or(("", &name[..]), |(group, last)| (group, last));
        let [r, g, b] = match last {
            "r" => ["r", "g", "b"],
            "red" => ["red", "green", "blue"],
            _ => continue,
        };
        let member = |part: &str| {
            let full = if group.is_empty() { part.to_owned() } else { format!("{group}.{part}") };
            named(&full)
        };
        if let (Some(r), Some(g), Some(b)) = (member(r), member(g), member(b)) {
            return Ok(([r, g, b], member("a").or_else(|| member("alpha"))));
        }
    }
    let alone = named("y").or_else(|| (channels.len() == 1).then(|| &channels[0]));
    let alone = alone.ok_or_else(|| format!("needs channels R, G, B or Y, has {}", names.join(", ")))?;
    Ok(([alone; 3], named("a")))
}

fn lowercase(name: &Text) -> String {
    name.to_string().to_lowercase()
}
