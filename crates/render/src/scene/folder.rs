//! Where the files of a scene may be: relative names are looked up here, and nothing outside of the scene's folder is
//! read unless that is allowed.
//!
//! A scene is data from somebody else. Without this fence a downloaded file could make a render read anything its user
//! can read. All file names in a scene go through [`Folder::resolve`], and all contents through `read`.

use std::fs;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use crate::{Error, Result};

/// The folders of one scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folder {
    root: PathBuf,
    search: Vec<PathBuf>,
    allow_outside: bool,
}

/// The current folder, for scenes that come from no file.
impl Default for Folder {
    fn default() -> Self {
        Self::new(".", false)
    }
}

impl Folder {
    /// The folder of the scene file. Unless `allow_outside`, only files below it may be named.
    pub fn new(root: impl Into<PathBuf>, allow_outside: bool) -> Self {
        let root = root.into();
        let root = if root.as_os_str().is_empty() { PathBuf::from(".") } else { root };
        Self { search: vec![root.clone()], root, allow_outside }
    }

    /// The folder of the scene file.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Look in `folder` first. It must have been resolved.
    pub(crate) fn prepend(&mut self, folder: PathBuf) {
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
        self.search.retain(|known| *known != folder);
        self.search.insert(0, folder);
    }

    /// The first place where `given` exists, else where it would be in the scene's folder. The error says why a place
    /// is out of bounds; the caller knows the line to blame.
    pub fn resolve(&self, given: &str) -> std::result::Result<PathBuf, String> {
        if given.is_empty() || given.contains('\0') {
            return Err(format!("'{}' is not a file name", given.escape_debug()));
        }
        let places = self.search.iter().map(|folder| folder.join(given));
        let found = places.into_iter().find(|place| place.exists()).unwrap_or_else(|| self.root.join(given));
        if !self.allow_outside && !self.contains(&found) {
            return Err(format!(
                "'{given}' lies outside of the scene's folder {}; allow this for scenes you trust",
                self.root.display()
            ));
        }
        Ok(found)
    }

    /// Whether a file is below the root when all links are followed. A file that does not exist is judged by its name.
    fn contains(&self, file: &Path) -> bool {
        let Ok(root) = self.root.canonicalize() else { return false };
        if let Ok(real) = file.canonicalize() {
            return real.starts_with(&root);
        }
        let below = file.strip_prefix(&self.root).or_else(|_| file.strip_prefix(&root));
        below.is_ok_and(|rest| rest.components().all(|part| matches!(part, Component::Normal(_))))
    }
}

/// All bytes of a regular file of at most `limit` bytes. Devices and pipes, which may never end, are refused.
pub(crate) fn read(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let io = |source| Error::Io { path: path.to_owned(), source };
    let metadata = fs::metadata(path).map_err(io)?;
    if !metadata.is_file() {
        return Err(Error::file(path, "not a regular file"));
    }
    let too_large = || Error::file(path, format_args!("larger than {} MiB", limit >> 20));
    if metadata.len() > limit {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(metadata.len() as usize);
    // The file may grow between the two calls.
    fs::File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)).map_err(io)?;
    if bytes.len() as u64 > limit { Err(too_large()) } else { Ok(bytes) }
}
