//! The door to the points crate: a point set by name, and arrays to fill.
use std::num::NonZeroUsize;

use evenlight_points::{Seed, fill_parallel, fill_parallel_f32, sequences};
use numpy::{PyReadwriteArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PointSet>()?;
    module.add_function(wrap_pyfunction!(replicate_seed, module)?)?;
    module.add_function(wrap_pyfunction!(available_sequences, module)?)
}

/// A sequence built from plain values.
#[pyclass(frozen, module = "evenlight._core")]
struct PointSet {
    inner: Box<dyn evenlight_points::PointSet>,
}

#[pymethods]
impl PointSet {
    #[new]
    fn new(name: &str, dims: usize, scramble: &str, seed: u64) -> PyResult<Self> {
        let built = sequences::build(name, dims, scramble, Seed::new(seed));
        Ok(Self { inner: built.map_err(|error| PyValueError::new_err(error.to_string()))? })
    }

    /// The number of coordinates of a point.
    #[getter]
    fn dims(&self) -> usize {
        self.inner.dims()
    }

    /// One coordinate of one point.
    fn coord(&self, index: u64, dim: usize) -> PyResult<f64> {
        if dim >= self.inner.dims() {
            let message = format!("dimension {dim} of a point set of {} dimensions", self.inner.dims());
            return Err(PyIndexError::new_err(message));
        }
        Ok(self.inner.coord(index, dim))
    }

    /// Writes rows `start` to `stop` into a C-contiguous array of float64 or float32, with some threads.
    fn fill(
        &self,
        py: Python<'_>,
        start: u64,
        stop: u64,
        out: &Bound<'_, PyUntypedArray>,
        workers: NonZeroUsize,
    ) -> PyResult<()> {
        let shape = (stop.saturating_sub(start) as usize, self.inner.dims());
        if out.shape() != [shape.0, shape.1] {
            let message = format!("out must have shape {shape:?}, not {}", out.getattr("shape")?);
            return Err(PyValueError::new_err(message));
        }
        if !out.is_c_contiguous() {
            return Err(PyValueError::new_err("out must be C-contiguous"));
        }
        if let Ok(mut array) = out.extract::<PyReadwriteArray2<'_, f64>>() {
            let places = array.as_slice_mut()?;
            py.detach(|| fill_parallel(&*self.inner, start..stop, places, workers));
        } else if let Ok(mut array) = out.extract::<PyReadwriteArray2<'_, f32>>() {
            let places = array.as_slice_mut()?;
            py.detach(|| fill_parallel_f32(&*self.inner, start..stop, places, workers));
        } else {
            let message = format!("out must be a writable array of float64 or float32, not {}", out.dtype());
            return Err(PyTypeError::new_err(message));
        }
        Ok(())
    }
}

/// The seed of an independent repetition.
#[pyfunction]
fn replicate_seed(seed: u64, replicate: u64) -> u64 {
    Seed::new(seed).replicate(replicate).bits64()
}

/// (name, citation, accepted scrambles, most dimensions) of every sequence.
#[pyfunction]
fn available_sequences() -> Vec<(&'static str, &'static str, Vec<&'static str>, usize)> {
    let line = |entry: &&sequences::Entry| {
        let scrambles = entry.accepts.iter().map(|scramble| scramble.name()).collect();
        (entry.name, entry.cite, scrambles, entry.most_dims)
    };
    sequences::ALL.iter().map(line).collect()
}
