//! The L2 family: mean squares of local discrepancies, exactly.
//!
//! Each is the squared error, averaged over all functions of a reproducing kernel Hilbert space's unit ball, of the mean over
//! the points: C − (2/n) Σ s(x) + (1/n²) Σ Σ k(x, y), where s and k are products over coordinates. What is returned
//! is this **square**; take the root to compare with an integration error.
//!
//! | measure | boxes | published by |
//! |---|---|---|
//! | [`Measure::Star`] | from the origin | Warnock 1972 |
//! | [`Measure::WeightedStar`] | the same, of all projections, with weights | Sloan and Woźniakowski 1998; weights 1: Hickernell 1998 |
//! | [`Measure::Centered`] | from the nearest corner | Hickernell 1998 |
//! | [`Measure::WrapAround`] | anywhere on the torus, of all projections | Hickernell 1998 |
//! | [`Measure::Mixture`] | a mean of the last two | Zhou, Fang and Ning 2013 |
//! | [`Measure::Symmetric`] | unions of even boxes | Hickernell 1998 |
//! | [`Measure::Periodic`] | anywhere on the torus | Lev 1995 |
//! | [`Measure::Extreme`] | anywhere | Morokoff and Caflisch 1994 |
//!
//! O(n² d) by all pairs, or O(n log^{d−1} n) by divide and conquer, whichever is expected to be faster.

use std::num::NonZeroUsize;

use super::Rows;
use super::halves::{cost, sum_by_halves};
use super::pairs::{Columns, pairwise, sum_over_pairs};
use super::shapes::{Bowl, Bridge, Least, Shape, Tent, Wrap};
use crate::Error;

/// Which boxes, and how they are averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// `L2-star`.
    Star,
    /// `weighted-star`.
    WeightedStar,
    /// `CD`.
    Centered,
    /// `WD`.
    WrapAround,
    /// `MD`.
    Mixture,
    /// `SD`.
    Symmetric,
    /// `PD`.
    Periodic,
    /// `ED`.
    Extreme,
}

/// How the pairs are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Algorithm {
    /// The one that is expected to be faster.
    Auto,
    /// All pairs.
    Pairs,
    /// Divide and conquer.
    Halves,
}

/// What is asked.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The discrepancy.
    pub measure: Measure,
    /// One weight for each coordinate, 0 or larger; 1 if there are none. Only measures that take projections into account
    /// have them: a projection counts as much as the product of its coordinates' weights.
    pub weights: Option<&'a [f64]>,
    /// How to sum.
    pub algorithm: Algorithm,
    /// Threads, for [`Algorithm::Pairs`]; they change no bit.
    pub workers: NonZeroUsize,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Centered,
        Self::WrapAround,
        Self::Mixture,
        Self::Star,
        Self::WeightedStar,
        Self::Symmetric,
        Self::Periodic,
        Self::Extreme,
    ];

    /// Its name everywhere; the first four are those of `scipy.stats.qmc`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Centered => "CD",
            Self::WrapAround => "WD",
            Self::Mixture => "MD",
            Self::Star => "L2-star",
            Self::WeightedStar => "weighted-star",
            Self::Symmetric => "SD",
            Self::Periodic => "PD",
            Self::Extreme => "ED",
        }
    }

    /// The measure of this name.
    pub fn named(name: &str) -> Result<Self, Error> {
        let known = Self::ALL.map(Self::name).join(", ");
        let unknown = || Error::Quality(format!("unknown method '{name}'; known: {known}"));
        Self::ALL.into_iter().find(|measure| measure.name() == name).ok_or_else(unknown)
    }

    /// Whether all projections are measured, so that they may have weights.
    const fn has_weights(self) -> bool {
        !matches!(self, Self::Star | Self::Periodic | Self::Extreme)
    }

    /// The constant factor C of a coordinate of weight w.
    fn constant(self, w: f64) -> f64 {
        match self {
            Self::Centered => 1.0 + w / 12.0,
            Self::WrapAround | Self::Symmetric | Self::WeightedStar => 1.0 + w / 3.0,
            Self::Mixture => 1.0 + w * 7.0 / 12.0,
            Self::Star | Self::Periodic => 1.0 / 3.0,
            Self::Extreme => 1.0 / 12.0,
        }
    }

    /// The factor s(x): the mean of k(x, y) over y.
    fn single(self, x: f64, w: f64) -> f64 {
        let z = (x - 0.5).abs();
        match self {
            Self::Centered => 1.0 + w * 0.5 * (z - z * z),
            Self::WrapAround | Self::Periodic => self.constant(w),
            Self::Mixture => 1.0 + w * (2.0 / 3.0 - 0.25 * (z + z * z)),
            Self::Symmetric => 1.0 + w * 2.0 * (x - x * x),
            Self::WeightedStar => 1.0 + w * 0.5 * (1.0 - x * x),
            Self::Star => 0.5 * (1.0 - x * x),
            Self::Extreme => 0.5 * x * (1.0 - x),
        }
    }

    /// The numbers a and b of the factor k(x, y) in its shape.
    fn numbers(self, x: f64, w: f64) -> [f64; 2] {
        let z = (x - 0.5).abs();
        match self {
            Self::Centered => [0.5 + 0.5 * w * z, 0.5 * w * x],
            Self::Symmetric => [0.5 + 0.5 * w, 2.0 * w * x],
            // ½ − Δ + Δ² = ¼ + (Δ − ½)²
            Self::WrapAround => [1.0 + 0.25 * w, w.sqrt() * x],
            Self::Periodic => [0.25, x],
            // 7/8 − (z + z′)/4 − ¾ Δ + ½ Δ² = 19/32 − (z + z′)/4 + ½ (Δ − ¾)²
            Self::Mixture => [0.5 + w * (19.0 / 64.0 - 0.25 * z), (0.5 * w).sqrt() * x],
            Self::WeightedStar => [1.0 + w * (1.0 - x), 0.0],
            Self::Star => [1.0 - x, 0.0],
            Self::Extreme => [x, 0.0],
        }
    }

    /// The number g of the shape.
    fn g(self, w: f64) -> f64 {
        match self {
            Self::WrapAround => 0.5 * w.sqrt(),
            Self::Periodic => 0.5,
            Self::Mixture => 0.75 * (0.5 * w).sqrt(),
            _ => 0.0,
        }
    }
}

/// The squared discrepancy.
///
/// ```
/// use evenlight_points::quality::{Rows, l2::{Algorithm, Measure, Request, l2_discrepancy}};
/// let rows = Rows::new(&[0.5], 1)?; // one point: ∫ (1{x > ½} − x)² dx
/// let (measure, algorithm) = (Measure::Star, Algorithm::Auto);
/// let request = Request { measure, weights: None, algorithm, workers: 1.try_into().unwrap() };
/// assert!((l2_discrepancy(&rows, &request)? - 1.0 / 12.0).abs() < 1e-15);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn l2_discrepancy(rows: &Rows<'_>, request: &Request<'_>) -> Result<f64, Error> {
    let measure = request.measure;
    check_weights(rows, request)?;
    let ones = vec![1.0; rows.dims()];
    let weights = request.weights.unwrap_or(&ones);
    let sum = match measure {
        Measure::Centered | Measure::Symmetric => sum::<Tent>(rows, weights, request),
        Measure::WrapAround | Measure::Periodic => sum::<Wrap>(rows, weights, request),
        Measure::Mixture => sum::<Bowl>(rows, weights, request),
        Measure::Star | Measure::WeightedStar => sum::<Least>(rows, weights, request),
        Measure::Extreme => sum::<Bridge>(rows, weights, request),
    };
    let single = |row: &[f64]| row.iter().zip(weights).map(|(&x, &w)| measure.single(x, w)).product::<f64>();
    let singles: Vec<f64> = rows.iter().map(single).collect();
    let constant: f64 = weights.iter().map(|&w| measure.constant(w)).product();
    let n = rows.len() as f64;
    Ok(constant - 2.0 / n * pairwise(&singles) + sum / (n * n))
}

fn check_weights(rows: &Rows<'_>, request: &Request<'_>) -> Result<(), Error> {
    let Some(weights) = request.weights else { return Ok(()) };
    let name = request.measure.name();
    let wrong = if !request.measure.has_weights() {
        format!("'{name}' has no weights; those that have: CD, WD, MD, SD, weighted-star")
    } else if weights.len() != rows.dims() {
        format!("{} weights for {} dimensions", weights.len(), rows.dims())
    } else if let Some(weight) = weights.iter().find(|weight| !(0.0..f64::INFINITY).contains(*weight)) {
        format!("weights must be finite and at least 0, not {weight}")
    } else {
        return Ok(());
    };
    Err(Error::Quality(wrong))
}

/// The sum over pairs, one way or the other.
fn sum<S: Shape>(rows: &Rows<'_>, weights: &[f64], request: &Request<'_>) -> f64 {
    let (n, dims, measure) = (rows.len(), rows.dims(), request.measure);
    let g = weights.iter().map(|&w| measure.g(w)).collect();
    let columns = Columns::<S>::new(n, g, |i, dim| measure.numbers(rows.row(i)[dim], weights[dim]));
    // nanoseconds, measured on one core with 256-bit vectors
    let all_pairs = 0.1 * n as f64 * n as f64 * dims as f64 / request.workers.get() as f64;
    let halves = match request.algorithm {
        Algorithm::Auto => cost::<S>(n, dims) < all_pairs,
        Algorithm::Pairs => false,
        Algorithm::Halves => true,
    };
    if halves { sum_by_halves(&columns) } else { sum_over_pairs(&columns, request.workers) }
}
