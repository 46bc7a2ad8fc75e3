//! The hash behind `scramble::owen`, in 32 and 64 bits, for machines with or without an operating system.
//!
//! The 64-bit version is for double precision. Its constants continue those of 32 bits, so that the
//! lower halves behave alike, and its multiplier has 64 random bits instead of 16.
//!
//! Both map (0, seed 0) to 0: hash your seeds first, as [`Seed`](crate::Seed) does.

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
pub const fn owen_hash_reversed_32(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
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

/// What the hash adds and what it multiplies with.
#[inline]
pub(crate) const fn key_64(seed: u64) -> (u64, u64) {
    (seed, seed.rotate_left(32) | 1)
}

/// [`owen_hash_reversed_64`] with a prepared key.
#[inline(always)]
pub(crate) const fn keyed_64(mut x: u64, addend: u64, multiplier: u64) -> u64 {
    x ^= x.wrapping_mul(0x9d5c_8a1f_3d20_adea);
    x = x.wrapping_add(addend);
    x = x.wrapping_mul(multiplier);
    x ^= x.wrapping_mul(0xc2b2_ae3d_0552_6c56);
    x ^ x.wrapping_mul(0x6f4b_91d7_53a2_2864)
}

/// The lower half of [`keyed_64`] from the lower halves of its arguments. Information only travels
/// upwards, so that nothing else is needed, and single precision costs half of the work.
#[inline(always)]
pub(crate) const fn keyed_64_low(mut x: u32, addend: u32, multiplier: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(addend);
    x = x.wrapping_mul(multiplier);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
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
}
