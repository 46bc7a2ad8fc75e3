//! A fast physically based renderer: the hard integrand.
//!
//! Every pixel is an integral over light paths. A scene is read once ([`scene`]), its triangles go into a ray kernel
//! ([`accel`]), and an integrator estimates every pixel from independent replicates, so that every pixel carries
//! a standard error.

pub mod accel;
pub mod bsdf;
mod error;
pub mod geometry;
pub mod output;
pub mod scene;
pub mod texture;

pub use error::{Error, Location, Result};
