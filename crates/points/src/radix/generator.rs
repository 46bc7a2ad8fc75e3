//! From an index to the digits of a coordinate: the index's own digits reversed, or a matrix times them.
//!
//! The index is written as `high · rows + low`. The matrices here are such that only the low digits of a coordinate
//! depend on the low digits of the index; the others are the same for a whole block of rows. The low ones are
//! known by the number of the prefix that they make, the first digit least significant.

use std::sync::OnceLock;

use super::LANES;
use super::places::{Places, TABULATED};
use crate::instruction_sets::for_this_machine;

/// How the digits of a coordinate follow from those of the index.
#[derive(Debug)]
pub(super) enum Generator {
    /// They are the same: the radical inverse.
    Identity,
    /// A matrix times those of the index.
    Matrix(Matrix),
}

/// A generating matrix.
#[derive(Debug)]
pub(super) struct Matrix {
    /// Column after column, each with all digits of a coordinate.
    columns: Vec<u16>,
    table: OnceLock<Table>,
}

/// The prefixes of all rows of block 0.
#[derive(Debug)]
pub(super) struct Table {
    numbers: Vec<u32>,
    /// Digit `place` of row `low` at `place * rows + low`.
    digits: Vec<u16>,
}

/// A digit that a block adds to those of block 0 without carry.
#[derive(Clone, Copy, Debug)]
struct Carry {
    place: usize,
    /// The least digit that becomes too large.
    least: u16,
    /// What to take from the number of the prefix then.
    excess: u32,
}

/// What the high digits of an index do to its coordinate.
#[derive(Clone, Debug, Default)]
pub(super) struct Shifted {
    /// What is added to the low digits, as digits.
    low: Vec<u64>,
    /// The high digits up to the last that is not 0.
    pub(super) high: Vec<u64>,
    number: u32,
    carries: Vec<Carry>,
}

impl Generator {
    /// A matrix by its entry in a row and a column. The first `places.low` columns end after as many rows.
    pub(super) fn from_entries(places: &Places, mut entry: impl FnMut(usize, usize) -> u64) -> Self {
        let count = (0..64).take_while(|&columns| u128::from(places.base).pow(columns) < 1 << 64).count();
        let entries = (0..count).flat_map(|column| (0..places.digits).map(move |row| (row, column)));
        let columns: Vec<_> = entries.map(|(row, column)| entry(row, column) as u16).collect();
        let closed = |column: &[u16]| column[places.low..].iter().all(|&digit| digit == 0);
        assert!(columns.chunks_exact(places.digits).take(places.low).all(closed), "low digits spread");
        Self::Matrix(Matrix { columns, table: OnceLock::new() })
    }

    /// What the high digits of indices do, into `shifted`.
    pub(super) fn shift(&self, places: &Places, mut high: u64, shifted: &mut Shifted) {
        shifted.high.clear();
        let Self::Matrix(matrix) = self else {
            while high > 0 && shifted.high.len() < places.worth.len() {
                shifted.high.push(high % places.base);
                high /= places.base;
            }
            return;
        };
        let mut digits = [0; 64];
        let columns = matrix.columns.chunks_exact(places.digits).skip(places.low);
        for column in columns {
            if high == 0 {
                break;
            }
            let factor = high % places.base;
            high /= places.base;
            digits.iter_mut().zip(column).for_each(|(digit, &entry)| *digit += factor * u64::from(entry));
        }
        for digit in &mut digits {
            *digit %= places.base;
        }
        shifted.low.clear();
        shifted.low.extend(&digits[..places.low]);
        let last = digits[places.low..].iter().rposition(|&digit| digit != 0);
        shifted.high.extend(&digits[places.low..][..last.map_or(0, |last| last + 1)]);
        shifted.carries(places.base);
    }

    /// The number of the prefix of a row of a block.
    pub(super) fn number(&self, places: &Places, low: u64, shifted: &Shifted) -> u64 {
        let Self::Matrix(matrix) = self else { return low };
        let digits = matrix.low_digits(places, low);
        let sums = digits.zip(&shifted.low).map(|(digit, shift)| (digit + shift) % places.base);
        sums.collect::<Vec<_>>().iter().rev().fold(0, |number, digit| number * places.base + digit)
    }

    /// The same for successive rows. There are no more than [`TABULATED`] in a block.
    pub(super) fn numbers(&self, places: &Places, low: u64, shifted: &Shifted, numbers: &mut [u32]) {
        let Self::Matrix(matrix) = self else { unreachable!("whose numbers are the rows themselves") };
        let table = matrix.table.get_or_init(|| matrix.table(places));
        add(low as usize, table, shifted, numbers);
    }
}

impl Matrix {
    /// The low digits of a row of block 0.
    fn low_digits(&self, places: &Places, low: u64) -> impl Iterator<Item = u64> {
        let digits: Vec<_> = places.low_digits(low).collect();
        (0..places.low).map(move |row| {
            let entries = self.columns.iter().skip(row).step_by(places.digits);
            entries.zip(&digits).map(|(&entry, digit)| u64::from(entry) * digit).sum::<u64>() % places.base
        })
    }

    fn table(&self, places: &Places) -> Table {
        debug_assert!(places.rows <= TABULATED, "a table of {} rows", places.rows);
        let mut digits = vec![0; places.low * places.rows as usize];
        let mut numbers = Vec::with_capacity(places.rows as usize);
        for low in 0..places.rows {
            let mut number = 0;
            for (place, digit) in self.low_digits(places, low).enumerate() {
                digits[place * places.rows as usize + low as usize] = digit as u16;
                number += digit as u32 * places.base.pow(place as u32) as u32;
            }
            numbers.push(number);
        }
        Table { numbers, digits }
    }
}

impl Shifted {
    /// Prepares the sums without carry.
    fn carries(&mut self, base: u64) {
        self.carries.clear();
        let (mut worth, mut number) = (1, 0);
        for (place, &digit) in self.low.iter().enumerate() {
            number += digit * worth;
            worth *= base;
            if digit > 0 {
                self.carries.push(Carry { place, least: (base - digit) as u16, excess: worth as u32 });
            }
        }
        self.number = number as u32;
    }
}

for_this_machine! {
    /// The prefixes of successive rows of a block, from those of block 0.
    add = add_body(low: usize, table: &Table, shifted: &Shifted, numbers: &mut [u32])
}

#[inline(always)]
fn add_body(low: usize, table: &Table, shifted: &Shifted, numbers: &mut [u32]) {
    debug_assert!(numbers.len() <= LANES);
    let rows = table.numbers.len();
    for (number, from) in numbers.iter_mut().zip(&table.numbers[low..]) {
        *number = from + shifted.number;
    }
    for carry in &shifted.carries {
        let digits = &table.digits[carry.place * rows..][low..];
        for (number, &digit) in numbers.iter_mut().zip(digits) {
            *number -= if digit >= carry.least { carry.excess } else { 0 };
        }
    }
}
