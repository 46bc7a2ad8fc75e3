//! The search for Korobov lattices {k (1, a, a², …) / n}: one number a instead of a vector.

use crate::Error;
use crate::quality::lattice_criteria::{Space, squared_error};
use crate::seed::mix;

/// The generating vector (1, a, a², …) modulo n.
pub fn powers(a: u64, n: u64, dims: usize) -> Vec<u64> {
    let next = |power: &u64| Some((u128::from(*power) * u128::from(a) % u128::from(n)) as u64);
    std::iter::successors(Some(1 % n), next).take(dims).collect()
}

/// The best of `candidates` numbers a for the weights, which say how many coordinates are looked at.
///
/// If there are no more units modulo n than `candidates`, all are tried, otherwise a fixed selection of them. In time
/// n · d · candidates.
///
/// # Errors
/// If `n` is 0, or the weights are none, negative or not finite.
pub fn search(n: u64, weights: &[f64], space: Space, candidates: u64) -> Result<u64, Error> {
    let all = n / 2 < candidates;
    let numbers = if all { 1..n / 2 + 2 } else { 0..u64::MAX };
    let tried = numbers
        .map(|i| if all { i } else { mix(n.wrapping_add(i)) % n })
        .filter(|a| coprime(*a, n))
        .take(candidates as usize);
    let mut best = (f64::INFINITY, 1);
    for a in tried {
        let error = squared_error(&powers(a, n, weights.len()), n, weights, space)?;
        if error < best.0 * (1.0 - 1e-12) {
            best = (error, a);
        }
    }
    Ok(best.1)
}

/// Whether two numbers have no common divisor but 1.
pub fn coprime(mut a: u64, mut b: u64) -> bool {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}
