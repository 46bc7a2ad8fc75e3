//! Errors of the core as Python exceptions.

use pyo3::PyErr;
use pyo3::exceptions::{PyOSError, PyValueError};

/// `OSError` for files that cannot be read or written, `ValueError` for everything that is not valid.
///
/// With the number of the system's error Python chooses the class, such as `FileNotFoundError`, and writes the message.
pub(crate) fn raise(error: evenlight_render::Error) -> PyErr {
    let evenlight_render::Error::Io { path, source } = &error else {
        return PyValueError::new_err(error.to_string());
    };
    let Some(number) = source.raw_os_error() else {
        return PyOSError::new_err(error.to_string());
    };
    let message = source.to_string();
    let reason = message.trim_end_matches(&format!(" (os error {number})")).to_owned();
    PyOSError::new_err((number, reason, path.clone().into_os_string()))
}
