//! Radical inverses in a prime base, plain and Owen-scrambled: one coordinate of the Halton sequence.
//!
//! The scramble maps each digit to `a·digit + b` modulo the base, with 1 ≤ a < base and 0 ≤ b < base
//! drawn anew, by hashing, for every (seed, dimension, level, prefix). The affine maps with a ≠ 0
//! carry each pair of different digits to each such pair equally often, and the variance of a nested
//! scramble depends on pairs only, so that mean and variance are those of uniform permutations
//! (J. Matoušek, *On the L2-discrepancy for anchored boxes*, 1998). In base 2 that is the binary scramble.
//!
//! Digits are permuted until 2^40 cells are told apart. Those after, which no two of the first 2^40
//! indices share a prefix of, are independent for each index.

use crate::Seed;
use crate::instruction_sets::for_this_machine;
use crate::scramble::owen::nested_uniform_scramble_64;
use crate::seed::mix;

/// Indices that [`RadicalInverse::scrambled_block`] works on at a time.
pub(crate) const BLOCK: usize = 64;

/// Digits are permuted one by one until at least this many cells are told apart.
const CELLS: u128 = 1 << 40;

/// The radical inverse in one base, with the keys of its scramble.
#[derive(Debug)]
pub(crate) struct RadicalInverse {
    base: u64,
    /// 2^128 divided by the number of cells, `base^levels`, rounded down.
    cell: u128,
    /// The key of the whole coordinate, for base 2.
    key: u64,
    /// The key of the digits after the last level.
    tail: u64,
    /// One key for each level.
    levels: Vec<u64>,
}

impl RadicalInverse {
    /// The inverse in a prime `base` below 2^16.
    pub(crate) fn new(base: u64, key: Seed) -> Self {
        let (mut count, mut cells) = (0, 1);
        while cells < CELLS {
            cells *= u128::from(base);
            count += 1;
        }
        Self {
            base,
            // floor((2^128 − 1) / cells) = floor(2^128 / cells), except that 2^40 divides exactly.
            cell: u128::MAX / cells + u128::from(cells.is_power_of_two()),
            key: key.bits64(),
            tail: key.split(0, 0).bits64(),
            levels: (1..=count).map(|level| key.split(0, level).bits64()).collect(),
        }
    }

    /// The radical inverse as a word, cut off after 64 binary digits.
    pub(crate) fn plain(&self, index: u64) -> u64 {
        if self.base == 2 || index == 0 {
            return index.reverse_bits();
        }
        let (mut inverse, mut rest) = (0, index);
        for _ in &self.levels {
            inverse = inverse * self.base + rest % self.base;
            rest /= self.base;
        }
        self.word(inverse, self.plain(rest))
    }

    /// The radical inverse with its digits scrambled, as a word.
    pub(crate) fn scrambled(&self, index: u64) -> u64 {
        if self.base == 2 {
            return nested_uniform_scramble_64(index.reverse_bits(), self.key);
        }
        let (mut inverse, mut rest, mut prefix, mut place) = (0, index, 0, 1);
        for &key in &self.levels {
            let digit = rest % self.base;
            rest /= self.base;
            inverse =
                inverse * self.base + permuted(digit, mix(key ^ prefix), self.base, reciprocal(self.base));
            prefix += digit * place;
            place *= self.base;
        }
        self.word(inverse, mix(self.tail ^ index))
    }

    /// [`scrambled`](Self::scrambled) of consecutive indices from `start` on, faster.
    pub(crate) fn scrambled_block(&self, start: u64, words: &mut [u64; BLOCK]) {
        if self.base == 2 {
            binary_block(start, self.key, words);
            return;
        }
        let (mut digits, mut prefixes, mut inverses) = ([0; BLOCK], [0; BLOCK], [0; BLOCK]);
        let mut place = 1;
        for &key in &self.levels {
            self.digits(start, place, &mut digits);
            permute_level(key, [self.base, place], &digits, &mut prefixes, &mut inverses);
            place *= self.base;
        }
        for (i, word) in words.iter_mut().enumerate() {
            *word = self.word(inverses[i], mix(self.tail ^ start.wrapping_add(i as u64)));
        }
    }

    /// The digit that counts `place`s of consecutive indices: runs of equal ones, like an odometer.
    fn digits(&self, start: u64, place: u64, digits: &mut [u64; BLOCK]) {
        let mut digit = start / place % self.base;
        let mut run = place - start % place;
        let mut rest = &mut digits[..];
        while !rest.is_empty() {
            let (now, later) = rest.split_at_mut(run.min(rest.len() as u64) as usize);
            now.fill(digit);
            digit = if digit + 1 == self.base { 0 } else { digit + 1 };
            (run, rest) = (place, later);
        }
    }

    /// The point at `tail` (in units of 2^-64) of cell number `inverse`.
    fn word(&self, inverse: u64, tail: u64) -> u64 {
        let within = (u128::from(tail >> 24) * self.cell) >> 40;
        ((u128::from(inverse) * self.cell + within) >> 64) as u64
    }
}

/// 2^32 / base, rounded down.
const fn reciprocal(base: u64) -> u64 {
    (1 << 32) / base
}

/// The digit under the affine map that `hash` chooses: two halves give a and b, each as evenly as 2^32
/// values allow. All products are below 2^64, and the image before reduction is below 2^32.
#[inline(always)]
fn permuted(digit: u64, hash: u64, base: u64, reciprocal: u64) -> u64 {
    let factor = 1 + (((hash >> 32) * (base - 1)) >> 32);
    let term = ((hash & 0xffff_ffff) * base) >> 32;
    let image = factor * digit + term;
    // The quotient comes out right or one too small.
    let remainder = image - ((image * reciprocal) >> 32) * base;
    remainder.min(remainder.wrapping_sub(base))
}

for_this_machine! {
    /// One level of the scramble: appends the permuted digits to `inverses`, the digits to `prefixes`.
    permute_level = permute_level_body(
        key: u64, base_and_place: [u64; 2], digits: &[u64; BLOCK], prefixes: &mut [u64; BLOCK],
        inverses: &mut [u64; BLOCK]
    )
}

#[inline(always)]
fn permute_level_body(
    key: u64,
    [base, place]: [u64; 2],
    digits: &[u64; BLOCK],
    prefixes: &mut [u64; BLOCK],
    inverses: &mut [u64; BLOCK],
) {
    let reciprocal = reciprocal(base);
    for ((&digit, prefix), inverse) in digits.iter().zip(prefixes).zip(inverses) {
        *inverse = *inverse * base + permuted(digit, mix(key ^ *prefix), base, reciprocal);
        *prefix += digit * place;
    }
}

for_this_machine! {
    /// The scrambled radical inverses in base 2.
    binary_block = binary_block_body(start: u64, key: u64, words: &mut [u64; BLOCK])
}

#[inline(always)]
fn binary_block_body(start: u64, key: u64, words: &mut [u64; BLOCK]) {
    for (i, word) in (0..).zip(words) {
        *word = nested_uniform_scramble_64(start.wrapping_add(i).reverse_bits(), key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn affine_maps_are_permutations_drawn_evenly() {
        for base in [3, 5, 7, 127, 65_521] {
            let hash = mix(base);
            let mut images: Vec<_> =
                (0..base).map(|digit| permuted(digit, hash, base, reciprocal(base))).collect();
            images.sort_unstable();
            assert!(images.into_iter().eq(0..base), "base {base}");
        }
        // Two digits go to each of the 20 ordered pairs of 5: chi-square with 19 degrees of freedom,
        // beyond 67 once in 3·10^7.
        let mut counts = [0.0_f64; 25];
        for hash in (0..20_000).map(mix) {
            counts
                [(permuted(1, hash, 5, reciprocal(5)) * 5 + permuted(3, hash, 5, reciprocal(5))) as usize] +=
                1.0;
        }
        let pairs = counts.iter().filter(|&&count| count > 0.0);
        assert_eq!(pairs.clone().count(), 20);
        assert!(pairs.map(|count| (count - 1000.0).powi(2) / 1000.0).sum::<f64>() < 67.0);
    }

    #[test]
    fn blocks_have_the_bits_of_single_words() {
        let mut words = [0; BLOCK];
        for base in [2, 3, 31, 8191, 65_521] {
            let inverse = RadicalInverse::new(base, Seed::new(base));
            for start in [0, 1, 6_000, (1 << 40) - 3, u64::MAX - 100] {
                inverse.scrambled_block(start, &mut words);
                assert!((start..).zip(words).all(|(index, word)| word == inverse.scrambled(index)), "{base}");
            }
        }
    }
}
