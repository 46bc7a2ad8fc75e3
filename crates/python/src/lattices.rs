//! The door to the construction of lattices and to their criteria: plain numbers in and out.

use evenlight_points::Error;
use evenlight_points::construction::{self, korobov};
use evenlight_points::quality::lattice_criteria::{Space, squared_error, squared_error_of_net};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(construct_lattice, module)?)?;
    module.add_function(wrap_pyfunction!(construct_polynomial_lattice, module)?)?;
    module.add_function(wrap_pyfunction!(construct_korobov, module)?)?;
    module.add_function(wrap_pyfunction!(lattice_error, module)?)?;
    module.add_function(wrap_pyfunction!(digital_net_error, module)?)
}

fn refused(error: Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn space(name: &str, smoothness: u32) -> PyResult<Space> {
    match name {
        "sobolev" => Ok(Space::Sobolev),
        "korobov" => Ok(Space::Korobov(smoothness)),
        other => Err(PyValueError::new_err(format!("unknown space '{other}'; known: sobolev, korobov"))),
    }
}

/// A generating vector, component by component.
#[pyfunction]
fn construct_lattice(
    py: Python<'_>,
    n: u64,
    least: Option<u64>,
    weights: Vec<f64>,
    space_name: &str,
    smoothness: u32,
) -> PyResult<Vec<u64>> {
    let space = space(space_name, smoothness)?;
    py.detach(|| construction::lattice(n, least, &weights, space)).map_err(refused)
}

/// Generating polynomials, component by component.
#[pyfunction]
fn construct_polynomial_lattice(
    py: Python<'_>,
    n: u64,
    least: Option<u64>,
    weights: Vec<f64>,
) -> PyResult<Vec<u64>> {
    py.detach(|| construction::polynomial_lattice(n, least, &weights)).map_err(refused)
}

/// The number of a Korobov lattice.
#[pyfunction]
fn construct_korobov(
    py: Python<'_>,
    n: u64,
    weights: Vec<f64>,
    space_name: &str,
    smoothness: u32,
    candidates: u64,
) -> PyResult<u64> {
    let space = space(space_name, smoothness)?;
    py.detach(|| korobov::search(n, &weights, space, candidates)).map_err(refused)
}

/// The squared worst-case error of a lattice.
#[pyfunction]
fn lattice_error(
    py: Python<'_>,
    generator: Vec<u64>,
    n: u64,
    weights: Vec<f64>,
    space_name: &str,
    smoothness: u32,
) -> PyResult<f64> {
    let space = space(space_name, smoothness)?;
    py.detach(|| squared_error(&generator, n, &weights, space)).map_err(refused)
}

/// The squared worst-case error of a net, averaged over digital shifts.
#[pyfunction]
fn digital_net_error(py: Python<'_>, x: PyReadonlyArray2<'_, f64>, weights: Vec<f64>) -> PyResult<f64> {
    let rows = x.as_slice()?;
    py.detach(|| squared_error_of_net(rows, &weights)).map_err(refused)
}
