//! Scenes and films for Python: plain settings in, arrays and plain records out.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use evenlight_render::integrator::{self, Mis};
use evenlight_render::render::{self, Progress, Settings};
use evenlight_render::scene::{Scene, SceneOptions};
use evenlight_render::{film::Film, filter, sampler};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A scene, loaded and ready to be rendered.
#[pyclass(name = "Scene", frozen)]
pub(crate) struct PyScene {
    inner: Arc<Scene>,
}

fn raise(error: evenlight_render::Error) -> PyErr {
    match error {
        evenlight_render::Error::Io { .. } => PyOSError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}
