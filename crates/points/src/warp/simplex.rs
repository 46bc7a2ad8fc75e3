//! The cube to a simplex of any dimension: barycentric coordinates, uniform over their simplex.
//!
//! Each number breaks a piece off the rest of a stick; the rest is the power of the number that makes all divisions alike.
//! One to one and smooth inside; density with respect to all coordinates but the first.

use super::rows::{Rows, Sizes};
use super::{Entry, Real, options};

pub(super) const ENTRY: Entry = Entry {
    name: "simplex",
    cite: "K.-T. Fang and Y. Wang, Number-theoretic methods in statistics, chapter 1.5 (1994)",
    takes: &["dims"],
    folds: false,
    build: |options| match options.dims {
        Some(dims @ 1..=64) => Ok(Box::new(Simplex { dims })),
        Some(other) => Err(options::refused("simplex", "dims", other, "from 1 to 64")),
        None => Err(options::missing("simplex", "dims", "from 1 to 64")),
    },
};

/// Barycentric coordinates of a simplex with `dims + 1` corners.
#[derive(Clone, Copy, Debug)]
struct Simplex {
    dims: usize,
}

impl Sizes for Simplex {
    fn inputs(&self) -> usize {
        self.dims
    }
    fn outputs(&self) -> usize {
        self.dims + 1
    }
}

impl<T: Real> Rows<T> for Simplex {
    fn map(&self, u: &[T], x: &mut [T]) {
        for (u, x) in u.chunks_exact(self.dims).zip(x.chunks_exact_mut(self.dims + 1)) {
            let mut rest = 1.0;
            for (i, u) in u.iter().enumerate() {
                let kept = u.wide().powf(1.0 / (self.dims - i) as f64);
                x[i] = T::of(rest * (1.0 - kept));
                rest *= kept;
            }
            x[self.dims] = T::of(rest);
        }
    }

    fn density(&self, x: &[T], density: &mut [T]) {
        let factorial: f64 = (1..=self.dims).map(|k| k as f64).product();
        let least = -T::of(4.0) * T::EPSILON;
        for (x, density) in x.chunks_exact(self.dims + 1).zip(density) {
            *density = T::of(if x.iter().all(|&x| x >= least) { factorial } else { 0.0 });
        }
    }

    fn invert(&self, x: &[T], u: &mut [T]) {
        for (u, x) in u.chunks_exact_mut(self.dims).zip(x.chunks_exact(self.dims + 1)) {
            // what is left from each corner on, summed from the end, where it is small
            let mut after = x[self.dims].wide();
            for i in (0..self.dims).rev() {
                let from = after + x[i].wide();
                let kept = if from > 0.0 { after / from } else { 0.0 };
                u[i] = T::of(kept.powi((self.dims - i) as i32));
                after = from;
            }
        }
    }
}
