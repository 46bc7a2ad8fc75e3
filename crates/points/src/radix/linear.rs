//! Linear scrambles in a prime base: digits times a random lower triangular matrix, and shifted, modulo the base.
//!
//! The low digits of the image depend on the low digits alone and are tabulated. To the high digits of the image, low
//! and high digits contribute a sum without carry: the sum of two fractions, from which a digit that became too
//! large takes the base again. So a coordinate costs a comparison for each high digit.

use super::places::{LINE, Places, line, product_high};
use super::prefixes::Prefixes;
use crate::Seed;
use crate::convert::unit_f64;
use crate::instruction_sets::for_this_machine;
use crate::scramble::Randomization;

/// Digits of a coordinate.
type Digits = [u16; 64];

/// A lower triangular matrix and a shift.
#[derive(Clone, Debug)]
pub(super) struct Linear {
    columns: Vec<Digits>,
    shift: Digits,
}

/// What high digits add.
#[derive(Clone, Debug, Default)]
pub(super) struct Addend {
    fraction: u64,
    carries: Vec<Carry>,
}

/// A high digit that is added without carry.
#[derive(Clone, Copy, Debug)]
struct Carry {
    place: usize,
    least: u16,
    excess: u64,
}

impl Linear {
    pub(super) fn new(places: &Places, randomization: Randomization, key: Seed) -> Self {
        let below = |values: u64, number: u64| {
            ((u128::from(key.split(0, number).bits64()) * u128::from(values)) >> 64) as u16
        };
        let unit = |number| 1 + below(places.base - 1, number);
        let entry = |row: usize, column: usize| {
            let (row, column) = (row as u64, column as u64);
            match randomization {
                Randomization::LinearStriped => unit(column),
                Randomization::LinearIBinomial if row == column => unit(0),
                Randomization::LinearIBinomial => below(places.base, row - column),
                _ if row == column => unit(row << 8 | column),
                _ => below(places.base, row << 8 | column),
            }
        };
        let digits = |entry: &dyn Fn(usize) -> u16| {
            let mut digits = [0; 64];
            (0..places.digits).for_each(|row| digits[row] = entry(row));
            digits
        };
        let column = |column| digits(&|row| if row < column { 0 } else { entry(row, column) });
        Self {
            columns: (0..places.digits).map(column).collect(),
            shift: digits(&|row| below(places.base, 1 << 16 | row as u64)),
        }
    }

    /// The images of one prefix.
    pub(super) fn image(&self, places: &Places, prefix: u64, images: &mut Prefixes, at: usize) {
        let image = places.follow(prefix, self.shift, |place, digit| self.step(places, place, digit));
        write(places, &image, images, at);
    }

    /// The images of all prefixes.
    pub(super) fn images(&self, places: &Places) -> Prefixes {
        let all = places.grow(self.shift, |place, digit| self.step(places, place, digit));
        let mut images = Prefixes::of(all.len(), places.worth.len());
        all.iter().enumerate().for_each(|(i, image)| write(places, image, &mut images, i));
        images
    }

    /// Adds a multiple of a column.
    fn step(&self, places: &Places, place: usize, digit: u64) -> impl Fn(Digits) -> Digits + use<> {
        let base = places.base as u32;
        let added = self.columns[place].map(|entry| u32::from(entry) * digit as u32 % base);
        move |mut digits| {
            for (digit, added) in digits.iter_mut().zip(added) {
                let sum = u32::from(*digit) + added;
                *digit = sum.min(sum.wrapping_sub(base)) as u16;
            }
            digits
        }
    }

    /// What high digits add to the high digits of images, into `addend`.
    pub(super) fn add(&self, places: &Places, high: &[u64], addend: &mut Addend) {
        let mut sums = [0_u64; 64];
        for (column, digit) in self.columns[places.low..].iter().zip(high) {
            sums.iter_mut().zip(column).for_each(|(sum, &entry)| *sum += digit * u64::from(entry));
        }
        addend.fraction = 0;
        addend.carries.clear();
        for (place, (sum, worth)) in sums[places.low..].iter().zip(&places.worth).enumerate() {
            let digit = sum % places.base;
            addend.fraction += digit * worth;
            if digit > 0 {
                let least = (places.base - digit) as u16;
                addend.carries.push(Carry { place, least, excess: places.base.wrapping_mul(*worth) });
            }
        }
    }
}

/// Writes an image at a place.
fn write(places: &Places, image: &Digits, images: &mut Prefixes, at: usize) {
    let (low, high) = image[..places.digits].split_at(places.low);
    images.words[at] = places.edge(low.iter().fold(0, |cell, &digit| cell * places.base + u64::from(digit)));
    images.fractions[at] =
        high.iter().zip(&places.worth).map(|(&digit, worth)| u64::from(digit) * worth).sum();
    let stride = images.words.len();
    high.iter().enumerate().for_each(|(place, &digit)| images.digits[place * stride + at] = digit);
}

for_this_machine! {
    /// Coordinates from the images of their prefixes, from some number on.
    finish = finish_body(addend: &Addend, cell: u64, images: &Prefixes, first: usize, out: &mut [f64])
}

#[inline(always)]
fn finish_body(addend: &Addend, cell: u64, images: &Prefixes, first: usize, out: &mut [f64]) {
    let lines = images.words[first..].chunks(LINE).zip(images.fractions[first..].chunks(LINE));
    for (i, (out, (words, fractions))) in out.chunks_mut(LINE).zip(lines).enumerate() {
        let mut sums = line(fractions).map(|fraction| fraction.wrapping_add(addend.fraction));
        for carry in &addend.carries {
            let digits = line(&images.digits[carry.place * images.words.len() + first + i * LINE..]);
            for (sum, digit) in sums.iter_mut().zip(digits) {
                // all ones or zero, and no branch
                let mask = 0_u64.wrapping_sub(u64::from(digit >= carry.least));
                *sum = sum.wrapping_sub(mask & carry.excess);
            }
        }
        let mut units = [0.0; LINE];
        for ((x, word), sum) in units.iter_mut().zip(line(words)).zip(sums) {
            *x = unit_f64(word + product_high(sum, cell));
        }
        out.copy_from_slice(&units[..out.len()]);
    }
}
