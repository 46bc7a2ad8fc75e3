//! `sobol`: two-dimensional Sobol' points, padded: every pair of dimensions of every pixel has its own Owen scramble and its
//! own order. The default.
//!
//! Any 2^k consecutive sample indices that start at a multiple of 2^k are a (0, k, 2)-net in each pair. The order is a nested uniform
//! shuffle (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)), so pairs are independent of each other. In two
//! dimensions the Sobol' matrices are the identity and Pascal's triangle mod 2, whose product with a word takes five shifts (Ahmed 2024,
//! "An Implementation Algorithm of 2D Sobol Sequence Fast, Elegant, and Compact").

use evenlight_points::Seed;
use evenlight_points::scramble::owen::owen_hash_reversed_32;

use crate::sampler::{BLOCK, Entry, unit_f32};

pub(crate) const ENTRY: Entry = Entry {
    name: "sobol",
    cite: "Burley 2020, Practical Hash-based Owen Scrambling, JCGT 9(4); Sobol' 1967",
    base: Some(2),
    fill,
};

const PAIRS: usize = BLOCK / 2;

fn fill(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the CPU was just found to have AVX2.
        #[expect(unsafe_code, reason = "eight pairs at a time in AVX2 registers")]
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
    let reversed_index = index.reverse_bits();
    let mut x = [0; PAIRS];
    let mut y = [0; PAIRS];
    for pair in 0..PAIRS {
        let number = block * PAIRS as u32 + pair as u32;
        // three keys of the pair: for the order and for each coordinate
        let order = mix(number.wrapping_mul(0x9e37_79b9).wrapping_add(low)) ^ high;
        let order = mix(order);
        let key_x = mix(order ^ 0x85eb_ca6b);
        let key_y = mix(order ^ 0xc2b2_ae35);
        // words hold the first digit in their lowest bit from here on
        let shuffled = owen_hash_reversed_32(reversed_index, order).reverse_bits();
        x[pair] = owen_hash_reversed_32(shuffled, key_x).reverse_bits();
        y[pair] = owen_hash_reversed_32(pascal(shuffled), key_y).reverse_bits();
    }
    for pair in 0..PAIRS {
        out[2 * pair] = unit_f32(x[pair]);
        out[2 * pair + 1] = unit_f32(y[pair]);
    }
}

/// The second Sobol' coordinate of an index, first digit in the lowest bit: digit k is the parity of the index bits j with C(j, k) odd,
/// that is (Lucas), with all binary digits of k among those of j.
#[inline(always)]
fn pascal(mut word: u32) -> u32 {
    word ^= (word >> 1) & 0x5555_5555;
    word ^= (word >> 2) & 0x3333_3333;
    word ^= (word >> 4) & 0x0f0f_0f0f;
    word ^= (word >> 8) & 0x00ff_00ff;
    word ^ (word >> 16)
}

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
        for index in [0, 1, 77, u32::MAX] {
            let (mut vector, mut scalar) = ([0.0; BLOCK], [0.0; BLOCK]);
            fill(key, index, 9, &mut vector);
            fill_lanes(key, index, 9, &mut scalar);
            assert_eq!(vector, scalar);
        }
    }

    #[test]
    fn pascal_matches_binomials() {
        for k in 0..32_u32 {
            for j in 0..32_u32 {
                let odd = k & j == k; // C(j, k) is odd (Lucas)
                assert_eq!(pascal(1 << j) >> k & 1 == 1, odd, "C({j}, {k})");
            }
        }
    }
}
