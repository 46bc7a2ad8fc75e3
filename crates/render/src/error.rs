//! One error type for the crate: what was asked, what is allowed, and where.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A place in a scene file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Location {
    /// The file, as it was opened.
    pub file: Arc<PathBuf>,
    /// The line, counted from 1; 0 when the whole file is meant.
    pub line: u32,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}", self.file.display()),
            line => write!(f, "{}:{line}", self.file.display()),
        }
    }
}

/// All that can go wrong while a scene is loaded, settings are checked or an image is written.
/// Rendering itself cannot fail.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene description is not valid, or asks for what is not known here.
    #[error("{location}: {message}")]
    Scene {
        /// Where the culprit stands.
        location: Location,
        /// What was asked and what is allowed.
        message: String,
    },
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A mesh, an image or a table is not valid.
    #[error("{}: {message}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
    /// A render setting is out of its range.
    #[error("{0}")]
    Settings(String),
}

impl Error {
    /// An error in the contents of a file.
    pub(crate) fn file(path: &Path, message: impl fmt::Display) -> Self {
        Self::File { path: path.to_owned(), message: message.to_string() }
    }
}

/// The result of everything that can fail in this crate.
pub type Result<T> = std::result::Result<T, Error>;
