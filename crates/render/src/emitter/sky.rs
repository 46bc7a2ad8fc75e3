//! The image of an environment map, with a density to sample it by: both in tiles, so that a sample waits for memory once.
//!
//! Cells lie between texel centers. A cell is chosen by inversion, so that stratified points stay stratified, going down a tree of
//! 8×8 weights: each choice compares eight running sums at once, without branches, and all levels but the last stay in the cache. There
//! the weights and texels of 8×8 cells lie together. With one search over all cells and a separate image, a third of a frame went by
//! waiting for memory.

use glam::Vec4;

use crate::geometry::{Rgb, luminance};
use crate::memory::{prefetch, use_large_pages};
use crate::texture::image::Image;

/// Cells along the side of a tile.
const SIDE: usize = 8;

/// Weights of 8×8 cells, or of 8×8 tables of the next level.
#[derive(Clone, Copy)]
#[repr(align(32))]
struct Table {
    /// Weights of the rows up to and including each.
    rows: [f32; SIDE],
    /// Weights of the cells up to and including each, within each row; cells outside of the image weigh nothing.
    cells: [[f32; SIDE]; SIDE],
}

/// Tables side by side that cover the image.
struct Level {
    /// Tables in a row.
    columns: usize,
    tables: Vec<Table>,
}

/// 8×8 cells and the texels at their corners.
struct Tile {
    weights: Table,
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
    /// From the one table at the top to those whose cells are tiles.
    levels: Vec<Level>,
    total: f32,
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
            Tile { weights: Table::new(|x, y| weight(left + x, top + y)), texels }
        };
        let tiles: Vec<Tile> = (0..columns * lines).map(tile).collect();
        use_large_pages(&tiles);
        let (levels, total) = levels_above(&tiles, columns);
        let per_weight = (width * rows) as f32 / total;
        Self { width, rows, columns, tiles, levels, total, scale, per_weight }
    }

    /// The sum of all weights.
    pub(crate) fn total_weight(&self) -> f32 {
        self.total
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
        let row = &self.tile(point.cell).weights.cells[y];
        let below = if x == 0 { 0.0 } else { row[x - 1] };
        (row[x] - below) * self.per_weight
    }

    /// The number of the tile that a sample leads to, and where in it; its weights are being fetched from memory.
    #[inline]
    pub(crate) fn choose_tile(&self, mut u: [f32; 2]) -> (usize, [f32; 2]) {
        let [mut x, mut y] = [0, 0];
        for level in &self.levels {
            let chosen = level.tables[y * level.columns + x].choose(u);
            [x, y] = [x * SIDE + chosen.cell[0], y * SIDE + chosen.cell[1]];
            u = chosen.fraction;
        }
        let number = y * self.columns + x;
        prefetch(&self.tiles[number].weights);
        (number, u)
    }

    /// The number of the cell in a tile that a sample leads to, and where in it; its texels are being fetched from memory.
    #[inline]
    pub(crate) fn choose_cell(&self, tile: usize, within: [f32; 2]) -> (usize, [f32; 2]) {
        let tile = &self.tiles[tile];
        let SkyPoint { cell: [x, y], fraction } = tile.weights.choose(within);
        for row in [y, y + 1] {
            let texel = 3 * (row * CORNERS + x);
            prefetch(&tile.texels[texel]);
            prefetch(&tile.texels[texel + 5]);
        }
        (y * SIDE + x, fraction)
    }

    /// The point of which [`Sky::choose_tile`] and [`Sky::choose_cell`] told the parts; it has that density.
    #[inline]
    pub(crate) fn point(&self, tile: usize, cell: usize, fraction: [f32; 2]) -> SkyPoint {
        let (column, line) = (tile % self.columns, tile / self.columns);
        SkyPoint { cell: [column * SIDE + cell % SIDE, line * SIDE + cell / SIDE], fraction }
    }
}

impl Table {
    fn new(weight: impl Fn(usize, usize) -> f32) -> Self {
        let row = |y: usize| running_sums(std::array::from_fn(|x| weight(x, y)));
        let cells: [[f32; SIDE]; SIDE] = std::array::from_fn(row);
        Self { rows: running_sums(cells.map(|row| row[SIDE - 1])), cells }
    }

    fn total(&self) -> f32 {
        self.rows[SIDE - 1]
    }

    /// One of the cells, and where in it.
    #[inline]
    fn choose(&self, [u, v]: [f32; 2]) -> SkyPoint {
        let (y, within_y) = choose_among(&self.rows, v);
        let (x, within_x) = choose_among(&self.cells[y], u);
        SkyPoint { cell: [x, y], fraction: [within_x, within_y] }
    }
}

/// The levels above the tiles, and the weight of all.
fn levels_above(tiles: &[Tile], mut columns: usize) -> (Vec<Level>, f32) {
    let mut weights: Vec<f32> = tiles.iter().map(|tile| tile.weights.total()).collect();
    let mut levels = Vec::new();
    while weights.len() > 1 {
        let lines = weights.len() / columns;
        let weight =
            |x: usize, y: usize| if x < columns && y < lines { weights[y * columns + x] } else { 0.0 };
        let [across, down] = [columns, lines].map(|n| n.div_ceil(SIDE));
        let table = |number: usize| {
            let (left, top) = (number % across * SIDE, number / across * SIDE);
            Table::new(|x, y| weight(left + x, top + y))
        };
        let tables: Vec<Table> = (0..across * down).map(table).collect();
        weights = tables.iter().map(Table::total).collect();
        columns = across;
        levels.push(Level { columns, tables });
    }
    levels.reverse();
    (levels, weights[0])
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

/// The inverse of a short running sum: which part, and where in it, in [0, 1). All are compared at once, without branches to mispredict.
#[inline(always)]
fn choose_among(sums: &[f32; SIDE], u: f32) -> (usize, f32) {
    let total = sums[SIDE - 1];
    // rounding must not lead past the last one with weight
    let target = at_most(u * total, total * BELOW_ONE);
    let passed = (0..SIDE).fold(0_u32, |passed, i| passed | u32::from(sums[i] <= target) << i);
    let number = (passed.trailing_ones() as usize).min(SIDE - 1);
    let below = if number == 0 { 0.0 } else { sums[number - 1] };
    let width = sums[number] - below;
    let fraction = if width > 0.0 { (target - below) / width } else { 0.0 };
    (number, at_most(fraction, BELOW_ONE))
}

/// The smaller of two numbers of which neither is NaN: one instruction.
#[inline(always)]
fn at_most(x: f32, limit: f32) -> f32 {
    if x < limit { x } else { limit }
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
            let (tile, within) = sky.choose_tile(u);
            let (cell, fraction) = sky.choose_cell(tile, within);
            let SkyPoint { cell: [x, y], .. } = sky.point(tile, cell, fraction);
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
