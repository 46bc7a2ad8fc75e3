//! The sum over all pairs of points of a product over coordinates: every pair once, many at a time.
//!
//! O(n² d / 2). Blocks of points against blocks of points: a point meets all partners of a block at once, in plain loops over
//! arrays of one length, which become vector instructions. Every partner has a sum of its own, and sums are added in a fixed
//! order, so that neither threads nor instruction sets change a bit.

use std::marker::PhantomData;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::shapes::Shape;
use crate::instruction_sets::for_this_machine;

/// Points of a block: their numbers stay in the first cache.
const BLOCK: usize = 128;

/// One number for each point of a block.
type Block = [f64; BLOCK];

/// The numbers a and b of all points, coordinate by coordinate, and g of each coordinate, for factors of one shape.
pub(super) struct Columns<S> {
    pub(super) n: usize,
    /// For each coordinate all a, filled up to whole blocks, then all b.
    numbers: Vec<f64>,
    pub(super) g: Vec<f64>,
    shape: PhantomData<S>,
}

impl<S: Shape> Columns<S> {
    /// `number(i, j)` gives a and b of coordinate j of point i.
    pub(super) fn new(n: usize, g: Vec<f64>, number: impl Fn(usize, usize) -> [f64; 2]) -> Self {
        let stride = n.next_multiple_of(BLOCK);
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
        let stride = self.n.next_multiple_of(BLOCK);
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
    let (mut totals, mut products) = ([0.0; BLOCK], [1.0; BLOCK]);
    let dims = columns.g.len();
    let rest = (dims - 1) % CHUNK + 1;
    for own in i..(i + BLOCK).min(columns.n) {
        if dims > CHUNK {
            products = [1.0; BLOCK];
            for dim in (rest..dims).step_by(CHUNK) {
                multiply::<S, CHUNK>(columns, [own, j], dim, &mut products);
            }
        }
        match rest {
            1 => add::<S, 1>(columns, [own, j], &products, &mut totals),
            2 => add::<S, 2>(columns, [own, j], &products, &mut totals),
            3 => add::<S, 3>(columns, [own, j], &products, &mut totals),
            _ => add::<S, CHUNK>(columns, [own, j], &products, &mut totals),
        }
    }
    *out = pairwise(&totals[..(columns.n - j).min(BLOCK)]);
}

/// Coordinates that are treated together, without a product in memory.
const CHUNK: usize = 4;

/// Multiplies by the factors of some coordinates from `dim` on.
#[inline(always)]
fn multiply<S: Shape, const K: usize>(
    columns: &Columns<S>,
    [own, j]: [usize; 2],
    dim: usize,
    products: &mut Block,
) {
    let factors = factors::<S, K>(columns, own, j, dim);
    for (place, product) in products.iter_mut().enumerate() {
        *product *= factors(place);
    }
}

/// Adds the products, times the factors of the first coordinates.
#[inline(always)]
fn add<S: Shape, const K: usize>(
    columns: &Columns<S>,
    [own, j]: [usize; 2],
    products: &Block,
    totals: &mut Block,
) {
    let factors = factors::<S, K>(columns, own, j, 0);
    for (place, total) in totals.iter_mut().enumerate() {
        *total += products[place] * factors(place);
    }
}

/// The product of the factors of coordinates `dim` to `dim + K`, of one point and each of the block that begins at `j`.
#[inline(always)]
fn factors<S: Shape, const K: usize>(
    columns: &Columns<S>,
    own: usize,
    j: usize,
    dim: usize,
) -> impl Fn(usize) -> f64 {
    let mine: [[f64; 2]; K] = std::array::from_fn(|k| columns.number(own, dim + k));
    let g: [f64; K] = std::array::from_fn(|k| columns.g[dim + k]);
    let theirs: [[&Block; 2]; K] = std::array::from_fn(|k| {
        let (a, b) = columns.column(dim + k);
        [a, b].map(|numbers| numbers[j..].first_chunk().expect("columns have whole blocks"))
    });
    move |place| {
        let factor = |k: usize| S::factor(mine[k], theirs[k].map(|numbers| numbers[place]), g[k]);
        (1..K).fold(factor(0), |product, k| product * factor(k))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;

    use super::super::shapes::{Bowl, Bridge, Least, Tent, Wrap};
    use super::*;
    use crate::Seed;
    use crate::convert::unit_f64;
    use crate::instruction_sets::WIDEST;

    fn sums<S: Shape>() -> Vec<u64> {
        let number = |i: usize, dim: usize| {
            let seed = Seed::new(i as u64).dimension(dim as u64);
            [0, 1].map(|which| unit_f64(seed.split(16, which).bits64()))
        };
        let one =
            |dims: usize| sum_over_pairs(&Columns::<S>::new(300, vec![0.5; dims], number), NonZeroUsize::MIN);
        (1..10).map(|dims| one(dims).to_bits()).collect()
    }

    #[test]
    fn narrower_vectors_give_the_same_bits() {
        let all = || [sums::<Tent>(), sums::<Least>(), sums::<Bridge>(), sums::<Bowl>(), sums::<Wrap>()];
        let wide = all();
        for widest in [32, 0] {
            WIDEST.store(widest, Ordering::Relaxed);
            assert_eq!(all(), wide);
        }
        WIDEST.store(64, Ordering::Relaxed);
    }
}
