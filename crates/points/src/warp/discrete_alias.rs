//! The interval to numbered choices of given weights, by an alias table: the same cost for any number of choices.
//!
//! A point is (choice, rest) as in `discrete`, but the map jumps, so that strata of the interval are torn: choose it for very many choices
//! and independent numbers. Several places lead to one choice; `invert` gives the one in the choice's own column.

use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "discrete_alias",
    cite: "M. D. Vose, A linear algorithm for generating random numbers with a given distribution, \
           IEEE Trans. Softw. Eng. 17(9), 972-975 (1991)",
    takes: &["values"],
    folds: true,
    build: |options| Ok(Box::new(Fixed::<_, 1, 2>(DiscreteAlias::new(options.values.as_deref())?))),
};

/// A column of equal width: the first part belongs to its own choice, the rest to another one.
#[derive(Clone, Copy, Debug)]
struct Column {
    own: f64,
    other: usize,
    probability: f64,
}

/// Choices by an alias table.
#[derive(Clone, Debug)]
pub struct DiscreteAlias {
    columns: Vec<Column>,
}

impl DiscreteAlias {
    /// Choices with these weights, up to a factor.
    ///
    /// # Errors
    /// If one is negative or all are 0.
    pub fn new(weights: Option<&[f64]>) -> Result<Self, Error> {
        let weights = options::weights("discrete_alias", weights)?;
        let (count, total) = (weights.len() as f64, weights.iter().sum::<f64>());
        let column = |(other, weight): (usize, &f64)| Column {
            own: weight / total * count,
            other,
            probability: weight / total,
        };
        let mut columns: Vec<_> = weights.iter().enumerate().map(column).collect();
        let (mut small, mut large): (Vec<_>, Vec<_>) =
            (0..columns.len()).partition(|&choice| columns[choice].own < 1.0);
        while let (Some(low), Some(&high)) = (small.pop(), large.last()) {
            columns[low].other = high;
            columns[high].own -= 1.0 - columns[low].own;
            if columns[high].own < 1.0 {
                large.pop();
                small.push(high);
            }
        }
        // What is left differs from 1 by rounding, unless its weight is 0.
        for choice in small.into_iter().chain(large) {
            columns[choice].own = 1.0;
        }
        Ok(Self { columns })
    }
}

impl<T: Real> Warp<T, 1> for DiscreteAlias {
    type Point = [T; 2];

    fn map(&self, [u]: [T; 1]) -> [T; 2] {
        let scaled = u.wide() * self.columns.len() as f64;
        let choice = (scaled as usize).min(self.columns.len() - 1);
        let (column, within) = (self.columns[choice], scaled - choice as f64);
        let (choice, rest) = if within < column.own {
            (choice, within / column.own)
        } else {
            (column.other, (within - column.own) / (1.0 - column.own))
        };
        [T::of(choice as f64), T::under(rest, 1.0)]
    }

    fn density(&self, &[choice, _]: &[T; 2]) -> T {
        let known = choice >= T::of(0.0) && choice < T::of(self.columns.len() as f64);
        T::of(if known { self.columns[choice.wide() as usize].probability } else { 0.0 })
    }

    fn invert(&self, &[choice, rest]: &[T; 2]) -> [T; 1] {
        let choice = (choice.wide() as usize).min(self.columns.len() - 1);
        let within = rest.wide() * self.columns[choice].own;
        [T::of((choice as f64 + within) / self.columns.len() as f64)]
    }
}
