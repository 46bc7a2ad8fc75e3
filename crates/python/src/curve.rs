//! The door to the space-filling curves: cells and indices, points along a curve, and the order of clouds.

use std::num::NonZeroUsize;

use evenlight_points::Seed;
use evenlight_points::warp::curve::points::{CurvePoints, Source};
use evenlight_points::warp::curve::sort::{Frame, order};
use evenlight_points::warp::curve::{self, CURVES, Curve, Grid};
use numpy::{
    PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(curve_cells, module)?)?;
    module.add_function(wrap_pyfunction!(curve_index, module)?)?;
    module.add_function(wrap_pyfunction!(curve_points, module)?)?;
    module.add_function(wrap_pyfunction!(curve_order, module)?)
}

fn named(name: &str) -> PyResult<&'static Curve> {
    let known = || CURVES.iter().map(|curve| curve.name).collect::<Vec<_>>().join(", ");
    curve::named(name)
        .ok_or_else(|| PyValueError::new_err(format!("unknown curve '{name}'; known: {}", known())))
}

fn grid(dims: usize, bits: u32) -> PyResult<Grid> {
    let message = "dims must be from 1 to 32, bits from 1 to 32, and dims * bits at most 64";
    Grid::new(dims, bits).ok_or_else(|| PyValueError::new_err(format!("{message}, not {dims} and {bits}")))
}

/// The cells of indices.
#[pyfunction]
fn curve_cells<'py>(
    py: Python<'py>,
    curve: &str,
    index: PyReadonlyArray1<'py, u64>,
    dims: usize,
    bits: u32,
) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let (curve, grid, index) = (named(curve)?, grid(dims, bits)?, index.as_slice()?);
    let mut cells = vec![0; index.len() * dims];
    py.detach(|| (curve.cells)(grid, index, &mut cells));
    PyArray1::from_vec(py, cells).reshape([index.len(), dims])
}

/// The indices of cells.
#[pyfunction]
fn curve_index<'py>(
    py: Python<'py>,
    curve: &str,
    cells: PyReadonlyArray2<'py, u32>,
    bits: u32,
) -> PyResult<Bound<'py, PyArray1<u64>>> {
    let (curve, grid) = (named(curve)?, grid(cells.shape()[1], bits)?);
    let (mut index, cells) = (vec![0; cells.shape()[0]], cells.as_slice()?);
    py.detach(|| (curve.indices)(grid, cells, &mut index));
    Ok(PyArray1::from_vec(py, index))
}

/// Writes points along a curve; n is the number of intervals, where there are any.
#[pyfunction]
fn curve_points(
    py: Python<'_>,
    curve: &str,
    source: &str,
    n_start: (u64, u64),
    seed: u64,
    mut out: PyReadwriteArray2<'_, f64>,
) -> PyResult<()> {
    let (n, start) = n_start;
    let source = match source {
        "centered" => Source::Centered(n),
        "stratified" => Source::Stratified(n),
        "van_der_corput" => Source::VanDerCorput,
        "owen" => Source::Owen,
        other => {
            let known = "centered, stratified, van_der_corput, owen";
            return Err(PyValueError::new_err(format!("unknown source '{other}'; known: {known}")));
        }
    };
    let dims = out.shape()[1];
    grid(dims, 1)?;
    let points = CurvePoints::new(named(curve)?, dims, source, Seed::new(seed));
    let out = out.as_slice_mut()?;
    py.detach(|| points.fill(start, out));
    Ok(())
}

/// The places of points in the order of a curve through a box.
#[pyfunction]
fn curve_order<'py>(
    py: Python<'py>,
    curve: &str,
    x: PyReadonlyArray2<'py, f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    workers: NonZeroUsize,
) -> PyResult<Bound<'py, PyArray1<u32>>> {
    let dims = x.shape()[1];
    grid(dims, 1)?;
    let (curve, grid) = (named(curve)?, Grid::finest(dims));
    if lower.len() != dims || upper.len() != dims {
        return Err(PyValueError::new_err(format!("a box in {dims} dimensions has as many bounds")));
    }
    let frame = Frame::new(grid, &lower, &upper);
    let x = x.as_slice()?;
    let found = py.detach(|| order(curve, grid, &frame, x, workers));
    Ok(PyArray1::from_vec(py, found))
}
