//! Dispersion: the volume of the largest box that is empty.
//!
//! Boxes of any place with sides along the axes, open, in the unit cube. A box with points in it is replaced by the 2 d boxes that
//! its most central point cuts off; the largest box is looked at first, so that the first empty one is the answer, and boxes that
//! were met before are left out. Exact; the number of boxes grows like n^d at worst, so that it is for small d.
//!
//! The problem: A. Naamad, D. Lee and W. Hsu, *On the maximum empty rectangle problem*, Discrete Appl. Math. 8, 1984.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashSet};

use super::Rows;
use crate::Error;

/// The largest empty box.
#[derive(Clone, Debug, PartialEq)]
pub struct Empty {
    /// Its volume.
    pub volume: f64,
    /// Where it begins and ends in each coordinate.
    pub lower: Vec<f64>,
    /// See [`Empty::lower`].
    pub upper: Vec<f64>,
}

/// A box that may have points, and the points it has.
struct Candidate {
    volume: f64,
    sides: Vec<[f64; 2]>,
    points: Vec<u32>,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let sides = |candidate: &Self| candidate.sides.concat();
        self.volume
            .total_cmp(&other.volume)
            .then_with(|| sides(other).partial_cmp(&sides(self)).expect("coordinates are numbers"))
    }
}

/// The largest empty box; an error if more than `limit` boxes would have to be looked at.
///
/// ```
/// use evenlight_points::quality::{Rows, dispersion::dispersion};
/// let empty = dispersion(&Rows::new(&[0.5, 0.25], 2)?, 1000)?;
/// assert_eq!((empty.volume, empty.lower, empty.upper), (0.75, vec![0.0, 0.25], vec![1.0, 1.0]));
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn dispersion(rows: &Rows<'_>, limit: usize) -> Result<Empty, Error> {
    let whole = Candidate {
        volume: 1.0,
        sides: vec![[0.0, 1.0]; rows.dims()],
        points: (0..rows.len() as u32).collect(),
    };
    let mut heap = BinaryHeap::from([whole]);
    let mut met: HashSet<Vec<u64>> = HashSet::new();
    while let Some(mut candidate) = heap.pop() {
        candidate.points.retain(|&point| inside(rows.row(point as usize), &candidate.sides));
        let Some(pivot) = central(rows, &candidate) else {
            let (lower, upper) = candidate.sides.iter().map(|&[lower, upper]| (lower, upper)).unzip();
            return Ok(Empty { volume: candidate.volume, lower, upper });
        };
        for half in halves(rows.row(pivot as usize), &candidate) {
            if half.volume > 0.0 && met.insert(half.sides.iter().flatten().map(|x| x.to_bits()).collect()) {
                heap.push(half);
            }
        }
        if met.len() > limit {
            let message =
                format!("more than {limit} boxes to look at for the largest empty one; raise the limit");
            return Err(Error::Quality(message));
        }
    }
    // every box with a point on each of its places has no volume left
    Ok(Empty { volume: 0.0, lower: vec![0.0; rows.dims()], upper: vec![0.0; rows.dims()] })
}

fn inside(row: &[f64], sides: &[[f64; 2]]) -> bool {
    row.iter().zip(sides).all(|(x, [lower, upper])| lower < x && x < upper)
}

/// The point whose best cut is worst: what it cuts off is small.
fn central(rows: &Rows<'_>, candidate: &Candidate) -> Option<u32> {
    let largest_part = |point: u32| {
        let parts = rows.row(point as usize).iter().zip(&candidate.sides);
        parts.map(|(x, [lower, upper])| (x - lower).max(upper - x) / (upper - lower)).fold(0.0, f64::max)
    };
    candidate.points.iter().copied().min_by(|&a, &b| largest_part(a).total_cmp(&largest_part(b)))
}

/// The 2 d boxes that avoid a point.
fn halves(pivot: &[f64], candidate: &Candidate) -> Vec<Candidate> {
    let mut found = Vec::with_capacity(2 * pivot.len());
    for (dim, &x) in pivot.iter().enumerate() {
        for side in 0..2 {
            let mut sides = candidate.sides.clone();
            sides[dim][1 - side] = x;
            let volume = sides.iter().map(|[lower, upper]| upper - lower).product();
            found.push(Candidate { volume, sides, points: candidate.points.clone() });
        }
    }
    found
}
