//! The extreme discrepancy: the largest local discrepancy over all boxes with sides along the axes, wherever they are.
//!
//! At most 2^d times the star discrepancy, and at least as large. Exact: the sides of all coordinates but the last run over
//! pairs of coordinates of points; in the last a pass over the points finds the worst interval. O(n log n) in one dimension,
//! O(n^{2 d − 1}) in more, so that it is for few points or two dimensions. A pair of sides is left out when the points
//! between them can no longer beat what was found.

use super::Rows;

/// The worst box.
#[derive(Clone, Debug, PartialEq)]
pub struct Extreme {
    /// |points inside / n − volume|.
    pub value: f64,
    /// Where it begins in each coordinate.
    pub lower: Vec<f64>,
    /// Where it ends.
    pub upper: Vec<f64>,
    /// Whether it is closed and has too many points; otherwise it is open and has too few.
    pub closed: bool,
}

/// The extreme discrepancy.
///
/// ```
/// use evenlight_points::quality::{Rows, extreme::extreme_discrepancy};
/// let found = extreme_discrepancy(&Rows::new(&[0.25, 0.75], 1)?);
/// assert_eq!((found.value, found.closed), (0.5, false)); // between the points
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn extreme_discrepancy(rows: &Rows<'_>) -> Extreme {
    let dims = rows.dims();
    let mut search = Search {
        dims,
        n: rows.len() as f64,
        best: Extreme { value: 0.0, lower: vec![0.0; dims], upper: vec![0.0; dims], closed: true },
        sides: vec![[0.0, 1.0]; dims],
    };
    let points: Vec<&[f64]> = {
        let mut points: Vec<_> = rows.iter().collect();
        points.sort_by(|a, b| a[dims - 1].total_cmp(&b[dims - 1]));
        points
    };
    for closed in [false, true] {
        search.sides(&points, 0, 1.0, closed);
    }
    search.best
}

struct Search {
    dims: usize,
    n: f64,
    best: Extreme,
    sides: Vec<[f64; 2]>,
}

impl Search {
    /// Tries all sides of the coordinates from `dim` on; `area` is the volume in those before.
    fn sides(&mut self, points: &[&[f64]], dim: usize, area: f64, closed: bool) {
        let most = if closed { points.len() as f64 / self.n } else { area };
        if most <= self.best.value {
            return;
        }
        if dim + 1 == self.dims {
            return self.interval(points, area, closed);
        }
        let mut lines: Vec<f64> = points.iter().map(|point| point[dim]).collect();
        if !closed {
            lines.extend([0.0, 1.0]);
        }
        lines.sort_unstable_by(f64::total_cmp);
        lines.dedup();
        for (at, &lower) in lines.iter().enumerate() {
            for &upper in lines[at..].iter().rev() {
                if !closed && (upper - lower) * area <= self.best.value {
                    break;
                }
                let between = |point: &&&[f64]| {
                    let x = point[dim];
                    if closed { lower <= x && x <= upper } else { lower < x && x < upper }
                };
                let inside: Vec<_> = points.iter().filter(between).copied().collect();
                if closed && inside.len() as f64 / self.n <= self.best.value {
                    break;
                }
                self.sides[dim] = [lower, upper];
                self.sides(&inside, dim + 1, area * (upper - lower), closed);
            }
        }
    }

    /// The worst interval of the last coordinate, in which the points are sorted.
    fn interval(&mut self, points: &[&[f64]], area: f64, closed: bool) {
        let dim = self.dims - 1;
        let groups =
            points.chunk_by(|a, b| a[dim] == b[dim]).map(|group| (group[0][dim], group.len() as f64));
        if closed {
            // the most of (points up to here − area x) less (points before some x − area x)
            let (mut before, mut start) = ((f64::INFINITY, 0.0), 0.0);
            for (x, count) in groups {
                if start - self.n * area * x < before.0 {
                    before = (start - self.n * area * x, x);
                }
                start += count;
                self.found((start - self.n * area * x - before.0) / self.n, [before.1, x], closed);
            }
        } else {
            let (mut best, mut passed) = ((0.0, 0.0), 0.0);
            for (x, count) in groups.chain([(1.0, 0.0)]) {
                self.found((self.n * area * x - passed - best.0) / self.n, [best.1, x], closed);
                passed += count;
                if self.n * area * x - passed < best.0 {
                    best = (self.n * area * x - passed, x);
                }
            }
        }
    }

    fn found(&mut self, value: f64, last: [f64; 2], closed: bool) {
        if value > self.best.value {
            self.sides[self.dims - 1] = last;
            let (lower, upper) = self.sides.iter().map(|&[lower, upper]| (lower, upper)).unzip();
            self.best = Extreme { value, lower, upper, closed };
        }
    }
}
