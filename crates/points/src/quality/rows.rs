//! Points to be judged: rows of numbers in [0, 1], checked once.

use crate::Error;

/// Points of the closed unit cube, one after the other.
///
/// ```
/// use evenlight_points::quality::Rows;
/// let rows = Rows::new(&[0.5, 0.25, 0.0, 1.0], 2)?;
/// assert_eq!((rows.len(), rows.dims(), rows.row(1)), (2, 2, &[0.0, 1.0][..]));
/// assert!(Rows::new(&[0.5, 1.25], 2).is_err());
/// # Ok::<(), evenlight_points::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    numbers: &'a [f64],
    dims: usize,
}

impl<'a> Rows<'a> {
    /// Takes `numbers` as rows of `dims`; an error if there is no point, or a number is not in [0, 1].
    pub fn new(numbers: &'a [f64], dims: usize) -> Result<Self, Error> {
        if dims == 0 || numbers.is_empty() || !numbers.len().is_multiple_of(dims) {
            let message = format!("{} numbers are no points of {dims} dimensions", numbers.len());
            return Err(Error::Quality(message));
        }
        if let Some(at) = numbers.iter().position(|x| !(0.0..=1.0).contains(x)) {
            let (row, dim, x) = (at / dims, at % dims, numbers[at]);
            let message = format!("coordinate {dim} of point {row} must be in [0, 1], not {x}");
            return Err(Error::Quality(message));
        }
        if numbers.len() / dims > u32::MAX as usize / 2 {
            return Err(Error::Quality("at most 2^31 points can be judged".into()));
        }
        Ok(Self { numbers, dims })
    }

    /// The number of points, at least 1.
    #[expect(clippy::len_without_is_empty, reason = "there is always a point")]
    pub fn len(&self) -> usize {
        self.numbers.len() / self.dims
    }

    /// The number of coordinates of a point, at least 1.
    pub fn dims(&self) -> usize {
        self.dims
    }

    /// One point.
    pub fn row(&self, index: usize) -> &'a [f64] {
        &self.numbers[index * self.dims..][..self.dims]
    }

    /// All points in order.
    pub fn iter(&self) -> impl Iterator<Item = &'a [f64]> {
        self.numbers.chunks_exact(self.dims)
    }
}
