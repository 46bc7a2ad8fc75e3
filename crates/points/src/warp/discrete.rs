//! The interval to numbered choices of given weights, by inversion; what is left of the number is kept.
//!
//! A point is (choice, rest): the rest is uniform in [0, 1) again and can be used for what follows. Monotone, so that well-spread points
//! stay well spread: choose it before the alias method unless there are very many choices. The cost is a binary search.

use super::steps::Steps;
use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "discrete",
    cite: "L. Devroye, Non-uniform random variate generation, chapter III.2 (1986)",
    takes: &["values"],
    folds: false,
    build: |options| Ok(Box::new(Fixed::<_, 1, 2>(Discrete::new(options.values.as_deref())?))),
};

/// Choices by inversion.
#[derive(Clone, Debug)]
pub struct Discrete {
    steps: Steps,
}

impl Discrete {
    /// Choices with these weights, up to a factor.
    ///
    /// # Errors
    /// If one is negative or all are 0.
    pub fn new(weights: Option<&[f64]>) -> Result<Self, Error> {
        Ok(Self { steps: Steps::new(options::weights("discrete", weights)?.iter().copied()) })
    }
}

impl<T: Real> Warp<T, 1> for Discrete {
    type Point = [T; 2];

    fn map(&self, [u]: [T; 1]) -> [T; 2] {
        let (choice, rest) = self.steps.find(u.wide());
        [T::of(choice as f64), T::under(rest, 1.0)]
    }

    fn density(&self, &[choice, _]: &[T; 2]) -> T {
        let known = choice >= T::of(0.0) && choice < T::of(self.steps.len() as f64);
        T::of(if known { self.steps.size(choice.wide() as usize) } else { 0.0 })
    }

    fn invert(&self, &[choice, rest]: &[T; 2]) -> [T; 1] {
        let choice = (choice.wide() as usize).min(self.steps.len() - 1);
        [T::of(self.steps.number(choice, rest.wide()))]
    }
}
