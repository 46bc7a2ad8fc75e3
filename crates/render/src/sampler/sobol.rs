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

use crate::sampler::{BLOCK, Entry, unit_f32};
use matrices::{DIMS, NIBBLES, WORDS};

pub(crate) const ENTRY: Entry = Entry {
    name: "sobol",
    cite: "Burley 2020, Practical Hash-based Owen Scrambling, JCGT 9(4); Ahmed et al. 2025, SZ Sequences; Sobol' 1967",
    base: Some(2),
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
    let bits = key.bits64();
    let (low, high) = (bits as u32, (bits >> 32) as u32);
    let mut words = [0; BLOCK];
    let mut keys = [0; BLOCK];
    for (group, (words, keys)) in
        words.as_chunks_mut::<DIMS>().0.iter_mut().zip(keys.as_chunks_mut::<DIMS>().0).enumerate()
    {
        let number = block * GROUPS as u32 + group as u32;
        let order = mix(mix(number.wrapping_mul(GOLDEN).wrapping_add(low)) ^ high);
        *keys = std::array::from_fn(|dim| order.wrapping_add(GOLDEN.wrapping_mul(dim as u32 + 1)));
        *words = point(shuffle(index, order));
    }
    for ((number, word), key) in out.iter_mut().zip(words).zip(keys) {
        *number = unit_f32(owen_hash_reversed_32(word, mix(key)).reverse_bits());
    }
}

/// A nested uniform shuffle of all indices, up to an exclusive-or of the upper halves of all of them: that is a digital shift of the
/// points, which their scramble swallows. It makes the upper halves of small indices vanish.
#[inline(always)]
fn shuffle(index: u32, key: u32) -> u32 {
    let shuffled = owen_hash_reversed_32(index.reverse_bits(), key).reverse_bits();
    if index < 1 << 16 {
        return shuffled & 0xffff;
    }
    shuffled ^ (owen_hash_reversed_32(0, key).reverse_bits() & 0xffff_0000)
}

/// The four coordinates of a point before scrambling, first digits in the lowest bits.
#[inline(always)]
fn point(index: u32) -> [u32; DIMS] {
    let mut words = [0; DIMS];
    let used = if index < 1 << 16 { NIBBLES / 2 } else { NIBBLES };
    for (nibble, table) in WORDS[..used].iter().enumerate() {
        let row = &table[(index >> (4 * nibble)) as usize & 15];
        words = std::array::from_fn(|dim| words[dim] ^ row[dim]);
    }
    words
}

const GOLDEN: u32 = 0x9e37_79b9;

/// A bijection of 32-bit words with low bias (C. Wellons 2018, "Prospecting for Hash Functions": lowbias32).
#[inline(always)]
fn mix(mut x: u32) -> u32 {
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

    /// All of any aligned power of two of indices, once each.
    #[test]
    fn shuffles_keep_aligned_runs_together() {
        for (start, length) in [(0, 64), (192, 64), (1 << 16, 1 << 10), ((1 << 17) - 512, 512_u32)] {
            let mut run: Vec<_> = (start..start + length).map(|index| shuffle(index, 0x1234_5678)).collect();
            run.sort_unstable();
            assert!(run[0].is_multiple_of(length));
            assert!(run.iter().zip(run[0]..).all(|(&a, b)| a == b));
        }
        let mut all: Vec<_> = (0..1 << 17).map(|index| shuffle(index, 0x1234_5678)).collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 1 << 17);
    }
}
