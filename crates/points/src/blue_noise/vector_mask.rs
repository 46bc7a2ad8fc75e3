//! Dither masks of vectors: pixels near each other have vectors far from each other.
//!
//! I. Georgiev and M. Fajardo, *Blue-noise dithered sampling*, SIGGRAPH Talks (2016). The energy is a sum over pairs of pixels of
//! e^(−|p − q|² / σ²) · e^(−|v(p) − v(q)|^(d/2)); the vectors of two random pixels are exchanged where that makes it smaller. It starts
//! from a mask by void and cluster in each channel. These alone are better for what depends on the channels one by one;
//! exchanges are for what depends on all of them together, and cost the channels some of their blue.

use std::num::NonZeroUsize;

use super::decay::decay;
use super::{MOST_DIMS, void_and_cluster};
use crate::instruction_sets::for_this_machine;
use crate::seed::mix;
use crate::{Error, Seed};

/// The width of the window in pixels.
const SIGMA: f64 = 2.1;

/// Where the window ends, in pixels to each side.
const REACH: usize = 6;

/// The most pixels of a window.
const WINDOW: usize = (2 * REACH + 1).pow(2);

/// Values (rank + 1/2) / pixels, channel after channel; for each pixel as many exchanges are tried as `tries` says.
///
/// ```
/// use evenlight_points::{Seed, blue_noise::vector_mask::planes};
/// let planes = planes([8, 8], 2, 16, Seed::new(1), std::num::NonZero::<usize>::MIN)?;
/// assert_eq!(planes.len(), 2 * 8 * 8);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// As [`void_and_cluster::ranks`], or if there are not 1 to 8 channels.
pub fn planes(
    sizes: [usize; 2],
    channels: usize,
    tries: u32,
    seed: Seed,
    workers: NonZeroUsize,
) -> Result<Vec<f64>, Error> {
    if !(1..=MOST_DIMS).contains(&channels) {
        return Err(Error::BlueNoise(format!("a mask has 1 to {MOST_DIMS} channels, not {channels}")));
    }
    let mask = |channel: usize| void_and_cluster::ranks(sizes[0], sizes[1], seed.dimension(channel as u64));
    let mut masks = Vec::with_capacity(channels);
    for first in (0..channels).step_by(workers.get()) {
        let last = (first + workers.get()).min(channels);
        masks.extend(std::thread::scope(|scope| {
            let threads: Vec<_> =
                (first + 1..last).map(|channel| scope.spawn(move || mask(channel))).collect();
            let others = threads.into_iter().map(|thread| thread.join().expect("a mask has no way to fail"));
            [mask(first)].into_iter().chain(others.collect::<Vec<_>>()).collect::<Vec<_>>()
        }));
    }
    let pixels = (sizes[0] * sizes[1]) as f64;
    let mut values = Vec::with_capacity(channels * sizes[0] * sizes[1]);
    for ranks in masks {
        values.extend(ranks?.into_iter().map(|rank| (f64::from(rank) + 0.5) / pixels));
    }
    if channels > 1 {
        exchange(sizes, channels, &mut values, tries, seed);
    }
    Ok(values)
}

/// Tries exchanges, one after the other.
fn exchange(sizes: [usize; 2], channels: usize, values: &mut [f64], tries: u32, seed: Seed) {
    let pixels = sizes[0] * sizes[1];
    let window = Window::new(sizes);
    let key = seed.split(0, 2).bits64();
    for number in 0..u64::from(tries) * pixels as u64 {
        let words = mix(key.wrapping_add(number));
        let below = |word: u64| (((word & 0xffff_ffff) * pixels as u64) >> 32) as usize;
        let (a, b) = (below(words), below(words >> 32));
        if a != b && window.change([a, b], channels, values) < 0.0 {
            (0..channels).for_each(|channel| values.swap(channel * pixels + a, channel * pixels + b));
        }
    }
}

/// The pixels near each pixel, none of them twice.
struct Window {
    sizes: [usize; 2],
    /// Offsets of rows and of columns, from above and from the left.
    offsets: [Vec<usize>; 2],
    /// e^(−|p − q|² / σ²) of each pixel of the window, 0 in the middle.
    weights: Vec<f64>,
}

impl Window {
    fn new(sizes: [usize; 2]) -> Self {
        let offsets = sizes.map(|size| {
            let (before, after) = (REACH.min((size - 1) / 2), REACH.min(size / 2));
            (size - before..=size + after).map(|offset| offset % size).collect::<Vec<_>>()
        });
        let along = |axis: usize, offset: usize| (offset.min(sizes[axis] - offset) as f64 / SIGMA).powi(2);
        let weight = |row: usize, column: usize| {
            let far = along(0, row) + along(1, column);
            if far > 0.0 { decay(far) } else { 0.0 }
        };
        let weights =
            offsets[0].iter().flat_map(|&row| offsets[1].iter().map(move |&column| weight(row, column)));
        Self { sizes, weights: weights.collect(), offsets }
    }

    /// What exchanging the vectors of two pixels adds to the energy.
    fn change(&self, pixels: [usize; 2], channels: usize, values: &[f64]) -> f64 {
        let size = self.sizes[0] * self.sizes[1];
        let vector = |pixel: usize| {
            let mut vector = [0.0; MOST_DIMS];
            (0..channels).for_each(|channel| vector[channel] = values[channel * size + pixel]);
            vector
        };
        let [a, b] = pixels;
        let vectors = [vector(a), vector(b)];
        let mut near = vec![[0.0; WINDOW]; channels];
        let mut energies = [[0.0; 2]; 2];
        for ((pixel, other), energies) in [(a, b), (b, a)].into_iter().zip(&mut energies) {
            let mut weights = [0.0; WINDOW];
            weights[..self.weights.len()].copy_from_slice(&self.weights);
            self.look(pixel, other, values, &mut near, &mut weights);
            pair_energies(&near, &weights, &vectors, energies);
        }
        energies[0][1] - energies[0][0] + energies[1][0] - energies[1][1]
    }

    /// Copies the values around a pixel, and takes the weight of another one away, which stays as far as it is.
    fn look(
        &self,
        pixel: usize,
        other: usize,
        values: &[f64],
        near: &mut [[f64; WINDOW]],
        weights: &mut [f64],
    ) {
        let [rows, columns] = self.sizes;
        let (row, column) = (pixel / columns, pixel % columns);
        let mut place = 0;
        for down in &self.offsets[0] {
            let first = (row + down) % rows * columns;
            for across in &self.offsets[1] {
                let at = column + across;
                let at = first + if at < columns { at } else { at - columns };
                for (near, plane) in near.iter_mut().zip(values.chunks_exact(rows * columns)) {
                    near[place] = plane[at];
                }
                if at == other {
                    weights[place] = 0.0;
                }
                place += 1;
            }
        }
    }
}

for_this_machine! {
    /// The energies that two vectors would have in the middle of a window.
    pair_energies = pair_energies_body(
        near: &[[f64; WINDOW]], weights: &[f64; WINDOW], vectors: &[[f64; MOST_DIMS]; 2], out: &mut [f64; 2]
    )
}

#[inline(always)]
fn pair_energies_body(
    near: &[[f64; WINDOW]],
    weights: &[f64; WINDOW],
    vectors: &[[f64; MOST_DIMS]; 2],
    out: &mut [f64; 2],
) {
    for (vector, out) in vectors.iter().zip(out) {
        let mut squares = [0.0; WINDOW];
        for (near, value) in near.iter().zip(vector) {
            for (square, x) in squares.iter_mut().zip(near) {
                *square += (x - value) * (x - value);
            }
        }
        for (square, weight) in squares.iter_mut().zip(weights) {
            *square = weight * decay(power(*square, near.len()));
        }
        *out = squares.iter().sum();
    }
}

/// s^(d/4), by square roots.
#[inline(always)]
fn power(s: f64, d: usize) -> f64 {
    let root = s.sqrt();
    let part = match d % 4 {
        0 => 1.0,
        1 => root.sqrt(),
        2 => root,
        _ => root * root.sqrt(),
    };
    (0..d / 4).fold(part, |product, _| product * s)
}
