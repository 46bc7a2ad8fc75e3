//! Dispersion: the volume of the largest box that is empty.
//!
//! Boxes of any place with sides along the axes, open, in the unit cube or on the torus, where they go on at the opposite face. A box with points in it is replaced by the 2 d boxes that
//! its most central point cuts off; the largest box is looked at first, so that the first empty one is the answer, and boxes that
//! were met before are left out. Exact; the number of boxes grows like n^d at worst, so that it is for small d.
//!
//! The problem: A. Naamad, D. Lee and W. Hsu, *On the maximum empty rectangle problem*, Discrete Appl. Math. 8, 1984.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashSet};

use super::Rows;
use crate::Error;

/// The most dimensions.
const MOST_DIMS: usize = 64;

/// The largest empty box.
#[derive(Clone, Debug, PartialEq)]
pub struct Empty {
    /// Its volume.
    pub volume: f64,
    /// Where it begins and ends in each coordinate; on the torus it may end beyond 1.
    pub lower: Vec<f64>,
    /// See [`Empty::lower`].
    pub upper: Vec<f64>,
}

/// A box that may have points, and the points it has.
struct Candidate {
    volume: f64,
    sides: Vec<[f64; 2]>,
    /// The axes along which it goes all around the torus.
    around: u64,
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
/// let empty = dispersion(&Rows::new(&[0.5, 0.25], 2)?, false, 1000)?;
/// assert_eq!((empty.volume, empty.lower, empty.upper), (0.75, vec![0.0, 0.25], vec![1.0, 1.0]));
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn dispersion(rows: &Rows<'_>, torus: bool, limit: usize) -> Result<Empty, Error> {
    if rows.dims() > MOST_DIMS {
        return Err(Error::Quality(format!(
            "points must have 1 to {MOST_DIMS} dimensions, not {}",
            rows.dims()
        )));
    }
    let whole = Candidate {
        volume: 1.0,
        sides: vec![[0.0, 1.0]; rows.dims()],
        around: if torus { u64::MAX >> (64 - rows.dims()) } else { 0 },
        points: (0..rows.len() as u32).collect(),
    };
    let mut heap = BinaryHeap::from([whole]);
    let mut met: HashSet<Vec<u64>> = HashSet::new();
    while let Some(mut candidate) = heap.pop() {
        let points = std::mem::take(&mut candidate.points);
        candidate.points =
            points.into_iter().filter(|&point| candidate.holds(rows.row(point as usize))).collect();
        let Some(pivot) = central(rows, &candidate) else {
            let (lower, upper) = candidate.sides.iter().map(|&[lower, upper]| (lower, upper)).unzip();
            return Ok(Empty { volume: candidate.volume, lower, upper });
        };
        for half in candidate.cut(rows.row(pivot as usize)) {
            if half.volume > 0.0 && met.insert(half.name()) {
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

impl Candidate {
    /// What tells it from all others.
    fn name(&self) -> Vec<u64> {
        let sides = self.sides.iter().flatten().map(|x| x.to_bits());
        sides.chain([self.around]).collect()
    }

    /// The side along an axis with the place of a coordinate on it, unless it goes all around.
    fn side(&self, dim: usize, x: f64) -> Option<(f64, [f64; 2])> {
        let side = self.sides[dim];
        let place = if x < side[0] { x + 1.0 } else { x };
        (self.around >> dim & 1 == 0).then_some((place, side))
    }

    fn holds(&self, row: &[f64]) -> bool {
        let within = |(x, [lower, upper]): (f64, [f64; 2])| lower < x && x < upper;
        row.iter().enumerate().all(|(dim, &x)| self.side(dim, x).is_none_or(within))
    }

    /// The boxes that avoid a point: two for each axis, and one for an axis around the torus.
    fn cut(&self, pivot: &[f64]) -> Vec<Self> {
        let mut found = Vec::with_capacity(2 * pivot.len());
        for (dim, &x) in pivot.iter().enumerate() {
            let sides = match self.side(dim, x) {
                Some((x, [lower, upper])) => vec![[lower, x], [x, upper]],
                None => vec![[x, x + 1.0]],
            };
            for side in sides {
                let mut sides = self.sides.clone();
                sides[dim] = side;
                let volume = sides.iter().map(|[lower, upper]| upper - lower).product();
                let around = self.around & !(1 << dim);
                found.push(Self { volume, sides, around, points: self.points.clone() });
            }
        }
        found
    }
}

/// The point whose best cut is worst: what it cuts off is small.
fn central(rows: &Rows<'_>, candidate: &Candidate) -> Option<u32> {
    let largest_part = |point: u32| {
        let places =
            rows.row(point as usize).iter().enumerate().filter_map(|(dim, &x)| candidate.side(dim, x));
        places.map(|(x, [lower, upper])| (x - lower).max(upper - x) / (upper - lower)).fold(0.0, f64::max)
    };
    candidate.points.iter().copied().min_by(|&a, &b| largest_part(a).total_cmp(&largest_part(b)))
}
