//! The interval to a density that is tabulated, and linear between its knots, by inversion.
//!
//! Choose it for one-dimensional functions that are known at points: monotone, so that well-spread points stay well spread.

use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "piecewise_linear",
    cite: "L. Devroye, Non-uniform random variate generation, chapter II.2 (1986)",
    takes: &["values", "knots"],
    folds: false,
    build: |options| {
        let (values, knots) = (options.values.as_deref(), options.knots.as_deref());
        Ok(Box::new(Fixed::<_, 1, 1>(PiecewiseLinear::new(values, knots)?)))
    },
};

/// A density, linear between knots.
#[derive(Clone, Debug)]
pub struct PiecewiseLinear {
    knots: Vec<f64>,
    /// Normalized densities at the knots.
    density: Vec<f64>,
    /// Probabilities below the knots.
    below: Vec<f64>,
}

impl PiecewiseLinear {
    /// Densities up to a factor, at ascending knots: evenly over [0, 1] if there are none.
    ///
    /// # Errors
    /// If there are fewer than two, one is negative, all are 0, or the knots do not ascend.
    pub fn new(values: Option<&[f64]>, knots: Option<&[f64]>) -> Result<Self, Error> {
        let values = options::weights("piecewise_linear", values)?;
        if values.len() < 2 {
            return Err(options::refused("piecewise_linear", "values", values, "at least two numbers"));
        }
        let knots = options::ascending("piecewise_linear", knots, values.len())?;
        let mut below = vec![0.0];
        for (x, value) in knots.windows(2).zip(values.windows(2)) {
            below.push(below[below.len() - 1] + 0.5 * (value[0] + value[1]) * (x[1] - x[0]));
        }
        let total = below[below.len() - 1];
        let below: Vec<_> = below.into_iter().map(|sum| sum / total).collect();
        Ok(Self { density: values.iter().map(|value| value / total).collect(), knots, below })
    }

    /// The interval of a number among ascending ones.
    fn interval(ascending: &[f64], x: f64) -> usize {
        ascending.partition_point(|&knot| knot <= x).clamp(1, ascending.len() - 1) - 1
    }

    /// Width and densities of an interval.
    fn piece(&self, i: usize) -> (f64, f64, f64) {
        (self.knots[i + 1] - self.knots[i], self.density[i], self.density[i + 1])
    }
}

impl<T: Real> Warp<T, 1> for PiecewiseLinear {
    type Point = [T; 1];

    fn map(&self, [u]: [T; 1]) -> [T; 1] {
        let i = Self::interval(&self.below, u.wide());
        let (width, a, b) = self.piece(i);
        let mass = (u.wide() - self.below[i]).max(0.0) / width;
        // the root of a t + (b − a) t²/2 = mass that has no cancellation
        let root = (a * a + 2.0 * (b - a) * mass).max(0.0).sqrt();
        let t = if mass > 0.0 { (2.0 * mass / (a + root)).min(1.0) } else { 0.0 };
        [T::of(self.knots[i] + width * t)]
    }

    fn density(&self, &[x]: &[T; 1]) -> T {
        let x = x.wide();
        if !(x >= self.knots[0] && x <= self.knots[self.knots.len() - 1]) {
            return T::of(0.0);
        }
        let i = Self::interval(&self.knots, x);
        let (width, a, b) = self.piece(i);
        T::of(a + (b - a) * (x - self.knots[i]) / width)
    }

    fn invert(&self, &[x]: &[T; 1]) -> [T; 1] {
        let i = Self::interval(&self.knots, x.wide());
        let (width, a, b) = self.piece(i);
        let t = ((x.wide() - self.knots[i]) / width).clamp(0.0, 1.0);
        [T::of((self.below[i] + width * t * (a + 0.5 * (b - a) * t)).min(1.0))]
    }
}
