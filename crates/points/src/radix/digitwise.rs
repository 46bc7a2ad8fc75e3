//! Randomizations that treat every digit by its place alone: none, a digital shift, a permutation for each place.
//!
//! A coordinate is then the sum of what its low and its high digits are worth: one table and one addend for a
//! whole block of rows. A shift modulo 1 is one more addend.

use super::permutations::permutation;
use super::places::{LINE, Places, TABULATED, line, product_high};
use crate::Seed;
use crate::convert::unit_f64;
use crate::instruction_sets::for_this_machine;
use crate::scramble::Randomization;
use crate::shuffle::{Keys, Shuffle, keys};

/// What happens to the digits of a place.
#[derive(Clone, Debug)]
enum Map {
    Shift(u64),
    Table(Vec<u16>),
    /// A permutation of too many digits for a table.
    Computed(Shuffle, Keys),
}

impl Map {
    #[inline]
    fn image(&self, digit: u64, base: u64) -> u64 {
        match self {
            Self::Shift(shift) if digit + shift >= base => digit + shift - base,
            Self::Shift(shift) => digit + shift,
            Self::Table(images) => images[digit as usize].into(),
            Self::Computed(shuffle, keys) => shuffle.image(digit, *keys),
        }
    }
}

/// A map for each place, and a shift modulo 1.
#[derive(Clone, Debug)]
pub(super) struct Digitwise {
    maps: Vec<Map>,
    /// What 0 in the high digits from each on is worth, in units of 2^-64 of a cell.
    zeros: Vec<u64>,
    shift: u64,
}

impl Digitwise {
    pub(super) fn new(places: &Places, randomization: Randomization, key: Seed) -> Self {
        let map = |place| match randomization {
            Randomization::DigitPermutation => permuting(places.base, key.split(0, place).bits64()),
            Randomization::DigitalShift => {
                let bits = u128::from(key.split(0, place).bits64());
                Map::Shift(((bits * u128::from(places.base)) >> 64) as u64)
            }
            _ => Map::Shift(0),
        };
        let maps: Vec<_> = (0..places.digits as u64).map(map).collect();
        let mut zeros = vec![0; places.worth.len() + 1];
        for (i, (map, worth)) in maps[places.low..].iter().zip(&places.worth).enumerate().rev() {
            zeros[i] = zeros[i + 1] + map.image(0, places.base) * worth;
        }
        let shift = if randomization == Randomization::Shift { key.bits64() } else { 0 };
        Self { maps, zeros, shift }
    }

    /// What a prefix is worth, in units of 2^-64.
    pub(super) fn word(&self, places: &Places, prefix: u64) -> u64 {
        places.edge(places.follow(prefix, 0, |place, digit| self.step(places, place, digit)))
    }

    /// The same for all prefixes.
    pub(super) fn words(&self, places: &Places) -> Vec<u64> {
        let mut cells = places.grow(0, |place, digit| self.step(places, place, digit));
        for cell in &mut cells {
            *cell = places.edge(*cell);
        }
        cells
    }

    fn step(&self, places: &Places, place: usize, digit: u64) -> impl Fn(u64) -> u64 + use<> {
        let (base, image) = (places.base, self.maps[place].image(digit, places.base));
        move |cell| cell * base + image
    }

    /// What high digits are worth, in units of 2^-64.
    pub(super) fn addend(&self, places: &Places, high: &[u64]) -> u64 {
        let maps = self.maps[places.low..].iter().zip(&places.worth);
        let given: u64 =
            maps.zip(high).map(|((map, worth), &digit)| map.image(digit, places.base) * worth).sum();
        product_high(given + self.zeros[high.len()], places.cell).wrapping_add(self.shift)
    }
}

/// A uniform random permutation of digits.
fn permuting(base: u64, key: u64) -> Map {
    if base <= TABULATED {
        Map::Table(permutation(base, key))
    } else {
        Map::Computed(Shuffle::new(base), keys(key))
    }
}

for_this_machine! {
    /// Coordinates from the words of their prefixes.
    finish = finish_body(addend: u64, words: &[u64], out: &mut [f64])
}

#[inline(always)]
fn finish_body(addend: u64, words: &[u64], out: &mut [f64]) {
    for (out, words) in out.chunks_mut(LINE).zip(words.chunks(LINE)) {
        let units = line(words).map(|word| unit_f64(word.wrapping_add(addend)));
        out.copy_from_slice(&units[..out.len()]);
    }
}
