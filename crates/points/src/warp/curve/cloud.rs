//! The order of a cloud that has no bounds along Hilbert's curve; on a line, that of its numbers.
//!
//! Coordinates are standardized and squeezed into the unit cube, so that no point far away makes all others one cell (as M. Gerber
//! and N. Chopin do, *Sequential quasi Monte Carlo*, J. R. Stat. Soc. B 77(3), 509-579, 2015). The squeeze
//! (1 + z / √(z² + π / 2)) / 2 has the slope of the normal distribution function in the middle, and takes no function whose
//! last digit depends on the machine.

use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroUsize;

use super::Grid;
use super::sort::{self, Frame};
use crate::warp::hilbert;

/// The places of row-major points, first to last.
///
/// # Panics
/// If there are no dimensions or too many, or 2^32 points or more.
pub fn order(dims: usize, x: &[f64]) -> Vec<u32> {
    let grid = Grid::finest(dims);
    let along = |frame: &Frame, x: &[f64]| sort::order(&hilbert::CURVE, grid, frame, x, NonZeroUsize::MIN);
    if dims == 1 {
        let lower = x.iter().copied().fold(f64::INFINITY, f64::min);
        let upper = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        return along(&Frame::new(grid, &[lower], &[upper]), x);
    }
    along(&Frame::new(grid, &vec![0.0; dims], &vec![1.0; dims]), &squeezed(dims, x))
}

/// All coordinates in (0, 1).
fn squeezed(dims: usize, x: &[f64]) -> Vec<f64> {
    let count = (x.len() / dims) as f64;
    let mut mean = vec![0.0; dims];
    for row in x.chunks_exact(dims) {
        mean.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
    }
    for sum in &mut mean {
        *sum /= count;
    }
    let mut square = vec![0.0; dims];
    for row in x.chunks_exact(dims) {
        square.iter_mut().zip(row).zip(&mean).for_each(|((sum, x), mean)| *sum += (x - mean) * (x - mean));
    }
    // z / √(z² + π / 2), multiplied by the spread above and below
    for sum in &mut square {
        *sum *= FRAC_PI_2 / count;
    }
    let mut out = x.to_vec();
    for row in out.chunks_exact_mut(dims) {
        for ((x, mean), square) in row.iter_mut().zip(&mean).zip(&square) {
            let away = *x - mean;
            *x = 0.5 + 0.5 * away / (away * away + square).sqrt();
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Seed;

    #[test]
    fn numbers_are_in_ascending_order_and_equal_ones_keep_theirs() {
        assert_eq!(order(1, &[2.0, -1e300, 2.0, 0.5, f64::MIN_POSITIVE]), [1, 4, 3, 0, 2]);
        assert_eq!(order(1, &[7.0; 5]), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn the_order_of_a_cloud_depends_on_its_shape_alone() {
        let unit = |i: u64| Seed::new(5).dimension(i).bits64() as f64 / 2f64.powi(64);
        let cloud: Vec<f64> = (0..3000).map(unit).collect();
        let moved: Vec<f64> =
            cloud.chunks(3).flat_map(|x| [8.0 * x[0] - 4.0, 0.25 * x[1], x[2] + 1.0]).collect();
        let mut found = order(3, &cloud);
        // rounding moves hardly any point across the side of a cell
        let same = found.iter().zip(order(3, &moved)).filter(|(a, b)| **a == *b).count();
        assert!(same > 990, "{same}");
        found.sort_unstable();
        assert!(found.into_iter().eq(0..1000));
    }

    #[test]
    fn a_flat_cloud_has_an_order() {
        assert_eq!(order(2, &[1.0, 0.0, 1.0, 2.0, 1.0, 1.0]).len(), 3);
    }
}
