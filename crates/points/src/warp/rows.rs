//! Warps whose sizes are known at run time only: rows of numbers in, rows of numbers out.
//!
//! One virtual call serves a whole array, so that this costs nothing beside the mathematics.

use std::num::NonZeroUsize;

use super::{Real, Warp};

/// How many numbers a warp takes and gives.
pub trait Sizes: Send + Sync {
    /// Uniform numbers for each point.
    fn inputs(&self) -> usize;
    /// Coordinates of each point.
    fn outputs(&self) -> usize;
}

/// A warp on arrays, row by row.
pub trait Rows<T>: Sizes {
    /// [`Warp::map`] of many rows.
    fn map(&self, u: &[T], x: &mut [T]);
    /// [`Warp::density`] of many rows.
    fn density(&self, x: &[T], density: &mut [T]);
    /// [`Warp::invert`] of many rows.
    fn invert(&self, x: &[T], u: &mut [T]);
}

/// A warp in both precisions.
pub trait AnyRows: Rows<f32> + Rows<f64> {}
impl<W: Rows<f32> + Rows<f64>> AnyRows for W {}

/// A warp of `N` numbers to `M` coordinates, as one on arrays.
#[derive(Clone, Debug)]
pub(crate) struct Fixed<W, const N: usize, const M: usize>(pub(crate) W);

impl<W: Send + Sync, const N: usize, const M: usize> Sizes for Fixed<W, N, M> {
    fn inputs(&self) -> usize {
        N
    }
    fn outputs(&self) -> usize {
        M
    }
}

impl<T: Real, W, const N: usize, const M: usize> Rows<T> for Fixed<W, N, M>
where
    W: Warp<T, N, Point = [T; M]>,
{
    fn map(&self, u: &[T], x: &mut [T]) {
        for (&u, x) in u.as_chunks().0.iter().zip(x.as_chunks_mut().0) {
            *x = self.0.map(u);
        }
    }
    fn density(&self, x: &[T], density: &mut [T]) {
        for (x, density) in x.as_chunks().0.iter().zip(density) {
            *density = self.0.density(x);
        }
    }
    fn invert(&self, x: &[T], u: &mut [T]) {
        for (x, u) in x.as_chunks().0.iter().zip(u.as_chunks_mut().0) {
            *u = self.0.invert(x);
        }
    }
}

/// The least number of rows for a thread.
const LEAST: usize = 1 << 13;

/// Calls `work` for parts of some rows, `from` and `to` numbers each, with up to `workers` threads.
pub fn in_parts<A: Sync, B: Send>(
    (input, from): (&[A], usize),
    (output, to): (&mut [B], usize),
    workers: NonZeroUsize,
    work: impl Fn(&[A], &mut [B]) + Sync,
) {
    let rows = output.len() / to.max(1);
    let share = rows.div_ceil((rows / LEAST).clamp(1, workers.get())).max(1);
    std::thread::scope(|scope| {
        let mut parts = input.chunks(share * from).zip(output.chunks_mut(share * to));
        let last = parts.next_back();
        for (input, output) in parts {
            let work = &work;
            scope.spawn(move || work(input, output));
        }
        if let Some((input, output)) = last {
            work(input, output);
        }
    });
}
