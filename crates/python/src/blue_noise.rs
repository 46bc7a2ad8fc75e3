//! The door to blue noise: points, dither masks and the order of pixels.

use std::num::NonZeroUsize;

use evenlight_points::blue_noise::{self, Request, gaussian, pixel_order, vector_mask};
use evenlight_points::{Error, Seed};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(available_blue_noise, module)?)?;
    module.add_function(wrap_pyfunction!(blue_noise_points, module)?)?;
    module.add_function(wrap_pyfunction!(dither_planes, module)?)?;
    module.add_function(wrap_pyfunction!(pixel_places, module)?)?;
    module.add_function(wrap_pyfunction!(relaxed, module)?)
}

fn raise(error: Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Name, citation, whether it is progressive, what its effort is counted in and how much is usual.
type Info = (&'static str, &'static str, bool, &'static str, u32);

/// All members of the family.
#[pyfunction]
fn available_blue_noise() -> Vec<Info> {
    let info = |entry: &&blue_noise::Entry| {
        (entry.name, entry.cite, entry.progressive, entry.effort.0, entry.effort.1)
    };
    blue_noise::ALL.iter().map(info).collect()
}

/// Points of a member.
#[pyfunction]
fn blue_noise_points<'py>(
    py: Python<'py>,
    name: &str,
    shape: (usize, usize),
    effort: u32,
    seed: u64,
    workers: NonZeroUsize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (n, dims) = shape;
    let request = Request { n, dims, effort, seed: Seed::new(seed), workers };
    let points = py.detach(|| blue_noise::points(name, &request)).map_err(raise)?;
    PyArray1::from_vec(py, points).reshape([n, dims])
}

/// Points after some steps of relaxation.
#[pyfunction]
fn relaxed<'py>(
    py: Python<'py>,
    x: PyReadonlyArray2<'py, f64>,
    steps: u32,
    workers: NonZeroUsize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let shape = [x.shape()[0], x.shape()[1]];
    let mut points = x.as_slice()?.to_vec();
    py.detach(|| gaussian::relax(&mut points, shape[1], steps, workers)).map_err(raise)?;
    PyArray1::from_vec(py, points).reshape(shape)
}

/// The values of a dither mask: rows and columns of each channel.
#[pyfunction]
fn dither_planes<'py>(
    py: Python<'py>,
    shape: (usize, usize, usize),
    tries: u32,
    seed: u64,
    workers: NonZeroUsize,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let (rows, columns, channels) = shape;
    let make = || vector_mask::planes([rows, columns], channels, tries, Seed::new(seed), workers);
    let planes = py.detach(make).map_err(raise)?;
    PyArray1::from_vec(py, planes).reshape([channels, rows, columns])
}

/// The place of each pixel in a sequence for the whole image.
#[pyfunction]
fn pixel_places<'py>(
    py: Python<'py>,
    curve: &str,
    shape: (usize, usize),
    shuffle: Option<u64>,
) -> PyResult<Bound<'py, PyArray2<u64>>> {
    let shape = [shape.0, shape.1];
    let places = py.detach(|| pixel_order::places(curve, shape, shuffle.map(Seed::new))).map_err(raise)?;
    PyArray1::from_vec(py, places).reshape(shape)
}
