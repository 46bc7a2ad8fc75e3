//! Errors of the core as Python exceptions.

use pyo3::PyErr;
use pyo3::exceptions::{PyOSError, PyValueError};

/// `OSError` for files that cannot be read or written, `ValueError` for everything that is not valid.
pub(crate) fn raise(error: evenlight_render::Error) -> PyErr {
    match error {
        evenlight_render::Error::Io { .. } => PyOSError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}
