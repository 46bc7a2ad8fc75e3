//! Points for renderers: one word from (index, dimension, seed), without tables to build or memory to keep.
//!
//! Everything here works without the standard library (`default-features = false`), in any thread, in
//! any order. A word has its first digit in its most significant bit; [`unit_f32`](crate::convert::unit_f32)
//! makes it a number in [0, 1).
//!
//! ```
//! use evenlight_points::convert::unit_f32;
//! use evenlight_points::scramble::Randomization;
//! use evenlight_points::{PointSet, Seed, sequences::sobol::sobol, stateless};
//! // The same points as those of the sequence, in single precision.
//! let points = sobol(3, Randomization::Owen, Seed::new(7));
//! let mut row = [0.0; 3];
//! points.fill_f32(100..101, &mut row);
//! assert_eq!(row[2], unit_f32(stateless::owen_sobol(100, 2, 7)));
//! ```
//!
//! A path of many dimensions need not use the later ones of Sobol', whose pairs are uneven at few points. *Padding*
//! takes the first few again and again, each time in another order (Burley 2020, section 5):
//!
//! ```
//! use evenlight_points::stateless::{owen_sobol, shuffled};
//! let vertex_number = |index: u32, vertex: u32, dimension: u32, seed: u64| {
//!     let seed = seed << 32 | u64::from(vertex);
//!     owen_sobol(shuffled(index, seed), dimension, seed)
//! };
//! assert_ne!(vertex_number(5, 0, 1, 7), vertex_number(5, 1, 1, 7));
//! ```

use crate::Seed;
pub use crate::data::direction_numbers::direction_numbers;
use crate::owen_hash::{key_64, keyed_64_low, nested_uniform_scramble_32};

/// The dimensions that come from Sobol's matrices.
pub const SOBOL_DIMS: u32 = 256;

/// The tag of the seeds of [`shuffled`].
const ORDER: u64 = 8;

/// Reversed words of the points 2^k, which saves the Owen hash a reversal.
static COLUMNS: [[u32; 32]; SOBOL_DIMS as usize] = {
    let mut columns = [[0; 32]; SOBOL_DIMS as usize];
    let mut dim = 0;
    while dim < columns.len() {
        let wide = direction_numbers(dim);
        let mut k = 0;
        while k < 32 {
            columns[dim][k] = wide[k].reverse_bits() as u32;
            k += 1;
        }
        dim += 1;
    }
    columns
};

/// A coordinate of a Sobol' point with the direction numbers of Joe and Kuo, not randomized.
///
/// # Panics
/// If `dimension` is not below [`SOBOL_DIMS`].
///
/// ```
/// use evenlight_points::stateless::sobol;
/// assert_eq!([sobol(0, 1), sobol(1, 1), sobol(2, 1)], [0, 1 << 31, 3 << 30]);
/// ```
#[inline]
pub fn sobol(index: u32, dimension: u32) -> u32 {
    reversed_sobol(index, dimension).reverse_bits()
}

/// A coordinate of an Owen-scrambled Sobol' point: the first 32 digits of the sequence `sobol` with the scramble
/// `owen` and [`Seed::new(seed)`](Seed::new).
///
/// # Panics
/// If `dimension` is not below [`SOBOL_DIMS`].
///
/// ```
/// use evenlight_points::convert::unit_f32;
/// use evenlight_points::stateless::owen_sobol;
/// let mean = (0..1024).map(|i| unit_f32(owen_sobol(i, 3, 7))).sum::<f32>() / 1024.0;
/// assert!((mean - 0.5).abs() < 1e-4);
/// ```
#[inline]
pub fn owen_sobol(index: u32, dimension: u32, seed: u64) -> u32 {
    let (addend, factor) = key_64(Seed::new(seed).dimension(u64::from(dimension)).bits64());
    keyed_64_low(reversed_sobol(index, dimension), addend as u32, factor as u32).reverse_bits()
}

/// The index in a random order that keeps nets nets: the first 2^k indices become some aligned 2^k indices.
///
/// ```
/// use evenlight_points::stateless::shuffled;
/// let mut low: Vec<u32> = (0..8).map(|i| shuffled(i, 7) % 8).collect();
/// low.sort_unstable();
/// assert_eq!(low, [0, 1, 2, 3, 4, 5, 6, 7]);
/// ```
#[inline]
pub const fn shuffled(index: u32, seed: u64) -> u32 {
    nested_uniform_scramble_32(index, Seed::new(seed).split(ORDER, 0).bits32())
}

#[inline]
fn reversed_sobol(mut index: u32, dimension: u32) -> u32 {
    let columns = &COLUMNS[dimension as usize];
    let mut word = 0;
    while index != 0 {
        word ^= columns[index.trailing_zeros() as usize];
        index &= index - 1;
    }
    word
}
