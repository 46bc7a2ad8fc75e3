//! Random permutations of 0, 1, …, n − 1 that are computed, not stored: any image costs the same.
//!
//! A number is written in two digits, `left · right_size + right` with both sizes near √n, and each
//! digit in turn is moved by a hash of the other: a Feistel network over any two moduli (J. Black and
//! P. Rogaway, *Ciphers with arbitrary finite domains*, CT-RSA 2002). The few numbers past the end that
//! the two digits can write, fewer than √n, are skipped by applying the network again.
//!
//! How many rounds: two numbers that share a digit keep their difference in the other until the shared
//! digit comes apart, which it fails to do with probability 1/size in each pair of rounds. There are as
//! many rounds as leave less than 2⁻¹⁸ of that. All other pairs go to uniform pairs, and the variance of
//! a mean over permuted strata depends on pairs alone.

use crate::instruction_sets::for_this_machine;
use crate::seed::mix;

/// The most numbers that can be permuted, so that digits have 16 bits and images 32.
pub(crate) const MOST: u64 = 1 << 31;

/// Pairs of rounds at least.
const PAIRS: u32 = 3;

/// The keys that a random word has for a number: permutations of one kind that are independent.
pub(crate) const fn keys_for(word: u64, number: u64) -> Keys {
    keys(mix(word.wrapping_add(number)))
}

/// The permutations of some numbers, one for each key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shuffle {
    n: u64,
    /// How many values the left and the right digit have.
    sizes: [u32; 2],
    pairs: u32,
}

/// The most numbers that are permuted at a time.
pub(crate) const BLOCK: usize = 256;

/// What a permutation is known by: the key of the first round and the odd step to the next one's.
pub(crate) type Keys = [u32; 2];

/// The two halves of a random word as the keys of a permutation.
pub(crate) const fn keys(word: u64) -> Keys {
    [word as u32, (word >> 32) as u32 | 1]
}

impl Shuffle {
    /// Permutations of `n` numbers, at least 1 and at most [`MOST`].
    pub(crate) fn new(n: u64) -> Self {
        assert!((1..=MOST).contains(&n), "{n} numbers to permute");
        let root = n.isqrt();
        let left = root + u64::from(root * root < n);
        let right = n.div_ceil(left);
        let mut pairs = PAIRS;
        while right > 1 && right.saturating_pow(pairs) < 1 << 18 {
            pairs += 1;
        }
        Self { n, sizes: [left as u32, right as u32], pairs }
    }

    /// The two digits of a number.
    pub(crate) fn digits(&self, number: u64) -> [u32; 2] {
        let right = u64::from(self.sizes[1]);
        [(number / right) as u32, (number % right) as u32]
    }

    /// The digits of the number after the one with these.
    pub(crate) fn next(&self, [left, right]: [u32; 2]) -> [u32; 2] {
        if right + 1 == self.sizes[1] { [left + 1, 0] } else { [left, right + 1] }
    }

    /// The image of a number below `n`.
    pub(crate) fn image(&self, number: u64, keys: Keys) -> u64 {
        debug_assert!(number < self.n, "{number} of {} numbers", self.n);
        self.walk(self.digits(number), keys)
    }

    /// The images of numbers that are given by their digits, each under the permutation of its own
    /// keys; they replace the left digits.
    pub(crate) fn images(&self, left: &mut [u32], right: &mut [u32], keys: [&[u32]; 2]) {
        for pair in 0..self.pairs {
            rounds(self.sizes, pair, keys, left, right);
        }
        let mut most = 0;
        join(self.sizes[1], left, right, &mut most);
        if u64::from(most) >= self.n {
            for (i, image) in left.iter_mut().enumerate().filter(|(_, image)| u64::from(**image) >= self.n) {
                *image = self.walk(self.digits(u64::from(*image)), [keys[0][i], keys[1][i]]) as u32;
            }
        }
    }

    /// Replaces numbers below `n` by their images, each under the permutation of its own keys.
    pub(crate) fn permute(&self, numbers: &mut [u32], keys: [&[u32]; 2]) {
        let mut right = [0; BLOCK];
        let right = &mut right[..numbers.len()];
        divide(self.sizes[1], numbers, right);
        self.images(numbers, right, keys);
    }

    /// [`permute`](Self::permute) with the same keys for all.
    pub(crate) fn permute_alike(&self, numbers: &mut [u32], [key, step]: Keys) {
        let (keys, steps) = ([key; BLOCK], [step; BLOCK]);
        self.permute(numbers, [&keys[..numbers.len()], &steps[..numbers.len()]]);
    }

    /// [`permute`](Self::permute) with the keys that a random word has for each of some other numbers.
    pub(crate) fn permute_apart(&self, numbers: &mut [u32], word: u64, others: &[u32]) {
        let (mut keys, mut steps) = ([0; BLOCK], [0; BLOCK]);
        let (keys, steps) = (&mut keys[..numbers.len()], &mut steps[..numbers.len()]);
        keys_apart(word, others, keys, steps);
        self.permute(numbers, [keys, steps]);
    }

    /// Applies the network until it leads back to a number below `n`.
    fn walk(&self, mut digits: [u32; 2], [key, step]: Keys) -> u64 {
        loop {
            for pair in 0..self.pairs {
                digits = pair_of_rounds(self.sizes, digits, round_keys(pair, key, step));
            }
            let image = u64::from(digits[0]) * u64::from(self.sizes[1]) + u64::from(digits[1]);
            if image < self.n {
                return image;
            }
        }
    }
}

#[inline(always)]
fn round_keys(pair: u32, key: u32, step: u32) -> Keys {
    let first = key.wrapping_add(step.wrapping_mul(2 * pair));
    [first, first.wrapping_add(step)]
}

/// Moves the left digit by a hash of the right one, then the right digit by a hash of the left one.
#[inline(always)]
fn pair_of_rounds(sizes: [u32; 2], [left, right]: [u32; 2], keys: Keys) -> [u32; 2] {
    let left = moved(left, hash(right, keys[0]), sizes[0]);
    [left, moved(right, hash(left, keys[1]), sizes[1])]
}

/// `digit` plus a uniform number made of `hash`, modulo `size`.
#[inline(always)]
fn moved(digit: u32, hash: u32, size: u32) -> u32 {
    // Below 2 · 2^16: subtracting once too often wraps to a large number.
    let sum = digit + (((hash >> 16) * size) >> 16);
    sum.min(sum.wrapping_sub(size))
}

/// A hash of two words whose upper half is used: two multiplications by odd constants without small
/// structure (the first digits of the golden and the silver ratio).
#[inline(always)]
fn hash(digit: u32, key: u32) -> u32 {
    let mut x = (digit ^ key).wrapping_mul(0x9e37_79b1);
    x ^= x >> 15;
    x = x.wrapping_add(key).wrapping_mul(0x6a09_e667);
    x ^ (x >> 13)
}

for_this_machine! {
    /// One pair of rounds of many permutations, one number each.
    rounds = rounds_body(sizes: [u32; 2], pair: u32, keys: [&[u32]; 2], left: &mut [u32], right: &mut [u32])
}

#[inline(always)]
fn rounds_body(sizes: [u32; 2], pair: u32, keys: [&[u32]; 2], left: &mut [u32], right: &mut [u32]) {
    for (((left, right), &key), &step) in left.iter_mut().zip(right).zip(keys[0]).zip(keys[1]) {
        [*left, *right] = pair_of_rounds(sizes, [*left, *right], round_keys(pair, key, step));
    }
}

for_this_machine! {
    /// Divides numbers below 2^31; they become quotients.
    divide = divide_body(by: u32, numbers: &mut [u32], remainders: &mut [u32])
}

#[inline(always)]
fn divide_body(by: u32, numbers: &mut [u32], remainders: &mut [u32]) {
    let reciprocal = (1 << 32) / u64::from(by);
    for (number, remainder) in numbers.iter_mut().zip(remainders) {
        // Right, or one too small.
        let quotient = ((u64::from(*number) * reciprocal) >> 32) as u32;
        let rest = *number - quotient * by;
        let short = u32::from(rest >= by);
        (*number, *remainder) = (quotient + short, rest - short * by);
    }
}

for_this_machine! {
    /// [`keys_for`] many numbers.
    keys_apart = keys_apart_body(word: u64, numbers: &[u32], keys: &mut [u32], steps: &mut [u32])
}

#[inline(always)]
fn keys_apart_body(word: u64, numbers: &[u32], keys: &mut [u32], steps: &mut [u32]) {
    for ((&number, key), step) in numbers.iter().zip(keys).zip(steps) {
        [*key, *step] = keys_for(word, u64::from(number));
    }
}

for_this_machine! {
    /// Digits to numbers, which replace the left digits, and the largest of them.
    join = join_body(size: u32, left: &mut [u32], right: &[u32], most: &mut u32)
}

#[inline(always)]
fn join_body(size: u32, left: &mut [u32], right: &[u32], most: &mut u32) {
    let mut largest = 0;
    for (left, right) in left.iter_mut().zip(right) {
        *left = *left * size + right;
        largest = largest.max(*left);
    }
    *most = largest;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Seed;

    fn word(seed: u64) -> Keys {
        keys(Seed::new(seed).bits64())
    }

    #[test]
    fn every_number_has_its_image() {
        for n in (1..=130).chain([1000, 1021, 1 << 12, 65_537]) {
            let shuffle = Shuffle::new(n);
            let mut images: Vec<_> = (0..n).map(|i| shuffle.image(i, word(n))).collect();
            images.sort_unstable();
            assert!(images.into_iter().eq(0..n), "{n}");
        }
    }

    #[test]
    fn quotients_and_remainders_are_exact() {
        let numbers = [0, 1, 2, 6, 7, 1000, 65_535, (1 << 31) - 2, (1 << 31) - 1];
        for by in [1, 2, 3, 7, 1000, 46_337, 65_536, (1 << 31) - 1] {
            let (mut quotients, mut remainders) = (numbers, [0; 9]);
            divide(by, &mut quotients, &mut remainders);
            for ((number, quotient), remainder) in numbers.iter().zip(quotients).zip(remainders) {
                assert_eq!((quotient, remainder), (number / by, number % by), "{number} by {by}");
            }
        }
    }

    #[test]
    fn many_at_a_time_are_the_same() {
        for n in [1, 2, 3, 5, 100, 1 << 20, (1 << 20) + 1, MOST - 1, MOST] {
            let shuffle = Shuffle::new(n);
            let numbers: Vec<_> = (0..n).step_by((n as usize / 400).max(1)).collect();
            let (mut left, mut right): (Vec<_>, Vec<_>) =
                numbers.iter().map(|&i| shuffle.digits(i)).map(|[left, right]| (left, right)).unzip();
            let (first, step): (Vec<_>, Vec<_>) =
                numbers.iter().map(|&i| word(i)).map(|[a, b]| (a, b)).unzip();
            shuffle.images(&mut left, &mut right, [&first, &step]);
            for (&number, &image) in numbers.iter().zip(&left) {
                assert_eq!(u64::from(image), shuffle.image(number, word(number)), "{number} of {n}");
            }
        }
    }

    /// Pearson's statistic of counts that are expected to be equal, in standard deviations.
    fn excess(counts: &[f64]) -> f64 {
        let expected = counts.iter().sum::<f64>() / counts.len() as f64;
        let statistic = counts.iter().map(|count| (count - expected).powi(2) / expected).sum::<f64>();
        let freedom = (counts.len() - 1) as f64;
        (statistic - freedom) / (2.0 * freedom).sqrt()
    }

    /// Over keys, two numbers go to each pair of different numbers equally often. The statistic is above 6
    /// standard deviations for one in 10^6 at 6 degrees of freedom, far less often at more; 70 checks.
    #[test]
    fn pairs_go_to_uniform_pairs() {
        for n in [2_u64, 3, 4, 5, 6, 7, 8, 9, 12, 13, 16, 25, 30] {
            let shuffle = Shuffle::new(n);
            for (a, b) in [(0, 1), (0, n - 1), (n / 2, n - 1), (1, n / 2 + 1)] {
                if a == b || b >= n {
                    continue;
                }
                let mut counts = vec![0.0; (n * n) as usize];
                for seed in 0..100 * n * n {
                    let key = word(seed + 1000 * n);
                    counts[(shuffle.image(a, key) * n + shuffle.image(b, key)) as usize] += 1.0;
                }
                let same: f64 = counts.iter().step_by(n as usize + 1).sum();
                assert_eq!(same, 0.0);
                let counts: Vec<_> =
                    (0..counts.len()).filter(|i| i % (n as usize + 1) != 0).map(|i| counts[i]).collect();
                assert!(excess(&counts) < 10.0, "{a} and {b} of {n}: {}", excess(&counts));
            }
        }
    }

    /// All 24 permutations of 4 numbers, and all 120 of 5, are equally frequent.
    #[test]
    fn permutations_of_few_numbers_are_uniform() {
        for n in [3_u64, 4, 5] {
            let shuffle = Shuffle::new(n);
            let mut counts = std::collections::HashMap::new();
            for seed in 0..120_000 {
                let code = (0..n).fold(0, |code, i| code * n + shuffle.image(i, word(seed)));
                *counts.entry(code).or_insert(0.0) += 1.0;
            }
            let counts: Vec<_> = counts.into_values().collect();
            assert_eq!(counts.len() as u64, (1..=n).product::<u64>());
            assert!(excess(&counts) < 6.0, "{n}: {}", excess(&counts));
        }
    }
}
