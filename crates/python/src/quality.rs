//! The door to figures of merit.

use evenlight_points::{Error, quality};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(t_value, module)?)?;
    module.add_function(wrap_pyfunction!(t_value_in_base, module)?)
}

fn raise(error: Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// The quality parameter of a net in base 2, from the columns of its matrices.
#[pyfunction]
fn t_value(py: Python<'_>, matrices: Vec<Vec<u64>>, m: u32) -> PyResult<u32> {
    py.detach(|| quality::t_value(&matrices, m)).map_err(raise)
}

/// The quality parameter of a net in a prime base, from the rows of digits of its matrices.
#[pyfunction]
fn t_value_in_base(py: Python<'_>, base: u32, matrices: Vec<Vec<Vec<u32>>>, m: u32) -> PyResult<u32> {
    py.detach(|| quality::t_value_in_base(base, &matrices, m)).map_err(raise)
}
