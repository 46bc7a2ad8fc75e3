//! `sobol`: four-dimensional points in base 2, padded: every quadruple of dimensions of every pixel has its own Owen scramble and its
//! own order. The default.
//!
//! The first and the last two numbers of a quadruple are pairs: any 2^k consecutive sample indices that start at a multiple of 2^k are a
//! (0, k, 2)-net in base 2 in each of them, and any 4^k that start at a multiple of 4^k a (0, k, 4)-net in base 4 in all four
//! together (Ahmed, Pharr, Ostromoukhov & Huang 2025, "SZ Sequences: Binary-Constructed (0, 2^q)-Sequences"). Sobol's own third
//! and fourth dimensions are neither. Owen scrambling in base 2 keeps both properties. The order is a nested uniform shuffle (Burley 2020,
//! "Practical Hash-based Owen Scrambling", JCGT 9(4)), so quadruples are independent of each other.

mod matrices;

use evenlight_points::Seed;
use evenlight_points::scramble::owen::owen_hash_reversed_32;

use crate::sampler::{BLOCK, Entry, GOLDEN, Sharing, mix, unit_f32};
use matrices::{DIMS, NIBBLES, WORDS};

pub(crate) const ENTRY: Entry = Entry {
    name: "sobol",
    cite: "Burley 2020, Practical Hash-based Owen Scrambling, JCGT 9(4); Ahmed et al. 2025, SZ Sequences; Sobol' 1967",
    base: Some(2),
    sharing: Sharing::Pixel,
    fill,
};

const GROUPS: usize = BLOCK / DIMS;

fn fill(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the CPU was just found to have AVX2.
        #[expect(unsafe_code, reason = "eight dimensions at a time in AVX2 registers")]
        unsafe {
            fill_avx2(key, index, block, out);
        }
        return;
    }
    fill_lanes(key, index, block, out);
}

/// The portable code, compiled to AVX2: same bits.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn fill_avx2(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]) {
    fill_lanes(key, index, block, out);
}

#[inline(always)]
fn fill_lanes(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]) {
    let mut words = [0; BLOCK];
    let mut keys = [0; BLOCK];
    let words_of = words.as_chunks_mut::<DIMS>().0.iter_mut();
    let groups = words_of.zip(keys.as_chunks_mut::<DIMS>().0);
    for ((words, keys), number) in groups.zip(block * GROUPS as u32..) {
        let bits = mix(key.bits64().wrapping_add(u64::from(number + 1).wrapping_mul(GOLDEN)));
        let (order, scramble) = ((bits >> 32) as u32, bits as u32);
        *words = point(index, order);
        *keys = std::array::from_fn(|dim| scramble.wrapping_add(KEYS[dim]));
    }
    for ((number, word), key) in out.iter_mut().zip(words).zip(keys) {
        *number = unit_f32(owen_hash_reversed_32(word, lowbias(key)).reverse_bits());
    }
}

/// The four coordinates of a point before scrambling, first digits in the lowest bits, after a nested uniform shuffle of the index.
///
/// The upper halves of all indices are changed by the same exclusive-or. That is a digital shift of the points, which their scramble
/// swallows; it makes the upper halves of small indices vanish.
#[inline(always)]
fn point(index: u32, order: u32) -> [u32; DIMS] {
    let shuffled = owen_hash_reversed_32(index.reverse_bits(), order);
    let mut words = half_point(shuffled >> 16, &WORDS[0]);
    if index >> 16 != 0 {
        let upper = half_point((shuffled ^ owen_hash_reversed_32(0, order)) & 0xffff, &WORDS[1]);
        words = std::array::from_fn(|dim| words[dim] ^ upper[dim]);
    }
    words
}

/// What sixteen index bits contribute, the first of them being the highest.
#[inline(always)]
fn half_point(bits: u32, table: &[[[u32; DIMS]; 16]; NIBBLES]) -> [u32; DIMS] {
    let nibble = |n: usize| &table[n][(bits >> (12 - 4 * n)) as usize & 15];
    let (a, b, c, d) = (nibble(0), nibble(1), nibble(2), nibble(3));
    std::array::from_fn(|dim| a[dim] ^ b[dim] ^ c[dim] ^ d[dim])
}

/// What tells the scrambles of the four dimensions apart: fractions of the golden ratio.
const KEYS: [u32; DIMS] = [0x9e37_79b9, 0x3c6e_f372, 0xdaa6_6d2b, 0x78dd_e6e4];

/// A bijection of 32-bit words with low bias (C. Wellons 2018, "Prospecting for Hash Functions": lowbias32).
#[inline(always)]
fn lowbias(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vector_and_scalar_code_give_the_same_bits() {
        let key = Seed::new(3).pixel(5, 7);
        for index in [0, 1, 77, 65_535, 65_536, u32::MAX] {
            let (mut vector, mut scalar) = ([0.0; BLOCK], [0.0; BLOCK]);
            fill(key, index, 9, &mut vector);
            fill_lanes(key, index, 9, &mut scalar);
            assert_eq!(vector, scalar);
        }
    }
}
