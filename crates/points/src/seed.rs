//! The only source of randomness: a small value that splits into as many independent ones as asked.
//!
//! Everything random in the house is a pure function of a [`Seed`]. Code that needs several
//! independent decisions splits the seed; nothing draws numbers in sequence, so no result depends on
//! the order of evaluation, on threads or on machines.

/// A splittable seed.
///
/// Children are made by hashing: for a given parent and kind, different numbers give different
/// children with certainty, and children of different parents or kinds are unrelated 64-bit hashes.
///
/// ```
/// use evenlight_points::Seed;
/// let seed = Seed::new(7);
/// assert_eq!(seed.replicate(1).dimension(3), Seed::new(7).replicate(1).dimension(3));
/// assert_ne!(seed.replicate(1).dimension(3), seed.dimension(3).replicate(1));
/// assert_ne!(seed.pixel(1, 2), seed.pixel(2, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Seed(u64);

/// The fractional part of the golden ratio times 2^64: the increment of `SplitMix64`.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl Seed {
    /// The tag of [`Seed::replicate`].
    pub const REPLICATE: u64 = 1;
    /// The tag of [`Seed::dimension`].
    pub const DIMENSION: u64 = 2;
    /// The tag of [`Seed::pixel`].
    pub const PIXEL: u64 = 3;

    /// The seed of a whole computation. Any number will do, 0 included.
    pub const fn new(number: u64) -> Self {
        Self(mix(number.wrapping_add(GOLDEN)))
    }

    /// The seed of one of many independent repetitions.
    #[must_use]
    pub const fn replicate(self, replicate: u64) -> Self {
        self.split(Self::REPLICATE, replicate)
    }

    /// The seed of one coordinate.
    #[must_use]
    pub const fn dimension(self, dimension: u64) -> Self {
        self.split(Self::DIMENSION, dimension)
    }

    /// The seed of one pixel.
    #[must_use]
    pub const fn pixel(self, x: u32, y: u32) -> Self {
        self.split(Self::PIXEL, (y as u64) << 32 | x as u64)
    }

    /// Child `number` of kind `tag`. Tags below 16 belong to this crate; use others for your own kinds.
    #[must_use]
    #[inline]
    pub const fn split(self, tag: u64, number: u64) -> Self {
        // Both steps are bijections: of the parent for a given child, and of `number` for a given
        // parent and tag, because the golden multiplier is odd.
        let kind = mix(self.0.wrapping_add(tag));
        Self(mix(kind.wrapping_add(number.wrapping_mul(GOLDEN))))
    }

    /// 64 uniform bits.
    #[inline]
    pub const fn bits64(self) -> u64 {
        self.0
    }

    /// 32 uniform bits: the upper half of [`Seed::bits64`].
    #[inline]
    pub const fn bits32(self) -> u32 {
        (self.0 >> 32) as u32
    }
}

/// A bijection of 64-bit words in which every input bit flips every output bit about half the time:
/// variant 13 of D. Stafford's search over the finalizer of `MurmurHash3`, used in `SplitMix64`
/// (G. Steele, D. Lea and C. Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014).
#[inline]
pub(crate) const fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A uniform word of a counter and two keys. Two rounds with two keys: a single round would be one of
/// `SplitMix64`'s streams, all of which are parts of one cycle, so that two dimensions could overlap.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) const fn counted(index: u64, first: u64, second: u64) -> u64 {
    mix(mix(first.wrapping_add(index)) ^ second)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_flipped_bit_flips_half_of_the_bits_of_a_child() {
        let flips: u32 = (0..64)
            .flat_map(|bit| (0..64).map(move |number| (bit, number)))
            .map(|(bit, number)| {
                let (a, b) = (Seed::new(number), Seed::new(number ^ (1 << bit)));
                (a.dimension(5).bits64() ^ b.dimension(5).bits64()).count_ones()
            })
            .sum();
        let mean = f64::from(flips) / f64::from(64 * 64);
        // The standard deviation of the mean is 4 / 64; five of them: one false alarm in two million.
        assert!((mean - 32.0).abs() < 5.0 * 4.0 / 64.0, "{mean}");
    }

    #[test]
    fn numbered_children_of_all_kinds_are_different() {
        let parents = (0..100).map(Seed::new);
        let mut seen: Vec<u64> = parents
            .flat_map(|parent| {
                (0..50).flat_map(move |n| (0..4).map(move |tag| parent.split(tag, n).bits64()))
            })
            .collect();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 100 * 50 * 4);
    }
}
