//! The door to files of pictures.

use std::collections::BTreeMap;
use std::path::PathBuf;

use evenlight_render::output::{self, Layer, Size};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::raise;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(check_writable, module)?)?;
    module.add_function(wrap_pyfunction!(write_exr, module)?)?;
    module.add_function(wrap_pyfunction!(write_png, module)?)
}

fn size_of(image: &PyReadonlyArray3<'_, f32>) -> Size {
    Size { height: image.shape()[0], width: image.shape()[1] }
}

#[pyfunction]
fn check_writable(path: PathBuf) -> PyResult<()> {
    output::check_writable(&path).map_err(raise)
}

/// `layers`: name, channel names and an (H, W, channels) array each.
#[pyfunction]
fn write_exr(
    py: Python<'_>,
    path: PathBuf,
    layers: Vec<(String, Vec<String>, PyReadonlyArray3<'_, f32>)>,
    metadata: BTreeMap<String, String>,
) -> PyResult<()> {
    let Some((_, _, first)) = layers.first() else {
        return Err(pyo3::exceptions::PyValueError::new_err("an image needs at least one layer"));
    };
    let size = size_of(first);
    let channels: Vec<Vec<&str>> =
        layers.iter().map(|(_, channels, _)| channels.iter().map(String::as_str).collect()).collect();
    let borrowed = layers.iter().zip(&channels).map(|((name, _, pixels), channels)| {
        Ok(Layer { name, channels, pixels: pixels.as_slice()? })
    });
    let borrowed = borrowed.collect::<PyResult<Vec<_>>>()?;
    py.detach(|| output::write_exr(&path, size, &borrowed, &metadata)).map_err(raise)
}

/// `image`: linear (H, W, 3).
#[pyfunction]
fn write_png(
    py: Python<'_>,
    path: PathBuf,
    image: PyReadonlyArray3<'_, f32>,
    exposure: f32,
    metadata: BTreeMap<String, String>,
) -> PyResult<()> {
    let (size, pixels) = (size_of(&image), image.as_slice()?);
    py.detach(|| output::write_png(&path, size, pixels, exposure, &metadata)).map_err(raise)
}
