//! `halton`: dimension j uses the j-th prime, with the digits of every pixel and dimension scrambled by their own nested
//! permutations. Any number of samples is as good as any other, but there is no common structure of pairs in high dimensions.
//!
//! A digit d of prime p becomes `(factor · d + shift) mod p` with factor and shift hashed from all digits before it (Matoušek 1998,
//! "On the L2-discrepancy for anchored boxes"): mean and variance are those of Owen's uniform permutations.

use std::sync::LazyLock;

use evenlight_points::Seed;

use crate::sampler::{BLOCK, Entry, independent};

pub(crate) const ENTRY: Entry = Entry {
    name: "halton",
    cite: "Halton 1960, Numer. Math. 2; Owen 1995; Matousek 1998, J. Complexity 14",
    base: None,
    fill,
};

/// Dimensions after these are independent: no light path gets there before roulette.
const DIMENSIONS: usize = 1024;

static PRIMES: LazyLock<Vec<u32>> = LazyLock::new(|| {
    let mut primes: Vec<u32> = Vec::with_capacity(DIMENSIONS);
    let mut candidate = 2_u32;
    while primes.len() < DIMENSIONS {
        if primes.iter().all(|&prime| !candidate.is_multiple_of(prime)) {
            primes.push(candidate);
        }
        candidate += 1;
    }
    primes
});

fn fill(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]) {
    let first = block as usize * BLOCK;
    let Some(primes) = PRIMES.get(first..first + BLOCK) else {
        return (independent::ENTRY.fill)(key, index, block, out);
    };
    for ((number, &prime), dimension) in out.iter_mut().zip(primes).zip(first as u64..) {
        *number = scrambled_radical_inverse(prime, index, key.dimension(dimension));
    }
}

fn scrambled_radical_inverse(prime: u32, index: u32, key: Seed) -> f32 {
    let scale = 1.0 / f64::from(prime);
    let (mut rest, mut prefix, mut place) = (index, 0_u64, 1.0_f64);
    let mut inverse = 0.0;
    // digits below 2^-26 cannot be seen in 24 bits
    while place > 1.0 / 67_108_864.0 {
        let hash = key.split(TAG, prefix).bits64();
        let digit = rest % prime;
        rest /= prime;
        let factor = 1 + (((hash >> 32) * u64::from(prime - 1)) >> 32);
        let shift = ((hash & 0xffff_ffff) * u64::from(prime)) >> 32;
        place *= scale;
        inverse += place * ((factor * u64::from(digit) + shift) % u64::from(prime)) as f64;
        // leaves of the tree of prefixes are told apart by level and digits
        prefix = (prefix + 1) * u64::from(prime) + u64::from(digit);
    }
    (inverse as f32).min(1.0 - f32::EPSILON / 2.0)
}

const TAG: u64 = 17;
