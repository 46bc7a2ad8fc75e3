//! The door between the Rust core and Python: conversions only, no mathematics.

mod output;

use pyo3::prelude::*;

/// The private extension module behind the `evenlight` package.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(output::check_writable, module)?)?;
    module.add_function(wrap_pyfunction!(output::write_exr, module)?)?;
    module.add_function(wrap_pyfunction!(output::write_png, module)?)
}
