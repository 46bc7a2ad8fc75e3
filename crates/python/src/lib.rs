//! The door between the Rust core and Python: conversions only, no mathematics.

#![allow(clippy::needless_pass_by_value, reason = "PyO3 gives away what it converts")]

mod blue_noise;
mod curve;
mod errors;
mod families;
mod lattices;
mod output;
mod particles;
mod points;
mod quality;
mod render;
mod warp;

use pyo3::prelude::*;

/// The private extension module behind the `evenlight` package.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    blue_noise::register(module)?;
    curve::register(module)?;
    families::register(module)?;
    lattices::register(module)?;
    output::register(module)?;
    particles::register(module)?;
    points::register(module)?;
    quality::register(module)?;
    render::register(module)?;
    warp::register(module)
}
