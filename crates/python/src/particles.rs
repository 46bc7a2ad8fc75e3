//! The door to what particle filters do between two moves: the order of a cloud, and who is selected.

use evenlight_points::resample::drawn;
use evenlight_points::warp::curve::{MOST_DIMS, cloud};
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(cloud_order, module)?)?;
    module.add_function(wrap_pyfunction!(drawn_places, module)?)
}

/// The places of points along Hilbert's curve through their cloud; of numbers, in ascending order.
#[pyfunction]
fn cloud_order<'py>(py: Python<'py>, x: PyReadonlyArray2<'py, f64>) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let dims = x.shape()[1];
    if !(1..=MOST_DIMS).contains(&dims) {
        return Err(PyValueError::new_err(format!("dims must be from 1 to {MOST_DIMS}, not {dims}")));
    }
    let x = x.as_slice()?;
    let found = py.detach(|| cloud::order(dims, x).into_iter().map(i64::from).collect());
    Ok(PyArray1::from_vec(py, found))
}

/// The places that ascending numbers draw by weights.
#[pyfunction]
fn drawn_places<'py>(
    py: Python<'py>,
    weights: PyReadonlyArray1<'py, f64>,
    numbers: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let (weights, numbers) = (weights.as_slice()?, numbers.as_slice()?);
    let mut out = vec![0; numbers.len()];
    py.detach(|| drawn(weights, numbers, &mut out));
    Ok(PyArray1::from_vec(py, out))
}
