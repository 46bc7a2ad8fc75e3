//! The interval to the standard normal distribution by its inverse: precise to the last digits of a double, tails too.
//!
//! Choose it before other ways to make normal numbers: it is monotone, so that well-spread points stay well spread. Numbers stand for
//! intervals of 2^-53 (2^-24 in single precision), of which the middle is taken, so that 0 does not become −∞.

use std::f64::consts::PI;

use super::quantile::{quantile, quantiles};
use super::rows::{Fixed, Rows, Sizes};
use super::{Entry, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "gaussian",
    cite: "M. J. Wichura, Algorithm AS 241: the percentage points of the normal distribution, Appl. Statist. 37(3), 477-484 (1988)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Gaussian)),
};

/// The standard normal distribution.
#[derive(Clone, Copy, Debug)]
pub struct Gaussian;

impl<T: Real> Warp<T, 1> for Gaussian {
    type Point = [T; 1];

    fn map(&self, [u]: [T; 1]) -> [T; 1] {
        [quantile(u)]
    }

    fn density(&self, &[x]: &[T; 1]) -> T {
        T::of(bell(x.wide()))
    }

    fn invert(&self, &[x]: &[T; 1]) -> [T; 1] {
        [T::of((cumulative(x.wide()) - 0.25 * T::EPSILON.wide()).clamp(0.0, 1.0))]
    }
}

impl Sizes for Gaussian {
    fn inputs(&self) -> usize {
        1
    }
    fn outputs(&self) -> usize {
        1
    }
}

impl<T: Real> Rows<T> for Gaussian {
    fn map(&self, u: &[T], x: &mut [T]) {
        quantiles(u, x);
    }
    fn density(&self, x: &[T], density: &mut [T]) {
        Fixed::<_, 1, 1>(*self).density(x, density);
    }
    fn invert(&self, x: &[T], u: &mut [T]) {
        Fixed::<_, 1, 1>(*self).invert(x, u);
    }
}

fn bell(x: f64) -> f64 {
    (-0.5 * x * x).exp() / (2.0 * PI).sqrt()
}

/// The probability of a standard normal number below x: a series in the middle (G. Marsaglia, *Evaluating the normal distribution*,
/// J. Stat. Softw. 11(4), 2004), Laplace's continued fraction in the tails.
pub fn cumulative(x: f64) -> f64 {
    if x.abs() > 2.0 {
        let mut fraction = 0.0;
        for k in (1..=TERMS).rev() {
            fraction = f64::from(k) / (x.abs() + fraction);
        }
        let tail = bell(x) / (x.abs() + fraction);
        return if x > 0.0 { 1.0 - tail } else { tail };
    }
    let (mut sum, mut term, mut k) = (0.0, x, 1.0);
    while sum + term != sum {
        sum += term;
        k += 2.0;
        term *= x * x / k;
    }
    0.5 + bell(x) * sum
}

/// Enough for x = 2, where the fraction converges slowest.
const TERMS: u32 = 100;

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of 50-digit arithmetic (mpmath), to 4 units in the last place.
    #[test]
    fn probabilities_are_precise() {
        for (p, x) in [
            (0.5, 0.0),
            (0.75, 0.674_489_750_196_081_7),
            (0.975, 1.959_963_984_540_054_2),
            (0.999, 3.090_232_306_167_813_5),
            (1e-10, -6.361_340_902_404_056),
            (1e-100, -21.273_453_560_965_32),
        ] {
            let found = cumulative(x);
            assert!((found - p).abs() <= 4e-16 * p.max(f64::abs(x * x) * p), "{x}: {found}");
        }
    }
}
