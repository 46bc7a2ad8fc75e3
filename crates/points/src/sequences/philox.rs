//! Philox4x64-10: counter-based pseudo-random numbers that other libraries reproduce.
//!
//! Every dimension is a stream of its own; any number of it costs the same. Choose it instead of
//! `independent`, which is faster, where numbers must be those of other software: column j is what
//! NumPy's `Philox(key=…)` and cuRAND's design give for the column's key (see [`Philox::key`]).

use std::ops::Range;

use super::Entry;
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "philox",
    cite: "J. Salmon, M. Moraes, R. Dror and D. Shaw, Parallel random numbers: as easy as 1, 2, 3, SC'11 (2011)",
    accepts: &[Randomization::None],
    takes: &[],
    most_dims: 1 << 20,
    build: |spec| Ok(Box::new(Philox::new(spec.dims, spec.seed))),
};

/// Words that a counter gives.
const WORDS: u64 = 4;

/// Independent uniform points.
#[derive(Debug)]
pub struct Philox {
    keys: Vec<[u64; 2]>,
}

impl Philox {
    /// Points of `dims` coordinates.
    pub fn new(dims: usize, seed: Seed) -> Self {
        Self { keys: (0..dims as u64).map(|dim| Self::key(seed, dim)).collect() }
    }

    /// The key of a dimension.
    pub fn key(seed: Seed, dim: u64) -> [u64; 2] {
        [0, 1].map(|half| seed.dimension(dim).split(0, half).bits64())
    }
}

impl PointSet for Philox {
    fn dims(&self) -> usize {
        self.keys.len()
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims(), seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        unit_f64(numbered(index, self.keys[dim])[(index % WORDS) as usize])
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        let mut start = rows.start;
        let mut rest = out;
        while !rest.is_empty() {
            // Up to the next counter.
            let skipped = (start % WORDS) as usize;
            let places = ((WORDS as usize - skipped) * self.dims()).min(rest.len());
            let (part, later) = rest.split_at_mut(places);
            for (dim, &key) in self.keys.iter().enumerate() {
                let words = numbered(start, key);
                let column = part.iter_mut().skip(dim).step_by(self.keys.len());
                column.zip(&words[skipped..]).for_each(|(x, &word)| *x = unit_f64(word));
            }
            (start, rest) = (start.wrapping_add((places / self.dims()) as u64), later);
        }
    }
}

/// The words of the counter that number `index` comes from. The first counter is 1, as in NumPy.
fn numbered(index: u64, key: [u64; 2]) -> [u64; 4] {
    philox([1 + index / WORDS, 0, 0, 0], key)
}

/// Ten rounds of J. Salmon, M. Moraes, R. Dror and D. Shaw (SC'11, 2011).
fn philox(mut counter: [u64; 4], mut key: [u64; 2]) -> [u64; 4] {
    for _ in 0..10 {
        let [a, b, c, d] = counter;
        let left = u128::from(a) * 0xd2e7_470e_e14c_6c93;
        let right = u128::from(c) * 0xca5a_8263_9512_1157;
        counter =
            [(right >> 64) as u64 ^ b ^ key[0], right as u64, (left >> 64) as u64 ^ d ^ key[1], left as u64];
        // The golden ratio and the square root of 3, less 1.
        key = [key[0].wrapping_add(0x9e37_79b9_7f4a_7c15), key[1].wrapping_add(0xbb67_ae85_84ca_a73b)];
    }
    counter
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The known answers that come with the authors' library Random123.
    #[test]
    fn published_words_are_reproduced() {
        let zeros = [0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b];
        assert_eq!(philox([0; 4], [0; 2]), zeros);
        let ones = [0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0];
        assert_eq!(philox([u64::MAX; 4], [u64::MAX; 2]), ones);
        let pi = [0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89];
        let digits = [0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6];
        assert_eq!(philox(pi, [0x452821e638d01377, 0xbe5466cf34e90c6c]), digits);
    }

    /// `Generator(Philox(key=…)).random(1000)` of NumPy 2, the key being an array of `uint64`.
    #[test]
    fn numpy_gives_the_same_numbers() {
        let points = Philox { keys: vec![[0x0123456789abcdef, 0xfedcba9876543210]] };
        for (index, bits) in NUMPY {
            assert_eq!(points.coord(index, 0), f64::from_bits(bits), "number {index}");
        }
    }

    const NUMPY: [(u64, u64); 4] = [
        (0, 0x3fc6973e04e0c9e0),
        (1, 0x3feaad8d545a23e0),
        (4, 0x3fd5bff533e13458),
        (999, 0x3fbc9130a6e4b258),
    ];
}
