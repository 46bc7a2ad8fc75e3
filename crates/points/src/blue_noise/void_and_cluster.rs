//! Dither masks by void and cluster: an order of the pixels of a torus whose every beginning is blue noise.
//!
//! R. Ulichney, *The void-and-cluster method for dither array generation*, Proc. SPIE 1913, 332–343 (1993). A tenth of the pixels is
//! relaxed: the one in the tightest cluster moves to the largest void until it would move back. From there pixels are added where the
//! void is largest, and taken where the cluster is tightest. Both are measured by a periodic Gaussian around each pixel taken; below a
//! tenth it widens with the distance of the pixels, so that the first ranks are as even as the later ones. The third phase of
//! the paper, by the clusters of those that are left, is the second in other words, as all Gaussians have the same sum.
//!
//! N pixels take O(N √N): a row knows its emptiest pixel, and a new pixel changes some rows only.

use super::decay::decay;
use super::uniform;
use crate::instruction_sets::for_this_machine;
use crate::{Error, Seed};

/// The width of the Gaussian in pixels.
const SIGMA: f64 = 1.5;

/// The share of pixels that is relaxed: one in so many.
const SHARE: usize = 10;

/// Where the Gaussian is cut off, in widths.
const REACH: f64 = 6.0;

/// The most pixels.
pub const MOST_PIXELS: usize = 1 << 24;

/// The rank of each pixel, row by row: the pixels of ranks below k are spread evenly, for every k.
///
/// ```
/// use evenlight_points::{Seed, blue_noise::void_and_cluster::ranks};
/// let mut ranks = ranks(8, 8, Seed::new(1))?;
/// ranks.sort();
/// assert!(ranks.into_iter().eq(0..64));
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// If there is no pixel, or there are more than [`MOST_PIXELS`].
pub fn ranks(rows: usize, columns: usize, seed: Seed) -> Result<Vec<u32>, Error> {
    let pixels = rows.saturating_mul(columns);
    if !(1..=MOST_PIXELS).contains(&pixels) {
        let message = format!("a mask has 1 to {MOST_PIXELS} pixels, not {rows} times {columns}");
        return Err(Error::BlueNoise(message));
    }
    let first = pixels.div_ceil(SHARE);
    let mut relaxed = random_pixels(pixels, first, seed);
    let mut mask = Mask::new([rows, columns], &relaxed);
    mask.relax(&mut relaxed);
    let mut order = removed_last_first([rows, columns], relaxed);
    while order.len() < pixels {
        let pixel = mask.largest_void();
        mask.add(pixel);
        order.push(pixel);
    }
    let mut ranks = vec![0; pixels];
    (0..).zip(order).for_each(|(rank, pixel)| ranks[pixel] = rank);
    Ok(ranks)
}

/// Different pixels, those with the smallest random numbers.
fn random_pixels(pixels: usize, wanted: usize, seed: Seed) -> Vec<usize> {
    let mut numbered: Vec<_> = uniform(seed, 0..pixels as u64).zip(0..).collect();
    numbered.sort_unstable_by(|a, b| a.partial_cmp(b).expect("numbers can be compared"));
    numbered.into_iter().take(wanted).map(|(_, pixel)| pixel).collect()
}

/// The sum of the Gaussians of some pixels.
struct Fullness {
    sizes: [usize; 2],
    gaussian: Gaussian,
    sum: Vec<f64>,
}

impl Fullness {
    fn new(sizes: [usize; 2], sigma: f64, pixels: &[usize]) -> Self {
        let gaussian = Gaussian { axes: sizes.map(|size| along(size, sigma)) };
        let mut fullness = Self { sizes, gaussian, sum: vec![0.0; sizes[0] * sizes[1]] };
        for &pixel in pixels {
            fullness.spread(pixel, 1.0);
        }
        fullness
    }

    /// Adds the Gaussian around a pixel, so many times.
    fn spread(&mut self, pixel: usize, times: f64) {
        let columns = self.sizes[1];
        let [(_, down), (left, across)] = &self.gaussian.axes;
        let start = ((pixel % columns) as isize + left).rem_euclid(columns as isize) as usize;
        let straight = across.len().min(columns - start);
        for (row, value) in self.rows(pixel).zip(down) {
            let sum = &mut self.sum[row * columns..][..columns];
            let factor = times * value;
            sum[start..].iter_mut().zip(across).for_each(|(sum, value)| *sum += factor * value);
            sum.iter_mut().zip(&across[straight..]).for_each(|(sum, value)| *sum += factor * value);
        }
    }

    /// The rows that the Gaussian around a pixel reaches, from top to bottom.
    fn rows(&self, pixel: usize) -> impl Iterator<Item = usize> + use<> {
        let [rows, columns] = self.sizes;
        let (top, down) = &self.gaussian.axes[0];
        let first = ((pixel / columns) as isize + top).rem_euclid(rows as isize) as usize;
        (first..first + down.len()).map(move |row| if row < rows { row } else { row - rows })
    }

    /// The place in a list of the pixel in the tightest cluster.
    fn tightest(&self, pixels: &[usize]) -> usize {
        let fuller = |best: (f64, usize), (place, &pixel): (usize, &usize)| {
            if self.sum[pixel] > best.0 { (self.sum[pixel], place) } else { best }
        };
        pixels.iter().enumerate().fold((f64::NEG_INFINITY, 0), fuller).1
    }
}

/// A periodic Gaussian: the product of two tables, one for the rows and one for the columns.
struct Gaussian {
    /// The least offset, and the values from there on.
    axes: [(isize, Vec<f64>); 2],
}

/// One axis of it: no offset occurs twice, and all images within reach are added.
fn along(size: usize, sigma: f64) -> (isize, Vec<f64>) {
    let reach = (REACH * sigma).ceil() as isize;
    let size = size as isize;
    let first = -reach.min((size - 1) / 2);
    let images = reach / size + 1;
    let value = |offset: isize| {
        let image = |image: isize| (0.5 * ((offset + image * size) as f64 / sigma).powi(2)).min(700.0);
        (-images..=images).map(|number| decay(image(number))).sum()
    };
    (first, (first..=reach.min(size / 2)).map(value).collect())
}

/// Pixels taken, and where there is room for more.
struct Mask {
    fullness: Fullness,
    /// 0 for free pixels, infinite for those taken.
    bar: Vec<f64>,
    /// How full the surroundings of the emptiest free pixel of each row are.
    emptiest: Vec<f64>,
}

impl Mask {
    fn new(sizes: [usize; 2], pixels: &[usize]) -> Self {
        let mut mask = Self {
            fullness: Fullness::new(sizes, SIGMA, pixels),
            bar: vec![0.0; sizes[0] * sizes[1]],
            emptiest: vec![0.0; sizes[0]],
        };
        for &pixel in pixels {
            mask.bar[pixel] = f64::INFINITY;
        }
        (0..sizes[0]).for_each(|row| mask.look(row));
        mask
    }

    fn add(&mut self, pixel: usize) {
        self.change(pixel, 1.0, f64::INFINITY);
    }

    fn remove(&mut self, pixel: usize) {
        self.change(pixel, -1.0, 0.0);
    }

    fn change(&mut self, pixel: usize, times: f64, bar: f64) {
        self.bar[pixel] = bar;
        self.fullness.spread(pixel, times);
        self.fullness.rows(pixel).for_each(|row| self.look(row));
    }

    /// A row as fullness and bars.
    fn row(&self, row: usize) -> (&[f64], &[f64]) {
        let columns = self.fullness.sizes[1];
        (&self.fullness.sum[row * columns..][..columns], &self.bar[row * columns..][..columns])
    }

    /// Finds how empty a row is at best.
    fn look(&mut self, row: usize) {
        let (sums, bars) = self.row(row);
        let mut least = 0.0;
        least_sum(sums, bars, &mut least);
        self.emptiest[row] = least;
    }

    fn largest_void(&self) -> usize {
        let rows = self.emptiest.iter().zip(0..);
        let (least, row) = rows
            .fold((f64::INFINITY, 0), |best, (&least, row)| if least < best.0 { (least, row) } else { best });
        let (sums, bars) = self.row(row);
        let column = sums.iter().zip(bars).position(|(sum, bar)| sum + bar == least);
        row * sums.len() + column.expect("the row has such a pixel")
    }

    /// Moves pixels from clusters to voids while that leads anywhere.
    fn relax(&mut self, pixels: &mut [usize]) {
        // Each move makes the sum over all pairs smaller, so that there is an end, but for moves that rounding makes take turns.
        for _ in 0..self.bar.len() {
            let cluster = self.fullness.tightest(pixels);
            self.remove(pixels[cluster]);
            let void = self.largest_void();
            self.add(void);
            if std::mem::replace(&mut pixels[cluster], void) == void {
                return;
            }
        }
    }
}

/// Numbers at a time.
const LANES: usize = 8;

for_this_machine! {
    /// The least sum of two numbers in the same place.
    least_sum = least_sum_body(a: &[f64], b: &[f64], out: &mut f64)
}

#[inline(always)]
fn least_sum_body(a: &[f64], b: &[f64], out: &mut f64) {
    let (blocks, rest) = a.as_chunks::<LANES>();
    let (others, other_rest) = b.as_chunks::<LANES>();
    let mut least = [f64::INFINITY; LANES];
    for (a, b) in blocks.iter().zip(others) {
        for lane in 0..LANES {
            let sum = a[lane] + b[lane];
            least[lane] = if sum < least[lane] { sum } else { least[lane] };
        }
    }
    let sums = rest.iter().zip(other_rest).map(|(a, b)| a + b);
    *out = sums.chain(least).fold(f64::INFINITY, |a, b| if b < a { b } else { a });
}

/// Pixels in the reverse order of their removal, each time from the tightest cluster.
fn removed_last_first(sizes: [usize; 2], mut left: Vec<usize>) -> Vec<usize> {
    let (count, mut order) = (left.len(), Vec::with_capacity(left.len()));
    while !left.is_empty() {
        // as wide as at the start, in distances of the pixels that are left
        let halvings = (count / left.len()).ilog2();
        let mut fullness = Fullness::new(sizes, SIGMA * 2.0_f64.powf(0.5 * f64::from(halvings)), &left);
        while left.len() > count >> (halvings + 1) {
            let pixel = left.swap_remove(fullness.tightest(&left));
            fullness.spread(pixel, -1.0);
            order.push(pixel);
        }
    }
    order.reverse();
    order
}
