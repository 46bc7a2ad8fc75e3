//! Clouds of points in the order of a curve: neighbors in the list are neighbors in space.
//!
//! Keys have 64 bits. A radix sort puts their first digits in order, a few more than tell the points of an even cloud apart; what
//! still has the same digits is compared. Each thread sorts a part, and parts are merged. Points in one cell keep their order, so that
//! the result does not depend on the threads.

use std::num::NonZeroUsize;

use super::{Curve, Grid};

/// A key and the place of its point.
type Item = (u64, u32);

/// The box around a cloud, as what turns coordinates into cells: (x − lower) · scale.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The least coordinate of each axis.
    pub lower: Vec<f64>,
    /// Cells of one unit, for each axis.
    pub scale: Vec<f64>,
}

impl Frame {
    /// The frame of a box on a grid; axes without extent have a single cell.
    pub fn new(grid: Grid, lower: &[f64], upper: &[f64]) -> Self {
        let cells = 2f64.powi(grid.bits as i32);
        let scale = lower.iter().zip(upper).map(|(a, b)| if b > a { cells / (b - a) } else { 0.0 });
        Self { lower: lower.to_vec(), scale: scale.collect() }
    }
}

/// Rows at a time.
const BLOCK: usize = 256;

/// The keys of row-major points; points outside of the frame are moved to its sides.
pub fn keys(curve: &Curve, grid: Grid, frame: &Frame, x: &[f64], keys: &mut [u64]) {
    let last = u32::MAX >> (32 - grid.bits);
    let mut cells = vec![0; BLOCK * grid.dims];
    for (x, keys) in x.chunks(BLOCK * grid.dims).zip(keys.chunks_mut(BLOCK)) {
        for (x, cells) in x.chunks_exact(grid.dims).zip(cells.chunks_exact_mut(grid.dims)) {
            for (i, cell) in cells.iter_mut().enumerate() {
                *cell = (((x[i] - frame.lower[i]) * frame.scale[i]) as u32).min(last);
            }
        }
        (curve.indices)(grid, &cells[..x.len()], keys);
    }
}

/// The order of row-major points along a curve: the places of the points, first to last.
///
/// # Panics
/// If there are 2^32 points or more.
pub fn order(curve: &Curve, grid: Grid, frame: &Frame, x: &[f64], workers: NonZeroUsize) -> Vec<u32> {
    let count = x.len() / grid.dims;
    assert!(u32::try_from(count).is_ok(), "{count} points");
    let share = count.div_ceil((count / LEAST).clamp(1, workers.get())).max(1);
    let part = |x: &[f64], first: usize| {
        let mut found = vec![0; x.len() / grid.dims];
        keys(curve, grid, frame, x, &mut found);
        let items = found.into_iter().zip(first as u32..).collect();
        sorted(items, grid.digits())
    };
    let parts = std::thread::scope(|scope| {
        let part = &part;
        let threads: Vec<_> = x
            .chunks(share * grid.dims)
            .enumerate()
            .map(|(number, x)| scope.spawn(move || part(x, number * share)))
            .collect();
        threads.into_iter().map(|thread| thread.join().expect("sorting does not fail")).collect::<Vec<_>>()
    });
    merged(parts, workers.get()).into_iter().map(|(_, place)| place).collect()
}

/// The least number of points for a thread.
const LEAST: usize = 1 << 14;

/// Bits of a digit of the radix sort: its counts stay in the first cache.
const DIGIT: u32 = 8;

/// Items by key, those with equal keys by place.
fn sorted(mut items: Vec<Item>, digits: u32) -> Vec<Item> {
    if items.len() < 64 {
        items.sort_unstable();
        return items;
    }
    let wanted = (items.len().ilog2() + 4).min(digits).next_multiple_of(DIGIT);
    let first = digits.saturating_sub(wanted);
    let mut other = vec![(0, 0); items.len()];
    for shift in (first..first + wanted).step_by(DIGIT as usize) {
        if shift < 64 {
            scatter(&items, &mut other, shift);
            std::mem::swap(&mut items, &mut other);
        }
    }
    // What has the same first digits is in the order of places.
    for run in items.chunk_by_mut(|a, b| a.0 >> first == b.0 >> first) {
        if run.len() > 1 {
            run.sort_unstable();
        }
    }
    items
}

/// One pass of the radix sort.
fn scatter(items: &[Item], other: &mut [Item], shift: u32) {
    const MASK: u64 = (1 << DIGIT) - 1;
    let mut starts = [0_u32; 1 << DIGIT];
    for (key, _) in items {
        starts[(key >> shift & MASK) as usize] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        (*start, sum) = (sum, sum + *start);
    }
    for &item in items {
        let start = &mut starts[(item.0 >> shift & MASK) as usize];
        other[*start as usize] = item;
        *start += 1;
    }
}

/// Sorted parts as one, pair by pair.
fn merged(mut parts: Vec<Vec<Item>>, workers: usize) -> Vec<Item> {
    while parts.len() > 1 {
        let pairs: Vec<_> = parts.chunks(2).collect();
        let each = (workers / pairs.len()).max(1);
        parts = std::thread::scope(|scope| {
            let threads: Vec<_> = pairs
                .into_iter()
                .map(|pair| {
                    scope.spawn(move || match pair {
                        [a, b] => {
                            let mut out = vec![(0, 0); a.len() + b.len()];
                            merge(a, b, &mut out, each);
                            out
                        }
                        alone => alone[0].clone(),
                    })
                })
                .collect();
            threads.into_iter().map(|thread| thread.join().expect("merging does not fail")).collect()
        });
    }
    parts.pop().unwrap_or_default()
}

/// Merges two sorted lists with several threads: both are cut at one item.
fn merge(a: &[Item], b: &[Item], out: &mut [Item], workers: usize) {
    if workers < 2 || a.len() < LEAST || b.len() < LEAST {
        let (mut i, mut j) = (0, 0);
        for item in out {
            let from_a = j == b.len() || (i < a.len() && a[i] < b[j]);
            *item = if from_a { a[i] } else { b[j] };
            (i, j) = (i + usize::from(from_a), j + usize::from(!from_a));
        }
        return;
    }
    let half = a.len() / 2;
    let cut = b.partition_point(|item| *item < a[half]);
    let (low, high) = out.split_at_mut(half + cut);
    std::thread::scope(|scope| {
        scope.spawn(|| merge(&a[..half], &b[..cut], low, workers / 2));
        merge(&a[half..], &b[cut..], high, workers - workers / 2);
    });
}
