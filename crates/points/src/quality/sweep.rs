//! The largest local discrepancy in one and two dimensions, exactly, by a sweep.
//!
//! In one dimension: sort, O(n log n). In two, s sweeps over the first coordinates while a kinetic tree keeps, for every
//! candidate t of the second, the points in {p < s, q < t}; the worst t is always on top. O(n log² n) time, O(n) memory; the
//! classical algorithms (P. Bundschuh and Y. Zhu, *A method for exact calculation of the discrepancy of low-dimensional
//! finite point sets I*, Abh. Math. Sem. Univ. Hamburg 63, 1993) take O(n²).
//!
//! The same sweep serves every family of sets whose area is linear in s up to what all t have in common.

use super::kinetic::Kinetic;
use super::{Rows, local};

/// The largest local discrepancy that was found, and the set that attains it.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremum {
    /// |points inside / n − volume|.
    pub value: f64,
    /// The upper corner of the set.
    pub corner: Vec<f64>,
    /// Whether the set is closed and has too many points; otherwise it is open and has too few.
    pub closed: bool,
}

impl Extremum {
    /// Nothing yet: less than any set can attain.
    pub(super) fn none(dims: usize) -> Self {
        Self { value: f64::NEG_INFINITY, corner: vec![1.0; dims], closed: false }
    }

    /// The larger of the two, this one if they are equal.
    #[must_use]
    pub(super) fn or(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }

    /// The discrepancy of one box of its own, by counting.
    pub(super) fn at(rows: &Rows<'_>, corner: Vec<f64>, closed: bool) -> Self {
        let surplus = local::count(rows, &corner, closed) as f64 / rows.len() as f64 - volume(&corner);
        Self { value: if closed { surplus } else { -surplus }, corner, closed }
    }
}

/// The volume of the box from the origin to `corner`.
pub(super) fn volume(corner: &[f64]) -> f64 {
    corner.iter().product()
}

/// Sets {p < s, q < t} of two coordinates, with s and t in [0, 1].
pub(super) trait Family {
    /// The area of a set in units of the whole; it grows with s and with t.
    fn area(s: f64, t: f64) -> f64;
    /// The area's slope in s, up to what is the same for all t that have not yet turned.
    fn slope(t: f64) -> f64;
    /// The s from which on the area is [`Family::rest`], up to what is the same for all t that have turned.
    fn turns(t: f64) -> f64;
    /// See [`Family::turns`].
    fn rest(t: f64) -> f64;
}

/// Boxes in the unit square.
pub(super) struct Boxes;

impl Family for Boxes {
    fn area(s: f64, t: f64) -> f64 {
        s * t
    }
    fn slope(t: f64) -> f64 {
        t
    }
    fn turns(_: f64) -> f64 {
        f64::INFINITY
    }
    fn rest(_: f64) -> f64 {
        0.0
    }
}

/// The star discrepancy in one dimension.
pub(super) fn one(rows: &Rows<'_>) -> Extremum {
    let mut x: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    x.sort_unstable_by(f64::total_cmp);
    let n = x.len() as f64;
    let mut best = Extremum::none(1);
    let mut below = 0;
    for end in 1..=x.len() {
        let here = x[end - 1];
        if end < x.len() && x[end] == here {
            continue;
        }
        best = best.or(Extremum { value: here - below as f64 / n, corner: vec![here], closed: false });
        best = best.or(Extremum { value: end as f64 / n - here, corner: vec![here], closed: true });
        below = end;
    }
    let inside = x.partition_point(|&here| here < 1.0) as f64;
    best.or(Extremum { value: 1.0 - inside / n, corner: vec![1.0], closed: false })
}

/// The largest |points inside / n − area| over the sets of a family.
pub(super) fn two<F: Family>(points: &[[f64; 2]]) -> Extremum {
    let mut points = points.to_vec();
    points.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let heights = distinct_and_one(points.iter().map(|point| point[1]));
    let mut few = Side::<F>::new(&heights, points.len(), false);
    let mut many = Side::<F>::new(&heights, points.len(), true);
    let mut best = Extremum::none(2);
    let mut rest = &points[..];
    for s in distinct_and_one(points.iter().map(|point| point[0])) {
        best = few.worst(s, best);
        let (here, later) = rest.split_at(rest.partition_point(|point| point[0] <= s));
        for point in here {
            let slot = heights.partition_point(|&t| t < point[1]);
            few.insert(slot + 1);
            many.insert(slot);
        }
        best = many.worst(s, best);
        rest = later;
    }
    best
}

/// All different numbers in ascending order, and 1.
fn distinct_and_one(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut found: Vec<f64> = numbers.chain([1.0]).collect();
    found.sort_unstable_by(f64::total_cmp);
    found.dedup();
    found
}

/// What the sweep knows of all t, for open sets with too few points or for closed sets with too many.
struct Side<'a, F> {
    heights: &'a [f64],
    n: f64,
    closed: bool,
    /// n times the discrepancy of each t before and after it turned.
    rising: Kinetic,
    turned: Kinetic,
    /// The slots that are still to turn, the next one last.
    turning: Vec<usize>,
    family: std::marker::PhantomData<F>,
}

impl<'a, F: Family> Side<'a, F> {
    fn new(heights: &'a [f64], n: usize, closed: bool) -> Self {
        let n = n as f64;
        let sign = if closed { -n } else { n };
        let rising = Kinetic::new(heights.iter().map(|&t| sign * F::slope(t)).collect(), 0.0);
        let mut turning: Vec<usize> =
            (0..heights.len()).filter(|&slot| F::turns(heights[slot]).is_finite()).collect();
        turning.sort_by(|&a, &b| F::turns(heights[b]).total_cmp(&F::turns(heights[a])));
        let turned =
            Kinetic::new(vec![0.0; if turning.is_empty() { 1 } else { heights.len() }], f64::NEG_INFINITY);
        Self { heights, n, closed, rising, turned, turning, family: std::marker::PhantomData }
    }

    /// A point that is in the sets of all t from `slot` on.
    fn insert(&mut self, slot: usize) {
        let by = if self.closed { 1.0 } else { -1.0 };
        self.rising.lift_from(slot, by);
        self.turned.lift_from(slot, by);
    }

    /// n times the area that a turned slot's height holds.
    fn held(&self, slot: usize) -> f64 {
        if self.closed { -self.n * F::rest(self.heights[slot]) } else { self.n * F::rest(self.heights[slot]) }
    }

    fn turn(&mut self, s: f64) {
        while let Some(&slot) = self.turning.last().filter(|&&slot| F::turns(self.heights[slot]) <= s) {
            self.turning.pop();
            let points = self.rising.height(slot);
            self.turned.set(slot, 0.0, points + self.held(slot));
            self.rising.set(slot, 0.0, f64::NEG_INFINITY);
        }
    }

    /// The worst set of width s, or the best so far.
    fn worst(&mut self, s: f64, mut best: Extremum) -> Extremum {
        self.turn(s);
        let rising = self.rising.top(s).map(|slot| (slot, self.rising.height(slot)));
        let turned = self.turned.top(s).map(|slot| (slot, self.turned.height(slot) - self.held(slot)));
        for (slot, points) in rising.into_iter().chain(turned) {
            let (t, share) = (self.heights[slot], points.round().abs() / self.n);
            let area = F::area(s, t);
            let value = if self.closed { share - area } else { area - share };
            if value > best.value {
                best = Extremum { value, corner: vec![s, t], closed: self.closed };
            }
        }
        best
    }
}
