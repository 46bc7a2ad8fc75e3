//! `gaussian`: points that repel each other until no Gaussian blur sees a difference between them and an even gray.
//!
//! A. Ahmed, J. Ren and P. Wonka, *Gaussian blue noise*, ACM Trans. Graph. 41(6), 260 (2022). The energy is the sum of a Gaussian of
//! the distance over all pairs on the torus, in frequencies the power below the principal frequency; steps go down its
//! gradient from independent points. Not progressive, but the spectrum is the cleanest of all, in any dimension. O(n) for a
//! step in few dimensions: each point meets those within five widths.

use std::num::NonZeroUsize;

use super::decay::decay;
use super::torus::{Buckets, squared_distance};
use super::{Entry, MOST_DIMS, Request, cloud};
use crate::Error;

pub(super) const ENTRY: Entry = Entry {
    name: "gaussian",
    cite: "Ahmed, Ren & Wonka 2022, Gaussian blue noise, ACM Trans. Graph. 41(6)",
    progressive: false,
    effort: ("steps", 200),
    points,
};

/// The width of the Gaussian, in units of the side of a point's share of the torus: wider ones leave points that touch, narrower ones
/// crystals.
const WIDTH: f64 = 0.6;

/// Where the Gaussian is cut off, in widths.
const REACH: f64 = 5.0;

/// The least number of points for a thread.
const LEAST: usize = 1 << 10;

fn points(request: &Request) -> Vec<f64> {
    let mut x = cloud(request, request.n);
    descend(&mut x, request.dims, request.effort, request.workers);
    x
}

/// Moves row-major points of the torus in steps down the gradient.
///
/// # Errors
/// If there are not 1 to [`MOST_DIMS`] dimensions, or a number is not in [0, 1).
pub fn relax(x: &mut Vec<f64>, dims: usize, steps: u32, workers: NonZeroUsize) -> Result<(), Error> {
    if !(1..=MOST_DIMS).contains(&dims) {
        return Err(Error::BlueNoise(format!("blue noise has 1 to {MOST_DIMS} dimensions, not {dims}")));
    }
    if let Some(wrong) = x.iter().find(|x| !(0.0..1.0).contains(*x)) {
        return Err(Error::BlueNoise(format!("points of the torus are in [0, 1), not at {wrong}")));
    }
    descend(x, dims, steps, workers);
    Ok(())
}

fn descend(x: &mut Vec<f64>, dims: usize, steps: u32, workers: NonZeroUsize) {
    let n = x.len() / dims;
    let width = WIDTH * (n as f64).powf(-1.0 / dims as f64);
    // half of the longest step that the waves of a dense set allow
    let stride = 1.0 / (std::f64::consts::TAU * WIDTH * WIDTH).powf(0.5 * dims as f64).max(1.0);
    for _ in 0..steps {
        let mut buckets = Buckets::new(dims, n, f64::MIN_POSITIVE);
        x.chunks_exact(dims).for_each(|x| buckets.insert(x));
        let field = Field { x, dims, buckets, width, stride };
        *x = field.moved(workers);
    }
}

/// All points, and how they act on each other.
struct Field<'a> {
    x: &'a [f64],
    dims: usize,
    buckets: Buckets,
    width: f64,
    stride: f64,
}

impl Field<'_> {
    /// Where all points go in one step.
    fn moved(&self, workers: NonZeroUsize) -> Vec<f64> {
        let mut moved = self.x.to_vec();
        let n = moved.len() / self.dims;
        let share = n.div_ceil((n / LEAST).clamp(1, workers.get())).max(1) * self.dims;
        std::thread::scope(|scope| {
            let mut parts = moved.chunks_mut(share);
            let first = parts.next();
            parts.for_each(|part| drop(scope.spawn(|| self.move_part(part))));
            if let Some(part) = first {
                self.move_part(part);
            }
        });
        moved
    }

    fn move_part(&self, part: &mut [f64]) {
        for x in part.chunks_exact_mut(self.dims) {
            let push = self.push(x);
            for (x, push) in x.iter_mut().zip(push) {
                let sum = *x + self.stride * push;
                // rounding may lead to 1
                *x = Some(sum - sum.floor()).filter(|&x| x < 1.0).unwrap_or(0.0);
            }
        }
    }

    /// The sum of what all points near a place push it.
    fn push(&self, place: &[f64]) -> [f64; MOST_DIMS] {
        let mut push = [0.0; MOST_DIMS];
        let scale = 0.5 / (self.width * self.width);
        self.buckets.any(place, REACH * self.width, |other| {
            let other = &self.x[other * self.dims..][..self.dims];
            let far = squared_distance(place, other) * scale;
            if far < 0.5 * REACH * REACH {
                let strength = decay(far);
                for ((push, a), b) in push.iter_mut().zip(place).zip(other) {
                    let away = a - b;
                    *push += strength * (away - away.round_ties_even());
                }
            }
            false
        });
        push
    }
}
