//! Pictures on disk: multi-layer OpenEXR for numbers, PNG for eyes.
//!
//! Every writer is atomic: bytes go to a temporary name in the folder of the target, reach the disk, and only then
//! take the target's name. An interrupted run leaves the old file or none, never half a file.

mod exr;
mod png;

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

pub use self::exr::write_exr;
pub use self::png::write_png;
use crate::{Error, Result};

/// One named group of channels of an image.
#[derive(Clone, Copy, Debug)]
pub struct Layer<'a> {
    /// What the numbers are: `color`, `standard_error`, `albedo`, `normal`, `depth`, …
    pub name: &'a str,
    /// The names of the channels: `["R", "G", "B"]`, `["X", "Y", "Z"]` or `["Z"]`.
    pub channels: &'a [&'a str],
    /// `height × width × channels` numbers, the top row first, channels innermost.
    pub pixels: &'a [f32],
}

/// The size of an image in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Size {
    /// Refuses `pixels` that are not `height × width × channels` numbers.
    fn check(self, name: &str, channels: usize, pixels: usize) -> Result<()> {
        let expected = self.width.checked_mul(self.height).and_then(|area| area.checked_mul(channels));
        if pixels == 0 || expected != Some(pixels) {
            let Self { width, height } = self;
            let message = format!(
                "layer '{name}': {pixels} numbers for {width} × {height} pixels of {channels} channels; \
                 the product of the three, at least 1, is allowed"
            );
            return Err(Error::Settings(message));
        }
        Ok(())
    }
}

/// Finds out before a long render whether `path` can be written, by making and removing a temporary file beside it.
pub fn check_writable(path: &Path) -> Result<()> {
    Replacement::begin(path).map(drop).map_err(|source| io_error(path, source))
}

/// Writes a file in one step: `fill` gets a buffered file, which takes the name `path` when all of it is on disk.
pub fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result<()> {
    let write = || {
        let replacement = Replacement::begin(path)?;
        let mut buffer = BufWriter::new(&replacement.file);
        fill(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        replacement.finish()
    };
    write().map_err(|source| io_error(path, source))
}

fn io_error(path: &Path, source: io::Error) -> Error {
    Error::Io { path: path.to_owned(), source }
}

/// A temporary file that takes the place of `target` when finished, and vanishes when dropped before.
struct Replacement {
    file: File,
    temporary: PathBuf,
    target: PathBuf,
}

impl Replacement {
    fn begin(path: &Path) -> io::Result<Self> {
        static COUNTER: AtomicU64 = AtomicU64::new(0);
        // A link keeps pointing where it points: what it points at is replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        if fs::metadata(&target).is_ok_and(|what| !what.is_file()) {
            return Err(io::Error::other("exists and is not a regular file"));
        }
        let named = !path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
        let Some(name) = target.file_name().filter(|_| named) else {
            return Err(io::Error::other("is not the name of a file"));
        };
        let count = COUNTER.fetch_add(1, Ordering::Relaxed);
        let hidden = format!(".{}.{}-{count}.tmp", name.to_string_lossy(), std::process::id());
        let temporary = target.with_file_name(hidden);
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary)?;
        Ok(Self { file, temporary, target })
    }

    fn finish(self) -> io::Result<()> {
        self.file.sync_all()?;
        fs::rename(&self.temporary, &self.target)?;
        // The new name itself should survive a power cut too; not every file system can promise it.
        let folder = self.target.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Ok(folder) = File::open(folder.unwrap_or(Path::new("."))) {
            folder.sync_all().ok();
        }
        Ok(())
    }
}

impl Drop for Replacement {
    fn drop(&mut self) {
        // After `finish` there is nothing left under this name.
        fs::remove_file(&self.temporary).ok();
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A folder of its own for each test, removed afterwards.
    pub(crate) struct Folder(pub(crate) PathBuf);

    impl Folder {
        pub(crate) fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("evenlight-{name}-{}", std::process::id()));
            fs::create_dir_all(&path).expect("the temporary folder is writable");
            Self(path)
        }

        pub(crate) fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).expect("the folder exists");
            entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            fs::remove_dir_all(&self.0).ok();
        }
    }

    #[test]
    fn a_failed_write_keeps_the_old_file_and_leaves_no_other() {
        let folder = Folder::new("atomic");
        let path = folder.0.join("a.bin");
        write_atomically(&path, |file| file.write_all(b"old")).expect("writable");
        let failed = write_atomically(&path, |file| {
            file.write_all(b"half of the ne")?;
            Err(io::Error::other("disk full"))
        });
        assert!(failed.expect_err("the error comes back").to_string().contains("disk full"));
        assert_eq!(fs::read(&path).expect("still there"), b"old");
        assert_eq!(folder.names(), ["a.bin"]);
    }

    #[test]
    fn a_new_file_replaces_the_old_one() {
        let folder = Folder::new("replace");
        let path = folder.0.join("a.bin");
        for content in [b"first!".as_slice(), b"second"] {
            write_atomically(&path, |file| file.write_all(content)).expect("writable");
            assert_eq!(fs::read(&path).expect("written"), content);
        }
        assert_eq!(folder.names(), ["a.bin"]);
    }

    #[test]
    fn unwritable_places_are_found_before_work() {
        let folder = Folder::new("check");
        let missing = folder.0.join("no/such/folder/a.exr");
        let message = check_writable(&missing).expect_err("no folder").to_string();
        assert!(message.contains("no/such/folder/a.exr"), "{message}");
        assert!(check_writable(&folder.0).is_err(), "a folder is not a file");
        assert!(check_writable(&folder.0.join("a.exr/")).is_err(), "nor is what would have to be one");
        check_writable(&folder.0.join("a.exr")).expect("this one is fine");
        assert!(folder.names().is_empty(), "checking leaves nothing behind");
    }

    #[cfg(unix)]
    #[test]
    fn links_survive_and_devices_are_refused() {
        let folder = Folder::new("link");
        let (target, link) = (folder.0.join("target"), folder.0.join("link"));
        fs::write(&target, b"old").expect("writable");
        std::os::unix::fs::symlink(&target, &link).expect("links work here");
        write_atomically(&link, |file| file.write_all(b"new")).expect("writable");
        assert!(fs::symlink_metadata(&link).expect("still there").is_symlink());
        assert_eq!(fs::read(&target).expect("written"), b"new");
        assert!(check_writable(Path::new("/dev/null")).is_err());
    }
}
