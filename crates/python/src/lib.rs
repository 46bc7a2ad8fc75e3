//! The door between the Rust core and Python: conversions only, no mathematics.
use pyo3::prelude::*;

mod points;

/// The private extension module behind the `evenlight` package.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    points::register(module)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
