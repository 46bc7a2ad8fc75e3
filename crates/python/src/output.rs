//! Images on disk, from NumPy arrays.

use std::collections::BTreeMap;
use std::path::PathBuf;

use evenlight_render::output::{self, Layer, Size};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::raise;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(check_writable, module)?)?;
    module.add_function(wrap_pyfunction!(write_exr, module)?)?;
    module.add_function(wrap_pyfunction!(write_png, module)?)
}

type Image<'py> = PyReadonlyArray3<'py, f32>;

/// Refuse a path that cannot be written, before the work is done.
#[pyfunction]
fn check_writable(path: PathBuf) -> PyResult<()> {
    output::check_writable(&path).map_err(raise)
}

/// Write `(name, channels, (H, W, C) array)` layers as one OpenEXR file.
#[pyfunction]
fn write_exr(
    py: Python<'_>,
    path: PathBuf,
    layers: Vec<(String, Vec<String>, Image<'_>)>,
    metadata: BTreeMap<String, String>,
) -> PyResult<()> {
    let Some((_, _, first)) = layers.first() else {
        return Err(PyValueError::new_err("an image needs at least one layer"));
    };
    let size = Size { width: first.shape()[1], height: first.shape()[0] };
    let channels: Vec<Vec<&str>> =
        layers.iter().map(|(_, names, _)| names.iter().map(String::as_str).collect()).collect();
    let plain = layers
        .iter()
        .zip(&channels)
        .map(|((name, _, image), channels)| Ok(Layer { name, channels, pixels: image.as_slice()? }));
    let plain = plain.collect::<PyResult<Vec<_>>>()?;
    py.detach(|| output::write_exr(&path, size, &plain, &metadata)).map_err(raise)
}

/// Write a linear `(H, W, 3)` array as an 8-bit sRGB preview.
#[pyfunction]
fn write_png(
    py: Python<'_>,
    path: PathBuf,
    image: Image<'_>,
    exposure: f32,
    metadata: BTreeMap<String, String>,
) -> PyResult<()> {
    let size = Size { width: image.shape()[1], height: image.shape()[0] };
    let pixels = image.as_slice()?;
    py.detach(|| output::write_png(&path, size, pixels, exposure, &metadata)).map_err(raise)
}
