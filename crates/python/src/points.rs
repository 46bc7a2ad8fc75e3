//! The door to the points crate: a point set by name, and arrays to fill.
use std::borrow::Borrow;
use std::num::NonZeroUsize;
use std::ops::Range;

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Options, Spec};
use evenlight_points::{Error, Seed, fill_parallel, fill_parallel_f32};
use numpy::{PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods};
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
    #[pyo3(signature = (name, dims, scramble, seed, *, n=None, base=None, order=None, strength=None, generator=None,
        matrices=None, bits=None))]
    #[expect(clippy::too_many_arguments, reason = "plain values, by keyword")]
    fn new(
        name: &str,
        dims: usize,
        scramble: &str,
        seed: u64,
        n: Option<u64>,
        base: Option<u32>,
        order: Option<u32>,
        strength: Option<u32>,
        generator: Option<Vec<u64>>,
        matrices: Option<Vec<Vec<u64>>>,
        bits: Option<u32>,
    ) -> PyResult<Self> {
        let options = Options { n, base, order, strength, generator, matrices, bits };
        let build = || {
            // an unknown sequence is said before an unknown randomization
            sequences::named(name)?;
            let spec = Spec { options, ..Spec::new(dims, Randomization::named(scramble)?, Seed::new(seed)) };
            sequences::build(name, &spec)
        };
        let built = build().map_err(|error: Error| PyValueError::new_err(error.to_string()));
        Ok(Self { inner: built? })
    }

    /// The number of coordinates of a point.
    #[getter]
    fn dims(&self) -> usize {
        self.inner.dims()
    }

    /// The number of points; None if there is no end to them.
    #[getter]
    fn count(&self) -> Option<u64> {
        self.inner.len()
    }

    /// The base in whose powers counts are balanced; None if no count is special.
    #[getter]
    fn base(&self) -> Option<u64> {
        self.inner.base()
    }

    /// The columns of the generating matrices; None for points that are no digital net in base 2.
    fn generating_matrices(&self) -> Option<Vec<Vec<u64>>> {
        self.inner.generating_matrices()
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
        let rows = (stop.saturating_sub(start)) as usize;
        check(out, &[rows, self.inner.dims()])?;
        fill(py, (1, workers), |_| &*self.inner, start..stop, out)
    }

    /// Writes the same rows of replicates 0, 1, … of the points with this seed, one after the other.
    fn fill_replicates(
        &self,
        py: Python<'_>,
        seed: u64,
        rows: (u64, u64),
        replicates: u64,
        out: &Bound<'_, PyUntypedArray>,
        workers: NonZeroUsize,
    ) -> PyResult<()> {
        let (start, stop) = rows;
        check(out, &[replicates as usize, stop.saturating_sub(start) as usize, self.inner.dims()])?;
        let set = |r| self.inner.reseeded(Seed::new(replicate_seed(seed, r)));
        fill(py, (replicates, workers), set, start..stop, out)
    }
}

/// Refuses arrays that are not as promised.
fn check(out: &Bound<'_, PyUntypedArray>, shape: &[usize]) -> PyResult<()> {
    if out.shape() != shape {
        let wanted = shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let message = format!("out must have shape ({wanted}), not {}", out.getattr("shape")?);
        return Err(PyValueError::new_err(message));
    }
    if !out.is_c_contiguous() {
        return Err(PyValueError::new_err("out must be C-contiguous"));
    }
    Ok(())
}

/// Writes the same rows of some point sets, one set after the other.
fn fill<S: Borrow<dyn evenlight_points::PointSet>>(
    py: Python<'_>,
    (sets, workers): (u64, NonZeroUsize),
    set: impl Fn(u64) -> S + Sync,
    rows: Range<u64>,
    out: &Bound<'_, PyUntypedArray>,
) -> PyResult<()> {
    let size = (out.len() / sets.max(1) as usize).max(1);
    if let Ok(mut array) = out.extract::<PyReadwriteArrayDyn<'_, f64>>() {
        let parts = array.as_slice_mut()?.chunks_mut(size);
        py.detach(|| {
            parts.zip(0..).for_each(|(part, r)| fill_parallel(set(r).borrow(), rows.clone(), part, workers));
        });
    } else if let Ok(mut array) = out.extract::<PyReadwriteArrayDyn<'_, f32>>() {
        let parts = array.as_slice_mut()?.chunks_mut(size);
        py.detach(|| {
            parts
                .zip(0..)
                .for_each(|(part, r)| fill_parallel_f32(set(r).borrow(), rows.clone(), part, workers));
        });
    } else {
        let message = format!("out must be a writable array of float64 or float32, not {}", out.dtype());
        return Err(PyTypeError::new_err(message));
    }
    Ok(())
}

/// The seed of an independent repetition.
#[pyfunction]
fn replicate_seed(seed: u64, replicate: u64) -> u64 {
    Seed::new(seed).replicate(replicate).bits64()
}

/// What a sequence says of itself: name, citation, accepted scrambles, options, most dimensions.
type Line = (&'static str, &'static str, Vec<&'static str>, Vec<&'static str>, usize);

/// All sequences.
#[pyfunction]
fn available_sequences() -> Vec<Line> {
    let line = |entry: &&sequences::Entry| {
        let scrambles = entry.accepts.iter().map(|randomization| randomization.name()).collect();
        (entry.name, entry.cite, scrambles, entry.takes.to_vec(), entry.most_dims)
    };
    sequences::ALL.iter().map(line).collect()
}
