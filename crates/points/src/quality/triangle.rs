//! The discrepancy of points in a triangle, over parallelograms or trapezoids at its corners, exactly.
//!
//! Seen from a corner V with the others P and Q, a point is V + p (P − V) + q (Q − V), and {p < s, q < t} cuts a parallelogram
//! from the triangle, of area 2 s t − max(s + t − 1, 0)² in units of the whole. The parallelogram discrepancy is the largest |points
//! inside / n − area| over s, t and the three corners (L. Brandolini, L. Colzani, G. Gigante and G. Travaglini 2013; K. Basu and
//! A. Owen, *Low discrepancy constructions in the triangle*, SIAM J. Numer. Anal. 53, 2015). For trapezoids one of the two
//! lines is turned to the side opposite V: {p < s, p + q < t}, of area 2 s t − s² or t² (T. Pillards and R. Cools, *A
//! theoretical view on transforming low-discrepancy sequences from a cube to a simplex*, Monte Carlo Methods Appl. 10, 2004);
//! there are six such families.
//!
//! Neither depends on the shape of the triangle. With the same sweep as in the square: O(n log² n) for each corner.

use super::sweep::{Extremum, Family, two};
use crate::Error;

/// Which sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sets {
    /// Parallelograms at the three corners.
    Parallelograms,
    /// Trapezoids at the three corners, two kinds at each.
    Trapezoids,
}

/// The worst set.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    /// Its discrepancy, its s and t, and whether it is closed.
    pub worst: Extremum,
    /// The numbers of the corner V and of the corner P.
    pub corners: [usize; 2],
}

/// Coordinates closer than this are one: barycentric coordinates have been rounded.
const TIE: f64 = 1e14;

/// The discrepancy of points that are given by barycentric coordinates, which are at least 0 and sum to 1 up to rounding.
///
/// ```
/// use evenlight_points::quality::triangle::{Sets, triangle_discrepancy};
/// let third = 1.0 / 3.0;
/// let found = triangle_discrepancy(&[[third; 3]], Sets::Parallelograms)?;
/// assert!((found.worst.value - 7.0 / 9.0).abs() < 1e-12);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn triangle_discrepancy(points: &[[f64; 3]], sets: Sets) -> Result<Triangle, Error> {
    if points.is_empty() {
        return Err(Error::Quality("no points".into()));
    }
    let wrong = |point: &[f64; 3]| {
        !(point.iter().all(|&x| x >= -1e-9) && (point.iter().sum::<f64>() - 1.0).abs() < 1e-9)
    };
    if let Some(at) = points.iter().position(wrong) {
        let message = format!("point {at} is not in the triangle: barycentric coordinates {:?}", points[at]);
        return Err(Error::Quality(message));
    }
    let orders: &[[usize; 2]] = match sets {
        Sets::Parallelograms => &[[0, 1], [1, 2], [2, 0]],
        Sets::Trapezoids => &[[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]],
    };
    let one = |&corners: &[usize; 2]| Triangle { worst: worst(points, corners, sets), corners };
    let larger = |a: Triangle, b: Triangle| if b.worst.value > a.worst.value { b } else { a };
    Ok(orders.iter().map(one).reduce(larger).expect("there are three corners"))
}

/// The worst set at a corner.
fn worst(points: &[[f64; 3]], [v, p]: [usize; 2], sets: Sets) -> Extremum {
    let q = 3 - v - p;
    let rounded = |x: f64| ((x * TIE).round() / TIE).clamp(0.0, 1.0);
    let seen = |point: &[f64; 3]| match sets {
        Sets::Parallelograms => [rounded(point[p]), rounded(point[q])],
        Sets::Trapezoids => [rounded(point[p]), rounded(1.0 - point[v])],
    };
    let seen: Vec<_> = points.iter().map(seen).collect();
    match sets {
        Sets::Parallelograms => two::<Parallelograms>(&seen),
        Sets::Trapezoids => two::<Trapezoids>(&seen),
    }
}

struct Parallelograms;

impl Family for Parallelograms {
    fn area(s: f64, t: f64) -> f64 {
        let beyond = (s + t - 1.0).max(0.0);
        2.0 * s * t - beyond * beyond
    }
    fn slope(t: f64) -> f64 {
        2.0 * t
    }
    fn turns(t: f64) -> f64 {
        1.0 - t
    }
    // 1 − (1 − s)² − (1 − t)² from there on
    fn rest(t: f64) -> f64 {
        -(1.0 - t) * (1.0 - t)
    }
}

struct Trapezoids;

impl Family for Trapezoids {
    fn area(s: f64, t: f64) -> f64 {
        let s = s.min(t);
        2.0 * s * t - s * s
    }
    fn slope(t: f64) -> f64 {
        2.0 * t
    }
    fn turns(t: f64) -> f64 {
        t
    }
    fn rest(t: f64) -> f64 {
        t * t
    }
}
