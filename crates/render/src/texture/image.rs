//! Images read from files: PNG, JPEG, BMP, TGA, Radiance HDR and OpenEXR.

use std::path::Path;

use crate::Result;

/// A decoded image in linear RGB (or raw values), top row first.
pub struct Image {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row-major RGB.
    pub pixels: Vec<[f32; 3]>,
}

impl Image {
    /// Decode a file; `raw` keeps 8- and 16-bit values as they are, else they are taken as sRGB and made linear.
    pub fn read(path: &Path, raw: bool) -> Result<Self> {
        let _ = (path, raw);
        Err(crate::Error::Settings("images are not read yet".into()))
    }
}
