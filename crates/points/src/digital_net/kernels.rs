//! The inner loops of [`DigitalNet`](super::DigitalNet), compiled for several instruction sets.
//!
//! Plain Rust that the compiler turns into vector instructions; the widest set the machine has is
//! chosen at run time. Everything is integer arithmetic and one exact conversion, so that all
//! versions give the same bits.

use crate::convert::unit_f64;
use crate::scramble::owen::owen_hash_reversed_64;

/// Defines a kernel `$name` that runs `$body` with the widest instruction set of this machine.
macro_rules! for_this_machine {
    ($(#[$doc:meta])* $name:ident = $body:ident ($($arg:ident : $type:ty),*)) => {
        $(#[$doc])*
        pub(super) fn $name($($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,gfni")]
                fn avx512($($arg: $type),*) {
                    $body($($arg),*);
                }
                #[target_feature(enable = "avx2")]
                fn avx2($($arg: $type),*) {
                    $body($($arg),*);
                }
                if has_avx512() {
                    #[allow(unsafe_code, reason = "the instruction set was checked the line before")]
                    // SAFETY: the features that `avx512` needs were found on this machine.
                    return unsafe { avx512($($arg),*) };
                }
                if is_x86_feature_detected!("avx2") {
                    #[allow(unsafe_code, reason = "the instruction set was checked the line before")]
                    // SAFETY: the feature that `avx2` needs was found on this machine.
                    return unsafe { avx2($($arg),*) };
                }
            }
            $body($($arg),*);
        }
    };
}

/// Ice Lake, Zen 4 and later: what the 512-bit kernels use.
#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512vbmi")
        && is_x86_feature_detected!("gfni")
}

for_this_machine! {
    /// Points without a scramble or with a digital shift, which is part of the offset.
    ///
    /// `period` holds the offsets of some whole rows, and `tile` at least as many words as `out`.
    shifted = shifted_body(tile: &[u64], period: &[u64], out: &mut [f64])
}

for_this_machine! {
    /// Owen-scrambled points. `tile` and `period` hold reversed words, `keys` go with `period`.
    owen = owen_body(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [f64])
}

#[inline(always)]
fn shifted_body(tile: &[u64], period: &[u64], out: &mut [f64]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        for ((x, word), offset) in out.iter_mut().zip(tile).zip(period) {
            *x = unit_f64(word ^ offset);
        }
    }
}

#[inline(always)]
fn owen_body(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [f64]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        for (((x, word), offset), &key) in out.iter_mut().zip(tile).zip(period).zip(keys) {
            *x = unit_f64(owen_hash_reversed_64(word ^ offset, key).reverse_bits());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernels of this machine against the plain compilation of the same loop, lengths included
    /// that no vector divides.
    #[test]
    fn instruction_sets_agree_to_the_bit() {
        let words = |n: u64, salt| (0..n).map(|i| crate::seed::mix(i + salt)).collect::<Vec<_>>();
        for (length, period) in [(1, 1), (7, 5), (203, 29), (1024, 128), (1000, 128)] {
            let (tile, offsets, keys) = (words(length, 1), words(period, 2000), words(period, 3000));
            let mut fast = vec![0.0; length as usize];
            let mut plain = fast.clone();
            owen(&tile, &offsets, &keys, &mut fast);
            owen_body(&tile, &offsets, &keys, &mut plain);
            assert_eq!(fast, plain);
            shifted(&tile, &offsets, &mut fast);
            shifted_body(&tile, &offsets, &mut plain);
            assert_eq!(fast, plain);
        }
    }
}
