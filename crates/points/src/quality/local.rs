//! The local discrepancy: by how much a box has too many points.
//!
//! For the anchored box [0, c) it is (points inside) / n − volume: positive where there are too many points. O(n d)
//! for each box.

use super::Rows;
use crate::Error;

/// The points in [0, `corner`), or in [0, `corner`] if `closed`.
pub(super) fn count(rows: &Rows<'_>, corner: &[f64], closed: bool) -> usize {
    let inside = |row: &&[f64]| row.iter().zip(corner).all(|(x, c)| if closed { x <= c } else { x < c });
    rows.iter().filter(inside).count()
}

/// (points inside) / n − volume, for each of the boxes from the origin to a row of `corners`.
///
/// ```
/// use evenlight_points::quality::{Rows, local::local_discrepancy};
/// let rows = Rows::new(&[0.1, 0.1, 0.5, 0.5, 0.9, 0.9], 2)?;
/// let corners = Rows::new(&[0.5, 0.5], 2)?;
/// assert_eq!(local_discrepancy(&rows, &corners, false)?, [1.0 / 3.0 - 0.25]);
/// assert_eq!(local_discrepancy(&rows, &corners, true)?, [2.0 / 3.0 - 0.25]);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn local_discrepancy(rows: &Rows<'_>, corners: &Rows<'_>, closed: bool) -> Result<Vec<f64>, Error> {
    if rows.dims() != corners.dims() {
        let message = format!("boxes of {} dimensions for points of {}", corners.dims(), rows.dims());
        return Err(Error::Quality(message));
    }
    let n = rows.len() as f64;
    let one = |corner: &[f64]| count(rows, corner, closed) as f64 / n - corner.iter().product::<f64>();
    Ok(corners.iter().map(one).collect())
}
