//! The film: per pixel and replicate, what was measured.
//!
//! Each replicate is an independent estimate of the whole image. The image is their mean, and its standard error comes from their
//! spread. The usual formula from the variance of single samples is *not* used: it is wrong for quasi-Monte Carlo points, whose
//! samples are correlated on purpose.

use crate::filter::Filter;
use crate::geometry::Vec3;
use crate::integrator::Measurement;
use crate::scene::build::Builder;
use crate::scene::node::{Kind, Node};
use crate::scene::properties::Properties;
use crate::{Error, Result};

/// The widest and highest film.
const LARGEST: i64 = 1 << 15;

/// The most pixels of all replicates together: 6 GiB.
const MOST_COLORS: u64 = 1 << 29;

/// What a scene file says of the image.
#[derive(Clone, Debug)]
pub struct FilmSettings {
    /// Width and height of the whole film in pixels.
    pub size: [u32; 2],
    /// The part of it that is rendered: left, top, width, height.
    pub crop: [u32; 4],
    /// How pixels are reconstructed.
    pub filter: Filter,
}

impl FilmSettings {
    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// The same, all of it, at another size.
    pub fn resized(&self, size: [u32; 2]) -> Result<Self> {
        if size.iter().any(|&n| n == 0 || i64::from(n) > LARGEST) {
            let [width, height] = size;
            return Err(Error::Settings(format!(
                "size {width}x{height}: each must be 1 to {LARGEST} pixels"
            )));
        }
        Ok(Self { size, crop: [0, 0, size[0], size[1]], filter: self.filter.clone() })
    }

    /// Read the film nested in a sensor; Mitsuba's default is 768×576 with a Gaussian filter.
    pub(crate) fn from_sensor(sensor: &Node, builder: &mut Builder) -> Result<Self> {
        let empty = Node::empty(Kind::Film, "hdrfilm");
        let sensor = Properties::new(sensor);
        let node = match sensor.children(Kind::Film)[..] {
            [] => &empty,
            [child] => &*child.node,
            _ => return Err(sensor.error("has more than one film")),
        };
        let properties = Properties::new(node);
        if node.plugin != "hdrfilm" {
            builder.forgive(properties.error("unknown film; known: hdrfilm"), "read as hdrfilm")?;
        }
        let size = [pixels(&properties, "width", 768)?, pixels(&properties, "height", 576)?];
        let crop = read_crop(&properties, size)?;
        // how files are written is the caller's choice
        for ignored in ["file_format", "pixel_format", "component_format"] {
            properties.optional_string(ignored)?;
        }
        for ignored in ["sample_border", "compensate"] {
            properties.boolean(ignored, false)?;
        }
        let filter = match properties.children(Kind::ReconstructionFilter)[..] {
            [] => Filter::by_name("gaussian")?,
            [child] => Filter::from_node(&child.node, builder)?,
            _ => return Err(properties.error("has more than one rfilter")),
        };
        builder.finish(&properties)?;
        Ok(Self { size, crop, filter })
    }
}

fn pixels(properties: &Properties<'_>, name: &str, default: i64) -> Result<u32> {
    let given = properties.optional_integer(name)?.unwrap_or(default);
    if (1..=LARGEST).contains(&given) {
        return Ok(given as u32);
    }
    Err(properties.error(format_args!("{name} must be 1 to {LARGEST} pixels, not {given}")))
}

fn read_crop(properties: &Properties<'_>, [width, height]: [u32; 2]) -> Result<[u32; 4]> {
    let read = |name: &str, default: u32| -> Result<i64> {
        Ok(properties.optional_integer(name)?.unwrap_or_else(|| default.into()))
    };
    let crop = [
        read("crop_offset_x", 0)?,
        read("crop_offset_y", 0)?,
        read("crop_width", width)?,
        read("crop_height", height)?,
    ];
    let fits = |offset: i64, length: i64, whole: u32| {
        offset >= 0 && length >= 1 && offset.checked_add(length).is_some_and(|end| end <= whole.into())
    };
    if fits(crop[0], crop[2], width) && fits(crop[1], crop[3], height) {
        return Ok(crop.map(|n| n as u32));
    }
    Err(properties.error("the crop window must lie within the film"))
}

/// A rectangle of pixels of one replicate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tile {
    pub(crate) replicate: u32,
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// Means over the samples of one pixel and replicate.
pub(crate) type PixelMean = Measurement;

/// Images in the making; row-major, top row first.
pub struct Film {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// How many independent estimates there are.
    pub replicates: u32,
    /// The mean color of each replicate and pixel; NaN where it is not complete.
    pub colors: Vec<[f32; 3]>,
    /// How many replicates of each pixel are complete.
    pub completed: Vec<u32>,
    /// Mean albedo, normal and depth at the first surface, over complete replicates.
    pub albedo: Vec<[f32; 3]>,
    /// See `albedo`.
    pub normal: Vec<[f32; 3]>,
    /// See `albedo`; over the samples that hit anything.
    pub depth: Vec<f32>,
}

impl Film {
    /// A film on which nothing has been recorded; an error if it is too large for the memory.
    pub fn new(width: u32, height: u32, replicates: u32) -> Result<Self> {
        let refuse = |why: &str| {
            Error::Settings(format!("an image of {width}x{height} pixels and {replicates} replicates {why}"))
        };
        let pixels = width as usize * height as usize;
        let count = (pixels as u64).checked_mul(replicates.into()).filter(|count| *count <= MOST_COLORS);
        let count = count.ok_or_else(|| {
            refuse(&format!("is too large; width × height × replicates up to {MOST_COLORS} is allowed"))
        })?;
        let mut colors = Vec::new();
        colors.try_reserve_exact(count as usize).map_err(|_| refuse("does not fit into the memory"))?;
        colors.resize(count as usize, [f32::NAN; 3]);
        Ok(Self {
            width,
            height,
            replicates,
            colors,
            completed: vec![0; pixels],
            albedo: vec![[0.0; 3]; pixels],
            normal: vec![[0.0; 3]; pixels],
            depth: vec![0.0; pixels],
        })
    }

    /// Merge a finished tile. Tiles must come in the order of their replicates.
    pub(crate) fn merge(&mut self, tile: &Tile, means: &[PixelMean]) {
        let pixels = self.completed.len();
        let rows = means.chunks_exact(tile.width as usize);
        for (y, row) in (tile.y..).zip(rows) {
            for (x, mean) in (tile.x..).zip(row) {
                let pixel = y as usize * self.width as usize + x as usize;
                self.colors[tile.replicate as usize * pixels + pixel] = mean.radiance.into();
                let before = self.completed[pixel] as f32;
                self.completed[pixel] += 1;
                let update = |old: [f32; 3], new: Vec3| -> [f32; 3] {
                    (Vec3::from(old) + (new - Vec3::from(old)) / (before + 1.0)).into()
                };
                self.albedo[pixel] = update(self.albedo[pixel], mean.albedo);
                self.normal[pixel] = update(self.normal[pixel], mean.normal);
                self.depth[pixel] += (mean.depth - self.depth[pixel]) / (before + 1.0);
            }
        }
    }

    /// The mean relative standard error over pixels with at least two complete replicates: Σ errors / Σ values.
    pub fn mean_relative_error(&self) -> Option<f64> {
        let pixels = self.completed.len();
        let (mut errors, mut values) = (0.0, 0.0);
        for (pixel, &count) in self.completed.iter().enumerate().filter(|(_, count)| **count > 1) {
            let count = f64::from(count);
            for channel in 0..3 {
                let value = |r: usize| f64::from(self.colors[r * pixels + pixel][channel]);
                let replicates = 0..count as usize;
                let mean = replicates.clone().map(value).sum::<f64>() / count;
                let squares = replicates.map(|r| (value(r) - mean).powi(2)).sum::<f64>();
                errors += (squares / (count * (count - 1.0))).sqrt();
                values += mean;
            }
        }
        (values > 0.0).then(|| errors / values)
    }
}
