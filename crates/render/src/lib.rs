//! A fast physically based renderer: the hard integrand.
//!
//! Every pixel is an integral over light paths. A scene is read once ([`scene`]), its triangles go into a ray kernel
//! ([`accel`]), and an integrator estimates every pixel from independent replicates ([`film`]), so that every pixel carries
//! a standard error.

pub mod accel;
pub mod bounces;
pub mod bsdf;
pub mod emitter;
mod error;
pub mod film;
pub mod filter;
pub mod geometry;
pub mod integrator;
mod memory;
pub mod output;
pub mod render;
pub mod sampler;
pub mod scene;
pub mod sensor;
pub mod shape;
pub mod texture;
mod workers;

pub use error::{Error, Location, Result};
