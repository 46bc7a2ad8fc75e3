//! The door to the warps: a warp by name, points of triangles, and arrays to fill.

use std::num::NonZeroUsize;

use evenlight_points::scramble::Randomization;
use evenlight_points::warp::rows::{AnyRows, Rows, in_parts};
use evenlight_points::warp::triangle::{kronecker, product::Product, van_der_corput::VanDerCorput};
use evenlight_points::warp::{self, Options, Real};
use evenlight_points::{Error, Seed};
use numpy::{
    Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Warp>()?;
    module.add_function(wrap_pyfunction!(available_warps, module)?)?;
    module.add_function(wrap_pyfunction!(triangle_van_der_corput, module)?)?;
    module.add_function(wrap_pyfunction!(triangle_kronecker, module)?)?;
    module.add_function(wrap_pyfunction!(triangle_product, module)?)
}

/// What a warp says of itself: name, citation, options, whether it folds.
type Line = (&'static str, &'static str, Vec<&'static str>, bool);

/// All warps.
#[pyfunction]
fn available_warps() -> Vec<Line> {
    let line = |entry: &&warp::Entry| (entry.name, entry.cite, entry.takes.to_vec(), entry.folds);
    warp::ALL.iter().map(line).collect()
}

/// A warp built from plain values.
#[pyclass(frozen, module = "evenlight._core")]
struct Warp {
    inner: Box<dyn AnyRows>,
}

/// What is asked of a warp.
#[derive(Clone, Copy)]
enum Way {
    Map,
    Density,
    Invert,
}

#[pymethods]
impl Warp {
    #[new]
    #[pyo3(signature = (name, *, dims=None, angle=None, radius=None, tube=None, height=None, corners=None, values=None, knots=None, columns=None))]
    #[expect(clippy::too_many_arguments, reason = "plain values, by keyword")]
    fn new(
        name: &str,
        dims: Option<usize>,
        angle: Option<f64>,
        radius: Option<f64>,
        tube: Option<f64>,
        height: Option<f64>,
        corners: Option<Vec<[f64; 3]>>,
        values: Option<Vec<f64>>,
        knots: Option<Vec<f64>>,
        columns: Option<usize>,
    ) -> PyResult<Self> {
        let options = Options { dims, angle, radius, tube, height, corners, values, knots, columns };
        let built = warp::build(name, &options);
        Ok(Self { inner: built.map_err(|error| PyValueError::new_err(error.to_string()))? })
    }

    /// Uniform numbers for each point.
    #[getter]
    fn inputs(&self) -> usize {
        self.inner.inputs()
    }

    /// Coordinates of each point.
    #[getter]
    fn outputs(&self) -> usize {
        self.inner.outputs()
    }

    /// Points of rows of uniform numbers.
    fn map(
        &self,
        py: Python<'_>,
        u: &Bound<'_, PyUntypedArray>,
        out: &Bound<'_, PyUntypedArray>,
        workers: NonZeroUsize,
    ) -> PyResult<()> {
        self.run(py, Way::Map, (u, out), workers)
    }

    /// Densities at points.
    fn density(
        &self,
        py: Python<'_>,
        x: &Bound<'_, PyUntypedArray>,
        out: &Bound<'_, PyUntypedArray>,
        workers: NonZeroUsize,
    ) -> PyResult<()> {
        self.run(py, Way::Density, (x, out), workers)
    }

    /// Uniform numbers of points.
    fn invert(
        &self,
        py: Python<'_>,
        x: &Bound<'_, PyUntypedArray>,
        out: &Bound<'_, PyUntypedArray>,
        workers: NonZeroUsize,
    ) -> PyResult<()> {
        self.run(py, Way::Invert, (x, out), workers)
    }
}

type Arrays<'a, 'py> = (&'a Bound<'py, PyUntypedArray>, &'a Bound<'py, PyUntypedArray>);

impl Warp {
    fn run(&self, py: Python<'_>, way: Way, arrays: Arrays<'_, '_>, workers: NonZeroUsize) -> PyResult<()> {
        let (u, x) = (self.inner.inputs(), self.inner.outputs());
        let sizes = match way {
            Way::Map => (u, x),
            Way::Density => (x, 1),
            Way::Invert => (x, u),
        };
        if arrays.0.extract::<PyReadonlyArrayDyn<'_, f32>>().is_ok() {
            apply::<f32>(py, &*self.inner, way, sizes, arrays, workers)
        } else {
            apply::<f64>(py, &*self.inner, way, sizes, arrays, workers)
        }
    }
}

/// Runs a warp in one precision.
fn apply<T: Element + Real>(
    py: Python<'_>,
    rows: &dyn Rows<T>,
    way: Way,
    (from, to): (usize, usize),
    (input, output): Arrays<'_, '_>,
    workers: NonZeroUsize,
) -> PyResult<()> {
    if input.shape().last() != Some(&from) || input.len() / from * to != output.len() {
        let message = format!("arrays of {from} and {to} columns are needed, with as many rows");
        return Err(PyValueError::new_err(message));
    }
    let wrong = |_| PyTypeError::new_err("arrays must be of float64 or float32, both the same");
    let input = input.extract::<PyReadonlyArrayDyn<'_, T>>().map_err(wrong)?;
    let mut output = output.extract::<PyReadwriteArrayDyn<'_, T>>().map_err(wrong)?;
    let (input, output) = (input.as_slice()?, output.as_slice_mut()?);
    let work = |input: &[T], output: &mut [T]| match way {
        Way::Map => rows.map(input, output),
        Way::Density => rows.density(input, output),
        Way::Invert => rows.invert(input, output),
    };
    py.detach(|| in_parts((input, from), (output, to), workers, work));
    Ok(())
}

fn refuse(error: Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Writes points of one triangle from index `start` on.
#[pyfunction]
fn triangle_van_der_corput(
    py: Python<'_>,
    start: u64,
    corners: Vec<f64>,
    scramble: &str,
    seed: u64,
    mut out: PyReadwriteArrayDyn<'_, f64>,
) -> PyResult<()> {
    let build = || VanDerCorput::new(Randomization::named(scramble)?, Seed::new(seed));
    let points = build().map_err(refuse)?;
    let out = out.as_slice_mut()?;
    py.detach(|| points.fill(start, &corners, out));
    Ok(())
}

/// The barycentric coordinates of n points of a turned lattice.
#[pyfunction]
fn triangle_kronecker(
    py: Python<'_>,
    n: usize,
    angle: f64,
    shift: [f64; 2],
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let points = py.detach(|| kronecker::kronecker(n, angle, shift));
    PyArray1::from_vec(py, points.into_flattened()).reshape([n, 3])
}

/// Writes points of a product of triangles from index `start` on.
#[pyfunction]
fn triangle_product(
    py: Python<'_>,
    start: u64,
    corners: PyReadonlyArrayDyn<'_, f64>,
    scramble: &str,
    seed: u64,
    mut out: PyReadwriteArrayDyn<'_, f64>,
) -> PyResult<()> {
    let &[factors, 3, k] = corners.shape() else {
        return Err(PyValueError::new_err("corners must have shape (factors, 3, k)"));
    };
    let build = || Product::new(factors, Randomization::named(scramble)?, Seed::new(seed));
    let points = build().map_err(refuse)?;
    let (corners, out) = (corners.as_slice()?, out.as_slice_mut()?);
    py.detach(|| points.fill(start, k, corners, out));
    Ok(())
}
