//! Nested scrambles: each digit is permuted according to all digits before it.
//!
//! Every node of the tree of digits has a random fraction, by hashing: the digits that all further zeros go to. A
//! digit d that is not 0 goes to (z + σ(d)) modulo the base, where z is what 0 goes to and σ a permutation of
//! the digits other than 0, drawn at this node, and leads to a node with a fraction of its own. As z and σ are
//! independent and uniform, so is the permutation. Thus a coordinate costs two hashes for each digit that is not 0,
//! however small its cells.
//!
//! With `owen_exact`, σ is uniform, by following d through a shuffle of all. With `owen`, σ(d) = a d with 1 ≤ a < base: such
//! maps carry each pair of different digits to each such pair equally often in a prime base, and mean and variance
//! depend on pairs only (J. Matousek, *On the L2-discrepancy for anchored boxes*, 1998). In other bases that fails,
//! and σ is uniform too. That errors and gain coefficients of `owen` are those of `owen_exact` is tested
//! (`tests/radix_owen_statistics.rs`, feature `statistics`).

use super::permutations::images as permuted;
use super::places::{LINE, Places, line, product, product_high};
use crate::Seed;
use crate::convert::unit_f64;
use crate::instruction_sets::for_this_machine;
use crate::primes::is_prime;
use crate::scramble::Randomization;
use crate::seed::mix;

/// A nested scramble of one coordinate.
#[derive(Clone, Debug)]
pub(super) struct Nested {
    /// Whether σ is a product instead of uniform.
    affine: bool,
    root: u64,
    /// For each place, what the hashes of σ and those of the nodes below differ by.
    keys: Vec<[u64; 2]>,
}

/// A prefix: the cell that it is in, and what is in the rest of its digits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Node {
    pub(super) cell: u64,
    pub(super) fraction: u64,
}

/// One digit of many coordinates at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Digit {
    base: u64,
    value: u64,
    affine: bool,
    /// 2^32 / base, rounded down.
    reciprocal: u64,
    /// What the hashes of σ and of the next node differ by.
    keys: [u64; 2],
    /// What 1 is worth here, in units of 2^-64 of a cell.
    worth: u64,
}

impl Nested {
    pub(super) fn new(places: &Places, randomization: Randomization, key: Seed) -> Self {
        let keys = (0..places.digits as u64).map(|place| [0, 1].map(|tag| key.split(tag, place).bits64()));
        Self {
            affine: randomization == Randomization::Owen && is_prime(places.base),
            root: key.bits64(),
            keys: keys.collect(),
        }
    }

    /// The node of a prefix.
    pub(super) fn node(&self, places: &Places, prefix: u64) -> Node {
        places.follow(prefix, self.root(), |place, digit| self.step(places, place, digit))
    }

    /// The nodes of all prefixes.
    pub(super) fn nodes(&self, places: &Places) -> Vec<Node> {
        places.grow(self.root(), |place, digit| self.step(places, place, digit))
    }

    fn root(&self) -> Node {
        Node { cell: 0, fraction: self.root }
    }

    fn step(&self, places: &Places, place: usize, digit: u64) -> impl Fn(Node) -> Node + use<> {
        let digit = self.digit(places, place, digit);
        move |Node { cell, fraction }| {
            let mut fractions = [fraction];
            let [image] = digit.descend(&mut fractions);
            Node { cell: cell * digit.base + image, fraction: fractions[0] }
        }
    }

    fn digit(&self, places: &Places, place: usize, digit: u64) -> Digit {
        let [turn, child] = self.keys[place];
        Digit {
            base: places.base,
            value: digit,
            affine: self.affine,
            reciprocal: (1 << 32) / places.base,
            keys: [turn, mix(child.wrapping_add(digit))],
            worth: place.checked_sub(places.low).map_or(0, |high| places.worth[high]),
        }
    }

    /// The high digits, into `digits`.
    pub(super) fn digits(&self, places: &Places, high: &[u64], digits: &mut Vec<Digit>) {
        digits.clear();
        digits.extend((places.low..).zip(high).map(|(place, &digit)| self.digit(places, place, digit)));
    }
}

impl Digit {
    /// Replaces the fractions of nodes by those of the next, and gives the images of the digit.
    #[inline(always)]
    fn descend<const N: usize>(&self, fractions: &mut [u64; N]) -> [u64; N] {
        let scaled = fractions.map(|fraction| scaled(fraction, self.base));
        let mut images = scaled.map(|(zero, _)| zero);
        if self.value == 0 {
            *fractions = scaled.map(|(_, rest)| rest);
            return images;
        }
        let mut turns = fractions.map(|fraction| mix(fraction ^ self.keys[0]));
        if self.affine {
            for (image, turn) in images.iter_mut().zip(turns) {
                let factor = 1 + (product(turn >> 32, self.base - 1) >> 32);
                *image = self.reduced(*image + product(factor, self.value));
            }
        } else {
            permuted(self.value - 1, self.base - 1, &mut turns);
            for (image, turned) in images.iter_mut().zip(turns) {
                *image = self.reduced(*image + turned + 1);
            }
        }
        *fractions = fractions.map(|fraction| mix(fraction ^ self.keys[1]));
        images
    }

    /// A number below 2^32, modulo the base.
    #[inline(always)]
    fn reduced(&self, number: u64) -> u64 {
        // The quotient comes out right or one too small.
        let remainder = number - product(product(number, self.reciprocal) >> 32, self.base);
        remainder.min(remainder.wrapping_sub(self.base))
    }
}

/// The first digit of a fraction, and the rest of it.
#[inline(always)]
fn scaled(fraction: u64, base: u64) -> (u64, u64) {
    let (upper, lower) = (product(fraction >> 32, base), product(fraction, base));
    let sum = upper + (lower >> 32);
    (sum >> 32, sum << 32 | lower & 0xffff_ffff)
}

for_this_machine! {
    /// Coordinates from the words and the fractions of the nodes of their prefixes.
    finish = finish_body(digits: &[Digit], cell: u64, words: &[u64], fractions: &[u64], out: &mut [f64])
}

#[inline(always)]
fn finish_body(digits: &[Digit], cell: u64, words: &[u64], fractions: &[u64], out: &mut [f64]) {
    let lines = words.chunks(LINE).zip(fractions.chunks(LINE));
    for (out, (words, fractions)) in out.chunks_mut(LINE).zip(lines) {
        let (mut rests, mut sums) = (line(fractions), [0; LINE]);
        for digit in digits {
            let images = digit.descend(&mut rests);
            for (sum, image) in sums.iter_mut().zip(images) {
                *sum += product(image, digit.worth) + (product(image, digit.worth >> 32) << 32);
            }
        }
        match digits.last() {
            None => sums = rests,
            Some(last) => {
                for (sum, rest) in sums.iter_mut().zip(rests) {
                    *sum += product_high(rest, last.worth);
                }
            }
        }
        let mut units = [0.0; LINE];
        for ((x, word), sum) in units.iter_mut().zip(line(words)).zip(sums) {
            *x = unit_f64(word + product_high(sum, cell));
        }
        out.copy_from_slice(&units[..out.len()]);
    }
}
