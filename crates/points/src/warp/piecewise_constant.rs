//! The interval to a histogram by inversion: a density that is constant between its knots.

use super::steps::Steps;
use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "piecewise_constant",
    cite: "L. Devroye, Non-uniform random variate generation, chapter II.2 (1986)",
    takes: &["values", "knots"],
    folds: false,
    build: |options| {
        let (values, knots) = (options.values.as_deref(), options.knots.as_deref());
        Ok(Box::new(Fixed::<_, 1, 1>(PiecewiseConstant::new(values, knots)?)))
    },
};

/// A histogram.
#[derive(Clone, Debug)]
pub struct PiecewiseConstant {
    knots: Vec<f64>,
    steps: Steps,
}

impl PiecewiseConstant {
    /// Densities up to a factor, between ascending knots, one more of them than densities: evenly over [0, 1] if there are none.
    ///
    /// # Errors
    /// If a density is negative, all are 0, or the knots do not ascend.
    pub fn new(values: Option<&[f64]>, knots: Option<&[f64]>) -> Result<Self, Error> {
        let values = options::weights("piecewise_constant", values)?;
        let knots = options::ascending("piecewise_constant", knots, values.len() + 1)?;
        let masses: Vec<_> =
            values.iter().zip(knots.windows(2)).map(|(value, pair)| value * (pair[1] - pair[0])).collect();
        Ok(Self { steps: Steps::new(masses.into_iter()), knots })
    }

    fn interval(&self, x: f64) -> usize {
        self.knots.partition_point(|&knot| knot <= x).clamp(1, self.steps.len()) - 1
    }

    fn width(&self, i: usize) -> f64 {
        self.knots[i + 1] - self.knots[i]
    }
}

impl<T: Real> Warp<T, 1> for PiecewiseConstant {
    type Point = [T; 1];

    fn map(&self, [u]: [T; 1]) -> [T; 1] {
        let (i, within) = self.steps.find(u.wide());
        [T::under(self.knots[i] + within * self.width(i), self.knots[i + 1])]
    }

    fn density(&self, &[x]: &[T; 1]) -> T {
        let i = self.interval(x.wide());
        let inside = x.wide() >= self.knots[0] && x.wide() <= self.knots[self.knots.len() - 1];
        T::of(if inside { self.steps.size(i) / self.width(i) } else { 0.0 })
    }

    fn invert(&self, &[x]: &[T; 1]) -> [T; 1] {
        let i = self.interval(x.wide());
        let within = ((x.wide() - self.knots[i]) / self.width(i)).clamp(0.0, 1.0);
        [T::of(self.steps.number(i, within))]
    }
}
