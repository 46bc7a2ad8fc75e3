//! How good a lattice is: squared worst-case errors in weighted spaces of functions, with product weights γ.
//!
//! All have the form e² = −1 + (1/n) Σ Π (1 + γ ω(x)), a sum over the points and a product over the coordinates x:
//!
//! * *Sobolev*: the mean square over random shifts of the worst-case error in the unanchored Sobolev space of mixed first
//!   derivatives; ω(x) = x² − x + 1/6 (I. H. Sloan, F. Y. Kuo and S. Joe, *Constructing randomly shifted lattice rules
//!   in weighted Sobolev spaces*, SIAM J. Numer. Anal. 40, 1650-1665, 2002);
//! * *Korobov*: the weighted `P_α` of periodic functions; ω(x) is the sum of exp(2πihx) / |h|^α over h ≠ 0, which is a Bernoulli
//!   polynomial for α = 2, 4, 6 (I. H. Sloan and S. Joe, *Lattice methods for multiple integration*, 1994);
//! * *Walsh*: for polynomial lattices, the mean square over digital shifts in the same Sobolev space;
//!   ω(x) = 1/6 − 2^(⌊log₂ x⌋ − 1) (J. Dick and F. Pillichshammer, *Multivariate integration in weighted Hilbert spaces based
//!   on Walsh functions and weighted Sobolev spaces*, J. Complexity 21, 149-195, 2005).

use std::f64::consts::PI;

use crate::Error;

/// A space of functions, by the ω of its error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Mixed first derivatives, averaged over shifts modulo 1.
    Sobolev,
    /// Periodic functions whose Fourier coefficients fall like h^-α/2: α = 2, 4 or 6.
    Korobov(u32),
    /// Mixed first derivatives, averaged over digital shifts.
    Walsh,
}

impl Space {
    /// ω of a coordinate in [0, 1).
    #[inline]
    pub fn omega(self, x: f64) -> f64 {
        let y = x * (1.0 - x);
        match self {
            Self::Sobolev => 1.0 / 6.0 - y,
            Self::Korobov(2) => 2.0 * PI * PI * (1.0 / 6.0 - y),
            Self::Korobov(4) => 2.0 / 3.0 * PI.powi(4) * (1.0 / 30.0 - y * y),
            Self::Korobov(_) => 4.0 / 45.0 * PI.powi(6) * (1.0 / 42.0 - y * y * (y + 0.5)),
            Self::Walsh if x == 0.0 => 1.0 / 6.0,
            Self::Walsh => 1.0 / 6.0 - 2f64.powi(exponent(x) - 1),
        }
    }
}

/// The binary exponent of a normal number.
fn exponent(x: f64) -> i32 {
    (x.to_bits() >> 52) as i32 - 1023
}

/// The squared worst-case error of the lattice {k z / n}, k = 0 to n − 1, in time n · d; one weight for each coordinate.
///
/// The sums are compensated: the absolute error is some units of 10^-16, or of the largest product if that is large.
///
/// ```
/// use evenlight_points::quality::lattice_criteria::{Space, squared_error};
/// let in_one_dimension = squared_error(&[1], 8, &[1.0], Space::Sobolev)?;
/// assert!((in_one_dimension - 1.0 / (6.0 * 64.0)).abs() < 1e-15);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// If there is no coordinate, another number of weights, a weight that is negative or not finite, or `n` is 0.
pub fn squared_error(z: &[u64], n: u64, weights: &[f64], space: Space) -> Result<f64, Error> {
    check(z, n, weights, space)?;
    let (reciprocal, mut residues) = (1.0 / n as f64, vec![0; z.len()]);
    let steps: Vec<_> = z.iter().map(|z| z % n).collect();
    Ok(mean(
        n,
        (0..n).map(|_| {
            let excess = product_excess(
                residues
                    .iter()
                    .zip(weights)
                    .map(|(&residue, weight)| weight * space.omega(residue as f64 * reciprocal)),
            );
            residues
                .iter_mut()
                .zip(&steps)
                .for_each(|(residue, step)| *residue = add_modulo(*residue, *step, n));
            excess
        }),
    ))
}

/// The squared worst-case error of any points in the space of digital shifts, row after row; one weight for each coordinate.
/// For base-2 digital nets, of which it is the mean square over their digital shifts.
///
/// # Errors
/// If `rows` is empty or has no whole number of points, or a weight is negative or not finite.
pub fn squared_error_of_net(rows: &[f64], weights: &[f64]) -> Result<f64, Error> {
    let dims = weights.len();
    check(&vec![1; dims], 1, weights, Space::Walsh)?;
    if rows.is_empty() || !rows.len().is_multiple_of(dims) {
        return Err(wrong(
            "rows",
            &format!("{} numbers", rows.len()),
            &format!("points of {dims} coordinates"),
        ));
    }
    let excess = |row: &[f64]| {
        product_excess(row.iter().zip(weights).map(|(&x, weight)| weight * Space::Walsh.omega(x)))
    };
    Ok(mean((rows.len() / dims) as u64, rows.chunks_exact(dims).map(excess)))
}

/// Π (1 + a) − 1, without forming the product.
fn product_excess(factors: impl Iterator<Item = f64>) -> f64 {
    factors.fold(0.0, |excess, a| a.mul_add(1.0 + excess, excess))
}

/// The mean of some numbers, with what rounding loses added in the end (A. Neumaier, ZAMM 54, 39-51, 1974).
fn mean(count: u64, numbers: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    for number in numbers {
        let next = sum + number;
        lost += if sum.abs() >= number.abs() { (sum - next) + number } else { (number - next) + sum };
        sum = next;
    }
    (sum + lost) / count as f64
}

fn add_modulo(a: u64, b: u64, n: u64) -> u64 {
    if a >= n - b { a - (n - b) } else { a + b }
}

/// Refuses what has no error.
pub(crate) fn check(z: &[u64], n: u64, weights: &[f64], space: Space) -> Result<(), Error> {
    if n == 0 {
        return Err(wrong("n", "0", "at least 1"));
    }
    if let Space::Korobov(alpha) = space
        && ![2, 4, 6].contains(&alpha)
    {
        return Err(wrong("smoothness", &alpha.to_string(), "2, 4 or 6"));
    }
    if z.is_empty() || z.len() != weights.len() {
        let allowed = format!("one for each of {} coordinates, of which there is at least one", z.len());
        return Err(wrong("weights", &format!("{} numbers", weights.len()), &allowed));
    }
    match weights.iter().find(|weight| !(weight.is_finite() && **weight >= 0.0)) {
        Some(weight) => Err(wrong("weights", &weight.to_string(), "finite and not negative")),
        None => Ok(()),
    }
}

pub(crate) fn wrong(name: &str, asked: &str, allowed: &str) -> Error {
    Error::Quality(format!("{name} must be {allowed}, not {asked}"))
}
