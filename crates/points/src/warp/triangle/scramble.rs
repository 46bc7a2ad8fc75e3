//! Nested uniform scrambling in base 4: at every node of the tree of digits, one of the 24 permutations of its own.
//!
//! Digits are permuted until 2^40 cells are told apart; those after, which no two of the first 2^40 indices share a
//! prefix of, are independent for each index. So a scrambled point is uniform to its last digit.

use crate::scramble::Randomization;
use crate::seed::mix;
use crate::{Error, Seed};

/// What points of triangles take, the default of the scrambled ones first.
pub const ACCEPTS: &[Randomization] =
    &[Randomization::Owen, Randomization::DigitalShift, Randomization::None];

/// Levels whose digits are permuted.
const LEVELS: u32 = 20;

/// The permutations of four digits: digit d becomes bits 2d and 2d + 1.
static PERMUTATIONS: [u8; 24] = permutations();

const fn permutations() -> [u8; 24] {
    let (mut all, mut count, mut code) = ([0; 24], 0, 0);
    while code < 256 {
        let digits = [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6];
        if 1 << digits[0] | 1 << digits[1] | 1 << digits[2] | 1 << digits[3] == 15 {
            all[count] = code as u8;
            count += 1;
        }
        code += 1;
    }
    all
}

/// A randomization of words in base 4, first digit most significant.
#[derive(Clone, Copy, Debug)]
pub struct Scramble {
    randomization: Randomization,
    key: u64,
    tail: u64,
}

impl Scramble {
    /// One of [`ACCEPTS`].
    ///
    /// # Errors
    /// If it is another.
    pub fn new(sequence: &'static str, randomization: Randomization, seed: Seed) -> Result<Self, Error> {
        if !ACCEPTS.contains(&randomization) {
            return Err(Error::NotAccepted { sequence, randomization, accepts: ACCEPTS });
        }
        Ok(Self { randomization, key: seed.bits64(), tail: seed.split(0, 0).bits64() })
    }

    /// The digits of the point with this index.
    #[inline]
    pub fn apply(&self, word: u64, index: u64) -> u64 {
        match self.randomization {
            Randomization::None => word,
            Randomization::DigitalShift => word ^ self.key,
            _ => self.nested(word, index),
        }
    }

    fn nested(&self, word: u64, index: u64) -> u64 {
        let mut scrambled = 0;
        for level in 0..LEVELS {
            // the digits before, after a 1 that tells nodes of different depths apart
            let node = (word >> 1 | 1 << 63) >> (63 - 2 * level);
            let bits = mix(mix(node ^ self.key).wrapping_add(self.key));
            let permutation = PERMUTATIONS[(((bits >> 32) * 24) >> 32) as usize];
            let digit = word >> (62 - 2 * level) & 3;
            scrambled = scrambled << 2 | u64::from(permutation >> (2 * digit) & 3);
        }
        let rest = 64 - 2 * LEVELS;
        scrambled << rest | mix(mix(index.wrapping_add(self.tail)) ^ self.key) >> (2 * LEVELS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over keys, two digits below one node go to each pair of different digits equally often: 12 pairs, 11 degrees of freedom; 60 is
    /// beyond one in 10^8. Below different nodes they are independent: 16 pairs, 15 degrees of freedom.
    #[test]
    fn pairs_of_digits_go_to_uniform_pairs() {
        for (a, b, pairs) in [(0_u64, 1_u64, 12), (2, 3, 12), (4, 9, 16), (5, 13, 16)] {
            let mut counts = [0.0; 16];
            for seed in 0..48_000 {
                let scramble =
                    Scramble::new("", Randomization::Owen, Seed::new(seed)).expect("it is accepted");
                let digit = |word: u64| scramble.apply(word << 60, 0) >> 60 & 3;
                counts[(digit(a) * 4 + digit(b)) as usize] += 1.0;
            }
            let expected = 48_000.0 / f64::from(pairs);
            let statistic = |count: f64| (count - expected) * (count - expected) / expected;
            let seen = counts.iter().filter(|&&count| count > 0.0);
            assert_eq!(seen.clone().count(), pairs as usize);
            assert!(seen.map(|&count| statistic(count)).sum::<f64>() < 60.0, "{counts:?}");
        }
    }

    #[test]
    fn digits_before_a_difference_stay_equal() {
        let scramble = Scramble::new("", Randomization::Owen, Seed::new(3)).expect("it is accepted");
        for i in 0..1000 {
            let word = mix(i);
            for level in 0..LEVELS {
                let other = word ^ 1 << (62 - 2 * level);
                let differ = scramble.apply(word, 0) ^ scramble.apply(other, 1);
                assert_eq!(differ.leading_zeros() / 2, level);
            }
        }
    }
}
