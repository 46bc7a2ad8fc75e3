//! The door to the renderer: plain settings in, arrays and plain records out.

use std::path::PathBuf;
use std::sync::Arc;

use evenlight_render::bounces;
use evenlight_render::film::Film;
use evenlight_render::integrator::{Mis, Roulette};
use evenlight_render::render::{self as engine, Progress, Settings};
use evenlight_render::scene::{Scene as Inner, SceneOptions, mitsuba};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::raise;

/// Adds this room to the extension module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Scene>()?;
    module.add_function(wrap_pyfunction!(load_scene, module)?)?;
    module.add_function(wrap_pyfunction!(render, module)?)?;
    module.add_function(wrap_pyfunction!(measure_bounces, module)?)
}

/// A scene, loaded and ready to be rendered.
#[pyclass(frozen, module = "evenlight._core")]
struct Scene {
    inner: Arc<Inner>,
}

#[pymethods]
impl Scene {
    /// What was found wrong and replaced, when loaded leniently.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.inner.warnings.clone()
    }

    /// Counts and settings of the scene.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (scene, info) = (&self.inner, PyDict::new(py));
        info.set_item("size", scene.film.size)?;
        info.set_item("filter", scene.film.filter.name)?;
        info.set_item("max_depth", signed_depth(scene.transport.max_depth))?;
        info.set_item("rr_depth", scene.transport.rr_depth)?;
        info.set_item("shapes", scene.world.shape_count())?;
        info.set_item("triangles", scene.world.triangle_count())?;
        info.set_item("emitters", scene.emitters.len())?;
        info.set_item("kernel", scene.world.kernel_name())?;
        Ok(info)
    }
}

/// Path lengths are −1 in Python where there is no limit.
fn signed_depth(depth: u32) -> i64 {
    if depth == u32::MAX { -1 } else { depth.into() }
}

#[pyfunction]
fn load_scene(
    py: Python<'_>,
    path: PathBuf,
    parameters: std::collections::BTreeMap<String, String>,
    lenient: bool,
    allow_outside: bool,
    embree_library: Option<PathBuf>,
    kernel: &str,
) -> PyResult<Scene> {
    let files = mitsuba::LoadOptions { parameters, allow_outside };
    let kernel = kernel.parse().map_err(raise)?;
    let options = SceneOptions { lenient, kernel, embree_library };
    let load = || Inner::build(&*mitsuba::load(&path, &files)?, &options);
    Ok(Scene { inner: Arc::new(py.detach(load).map_err(raise)?) })
}

/// Settings by their Python names; all must be given.
fn settings_from(given: &Bound<'_, PyDict>) -> PyResult<Settings> {
    let get = |name: &str| given.as_any().get_item(name);
    let limit: Option<i64> = get("max_depth")?.extract()?;
    let no_limit = |depth: i64| if depth == -1 { Ok(u32::MAX) } else { u32::try_from(depth) };
    let refuse =
        |_| pyo3::exceptions::PyValueError::new_err("max_depth must be -1 (no limit) or not negative");
    Ok(Settings {
        integrator: get("integrator")?.extract()?,
        sampler: get("sampler")?.extract()?,
        spp: get("spp")?.extract()?,
        replicates: get("replicates")?.extract()?,
        seed: get("seed")?.extract()?,
        threads: get("threads")?.extract::<Option<usize>>()?.unwrap_or(0),
        max_depth: limit.map(no_limit).transpose().map_err(refuse)?,
        filter: get("filter")?.extract()?,
        size: get("size")?.extract()?,
        mis: Mis::by_name(&get("mis")?.extract::<String>()?).map_err(raise)?,
        roulette: roulette_from(&get("roulette")?)?,
    })
}

/// A name or survival probabilities.
fn roulette_from(given: &Bound<'_, PyAny>) -> PyResult<Roulette> {
    match given.extract::<String>() {
        Ok(name) => Roulette::by_name(&name),
        Err(_) => Roulette::with_survival(&given.extract::<Vec<f64>>()?),
    }
    .map_err(raise)
}

/// Render; the callback is told about ten times a second how far it is. An interrupt stops cleanly, with what there is.
#[pyfunction]
fn render<'py>(
    py: Python<'py>,
    scene: &Scene,
    settings: &Bound<'py, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let settings = settings_from(settings)?;
    let start = std::time::Instant::now();
    let mut raised = None;
    let mut samples = 0;
    let mut go_on = |report: Progress<'_>| {
        samples = report.samples;
        let told = Python::attach(|py| tell(py, &report, progress.as_ref()));
        raised = raised.take().or(told.err());
        raised.is_none()
    };
    let film = py.detach(|| engine::render(&scene.inner, &settings, &mut go_on)).map_err(raise)?;
    let partial = raised.is_some();
    if let Some(error) =
        raised.filter(|error| !error.is_instance_of::<pyo3::exceptions::PyKeyboardInterrupt>(py))
    {
        return Err(error);
    }
    let metadata = PyDict::new(py);
    metadata.set_item("samples", samples)?;
    metadata.set_item("seconds", start.elapsed().as_secs_f64())?;
    metadata.set_item("kernel", scene.inner.world.kernel_name())?;
    metadata.set_item("size", [film.width, film.height])?;
    metadata.set_item("filter", settings.filter.as_deref().unwrap_or(scene.inner.film.filter.name))?;
    let depth = settings.max_depth.unwrap_or(scene.inner.transport.max_depth);
    metadata.set_item("max_depth", signed_depth(depth))?;
    let result = arrays(py, film)?;
    result.set_item("metadata", metadata)?;
    result.set_item("partial", partial)?;
    Ok(result)
}

/// Statistics of the bounces, one number for each; the roulette of the settings is ignored. An interrupt raises.
#[pyfunction]
fn measure_bounces<'py>(
    py: Python<'py>,
    scene: &Scene,
    settings: &Bound<'py, PyDict>,
    images: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let settings = settings_from(settings)?;
    let mut raised = None;
    let mut go_on = |_| {
        raised = raised.take().or(Python::attach(see_signals).err());
        raised.is_none()
    };
    let measured =
        py.detach(|| bounces::measure(&scene.inner, &settings, images, &mut go_on)).map_err(raise)?;
    let Some(measured) = measured else {
        return Err(raised.unwrap_or_else(|| pyo3::exceptions::PyKeyboardInterrupt::new_err(())));
    };
    let result = PyDict::new(py);
    let [width, height] = measured.size.map(|n| n as usize);
    if images {
        let shape = [measured.mean.len(), height, width, 3];
        result
            .set_item("images", PyArray1::from_vec(py, measured.images.into_flattened()).reshape(shape)?)?;
    }
    for (name, numbers) in [
        ("mean", measured.mean),
        ("mean_square", measured.mean_square),
        ("tail_mean_square", measured.tail_mean_square),
        ("alive", measured.alive),
        ("rays", measured.rays),
    ] {
        result.set_item(name, PyArray1::from_vec(py, numbers))?;
    }
    Ok(result)
}

/// Let Python see signals.
fn see_signals(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// Let Python see signals, and the callback the progress.
fn tell(py: Python<'_>, report: &Progress<'_>, callback: Option<&Py<PyAny>>) -> PyResult<()> {
    see_signals(py)?;
    let Some(callback) = callback else { return Ok(()) };
    let record = PyDict::new(py);
    record.set_item("done", report.samples)?;
    record.set_item("total", report.total)?;
    record.set_item("relative_error", report.film.mean_relative_error())?;
    callback.call1(py, (record,)).map(drop)
}

/// The film's images as arrays of float32.
fn arrays(py: Python<'_>, film: Film) -> PyResult<Bound<'_, PyDict>> {
    let Film { width, height, replicates, colors, albedo, normal, depth, .. } = film;
    let (width, height, replicates) = (width as usize, height as usize, replicates as usize);
    let colored = |pixels: Vec<[f32; 3]>| PyArray1::from_vec(py, pixels.into_flattened());
    let result = PyDict::new(py);
    result.set_item("replicates", colored(colors).reshape([replicates, height, width, 3])?)?;
    result.set_item("albedo", colored(albedo).reshape([height, width, 3])?)?;
    result.set_item("normal", colored(normal).reshape([height, width, 3])?)?;
    result.set_item("depth", PyArray1::from_vec(py, depth).reshape([height, width])?)?;
    Ok(result)
}
