//! Clouds of points in the order of a curve: neighbors in the list are neighbors in space.
//!
//! A curve on a coarser grid visits the cells in the same order, so that a point has its place by the first few digits of its
//! number already: as many as tell the points of an even cloud apart. These are put in order by a radix sort, in one word with
//! the place of the point. What is still in one cell is told apart by all 64 digits. Each thread sorts a part, and parts
//! are merged. Points in one cell of the finest grid keep their order, so that the result does not depend on the threads.

use std::num::NonZeroUsize;

use super::{Curve, Grid};

/// The first digits of a number, and in the lower half the place of its point.
type Item = u64;

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
    first_digits(curve, [grid, grid], frame, x, keys);
}

/// The digits of keys on a coarser grid than that of the frame.
fn first_digits(curve: &Curve, [fine, coarse]: [Grid; 2], frame: &Frame, x: &[f64], keys: &mut [u64]) {
    let (last, shift) = (u32::MAX >> (32 - fine.bits), fine.bits - coarse.bits);
    let dims = fine.dims;
    let mut cells = vec![0; BLOCK * dims];
    for (x, keys) in x.chunks(BLOCK * dims).zip(keys.chunks_mut(BLOCK)) {
        for (x, cells) in x.chunks_exact(dims).zip(cells.chunks_exact_mut(dims)) {
            for (i, cell) in cells.iter_mut().enumerate() {
                *cell = (((x[i] - frame.lower[i]) * frame.scale[i]) as u32).min(last) >> shift;
            }
        }
        (curve.indices)(coarse, &cells[..x.len()], keys);
    }
}

/// The order of row-major points along a curve: the places of the points, first to last.
///
/// # Panics
/// If there are 2^32 points or more.
pub fn order(curve: &Curve, grid: Grid, frame: &Frame, x: &[f64], workers: NonZeroUsize) -> Vec<u32> {
    let count = x.len() / grid.dims;
    assert!(u32::try_from(count).is_ok(), "{count} points");
    let coarse = coarse(grid, count);
    let share = count.div_ceil((count / LEAST).clamp(1, workers.get())).max(1);
    let part = |x: &[f64], first: usize| {
        let mut items = vec![0; x.len() / grid.dims];
        first_digits(curve, [grid, coarse], frame, x, &mut items);
        for (item, place) in items.iter_mut().zip(first as u64..) {
            *item = *item << 32 | place;
        }
        sorted(items, coarse.digits())
    };
    let parts = std::thread::scope(|scope| {
        let part = &part;
        let mut chunks = x.chunks(share * grid.dims).enumerate();
        let own = chunks.next();
        let others: Vec<_> = chunks.map(|(number, x)| scope.spawn(move || part(x, number * share))).collect();
        let mut parts: Vec<_> = own.map(|(_, x)| part(x, 0)).into_iter().collect();
        parts.extend(others.into_iter().map(|thread| thread.join().expect("sorting does not fail")));
        parts
    });
    let items = merged(parts, workers.get());
    let mut places: Vec<u32> = items.iter().map(|&item| item as u32).collect();
    if coarse != grid {
        let mut rest = &mut places[..];
        for run in items.chunk_by(|a, b| a >> 32 == b >> 32) {
            let (together, later) = rest.split_at_mut(run.len());
            if run.len() > 1 {
                tell_apart(curve, grid, frame, x, together);
            }
            rest = later;
        }
    }
    places
}

/// The grid of the first digits: at most 32 of them.
fn coarse(grid: Grid, count: usize) -> Grid {
    let dims = grid.dims as u32;
    let wanted = count.max(1).ilog2() + SPARE;
    Grid { bits: wanted.div_ceil(dims).min(32 / dims).min(grid.bits), ..grid }
}

/// Digits beyond those that number the points: one point in 2^7 shares them with another, in an even cloud.
const SPARE: u32 = 8;

/// Sorts the places of points that have the same first digits by all of them; on a line, by the coordinate itself.
fn tell_apart(curve: &Curve, grid: Grid, frame: &Frame, x: &[f64], places: &mut [u32]) {
    if grid.dims == 1 {
        let along = |place: u32| x[place as usize];
        places.sort_by(|&a, &b| along(a).total_cmp(&along(b)));
        return;
    }
    let row = |&place: &u32| &x[place as usize * grid.dims..][..grid.dims];
    let rows: Vec<f64> = places.iter().flat_map(row).copied().collect();
    let mut found = vec![0; places.len()];
    keys(curve, grid, frame, &rows, &mut found);
    let mut numbered: Vec<_> = found.into_iter().zip(places.iter().copied()).collect();
    numbered.sort_unstable();
    for (place, (_, sorted)) in places.iter_mut().zip(numbered) {
        *place = sorted;
    }
}

/// The least number of points for a thread.
const LEAST: usize = 1 << 14;

/// The most bits of a digit of the radix sort: its counts stay in the first cache.
const DIGIT: u32 = 11;

/// Items in order; those with the same digits are so already.
fn sorted(mut items: Vec<Item>, digits: u32) -> Vec<Item> {
    if items.len() < 64 {
        items.sort_unstable();
        return items;
    }
    let passes = digits.div_ceil(DIGIT);
    let width = digits.div_ceil(passes);
    let mut other = vec![0; items.len()];
    for pass in 0..passes {
        scatter(&items, &mut other, 32 + pass * width, width);
        std::mem::swap(&mut items, &mut other);
    }
    items
}

/// One pass of the radix sort, by the bits from `shift` on.
fn scatter(items: &[Item], other: &mut [Item], shift: u32, width: u32) {
    let mask = (1 << width) - 1;
    let digit = |item: Item| (item >> shift & mask) as usize;
    let mut starts = [0_u32; 1 << DIGIT];
    for &item in items {
        starts[digit(item)] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        (*start, sum) = (sum, sum + *start);
    }
    for &item in items {
        let start = &mut starts[digit(item)];
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
                            let mut out = vec![0; a.len() + b.len()];
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
