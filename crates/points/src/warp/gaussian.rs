//! The interval to the standard normal distribution by its inverse: precise to the last digits of a double, tails too.
//!
//! Choose it before other ways to make normal numbers: it is monotone, so that well-spread points stay well spread. Numbers stand for
//! intervals of 2^-53 (2^-24 in single precision), of which the middle is taken, so that 0 does not become −∞.

use std::f64::consts::PI;

use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "gaussian",
    cite: "M. J. Wichura, Algorithm AS 241: the percentage points of the normal distribution, Appl. Statist. 37(3), 477-484 (1988)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 1, 1>(Gaussian))),
};

/// The standard normal distribution.
#[derive(Clone, Copy, Debug)]
pub struct Gaussian;

impl<T: Real> Warp<T, 1> for Gaussian {
    type Point = [T; 1];

    fn map(&self, [u]: [T; 1]) -> [T; 1] {
        let half = 0.25 * T::EPSILON.wide();
        [T::of(quantile(u.wide() + half, 1.0 - u.wide() - half))]
    }

    fn density(&self, &[x]: &[T; 1]) -> T {
        T::of(bell(x.wide()))
    }

    fn invert(&self, &[x]: &[T; 1]) -> [T; 1] {
        [T::of((cumulative(x.wide()) - 0.25 * T::EPSILON.wide()).clamp(0.0, 1.0))]
    }
}

fn bell(x: f64) -> f64 {
    (-0.5 * x * x).exp() / (2.0 * PI).sqrt()
}

/// The number below which a standard normal one is with this probability; `upper` is 1 − `lower`, without rounding where it is small.
pub fn quantile(lower: f64, upper: f64) -> f64 {
    let q = if lower < upper { lower - 0.5 } else { 0.5 - upper };
    if q.abs() <= 0.425 {
        let r = 0.180625 - q * q;
        return q * rational(&CENTER, r);
    }
    let r = (-lower.min(upper).ln()).sqrt();
    let x = if r <= 5.0 { rational(&MIDDLE, r - 1.6) } else { rational(&FAR, r - 5.0) };
    x.copysign(q)
}

/// Coefficients of the numerator and of the denominator, the highest power first.
type Rational = [[f64; 8]; 2];

fn rational(&[above, below]: &Rational, x: f64) -> f64 {
    let polynomial = |coefficients: [f64; 8]| coefficients.into_iter().fold(0.0, |sum, c| sum * x + c);
    polynomial(above) / polynomial(below)
}

/// Near the middle: |p − 1/2| ≤ 0.425.
#[rustfmt::skip]
#[expect(clippy::excessive_precision, reason = "the digits as published")]
const CENTER: Rational = [
    [
        2.5090809287301226727e+3, 3.3430575583588128105e+4,
        6.7265770927008700853e+4, 4.5921953931549871457e+4,
        1.3731693765509461125e+4, 1.9715909503065514427e+3,
        1.3314166789178437745e+2, 3.3871328727963666080e+0,
    ],
    [
        5.2264952788528545610e+3, 2.8729085735721942674e+4,
        3.9307895800092710610e+4, 2.1213794301586595867e+4,
        5.3941960214247511077e+3, 6.8718700749205790830e+2,
        4.2313330701600911252e+1, 1.0,
    ],
];

/// Further out, to √(−ln p) = 5.
#[rustfmt::skip]
#[expect(clippy::excessive_precision, reason = "the digits as published")]
const MIDDLE: Rational = [
    [
        7.74545014278341407640e-4, 2.27238449892691845833e-2,
        2.41780725177450611770e-1, 1.27045825245236838258e+0,
        3.64784832476320460504e+0, 5.76949722146069140550e+0,
        4.63033784615654529590e+0, 1.42343711074968357734e+0,
    ],
    [
        1.05075007164441684324e-9, 5.47593808499534494600e-4,
        1.51986665636164571966e-2, 1.48103976427480074590e-1,
        6.89767334985100004550e-1, 1.67638483018380384940e+0,
        2.05319162663775882187e+0, 1.0,
    ],
];

/// The far tails.
#[rustfmt::skip]
#[expect(clippy::excessive_precision, reason = "the digits as published")]
const FAR: Rational = [
    [
        2.01033439929228813265e-7, 2.71155556874348757815e-5,
        1.24266094738807843860e-3, 2.65321895265761230930e-2,
        2.96560571828504891230e-1, 1.78482653991729133580e+0,
        5.46378491116411436990e+0, 6.65790464350110377720e+0,
    ],
    [
        2.04426310338993978564e-15, 1.42151175831644588870e-7,
        1.84631831751005468180e-5, 7.86869131145613259100e-4,
        1.48753612908506148525e-2, 1.36929880922735805310e-1,
        5.99832206555887937690e-1, 1.0,
    ],
];

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

    /// Values of 50-digit arithmetic (M. Abramowitz and I. Stegun, table 26.1, and mpmath), to 4 units in the last place.
    #[test]
    fn quantiles_and_probabilities_are_precise() {
        for (p, x) in [
            (0.5, 0.0),
            (0.75, 0.674_489_750_196_081_7),
            (0.975, 1.959_963_984_540_054_2),
            (0.999, 3.090_232_306_167_813_5),
            (1e-10, -6.361_340_902_404_056),
            (1e-100, -21.273_453_560_965_32),
        ] {
            let found = quantile(p, 1.0 - p);
            assert!((found - x).abs() <= 1e-15 * f64::abs(x), "{p}: {found}");
            assert!(
                (cumulative(x) - p).abs() <= 4e-16 * p.max(f64::abs(x * x) * p),
                "{x}: {}",
                cumulative(x)
            );
        }
    }
}
