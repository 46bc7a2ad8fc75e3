//! Cameras: from a point of the film and a point of the lens to a ray.
//!
//! Plugin names, parameters and defaults are those of Mitsuba 3: the camera looks along its local +z axis, its +y is up
//! and its +x points to the left of the image.

use std::sync::Arc;

use crate::Result;
use crate::geometry::Ray;
use crate::scene::build::Builder;
use crate::scene::properties::Properties;

pub mod orthographic;
pub mod perspective;
pub mod thinlens;

/// A line of the registry. The film's width over height is known when a sensor is built.
pub struct Entry {
    /// Name of the Mitsuba 3 plugin.
    pub name: &'static str,
    /// Read the parameters and build, for a film of this aspect ratio (width / height).
    pub build: fn(&Properties<'_>, &mut Builder, f64) -> Result<Arc<dyn Sensor>>,
}

/// The sensors there are.
pub static ALL: &[Entry] = &[orthographic::ENTRY, perspective::ENTRY, thinlens::ENTRY];

/// A camera.
pub trait Sensor: Send + Sync {
    /// The ray through `film`, in units of the full film with (0, 0) its top left and (1, 1) its bottom right corner.
    /// `lens` is a point of the unit square.
    fn ray(&self, film: [f32; 2], lens: [f32; 2]) -> Ray;
}
