//! Equal cells of the unit interval, and places inside them that rounding never moves to a neighbor.
//!
//! Cell c of n is [c/n, (c + 1)/n). Where n is a power of 2, any word cut off after its first digits
//! stays in its cell. Elsewhere the end of a cell is no word; places keep a distance of a few units of
//! the last of 53 digits from it, so that x is in its cell and the rounded product x · n has the integer part c.

use crate::convert::unit_f64;
use crate::instruction_sets::for_this_machine;
use crate::seed::counted;

/// Units of 2⁻⁶⁴ below the last of 53 binary digits.
const ROUNDING: u64 = 1 << 11;

/// The most cells.
pub(crate) const MOST: u64 = 1 << 32;

/// The division of [0, 1) into equal cells, as words of 64 binary digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cells {
    /// 2^64 / n: the integer part, and the first 32 binary digits after it.
    pitch: [u64; 2],
    /// How far after the rounded start of a cell its places begin, and over how much they spread.
    start: u64,
    width: u64,
}

impl Cells {
    /// `n` cells, at least 1 and at most [`MOST`].
    pub(crate) fn new(n: u64) -> Self {
        assert!((1..=MOST).contains(&n), "{n} cells");
        if n.is_power_of_two() {
            let pitch = (u64::MAX / n).saturating_add(u64::from(n > 1));
            return Self { pitch: [pitch, 0], start: 0, width: pitch };
        }
        let (whole, rest) = (u64::MAX / n, u64::MAX % n + 1);
        // The rounded start is below the true one by less than two units.
        let start = ROUNDING + 1;
        Self { pitch: [whole, (rest << 32) / n], start, width: whole - start - ROUNDING }
    }

    /// The place at `within`, in units of 2⁻⁶⁴ of the width, in a cell.
    #[inline(always)]
    pub(crate) fn place(&self, cell: u32, within: u64) -> u64 {
        let cell = u64::from(cell);
        let begin = cell.wrapping_mul(self.pitch[0]) + ((cell * self.pitch[1]) >> 32) + self.start;
        begin + scaled(within, self.width)
    }
}

for_this_machine! {
    /// The coordinates of consecutive points from `start` on, whose places within their cells come from two keys.
    place_points = place_points_body(cells: Cells, start: u64, keys: [u64; 2], numbers: &[u32], out: &mut [f64])
}

#[inline(always)]
fn place_points_body(cells: Cells, start: u64, keys: [u64; 2], numbers: &[u32], out: &mut [f64]) {
    for ((x, &cell), i) in out.iter_mut().zip(numbers).zip(0..) {
        *x = unit_f64(cells.place(cell, counted(start.wrapping_add(i), keys[0], keys[1])));
    }
}

/// The upper half of a product of words, or one or two less: in halves, which vector units multiply.
#[inline(always)]
fn scaled(a: u64, b: u64) -> u64 {
    let ([a0, a1], [b0, b1]) = ([a & 0xffff_ffff, a >> 32], [b & 0xffff_ffff, b >> 32]);
    a1 * b1 + ((a1 * b0) >> 32) + ((a0 * b1) >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::unit_f64;

    #[test]
    fn places_are_in_their_cells_exactly_and_after_rounding() {
        for n in (1..100).chain([1000, 1 << 20, (1 << 20) + 1, 999_999_937, MOST - 1, MOST]) {
            let cells = Cells::new(n);
            for cell in (0..n).step_by((n as usize / 300).max(1)).chain([n - 1]) {
                for within in [0, 1, 1 << 63, u64::MAX - 1, u64::MAX, 0x0123_4567_89ab_cdef] {
                    let x = unit_f64(cells.place(cell as u32, within));
                    let digits = (x * 2f64.powi(53)) as u64;
                    let exact = (u128::from(digits) * u128::from(n)) >> 53;
                    assert_eq!(
                        (exact as u64, (x * n as f64) as u64),
                        (cell, cell),
                        "{within} of {cell} of {n}"
                    );
                }
            }
        }
    }

    #[test]
    fn cells_are_filled() {
        for n in [1, 3, 1000, 1 << 20, 1_000_003] {
            let cells = Cells::new(n);
            let gap = |cell: u64| {
                let end = unit_f64(cells.place(cell as u32, u64::MAX));
                unit_f64(cells.place(cell as u32 + 1, 0)) - end
            };
            assert!(n == 1 || gap(n / 2 - 1) * (n as f64) < 1e-8, "{n}");
            assert!(unit_f64(cells.place(n as u32 - 1, u64::MAX)) < 1.0);
            assert!(unit_f64(cells.place(0, 0)) * (n as f64) < 1e-8);
        }
    }
}
