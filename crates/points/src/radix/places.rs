//! A number system as one coordinate uses it: its base, and what its places are worth.

/// Up to this many prefixes are tabulated.
pub(super) const TABULATED: u64 = 4096;

/// Digits that coordinates have at least: cells of 2^-54, one bit more than a double shows.
const CELLS: u128 = 1 << 54;

/// A base, the digits of a coordinate, and their division into *low* ones, of which there are tables, and *high* ones.
#[derive(Clone, Debug)]
pub(super) struct Places {
    pub(super) base: u64,
    /// How many digits are low.
    pub(super) low: usize,
    /// How many values the low digits have: rows of a block, cells of an axis.
    pub(super) rows: u64,
    /// How many digits there are.
    pub(super) digits: usize,
    /// 2^64 / rows, rounded down: the length of a cell.
    pub(super) cell: u64,
    /// 2^128 / rows, rounded up.
    edges: u128,
    /// What 1 is worth in each high digit, in units of 2^-64 of a cell, rounded down.
    pub(super) worth: Vec<u64>,
}

impl Places {
    /// Digits in a base from 2 to 2^16, of which a multiple of `group` are low.
    pub(super) fn new(base: u64, group: usize) -> Self {
        let power = |digits: usize| base.pow(digits as u32);
        let mut low = group;
        while power(low + group) <= TABULATED {
            low += group;
        }
        let (mut digits, mut cells) = (0, 1_u128);
        while cells < CELLS || digits <= low {
            (digits, cells) = (digits + 1, cells.saturating_mul(base.into()));
        }
        let rows = power(low);
        let mut worth = Vec::with_capacity(digits - low);
        let mut rest = 1_u128 << 64;
        for _ in low..digits {
            rest /= u128::from(base);
            worth.push(rest as u64);
        }
        let cell = ((1_u128 << 64) / u128::from(rows)) as u64;
        Self { base, low, rows, digits, cell, edges: u128::MAX / u128::from(rows) + 1, worth }
    }

    /// Where cell number `cell` begins, in units of 2^-64, rounded down.
    pub(super) fn edge(&self, cell: u64) -> u64 {
        // Rounding `edges` up adds less than 2^-64 · rows, too little to reach the next multiple of 1 / rows.
        ((u128::from(cell) * self.edges) >> 64) as u64
    }

    /// The digits of a number, the least significant first, as many as there are low ones.
    pub(super) fn low_digits(&self, mut number: u64) -> impl Iterator<Item = u64> {
        let base = self.base;
        (0..self.low).map(move |_| {
            let digit = number % base;
            number /= base;
            digit
        })
    }

    /// What grows digit by digit from a root, for one prefix, whose number has its first digit least significant.
    /// `step` is what a digit at a place does.
    pub(super) fn follow<T, S: Fn(T) -> T>(&self, prefix: u64, root: T, step: impl Fn(usize, u64) -> S) -> T {
        self.low_digits(prefix).enumerate().fold(root, |state, (place, digit)| step(place, digit)(state))
    }

    /// The same for all prefixes in the order of their numbers.
    pub(super) fn grow<T: Copy, S: Fn(T) -> T>(&self, root: T, step: impl Fn(usize, u64) -> S) -> Vec<T> {
        let mut states = Vec::with_capacity(self.rows as usize);
        states.push(root);
        for place in 0..self.low {
            let shorter = states.len();
            for digit in 1..self.base {
                let step = step(place, digit);
                for i in 0..shorter {
                    states.push(step(states[i]));
                }
            }
            let step = step(place, 0);
            states[..shorter].iter_mut().for_each(|state| *state = step(*state));
        }
        states
    }
}

/// Coordinates that are made together, in registers.
pub(super) const LINE: usize = 8;

/// The first numbers of a slice, and zeros after its end.
#[inline(always)]
pub(super) fn line<T: Copy + Default>(numbers: &[T]) -> [T; LINE] {
    numbers.first_chunk().copied().unwrap_or_else(|| {
        let mut line = [T::default(); LINE];
        line[..numbers.len()].copy_from_slice(numbers);
        line
    })
}

/// The product of two numbers below 2^32, which one instruction multiplies in vectors if it is told so.
#[inline(always)]
pub(super) fn product(x: u64, y: u64) -> u64 {
    (x & 0xffff_ffff) * (y & 0xffff_ffff)
}

/// The upper 64 bits of a product, at most 2 too small, of halves as vectors multiply them.
#[inline(always)]
pub(super) fn product_high(x: u64, y: u64) -> u64 {
    let (x1, y1) = (x >> 32, y >> 32);
    product(x1, y1) + (product(x1, y) >> 32) + (product(x, y1) >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::mix;

    #[test]
    fn cells_begin_where_they_should() {
        for base in [2, 3, 6, 10, 67, 4093, 65_521, 65_536] {
            let places = Places::new(base, 1);
            assert!(places.rows <= TABULATED.max(base) && places.low < places.digits, "{base}");
            assert!((base as f64).powi(places.digits as i32) >= 2f64.powi(54), "{base}");
            for cell in (0..places.rows).step_by(1 + places.rows as usize / 500).chain([places.rows - 1]) {
                let exact = (u128::from(cell) << 64) / u128::from(places.rows);
                assert_eq!(u128::from(places.edge(cell)), exact, "{base}, {cell}");
            }
        }
    }

    #[test]
    fn products_are_nearly_exact_and_never_too_large() {
        for i in 0..10_000 {
            let (x, y) = (mix(i), mix(!i) >> (i % 60));
            let exact = ((u128::from(x) * u128::from(y)) >> 64) as u64;
            assert!((exact.saturating_sub(2)..=exact).contains(&product_high(x, y)), "{x} {y}");
        }
    }
}
