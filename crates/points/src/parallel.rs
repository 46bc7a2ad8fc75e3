//! Filling one array with several threads.
//!
//! Every point is a function of its index, so each thread makes a range of rows of its own: the bits are
//! the same for any number of threads. Worth it from about 2^16 coordinates on, below which starting a
//! thread takes longer than the points.

use std::num::NonZeroUsize;
use std::ops::Range;

use crate::PointSet;
use crate::point_set::check_length;

/// [`PointSet::fill`] with up to `workers` threads.
///
/// ```
/// use evenlight_points::scramble::Randomization;
/// use evenlight_points::sequences::{self, Spec};
/// use evenlight_points::{Seed, fill_parallel};
/// let points = sequences::build("sobol", &Spec::new(3, Randomization::Owen, Seed::new(7)))?;
/// let (mut alone, mut together) = (vec![0.0; 3 * 1000], vec![0.0; 3 * 1000]);
/// points.fill(5..1005, &mut alone);
/// fill_parallel(&*points, 5..1005, &mut together, 4.try_into().unwrap());
/// assert_eq!(alone, together);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Panics
/// If `out` does not have `dims()` places for each row.
pub fn fill_parallel(points: &dyn PointSet, rows: Range<u64>, out: &mut [f64], workers: NonZeroUsize) {
    check_length(&rows, points.dims(), out.len());
    in_parts(points.dims(), rows, out, workers, |rows, part| points.fill(rows, part));
}

/// [`PointSet::fill_f32`] with up to `workers` threads.
///
/// # Panics
/// If `out` does not have `dims()` places for each row.
pub fn fill_parallel_f32(points: &dyn PointSet, rows: Range<u64>, out: &mut [f32], workers: NonZeroUsize) {
    check_length(&rows, points.dims(), out.len());
    in_parts(points.dims(), rows, out, workers, |rows, part| points.fill_f32(rows, part));
}

/// The least number of coordinates for a thread.
const LEAST: u64 = 1 << 15;

/// Parts begin at multiples of a power of two of rows, where the tables of a net begin.
const GRAIN: u64 = 1 << 10;

/// Calls `fill` for parts of the rows, each in a thread of its own but for the last.
fn in_parts<T: Send>(
    dims: usize,
    rows: Range<u64>,
    out: &mut [T],
    workers: NonZeroUsize,
    fill: impl Fn(Range<u64>, &mut [T]) + Sync,
) {
    let useful = (out.len() as u64 / LEAST).clamp(1, workers.get() as u64);
    let share = (rows.end.saturating_sub(rows.start)).div_ceil(useful);
    let share = if share > GRAIN { share.next_multiple_of(GRAIN) } else { share };
    let (mut start, mut rest) = (rows.start, out);
    std::thread::scope(|scope| {
        while rows.end - start > share {
            let (part, later) = rest.split_at_mut(share as usize * dims);
            let fill = &fill;
            scope.spawn(move || fill(start..start + share, part));
            (start, rest) = (start + share, later);
        }
        fill(start..rows.end, rest);
    });
}
