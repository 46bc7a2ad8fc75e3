//! The image of an environment map, with a density to sample it by: both in tiles, so that a sample waits for memory once.
//!
//! Cells lie between texel centers. A cell is chosen by inversion, so that stratified points stay stratified, in two levels: tiles of
//! 8×8 cells through small guide tables that stay in the cache, then a cell of the tile, whose weights and texels lie together. With one
//! search over all cells and a separate image, a third of a frame went by waiting for memory.

use glam::Vec4;

use crate::geometry::{Rgb, luminance};
use crate::memory::{prefetch, use_large_pages};
use crate::texture::image::Image;

/// Cells along the side of a tile.
const SIDE: usize = 8;

/// 8×8 cells and the texels at their corners.
struct Tile {
    /// Weights of the rows up to and including each.
    rows: [f32; SIDE],
    /// Weights of the cells up to and including each, within each row; cells outside of the image weigh nothing.
    cells: [[f32; SIDE]; SIDE],
    /// Half-precision red, green and blue of each texel, row by row, and one number to spare: four are read at a time.
    texels: [u16; 3 * CORNERS * CORNERS + 1],
}

/// Texels along the side of a tile.
const CORNERS: usize = SIDE + 1;

/// An image that wraps around horizontally, and a density over its cells.
pub(crate) struct Sky {
    width: usize,
    /// Rows of cells: one less than rows of texels.
    rows: usize,
    /// Tiles in a row of tiles.
    columns: usize,
    tiles: Vec<Tile>,
    lines: Vec<Inversion>,
    marginal: Inversion,
    /// What texels are to be multiplied by.
    scale: f32,
    /// Density of a cell of weight 1.
    per_weight: f32,
}

/// A point in a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkyPoint {
    /// Column and row of the cell.
    pub(crate) cell: [usize; 2],
    /// Where in the cell, in [0, 1).
    pub(crate) fraction: [f32; 2],
}

impl Sky {
    /// Cut an image of at least 2×2 texels into tiles; a cell weighs its mean luminance times `row_weight` of its row.
    pub(crate) fn new(image: &Image, row_weight: impl Fn(usize) -> f32) -> Self {
        let (width, rows) = (image.width, image.height - 1);
        let (columns, lines) = (width.div_ceil(SIDE), rows.div_ceil(SIDE));
        let row_weights: Vec<f32> = (0..rows).map(row_weight).collect();
        let largest = image.pixels.iter().flatten().fold(0.0_f32, |a, &b| a.max(b));
        let scale = (largest / LARGEST_HALF).max(1.0);
        let texel = |x: usize, y: usize| Rgb::from(image.pixels[y.min(rows) * width + x % width]);
        let weight = |x: usize, y: usize| {
            if x >= width || y >= rows {
                return 0.0;
            }
            let corners = texel(x, y) + texel(x + 1, y) + texel(x, y + 1) + texel(x + 1, y + 1);
            luminance(corners).max(0.0) * 0.25 * row_weights[y]
        };
        let tile = |number: usize| {
            let (left, top) = (number % columns * SIDE, number / columns * SIDE);
            let mut texels = [0; 3 * CORNERS * CORNERS + 1];
            for (number, half) in texels.as_chunks_mut().0.iter_mut().enumerate() {
                let (x, y) = (left + number % CORNERS, top + number / CORNERS);
                *half = (texel(x, y) / scale).to_array().map(to_half);
            }
            let cells: [[f32; SIDE]; SIDE] =
                std::array::from_fn(|y| running_sums(std::array::from_fn(|x| weight(left + x, top + y))));
            Tile { rows: running_sums(cells.map(|row| row[SIDE - 1])), cells, texels }
        };
        let tiles: Vec<Tile> = (0..columns * lines).map(tile).collect();
        use_large_pages(&tiles);
        let lines: Vec<_> = tiles
            .chunks_exact(columns)
            .map(|line| Inversion::new(line.iter().map(|tile| tile.rows[SIDE - 1])))
            .collect();
        let marginal = Inversion::new(lines.iter().map(Inversion::total));
        let per_weight = (width * rows) as f32 / marginal.total();
        Self { width, rows, columns, tiles, lines, marginal, scale, per_weight }
    }

    /// The sum of all weights.
    pub(crate) fn total_weight(&self) -> f32 {
        self.marginal.total()
    }

    /// Columns and rows of cells.
    pub(crate) fn cells(&self) -> [usize; 2] {
        [self.width, self.rows]
    }

    #[inline]
    fn tile(&self, [x, y]: [usize; 2]) -> &Tile {
        &self.tiles[y / SIDE * self.columns + x / SIDE]
    }

    /// The bilinearly interpolated color.
    #[inline]
    pub(crate) fn color(&self, point: &SkyPoint) -> Rgb {
        let ([x, y], [fx, fy]) = (point.cell.map(|n| n % SIDE), point.fraction);
        let texels = &self.tile(point.cell).texels;
        let at = |x: usize, y: usize| {
            let start = 3 * (y * CORNERS + x);
            let four: [u16; 4] = std::array::from_fn(|i| texels[start..start + 4][i]);
            Rgb::from_vec4(Vec4::from_array(four.map(from_half)))
        };
        let top = at(x, y) * (1.0 - fx) + at(x + 1, y) * fx;
        let bottom = at(x, y + 1) * (1.0 - fx) + at(x + 1, y + 1) * fx;
        (top * (1.0 - fy) + bottom * fy) * self.scale
    }

    /// Density with respect to area, where the whole image has area 1.
    #[inline]
    pub(crate) fn density(&self, point: &SkyPoint) -> f32 {
        let [x, y] = point.cell.map(|n| n % SIDE);
        let row = &self.tile(point.cell).cells[y];
        let below = if x == 0 { 0.0 } else { row[x - 1] };
        (row[x] - below) * self.per_weight
    }

    /// The tile of a sample, and where in it.
    #[inline]
    fn choose_tile(&self, u: [f32; 2]) -> ([usize; 2], [f32; 2]) {
        let (line, within_y) = self.marginal.invert(u[1]);
        let (column, within_x) = self.lines[line].invert(u[0]);
        ([column, line], [within_x, within_y])
    }

    /// Have the tile fetched that [`Sky::sample`] will need for the same `u`.
    #[inline]
    pub(crate) fn prefetch(&self, u: [f32; 2]) {
        let ([column, line], _) = self.choose_tile(u);
        prefetch(&self.tiles[line * self.columns + column]);
    }

    /// A point of that density.
    #[inline]
    pub(crate) fn sample(&self, u: [f32; 2]) -> SkyPoint {
        let ([column, line], [within_x, within_y]) = self.choose_tile(u);
        let Tile { rows, cells, .. } = &self.tiles[line * self.columns + column];
        let y = Chosen::among(rows, within_y);
        let x = Chosen::among(&cells[y.number], within_x);
        SkyPoint {
            cell: [column * SIDE + x.number, line * SIDE + y.number],
            fraction: [x.fraction, y.fraction],
        }
    }
}

/// The largest finite number in half precision.
const LARGEST_HALF: f32 = 65_504.0;

/// Round a number in [0, 65504] to half precision: 11 significant bits, as in most environment maps.
fn to_half(value: f32) -> u16 {
    // scaled, the exponent and the first ten bits of the fraction are where half precision has them
    let bits = (value.clamp(0.0, LARGEST_HALF) * f32::from_bits(0x0780_0000)).to_bits();
    ((bits + 0x1000) >> 13).min(0x7bff) as u16
}

/// The number that [`to_half`] made.
#[inline]
fn from_half(half: u16) -> f32 {
    f32::from_bits(u32::from(half) << 13) * f32::from_bits(0x7780_0000)
}

/// Largest number below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// Sums up to and including each number.
fn running_sums(mut numbers: [f32; SIDE]) -> [f32; SIDE] {
    for i in 1..SIDE {
        numbers[i] += numbers[i - 1];
    }
    numbers
}

/// A piecewise-constant density over equally long intervals, inverted with a guide table: it says where the search begins, and
/// the search takes less than a step on average (Chen & Asau 1974, "On Generating Random Variates from an Empirical Distribution").
struct Inversion {
    /// Weights up to and including each interval.
    cumulative: Vec<f32>,
    /// Over equal parts of the unit interval, a power of two of them: the interval in which each part begins.
    guide: Vec<u16>,
}

impl Inversion {
    fn new(weights: impl Iterator<Item = f32>) -> Self {
        let mut sum = 0.0_f64;
        let cumulative: Vec<f32> = weights
            .map(|weight| {
                sum += f64::from(weight);
                sum as f32
            })
            .collect();
        let parts = (2 * cumulative.len()).next_power_of_two();
        let start = |part: usize| {
            let target = part as f32 / parts as f32 * sum as f32;
            cumulative.partition_point(|&sum| sum <= target).min(cumulative.len() - 1) as u16
        };
        let guide = (0..parts).map(start).collect();
        Self { cumulative, guide }
    }

    #[inline]
    fn total(&self) -> f32 {
        self.cumulative[self.cumulative.len() - 1]
    }

    /// The chosen interval and where in it, in [0, 1).
    #[inline]
    fn invert(&self, u: f32) -> (usize, f32) {
        // rounding must not lead past the last interval with weight
        let target = (u * self.total()).min(self.total() * BELOW_ONE);
        let mut number = usize::from(self.guide[(u * self.guide.len() as f32) as usize]);
        while self.cumulative[number] <= target && number + 1 < self.cumulative.len() {
            number += 1;
        }
        let below = if number == 0 { 0.0 } else { self.cumulative[number - 1] };
        (number, fraction(target - below, self.cumulative[number] - below))
    }
}

/// One of the rows or cells of a tile, and where in it.
struct Chosen {
    number: usize,
    /// In [0, 1).
    fraction: f32,
}

impl Chosen {
    /// The inverse of a short running sum: compared all at once, without branches to mispredict.
    #[inline]
    fn among(sums: &[f32; SIDE], u: f32) -> Self {
        // rounding must not lead past the last one with weight
        let target = (u * sums[SIDE - 1]).min(sums[SIDE - 1] * BELOW_ONE);
        let before = sums.iter().map(|&sum| i32::from(sum <= target)).sum::<i32>();
        let number = (before as usize).min(SIDE - 1);
        let below = if number == 0 { 0.0 } else { sums[number - 1] };
        Self { number, fraction: fraction(target - below, sums[number] - below) }
    }
}

/// `part / whole` in [0, 1).
#[inline]
fn fraction(part: f32, whole: f32) -> f32 {
    (part / whole.max(f32::MIN_POSITIVE)).clamp(0.0, BELOW_ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image() -> Image {
        let value = |i: usize| if i.is_multiple_of(3) { 0.0 } else { (i * 7 % 11) as f32 * 1e4 };
        Image {
            width: 37,
            height: 22,
            pixels: (0..37 * 22).map(|i| [value(i); 3]).collect(),
            alpha: None,
            channels: 3,
        }
    }

    #[test]
    fn samples_follow_the_density() {
        let sky = Sky::new(&image(), |row| (row + 1) as f32);
        let steps = 1500;
        let mut counts = vec![0.0_f32; 37 * 21];
        for i in 0..steps * steps {
            let u = [i / steps, i % steps].map(|n| (n as f32 + 0.5) / steps as f32);
            let SkyPoint { cell: [x, y], fraction } = sky.sample(u);
            assert!(fraction.iter().all(|f| (0.0..1.0).contains(f)));
            counts[y * 37 + x] += 1.0 / (steps * steps) as f32;
        }
        for (cell, count) in counts.iter().enumerate() {
            let point = SkyPoint { cell: [cell % 37, cell / 37], fraction: [0.5; 2] };
            let expected = sky.density(&point) / (37.0 * 21.0);
            // a grid of points may lose one line at each side of a cell: 4 × 0.06 / 1500
            assert!((count - expected).abs() < 1.6e-4, "cell {cell}: {count} for {expected}");
        }
    }

    #[test]
    fn colors_are_interpolated_across_tiles_and_around() {
        let (image, sky) = (image(), Sky::new(&image(), |_| 1.0));
        let texel = |x: usize, y: usize| image.pixels[y * 37 + x % 37][0];
        for cell in [[0, 0], [7, 7], [8, 15], [36, 20]] {
            let [x, y] = cell;
            let color = sky.color(&SkyPoint { cell, fraction: [0.25, 0.5] });
            let left = 0.5 * (texel(x, y) + texel(x, y + 1));
            let right = 0.5 * (texel(x + 1, y) + texel(x + 1, y + 1));
            let expected = 0.75 * left + 0.25 * right;
            assert!((color.x - expected).abs() <= 5e-4 * expected, "{cell:?}: {} for {expected}", color.x);
        }
    }

    #[test]
    fn halves_are_rounded_to_eleven_bits() {
        for value in [0.0, 1e-6, 1e-3, 0.1, 0.5, 1.0, 3.75, 1000.3, 65_504.0] {
            let back = from_half(to_half(value));
            assert!((back - value).abs() <= (value / 2048.0).max(3e-8), "{back} for {value}");
        }
    }
}
