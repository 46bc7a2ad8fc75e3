//! The square to an image as a density on the square: a row by its sum, then a pixel of the row, then a place in the pixel.
//!
//! For environment maps and textures. The first number goes along rows and the second across them, both monotone. Rows of a map by latitude
//! need the sine of the latitude as a factor, so that the density is that of directions.

use super::steps::Steps;
use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "image",
    cite: "M. Pharr, W. Jakob and G. Humphreys, Physically based rendering, 4th edition, appendix A.5 (2023)",
    takes: &["values", "columns"],
    folds: false,
    build: |options| Ok(Box::new(Fixed::<_, 2, 2>(Image::new(options.values.as_deref(), options.columns)?))),
};

/// An image on the unit square: x along its rows, y down its columns.
#[derive(Clone, Debug)]
pub struct Image {
    rows: Steps,
    pixels: Vec<Steps>,
}

impl Image {
    /// Rows of `columns` densities, up to a factor.
    ///
    /// # Errors
    /// If a density is negative, all are 0, or they do not make whole rows.
    pub fn new(values: Option<&[f64]>, columns: Option<usize>) -> Result<Self, Error> {
        let values = options::weights("image", values)?;
        let allowed = "a divisor of the number of values";
        let columns = columns.ok_or_else(|| options::missing("image", "columns", allowed))?;
        if columns == 0 || !values.len().is_multiple_of(columns) {
            return Err(options::refused("image", "columns", columns, allowed));
        }
        let rows = values.chunks(columns);
        let sums: Vec<_> = rows.clone().map(|row| row.iter().sum()).collect();
        Ok(Self {
            rows: Steps::new(sums.into_iter()),
            pixels: rows.map(|row| Steps::new(row.iter().copied())).collect(),
        })
    }

    /// The row or column of a coordinate, and how far within it the coordinate is.
    fn place(count: usize, x: f64) -> (usize, f64) {
        let at = x * count as f64;
        let step = (at.max(0.0) as usize).min(count - 1);
        (step, (at - step as f64).clamp(0.0, 1.0))
    }
}

impl<T: Real> Warp<T, 2> for Image {
    type Point = [T; 2];

    fn map(&self, [u, v]: [T; 2]) -> [T; 2] {
        let (row, down) = self.rows.find(v.wide());
        let pixels = &self.pixels[row];
        let (column, along) = pixels.find(u.wide());
        let place = |step: usize, within: f64, count: usize| {
            T::under((step as f64 + within) / count as f64, (step + 1) as f64 / count as f64)
        };
        [place(column, along, pixels.len()), place(row, down, self.rows.len())]
    }

    fn density(&self, x: &[T; 2]) -> T {
        let [x, y] = x.map(T::wide);
        if !((0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y)) {
            return T::of(0.0);
        }
        let (row, _) = Self::place(self.rows.len(), y);
        let pixels = &self.pixels[row];
        let (column, _) = Self::place(pixels.len(), x);
        let count = (self.rows.len() * pixels.len()) as f64;
        T::of(self.rows.size(row) * pixels.size(column) * count)
    }

    fn invert(&self, x: &[T; 2]) -> [T; 2] {
        let [x, y] = x.map(T::wide);
        let (row, down) = Self::place(self.rows.len(), y);
        let pixels = &self.pixels[row];
        let (column, along) = Self::place(pixels.len(), x);
        [pixels.number(column, along), self.rows.number(row, down)].map(T::of)
    }
}
