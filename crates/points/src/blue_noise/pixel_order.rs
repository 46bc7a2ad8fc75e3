//! Places of pixels in one sequence for a whole image, so that the error is blue noise on the screen.
//!
//! A. Ahmed and P. Wonka, *Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering of pixels*, ACM
//! Trans. Graph. 39(6), 244 (2020). Pixels are numbered along the Morton or the Hilbert curve of the smallest square of side 2^k
//! that holds the image; pixel p takes the samples p · spp to (p + 1) · spp − 1 of one (t, s)-sequence. The four pixels of a
//! square, the sixteen of the next and so on share a net, so that their errors cancel. At every node of the tree of squares the
//! four children change places at random, so that no pattern of the curve is left.

use super::super::warp::curve::{Grid, named};
use crate::scramble::Randomization;
use crate::warp::triangle::scramble::Scramble;
use crate::{Error, Seed};

/// The largest side of an image, in binary digits.
const MOST_BITS: u32 = 16;

/// The place of each pixel, row by row: below 4^k for an image that fits in a square of side 2^k. The children of each square
/// change places as `shuffle` says, or not at all.
///
/// ```
/// use evenlight_points::blue_noise::pixel_order::places;
/// assert_eq!(places("morton", [2, 2], None)?, [0, 1, 2, 3]);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// If the curve is unknown or the image has no pixel or a side of more than 2^16.
pub fn places(curve: &str, [rows, columns]: [usize; 2], shuffle: Option<Seed>) -> Result<Vec<u64>, Error> {
    let curve = named(curve)
        .ok_or_else(|| Error::BlueNoise(format!("unknown curve '{curve}'; known: hilbert, morton, gray")))?;
    let most = 1 << MOST_BITS;
    if !(1..=most).contains(&rows) || !(1..=most).contains(&columns) {
        let message = format!("an image has sides from 1 to {most}, not {rows} times {columns}");
        return Err(Error::BlueNoise(message));
    }
    let bits = rows.max(columns).next_power_of_two().ilog2().max(1);
    let grid = Grid { dims: 2, bits };
    let cells: Vec<u32> =
        (0..rows as u32).flat_map(|row| (0..columns as u32).flat_map(move |column| [row, column])).collect();
    let mut places = vec![0; rows * columns];
    (curve.indices)(grid, &cells, &mut places);
    if let Some(seed) = shuffle {
        let scramble = Scramble::new("pixel order", Randomization::Owen, seed)?;
        let unused = 64 - grid.digits();
        for place in &mut places {
            *place = scramble.apply(*place << unused, 0) >> unused;
        }
    }
    Ok(places)
}
