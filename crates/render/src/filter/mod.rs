//! Pixel reconstruction filters, sampled by importance.
//!
//! A pixel's value is the integral of radiance against a filter centered on it. Points are drawn from the filter's absolute value
//! (Ernst, Stamminger & Greiner 2006, "Filter Importance Sampling"), so every sample belongs to one pixel: pixels stay
//! independent, tiles need no borders, and each pixel's replicates give its standard error.

use crate::Result;
use crate::scene::node::Node;
use crate::scene::properties::Properties;

pub mod r#box;
pub mod catmullrom;
pub mod gaussian;
pub mod lanczos;
pub mod mitchell;
pub mod tent;

/// One filter of the registry.
pub struct Entry {
    /// Name of the Mitsuba 3 plugin.
    pub name: &'static str,
    /// Read the parameters and tabulate.
    pub build: fn(&Properties<'_>) -> Result<Filter>,
}

/// The filters there are.
pub static ALL: &[Entry] =
    &[r#box::ENTRY, catmullrom::ENTRY, gaussian::ENTRY, lanczos::ENTRY, mitchell::ENTRY, tent::ENTRY];

/// Intervals of the table on each side of the center.
const RESOLUTION: usize = 128;

/// A separable filter, ready to be sampled along one axis.
#[derive(Clone, Debug)]
pub struct Filter {
    /// Name of the plugin.
    pub name: &'static str,
    radius: f32,
    /// Cumulative integral of |f| at the ends of equal intervals of [−radius, radius]; empty for a box.
    cumulative: Vec<f32>,
    /// Sign of f on each interval times ∫|f| / ∫f.
    weight: Vec<f32>,
}

impl Filter {
    /// All pixels are averages over their own square.
    pub fn pixel_box() -> Self {
        Self { name: "box", radius: 0.5, cumulative: Vec::new(), weight: Vec::new() }
    }

    /// Tabulate the even function `f` of radius `radius` (pixels).
    pub(crate) fn tabulate(name: &'static str, radius: f32, f: impl Fn(f64) -> f64) -> Self {
        let count = 2 * RESOLUTION;
        let step = 2.0 * f64::from(radius) / count as f64;
        let value = |i: usize| f(step * (i as f64 + 0.5) - f64::from(radius));
        let total: f64 = (0..count).map(value).sum();
        let absolute: f64 = (0..count).map(|i| value(i).abs()).sum();
        let mut sum = 0.0;
        let cumulative = (0..count).map(|i| {
            sum += value(i).abs() / absolute;
            sum as f32
        });
        let weight = (0..count).map(|i| (value(i).signum() * absolute / total) as f32);
        Self { name, radius, cumulative: cumulative.collect(), weight: weight.collect() }
    }

    /// Offset from the pixel center (pixels) and the weight of the sample.
    #[inline]
    pub fn sample(&self, u: f32) -> (f32, f32) {
        if self.cumulative.is_empty() {
            return ((u - 0.5) * 2.0 * self.radius, 1.0);
        }
        let chosen = self.cumulative.partition_point(|&sum| sum <= u).min(self.cumulative.len() - 1);
        let below = if chosen == 0 { 0.0 } else { self.cumulative[chosen - 1] };
        let within = ((u - below) / (self.cumulative[chosen] - below).max(1e-12)).clamp(0.0, 1.0);
        let step = 2.0 * self.radius / self.cumulative.len() as f32;
        (step * (chosen as f32 + within) - self.radius, self.weight[chosen])
    }

    /// The filter of a scene file.
    pub(crate) fn from_node(node: &Node, builder: &mut crate::scene::build::Builder) -> Result<Self> {
        let properties = Properties::new(node);
        let Some(entry) = ALL.iter().find(|entry| entry.name == node.plugin) else {
            builder.unknown_plugin(node, ALL.iter().map(|entry| entry.name), "replaced by box")?;
            return Ok(Self::pixel_box());
        };
        let filter = (entry.build)(&properties)?;
        builder.finish(&properties)?;
        Ok(filter)
    }

    /// A filter by name, with its default parameters.
    pub fn by_name(name: &str) -> Result<Self> {
        let entry = ALL.iter().find(|entry| entry.name == name);
        let entry = entry.ok_or_else(|| {
            let known = ALL.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ");
            crate::Error::Settings(format!("unknown filter '{name}'; known: {known}"))
        })?;
        let node = Node::empty(crate::scene::node::Kind::ReconstructionFilter, entry.name);
        (entry.build)(&Properties::new(&node))
    }
}
