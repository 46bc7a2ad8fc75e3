//! `halton`: dimension j uses the j-th prime, with the digits of every pixel and dimension scrambled by their own nested
//! permutations. Any number of samples is as good as any other, but there is no common structure of pairs in high dimensions.
//!
//! A digit d of prime p becomes `(factor · d + shift) mod p` with factor and shift hashed from all digits before it (Matoušek 1998,
//! "On the L2-discrepancy for anchored boxes"): mean and variance are those of Owen's uniform permutations. Zeros add nothing to
//! the prefix, so that one hash serves all of a run of zeros, and the endless run after the last digit of the index: its bits as a
//! fraction, digit after digit in base p, are the shifts.

use std::sync::LazyLock;

use evenlight_points::Seed;

use crate::sampler::{BLOCK, Entry, GOLDEN, Sharing, independent, mix, unit_f32};

pub(crate) const ENTRY: Entry = Entry {
    name: "halton",
    cite: "Halton 1960, Numer. Math. 2; Owen 1995; Matousek 1998, J. Complexity 14",
    base: None,
    sharing: Sharing::Pixel,
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
    let start = key.split(TAG, 0).bits64();
    for ((number, &prime), dimension) in out.iter_mut().zip(primes).zip(first as u64..) {
        *number = scrambled_radical_inverse(prime, index, mix(start ^ dimension));
    }
}

fn scrambled_radical_inverse(prime: u32, index: u32, key: u64) -> f32 {
    let scale = 1.0 / f64::from(prime);
    let (mut rest, mut prefix, mut weight) = (index, 0_u64, 1_u64);
    let (mut inverse, mut place) = (0.0, 1.0);
    let (mut shifts, mut factor) = hash(key, prefix, prime);
    while rest != 0 {
        let digit = rest % prime;
        rest /= prime;
        let product = u128::from(shifts) * u128::from(prime);
        let shift = (product >> 64) as u32;
        shifts = product as u64;
        place *= scale;
        inverse += place * f64::from((factor * digit + shift) % prime);
        if digit != 0 {
            prefix += u64::from(digit) * weight;
            (shifts, factor) = hash(key, prefix, prime);
        }
        weight *= u64::from(prime);
    }
    let tail = f64::from(unit_f32((shifts >> 32) as u32));
    ((inverse + place * tail) as f32).min(1.0 - f32::EPSILON / 2.0)
}

/// The shifts of the nodes under a prefix and the factor, from 1 to p - 1, that all of them share.
#[inline]
fn hash(key: u64, prefix: u64, prime: u32) -> (u64, u32) {
    let shifts = mix(key.wrapping_add(GOLDEN.wrapping_mul(prefix)));
    let other = shifts.wrapping_mul(GOLDEN) >> 32;
    (shifts, 1 + ((other * u64::from(prime - 1)) >> 32) as u32)
}

const TAG: u64 = 17;
