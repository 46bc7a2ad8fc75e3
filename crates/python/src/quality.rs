//! The door to the measures of quality: arrays of points in, numbers out.

use std::num::NonZeroUsize;

use evenlight_points::Seed;
use evenlight_points::quality::bracketing::Limits;
use evenlight_points::quality::l2::{self, Algorithm, Measure, Request};
use evenlight_points::quality::star::{self, Kind, Method, Settings};
use evenlight_points::quality::threshold_accepting::Effort;
use evenlight_points::quality::triangle::{self, Sets};
use evenlight_points::quality::{self, Rows};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(dispersion, module)?)?;
    module.add_function(wrap_pyfunction!(extreme_discrepancy, module)?)?;
    module.add_function(wrap_pyfunction!(gain_coefficient, module)?)?;
    module.add_function(wrap_pyfunction!(isotropic_discrepancy, module)?)?;
    module.add_function(wrap_pyfunction!(l2_discrepancy, module)?)?;
    module.add_function(wrap_pyfunction!(local_discrepancy, module)?)?;
    module.add_function(wrap_pyfunction!(smallest_t, module)?)?;
    module.add_function(wrap_pyfunction!(star_discrepancy, module)?)?;
    module.add_function(wrap_pyfunction!(star_discrepancy_cost, module)?)?;
    module.add_function(wrap_pyfunction!(t_value, module)?)?;
    module.add_function(wrap_pyfunction!(t_value_in_base, module)?)?;
    module.add_function(wrap_pyfunction!(triangle_discrepancy, module)?)
}

/// Points, one in a row.
type Points<'py> = PyReadonlyArray2<'py, f64>;

fn raise(error: evenlight_points::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// The rows of an array.
fn rows<'a>(x: &'a Points<'_>) -> PyResult<Rows<'a>> {
    Rows::new(x.as_slice()?, x.shape()[1]).map_err(raise)
}

/// Points inside / n − volume for each box.
#[pyfunction]
fn local_discrepancy<'py>(
    py: Python<'py>,
    x: Points<'py>,
    corners: Points<'py>,
    closed: bool,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (x, corners) = (rows(&x)?, rows(&corners)?);
    let found = py.detach(|| quality::local::local_discrepancy(&x, &corners, closed)).map_err(raise)?;
    Ok(found.to_pyarray(py))
}

/// How a star discrepancy is to be found.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct StarSettings {
    method: String,
    trials: u32,
    steps: u32,
    brackets: u64,
    width: f64,
    limit: f64,
    seed: u64,
    workers: NonZeroUsize,
}

/// Value, kind, the worst box's corner, discrepancy and whether it is closed, and the method.
type Star = (f64, &'static str, Vec<f64>, f64, bool, &'static str);

/// Calls Python with the part that is done; an exception, or Ctrl-C, is kept and stops the work.
fn report(py: Python<'_>, progress: Option<&Py<PyAny>>, raised: &mut Option<PyErr>, part: f64) -> bool {
    let told =
        py.check_signals().and_then(|()| progress.map_or(Ok(()), |call| call.call1(py, (part,)).map(drop)));
    *raised = raised.take().or(told.err());
    raised.is_none()
}

/// The star discrepancy, or a bound.
#[pyfunction]
fn star_discrepancy(
    py: Python<'_>,
    x: Points<'_>,
    settings: StarSettings,
    progress: Option<Py<PyAny>>,
) -> PyResult<Star> {
    let x = rows(&x)?;
    let settings = Settings {
        method: Method::named(&settings.method).map_err(raise)?,
        effort: Effort { trials: settings.trials, steps: settings.steps },
        limits: Limits { brackets: settings.brackets, width: settings.width },
        steps: settings.limit,
        seed: Seed::new(settings.seed),
        workers: settings.workers,
    };
    let mut raised = None;
    let found = py.detach(|| {
        let mut tell = |part| Python::attach(|py| report(py, progress.as_ref(), &mut raised, part));
        star::star_discrepancy(&x, &settings, &mut tell)
    });
    if let Some(error) = raised {
        return Err(error);
    }
    let star = found.map_err(raise)?.expect("only an exception stops it");
    let kind = match star.kind {
        Kind::Exact => "exact",
        Kind::Lower => "lower",
        Kind::Upper => "upper",
    };
    Ok((star.value, kind, star.worst.corner, star.worst.value, star.worst.closed, star.method.name()))
}

/// About how many steps the exact star discrepancy takes.
#[pyfunction]
fn star_discrepancy_cost(py: Python<'_>, x: Points<'_>, seed: u64) -> PyResult<f64> {
    let x = rows(&x)?;
    Ok(py.detach(|| star::star_discrepancy_cost(&x, Seed::new(seed))))
}

/// A squared discrepancy of the L2 family.
#[pyfunction]
fn l2_discrepancy(
    py: Python<'_>,
    x: Points<'_>,
    measure: &str,
    weights: Option<Vec<f64>>,
    algorithm: &str,
    workers: NonZeroUsize,
) -> PyResult<f64> {
    let x = rows(&x)?;
    let algorithm = match algorithm {
        "auto" => Algorithm::Auto,
        "pairs" => Algorithm::Pairs,
        "halves" => Algorithm::Halves,
        _ => {
            return Err(PyValueError::new_err(format!(
                "unknown algorithm '{algorithm}'; known: auto, pairs, halves"
            )));
        }
    };
    let measure = Measure::named(measure).map_err(raise)?;
    let request = Request { measure, weights: weights.as_deref(), algorithm, workers };
    py.detach(|| l2::l2_discrepancy(&x, &request)).map_err(raise)
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

/// The worst set of a triangle: its discrepancy, s and t, whether it is closed, and the numbers of two corners.
#[pyfunction]
fn triangle_discrepancy(
    py: Python<'_>,
    barycentric: Points<'_>,
    sets: &str,
) -> PyResult<(f64, Vec<f64>, bool, [usize; 2])> {
    let sets = match sets {
        "parallelograms" => Sets::Parallelograms,
        "trapezoids" => Sets::Trapezoids,
        _ => {
            let message = format!("unknown sets '{sets}'; known: parallelograms, trapezoids");
            return Err(PyValueError::new_err(message));
        }
    };
    let points = barycentric.as_slice()?.as_chunks().0;
    let found = py.detach(|| triangle::triangle_discrepancy(points, sets)).map_err(raise)?;
    Ok((found.worst.value, found.worst.corner, found.worst.closed, found.corners))
}

/// The smallest t such that the points are a net.
#[pyfunction]
fn smallest_t(py: Python<'_>, x: Points<'_>, base: u32) -> PyResult<u32> {
    let x = rows(&x)?;
    py.detach(|| quality::nets::smallest_t(&x, base)).map_err(raise)
}

/// The gain coefficient of one vector of levels.
#[pyfunction]
fn gain_coefficient(py: Python<'_>, x: Points<'_>, levels: Vec<Option<u32>>, base: u32) -> PyResult<f64> {
    let x = rows(&x)?;
    py.detach(|| quality::nets::gain_coefficient(&x, &levels, base)).map_err(raise)
}

/// The volume of the largest empty box, and where it is.
#[pyfunction]
fn dispersion(
    py: Python<'_>,
    x: Points<'_>,
    torus: bool,
    limit: usize,
) -> PyResult<(f64, Vec<f64>, Vec<f64>)> {
    let x = rows(&x)?;
    let found = py.detach(|| quality::dispersion::dispersion(&x, torus, limit)).map_err(raise)?;
    Ok((found.volume, found.lower, found.upper))
}

/// The extreme discrepancy, the box that attains it, and whether that is closed.
#[pyfunction]
fn extreme_discrepancy(py: Python<'_>, x: Points<'_>) -> PyResult<(f64, Vec<f64>, Vec<f64>, bool)> {
    let x = rows(&x)?;
    let found = py.detach(|| quality::extreme::extreme_discrepancy(&x));
    Ok((found.value, found.lower, found.upper, found.closed))
}

/// The discrepancy of the worst convex set that is known, its corners, whether it is closed, and an upper bound.
#[pyfunction]
fn isotropic_discrepancy(
    py: Python<'_>,
    x: Points<'_>,
    sectors: usize,
    workers: NonZeroUsize,
) -> PyResult<(f64, Vec<[f64; 2]>, bool, f64)> {
    let x = rows(&x)?;
    let found =
        py.detach(|| quality::isotropic::isotropic_discrepancy(&x, sectors, workers)).map_err(raise)?;
    Ok((found.worst.value, found.worst.vertices, found.worst.closed, found.upper))
}
