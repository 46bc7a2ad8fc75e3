//! The isotropic discrepancy: the largest local discrepancy over all convex sets, in the square.
//!
//! J is the largest |points inside / n − area| over all convex parts of [0, 1]² (E. Hlawka 1964; H. Niederreiter, *Random Number
//! Generation and Quasi-Monte Carlo Methods*, 1992, chapter 2). It does not depend on the axes, bounds the errors of integrals
//! over convex regions, and is far larger than the star discrepancy D: D ≤ J ≤ 8 √D.
//!
//! | which sets | kind | cost |
//! |---|---|---|
//! | `fullest`: too many points | exact | O(n^3) |
//! | `emptiest`: too few | between bounds | O(n^3 sectors^2) for each halving of what is open |
//!
//! So the answer is exact where too many points are worse for sure, and otherwise between two bounds, which more sectors
//! bring together.

mod ascent;
mod chains;
mod emptiest;
mod fullest;
mod pieces;
mod polygon;
mod sectors;

use std::num::NonZeroUsize;

use self::polygon::{Cloud, Point};
use super::Rows;
use crate::Error;

/// A convex polygon and its local discrepancy.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    /// |points inside / n − area|.
    pub value: f64,
    /// Its corners counterclockwise; one or two are a point or a line segment.
    pub vertices: Vec<Point>,
    /// Whether it is closed and has too many points; otherwise it is open and has too few.
    pub closed: bool,
}

/// The isotropic discrepancy is at least that of the worst set that is known, and at most `upper`; exact if these are equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Isotropic {
    /// The worst set that is known.
    pub worst: Convex,
    /// At least the isotropic discrepancy.
    pub upper: f64,
}

/// The most points.
pub const MOST_POINTS: usize = 1024;

/// The most numbers that are kept for pieces of polygons: half a gigabyte.
const MOST_PIECES: usize = 1 << 26;

/// Bounds for the isotropic discrepancy; `sectors` is a power of 2, at least 8.
///
/// ```
/// use evenlight_points::quality::{Rows, isotropic::isotropic_discrepancy};
/// let middle = Rows::new(&[0.5, 0.5], 2)?;
/// let found = isotropic_discrepancy(&middle, 16, std::num::NonZero::<usize>::MIN)?;
/// assert_eq!((found.worst.value, found.upper), (1.0, 1.0)); // the point itself has no area
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// If the points are not in two dimensions, or there are too many of them or of the sectors.
pub fn isotropic_discrepancy(
    rows: &Rows<'_>,
    sectors: usize,
    workers: NonZeroUsize,
) -> Result<Isotropic, Error> {
    let (n, dims) = (rows.len(), rows.dims());
    if dims != 2 {
        return Err(Error::Quality(format!("the isotropic discrepancy is for 2 dimensions, not {dims}")));
    }
    if n > MOST_POINTS {
        return Err(Error::Quality(format!(
            "the isotropic discrepancy is for at most {MOST_POINTS} points, not {n}"
        )));
    }
    if !(sectors.is_power_of_two() && (8..=4096).contains(&sectors)) {
        return Err(Error::Quality(format!("sectors must be a power of 2 from 8 to 4096, not {sectors}")));
    }
    let pieces = n * n * (sectors / 2 + 1) * (sectors / 2 + 2) / 2;
    if pieces > MOST_PIECES {
        return Err(Error::Quality(format!(
            "{sectors} sectors for {n} points need {pieces} pieces; at most {MOST_PIECES} are possible: take fewer sectors"
        )));
    }
    let cloud = Cloud::new(rows);
    let full = fullest::fullest(&cloud, workers);
    let empty = emptiest::emptiest(&cloud, sectors, full.value, workers);
    let worst = if empty.lower.value > full.value { empty.lower } else { full };
    Ok(Isotropic { upper: empty.upper.clamp(worst.value, 1.0), worst })
}
