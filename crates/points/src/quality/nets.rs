//! Are these points a net? Counting in all elementary intervals, and gain coefficients.
//!
//! An elementary interval in base b is a box whose side in coordinate j is a b-adic interval of length `b^{−k_j}`. b^m points are a
//! (t, m, s)-net if every elementary interval of volume b^{t−m} has b^t of them (H. Niederreiter, *Point sets and sequences with small
//! discrepancy*, Monatsh. Math. 104, 1987).
//!
//! Under a nested uniform scramble the variance of the mean is Σ Γ σ² / n, where σ² are parts of the integrand's variance, one for
//! each vector of levels k over a set u of coordinates, and the gain coefficients Γ depend on the points alone; independent points
//! have Γ = 1 (A. Owen, *Monte Carlo variance of scrambled net quadrature*, SIAM J. Numer. Anal. 34, 1997).

use super::Rows;
use crate::Error;

/// Numbers of the elementary intervals of a coordinate, at every level.
struct Digits {
    base: u32,
    n: usize,
    dims: usize,
    /// ⌊x b^levels⌋, coordinate by coordinate.
    finest: Vec<u64>,
    levels: u32,
}

impl Digits {
    fn new(rows: &Rows<'_>, base: u32, levels: u32) -> Result<Self, Error> {
        if base < 2 {
            return Err(Error::Quality(format!("a base must be at least 2, not {base}")));
        }
        let cells = u64::from(base).checked_pow(levels).filter(|&cells| cells < 1 << 50);
        let Some(cells) = cells else {
            return Err(Error::Quality(format!(
                "{levels} digits in base {base} are more than a number can hold"
            )));
        };
        let (n, dims) = (rows.len(), rows.dims());
        let cell = |x: f64| {
            // a multiple of b^-levels may have been rounded down: in any base but 2 it is no binary fraction
            let scaled = x * cells as f64;
            let near = scaled.round();
            let whole =
                if (near - scaled).abs() <= near * 4.0 * f64::EPSILON { near } else { scaled.floor() };
            (whole as u64).min(cells - 1)
        };
        let finest = (0..dims).flat_map(|dim| rows.iter().map(move |row| cell(row[dim]))).collect();
        Ok(Self { base, n, dims, finest, levels })
    }

    /// For every point a number that tells the boxes apart that have these levels, or None for no split at all.
    fn boxes(&self, levels: &[u32]) -> Result<Vec<u64>, Error> {
        let mut numbers = vec![0_u64; self.n];
        let mut boxes = 1_u64;
        for (dim, &level) in levels.iter().enumerate().filter(|(_, level)| **level > 0) {
            let side = u64::from(self.base).pow(level);
            let coarser = u64::from(self.base).pow(self.levels - level);
            let column = &self.finest[dim * self.n..][..self.n];
            boxes = boxes
                .checked_mul(side)
                .ok_or_else(|| Error::Quality("too many elementary intervals".into()))?;
            for (number, &finest) in numbers.iter_mut().zip(column) {
                *number = *number * side + finest / coarser;
            }
        }
        Ok(numbers)
    }

    /// Σ (points in a box)² over all boxes of these levels.
    fn squares(&self, levels: &[u32]) -> Result<f64, Error> {
        let mut numbers = self.boxes(levels)?;
        numbers.sort_unstable();
        Ok(numbers.chunk_by(|a, b| a == b).map(|same| (same.len() as f64).powi(2)).sum())
    }

    /// Whether all boxes of these levels have the same number of points.
    fn even(&self, levels: &[u32]) -> Result<bool, Error> {
        let share =
            self.n / usize::try_from(u64::from(self.base).pow(levels.iter().sum())).unwrap_or(usize::MAX);
        let mut numbers = self.boxes(levels)?;
        numbers.sort_unstable();
        let mut same = numbers.chunk_by(|a, b| a == b);
        Ok(share > 0 && same.all(|same| same.len() == share))
    }
}

/// The smallest t such that the points are a (t, m, s)-net in some base: their number must be a power b^m of it.
///
/// Counts in every elementary interval, for points of any origin: O(n log n) for each of the `C(k + s − 1, s − 1)` shapes of volume
/// b^{−k}, k from 1 to m − t + 1.
///
/// ```
/// use evenlight_points::quality::{Rows, nets::smallest_t};
/// let hammersley = [0.0, 0.0, 0.25, 0.5, 0.5, 0.25, 0.75, 0.75];
/// assert_eq!(smallest_t(&Rows::new(&hammersley, 2)?, 2)?, 0);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn smallest_t(rows: &Rows<'_>, base: u32) -> Result<u32, Error> {
    let (n, mut m) = (rows.len() as u64, 0);
    while u64::from(base.max(2)).pow(m) < n {
        m += 1;
    }
    if u64::from(base.max(2)).pow(m) != n {
        return Err(Error::Quality(format!("a net in base {base} has a power of {base} of points, not {n}")));
    }
    let digits = Digits::new(rows, base, m)?;
    for k in 1..=m {
        let mut levels = vec![0; digits.dims];
        levels[0] = k;
        loop {
            if !digits.even(&levels)? {
                return Ok(m + 1 - k);
            }
            if !next_composition(&mut levels) {
                break;
            }
        }
    }
    Ok(0)
}

/// The next vector of the same sum in reverse lexicographic order; false after the last.
fn next_composition(levels: &mut [u32]) -> bool {
    let last = levels.len() - 1;
    let Some(at) = levels[..last].iter().rposition(|&level| level > 0) else { return false };
    let rest = levels[last];
    levels[last] = 0;
    levels[at] -= 1;
    levels[at + 1] = rest + 1;
    true
}

/// The gain coefficient of the levels k over the coordinates u: `levels[j]` is k for a coordinate of u, and None for others.
///
/// O(2^|u| n log n).
///
/// ```
/// use evenlight_points::quality::{Rows, nets::gain_coefficient};
/// let rows = Rows::new(&[0.0, 0.5], 1)?;
/// assert_eq!(gain_coefficient(&rows, &[Some(0)], 2)?, 0.0); // halves are hit evenly
/// assert_eq!(gain_coefficient(&rows, &[Some(1)], 2)?, 1.0); // quarters as by independent points
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn gain_coefficient(rows: &Rows<'_>, levels: &[Option<u32>], base: u32) -> Result<f64, Error> {
    if levels.len() != rows.dims() {
        return Err(Error::Quality(format!("{} levels for {} dimensions", levels.len(), rows.dims())));
    }
    let chosen: Vec<usize> = (0..levels.len()).filter(|&dim| levels[dim].is_some()).collect();
    if chosen.is_empty() || chosen.len() > 20 {
        return Err(Error::Quality(format!("levels of 1 to 20 coordinates, not of {}", chosen.len())));
    }
    let finest = levels.iter().flatten().max().map_or(0, |level| level + 1);
    let digits = Digits::new(rows, base, finest)?;
    let b = f64::from(base);
    // Π (b 1{same finer interval} − 1{same interval}), multiplied out
    let mut sum = 0.0;
    for finer in 0_u32..1 << chosen.len() {
        let mut boxes = vec![0; digits.dims];
        for (bit, &dim) in chosen.iter().enumerate() {
            boxes[dim] = levels[dim].unwrap_or(0) + (finer >> bit & 1);
        }
        let ones = finer.count_ones() as i32;
        let sign = if (chosen.len() as i32 - ones) % 2 == 0 { 1.0 } else { -1.0 };
        sum += sign * b.powi(ones) * digits.squares(&boxes)?;
    }
    Ok(sum / (rows.len() as f64 * (b - 1.0).powi(chosen.len() as i32)))
}
