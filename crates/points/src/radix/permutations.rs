//! Uniform random permutations of digits, from hashes: the whole of one, or single images of many.
//!
//! The shuffle of R. A. Fisher and F. Yates: the number at place i changes places with one at i or after, chosen
//! uniformly. Following one number through the shuffle needs no memory, so vectors follow many through many
//! shuffles. Several choices share a hash as long as they have less than 2^16 values together, so that no
//! permutation is more likely than another by more than one in 2^32.

use crate::instruction_sets::for_this_machine;
use crate::seed::mix;

/// The increment of `SplitMix64`: hashes of one key are numbered by it.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Bits of a hash that choices are made of.
const BITS: u32 = 48;

/// When the choices of a shuffle take a new hash: known from their numbers of values alone.
struct Schedule {
    number: u64,
    values: u64,
}

impl Schedule {
    const START: Self = Self { number: 0, values: u64::MAX >> 16 };

    /// What to add to the keys for a new hash before a choice among `values`, if one is needed.
    #[inline(always)]
    fn fresh(&mut self, values: u64) -> Option<u64> {
        self.values *= values;
        (self.values > 1 << 16).then(|| {
            (self.number, self.values) = (self.number + 1, values);
            self.number.wrapping_mul(STEP)
        })
    }
}

#[inline(always)]
fn choices(key: u64, salt: u64) -> u64 {
    mix(key ^ salt) >> (64 - BITS)
}

/// A uniform number below `values`, and what is left of the fraction for further ones.
#[inline(always)]
fn chosen(fraction: u64, values: u64) -> (u64, u64) {
    let product = fraction * values;
    (product >> BITS, product & ((1 << BITS) - 1))
}

/// The images of 0, 1, … under the permutation that a key has.
pub(super) fn permutation(count: u64, key: u64) -> Vec<u16> {
    let mut numbers: Vec<_> = (0..count).collect();
    let (mut schedule, mut fraction) = (Schedule::START, 0);
    for place in 0..count.saturating_sub(1) {
        if let Some(salt) = schedule.fresh(count - place) {
            fraction = choices(key, salt);
        }
        let (distance, rest) = chosen(fraction, count - place);
        numbers.swap(place as usize, (place + distance) as usize);
        fraction = rest;
    }
    let mut images = vec![0; numbers.len()];
    (0_u32..).zip(numbers).for_each(|(image, number)| images[number as usize] = image as u16);
    images
}

for_this_machine! {
    /// Replaces keys by the images of one number under the permutations that they have.
    images = images_body(number: u64, count: u64, keys: &mut [u64])
}

/// Keys that are followed together.
const LANES: usize = 8;

#[inline(always)]
fn images_body(number: u64, count: u64, keys: &mut [u64]) {
    for keys in keys.chunks_mut(LANES) {
        let (mut lanes, mut places, mut fractions) = ([0; LANES], [number; LANES], [0; LANES]);
        lanes[..keys.len()].copy_from_slice(keys);
        let mut schedule = Schedule::START;
        for place in 0..count.saturating_sub(1) {
            if let Some(salt) = schedule.fresh(count - place) {
                fractions = lanes.map(|key| choices(key, salt));
            }
            for (at, fraction) in places.iter_mut().zip(&mut fractions) {
                let (distance, rest) = chosen(*fraction, count - place);
                let other = place + distance;
                *at = match *at {
                    at if at == place => other,
                    at if at == other => place,
                    at => at,
                };
                *fraction = rest;
            }
        }
        keys.copy_from_slice(&places[..keys.len()]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_images_are_those_of_the_whole() {
        for count in [1, 2, 3, 7, 12, 256, 311] {
            for key in [1, 77, u64::MAX] {
                let whole = permutation(count, key);
                let mut sorted = whole.clone();
                sorted.sort_unstable();
                assert!(sorted.iter().map(|&image| u64::from(image)).eq(0..count));
                for number in 0..count {
                    let mut keys = [key, key + 1, key];
                    images(number, count, &mut keys);
                    assert_eq!([keys[0], keys[2]], [whole[number as usize].into(); 2]);
                }
            }
        }
    }

    /// All 120 permutations of 5 numbers equally often: chi-square with 119 degrees of freedom exceeds 205 once in 10^6.
    #[test]
    fn all_permutations_are_equally_likely() {
        let mut counts = std::collections::BTreeMap::<_, f64>::new();
        for key in (0..120_000).map(mix) {
            *counts.entry(permutation(5, key)).or_default() += 1.0;
        }
        assert_eq!(counts.len(), 120);
        let statistic: f64 = counts.values().map(|count| (count - 1000.0).powi(2) / 1000.0).sum();
        assert!(statistic < 205.0, "{statistic}");
    }
}
