//! The sum over all pairs of points of a product over coordinates: every pair once, many at a time.
//!
//! O(n² d / 2). Blocks of points against blocks of points, sixteen partners together; each block has a sum of its own and the
//! sums are added in a fixed order, so that neither threads nor instruction sets change a bit.

use std::marker::PhantomData;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::shapes::Shape;
use crate::instruction_sets::for_this_machine;

/// Partners that are treated together.
const LANES: usize = 16;

/// Points of a block: their numbers stay in the first cache.
const BLOCK: usize = 256;

/// The numbers a and b of all points, coordinate by coordinate, and g of each coordinate, for factors of one shape.
pub(super) struct Columns<S> {
    pub(super) n: usize,
    /// For each coordinate all a, filled up to whole lanes, then all b.
    numbers: Vec<f64>,
    pub(super) g: Vec<f64>,
    shape: PhantomData<S>,
}

impl<S: Shape> Columns<S> {
    /// `number(i, j)` gives a and b of coordinate j of point i.
    pub(super) fn new(n: usize, g: Vec<f64>, number: impl Fn(usize, usize) -> [f64; 2]) -> Self {
        let stride = n.next_multiple_of(LANES);
        let mut numbers = vec![0.0; 2 * stride * g.len()];
        for (dim, column) in numbers.chunks_exact_mut(2 * stride).enumerate() {
            for i in 0..n {
                [column[i], column[stride + i]] = number(i, dim);
            }
        }
        Self { n, numbers, g, shape: PhantomData }
    }

    /// All a and all b of a coordinate.
    #[inline(always)]
    fn column(&self, dim: usize) -> (&[f64], &[f64]) {
        let stride = self.n.next_multiple_of(LANES);
        self.numbers[2 * stride * dim..][..2 * stride].split_at(stride)
    }

    /// a and b of a coordinate of a point.
    #[inline(always)]
    pub(super) fn number(&self, i: usize, dim: usize) -> [f64; 2] {
        let (a, b) = self.column(dim);
        [a[i], b[i]]
    }
}

/// Σ Π factor over all ordered pairs, those of a point with itself included.
pub(super) fn sum_over_pairs<S: Shape>(columns: &Columns<S>, workers: NonZeroUsize) -> f64 {
    let blocks = columns.n.div_ceil(BLOCK);
    let tasks: Vec<[usize; 2]> = (0..blocks).flat_map(|i| (i..blocks).map(move |j| [i, j])).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some((task, &[i, j])) = {
            let task = next.fetch_add(1, Ordering::Relaxed);
            tasks.get(task).map(|blocks| (task, blocks))
        } {
            let mut sum = 0.0;
            sum_of_blocks(columns, i * BLOCK, j * BLOCK, &mut sum);
            done.push((task, if i == j { sum } else { 2.0 * sum }));
        }
        done
    };
    let mut sums = vec![0.0; tasks.len()];
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..workers.get().min(tasks.len())).map(|_| scope.spawn(work)).collect();
        let mut done = work();
        done.extend(others.into_iter().flat_map(|other| other.join().expect("sums cannot fail")));
        for (task, sum) in done {
            sums[task] = sum;
        }
    });
    pairwise(&sums)
}

/// The sum, with the rounding error of a balanced tree.
pub(super) fn pairwise(numbers: &[f64]) -> f64 {
    if numbers.len() <= 8 {
        return numbers.iter().sum();
    }
    let (left, right) = numbers.split_at(numbers.len() / 2);
    pairwise(left) + pairwise(right)
}

for_this_machine! {
    /// The sum of a block of points that begins at `i`, with one that begins at `j`.
    sum_of_blocks = blocks <S: Shape> (columns: &Columns<S>, i: usize, j: usize, out: &mut f64)
}

#[inline(always)]
fn blocks<S: Shape>(columns: &Columns<S>, i: usize, j: usize, out: &mut f64) {
    let (i_end, j_end) = ((i + BLOCK).min(columns.n), (j + BLOCK).min(columns.n));
    let mut sums = [0.0; LANES];
    for own in i..i_end {
        for start in (j..j_end).step_by(LANES) {
            let products = products(columns, own, start);
            if start + LANES <= j_end {
                for lane in 0..LANES {
                    sums[lane] += products[lane];
                }
            } else {
                for lane in 0..j_end - start {
                    sums[lane] += products[lane];
                }
            }
        }
    }
    *out = pairwise(&sums);
}

/// The products of one point with the next lanes of others.
#[inline(always)]
fn products<S: Shape>(columns: &Columns<S>, own: usize, start: usize) -> [f64; LANES] {
    let mut products = [1.0; LANES];
    for (dim, &g) in columns.g.iter().enumerate() {
        let (a, b) = columns.column(dim);
        let mine = [a[own], b[own]];
        let (a, b): (&[f64; LANES], &[f64; LANES]) = (
            a[start..][..LANES].try_into().expect("whole lanes"),
            b[start..][..LANES].try_into().expect("whole lanes"),
        );
        for lane in 0..LANES {
            products[lane] *= S::factor(mine, [a[lane], b[lane]], g);
        }
    }
    products
}
