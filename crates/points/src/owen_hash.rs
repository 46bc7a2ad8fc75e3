//! The hash behind `scramble::owen`, in 32 and 64 bits, for machines with or without an operating system.
//!
//! The 64-bit version is for double precision. Its lower half, the first 32 digits, is the hash of 32 bits with 32 random bits
//! in its multiplier instead of 16. To the upper half go the upper halves of the products, so that every digit depends on
//! all before it; it is multiplied by the random number itself, which makes the pairs of points that agree in 32 digits
//! as uniform as any others. All of it are products of 32 bits, which all vector units have.
//!
//! Both map (0, seed 0) to 0: hash your seeds first, as [`Seed`](crate::Seed) does.

use crate::seed::mix;

/// Scrambles a 32-bit word, first digit in its most significant bit.
///
/// For renderers: inlined into a loop over an array, it becomes vector instructions.
///
/// ```
/// use evenlight_points::scramble::owen::nested_uniform_scramble_32;
/// assert_eq!(nested_uniform_scramble_32(0x12345678, 0x9e3779b9), 0x942414a5);
/// ```
#[inline]
pub const fn nested_uniform_scramble_32(x: u32, seed: u32) -> u32 {
    owen_hash_reversed_32(x.reverse_bits(), seed).reverse_bits()
}

/// The core of [`nested_uniform_scramble_32`], on a word whose first digit is the least significant
/// bit. Tables of bit-reversed direction numbers save the first reversal.
#[inline]
pub const fn owen_hash_reversed_32(x: u32, seed: u32) -> u32 {
    keyed_64_low(x, seed, (seed >> 16) | 1)
}

/// Scrambles a 64-bit word, first digit in its most significant bit.
#[inline]
pub const fn nested_uniform_scramble_64(x: u64, seed: u64) -> u64 {
    owen_hash_reversed_64(x.reverse_bits(), seed).reverse_bits()
}

/// The core of [`nested_uniform_scramble_64`], on a word whose first digit is the least significant bit.
#[inline]
pub const fn owen_hash_reversed_64(x: u64, seed: u64) -> u64 {
    let (addend, multiplier) = key_64(seed);
    keyed_64(x, addend, multiplier)
}

/// What the hash adds and what it multiplies with, the latter below 2^32.
#[inline]
pub(crate) const fn key_64(seed: u64) -> (u64, u64) {
    (seed & 0xffff_ffff | mix(seed) >> 32 << 32, seed >> 32 | 1)
}

/// The even factors of N. Vegdahl's hash.
const FACTORS: [u32; 3] = [0x3d20_adea, 0x0552_6c56, 0x53a2_2864];

/// [`owen_hash_reversed_64`] with a prepared key.
#[inline(always)]
const fn keyed_64(x: u64, addend: u64, multiplier: u64) -> u64 {
    let x = scaled_64(folded_64(x, FACTORS[0]).wrapping_add(addend), multiplier);
    folded_64(folded_64(x, FACTORS[1]), FACTORS[2])
}

#[inline(always)]
const fn folded_64(x: u64, factor: u32) -> u64 {
    x ^ product(x, factor as u64)
}

#[inline(always)]
const fn scaled_64(x: u64, multiplier: u64) -> u64 {
    product(x, multiplier).wrapping_add(product(x >> 32, multiplier) << 32)
}

/// The product of two lower halves, which one instruction multiplies in vectors.
#[inline(always)]
const fn product(x: u64, y: u64) -> u64 {
    (x & 0xffff_ffff) * (y & 0xffff_ffff)
}

/// The lower half of [`owen_hash_reversed_64`] from the lower halves of its arguments. Information only travels
/// upwards, so that nothing else is needed, and single precision costs half of the work.
#[inline(always)]
pub(crate) const fn keyed_64_low(x: u32, addend: u32, multiplier: u32) -> u32 {
    let x = folded_32(x, FACTORS[0]).wrapping_add(addend).wrapping_mul(multiplier);
    folded_32(folded_32(x, FACTORS[1]), FACTORS[2])
}

#[inline(always)]
const fn folded_32(x: u32, factor: u32) -> u32 {
    x ^ x.wrapping_mul(factor)
}

/// [`owen_hash_reversed_64`] of some words with prepared keys. Step by step for all of them: a processor finds work in the
/// instructions that are next, and those of one word wait for each other.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn keyed_64_each<const N: usize>(x: &mut [u64; N], addends: &[u64; N], multipliers: &[u64; N]) {
    for x in x.iter_mut() {
        *x = folded_64(*x, FACTORS[0]);
    }
    for i in 0..N {
        x[i] = x[i].wrapping_add(addends[i]);
    }
    for i in 0..N {
        x[i] = scaled_64(x[i], multipliers[i]);
    }
    for x in x.iter_mut() {
        *x = folded_64(*x, FACTORS[1]);
    }
    for x in x.iter_mut() {
        *x = folded_64(*x, FACTORS[2]);
    }
}

/// [`keyed_64_low`] of some words.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn keyed_64_low_each<const N: usize>(
    x: &mut [u32; N],
    addends: &[u32; N],
    multipliers: &[u32; N],
) {
    for x in x.iter_mut() {
        *x = folded_32(*x, FACTORS[0]);
    }
    for i in 0..N {
        x[i] = x[i].wrapping_add(addends[i]);
    }
    for i in 0..N {
        x[i] = x[i].wrapping_mul(multipliers[i]);
    }
    for x in x.iter_mut() {
        *x = folded_32(*x, FACTORS[1]);
    }
    for x in x.iter_mut() {
        *x = folded_32(*x, FACTORS[2]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of N. Vegdahl's published hash.
    #[test]
    fn the_published_hash_is_reproduced() {
        assert_eq!(nested_uniform_scramble_32(0, 0xdeadbeef), 0xa792495e);
        assert_eq!(nested_uniform_scramble_32(0x80000000, 0xdeadbeef), 0x6607918a);
        assert_eq!(nested_uniform_scramble_32(0x12345678, 0x9e3779b9), 0x942414a5);
    }

    #[test]
    fn the_lower_half_needs_only_lower_halves() {
        for i in 0..1000 {
            let (word, seed) = (crate::seed::mix(i), crate::seed::mix(!i));
            let (addend, multiplier) = key_64(seed);
            let low = keyed_64_low(word as u32, addend as u32, multiplier as u32);
            assert_eq!(low, owen_hash_reversed_64(word, seed) as u32);
        }
    }

    #[test]
    fn many_at_a_time_are_the_same() {
        let words: [u64; 16] = std::array::from_fn(|i| mix(i as u64));
        let seeds = words.map(|word| mix(!word));
        let (addends, multipliers) = (seeds.map(|seed| key_64(seed).0), seeds.map(|seed| key_64(seed).1));
        let expected: [_; 16] = std::array::from_fn(|i| owen_hash_reversed_64(words[i], seeds[i]));
        let mut all = words;
        keyed_64_each(&mut all, &addends, &multipliers);
        assert_eq!(all, expected);
        let mut low = words.map(|word| word as u32);
        keyed_64_low_each(&mut low, &addends.map(|key| key as u32), &multipliers.map(|key| key as u32));
        assert_eq!(low, expected.map(|word| word as u32));
    }
}
