//! The door between the Rust core and Python: conversions only, no mathematics.

mod output;
mod points;

use pyo3::prelude::*;

/// The private extension module behind the `evenlight` package.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    output::register(module)?;
    points::register(module)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
