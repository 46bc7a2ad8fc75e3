//! The inner loops of [`DigitalNet`](super::DigitalNet).

use crate::convert::{Digits, Unit};
use crate::instruction_sets::for_this_machine;

for_this_machine! {
    /// Points without a scramble or with a digital shift, which is part of the offset.
    ///
    /// `period` holds the offsets of some whole rows, and `tile` at least as many words as `out`.
    shifted = shifted_body<T: Unit>(tile: &[T::Digits], period: &[T::Digits], out: &mut [T])
}

for_this_machine! {
    /// Owen-scrambled points. `tile` and `period` hold reversed words, and `keys` what the hash adds and
    /// multiplies with, for as many words as `period`.
    owen = owen_body<T: Unit>(
        tile: &[T::Digits], period: &[T::Digits], keys: [&[T::Digits]; 2], out: &mut [T])
}

#[inline(always)]
fn shifted_body<T: Unit>(tile: &[T::Digits], period: &[T::Digits], out: &mut [T]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        for ((x, &word), &offset) in out.iter_mut().zip(tile).zip(period) {
            *x = T::from_digits(word ^ offset);
        }
    }
}

#[inline(always)]
fn owen_body<T: Unit>(tile: &[T::Digits], period: &[T::Digits], keys: [&[T::Digits]; 2], out: &mut [T]) {
    let [addends, multipliers] = keys;
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        let keys = addends.iter().zip(multipliers);
        for (((x, &word), &offset), (&addend, &multiplier)) in out.iter_mut().zip(tile).zip(period).zip(keys) {
            *x = T::from_digits((word ^ offset).owen(addend, multiplier).reversed());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::instruction_sets::WITHOUT_AVX512;

    /// The kernels of this machine against the plain compilation of the same loop, lengths included
    /// that no vector divides.
    #[test]
    fn instruction_sets_agree_to_the_bit() {
        let words = |n: u64, salt| (0..n).map(|i| crate::seed::mix(i + salt)).collect::<Vec<_>>();
        for (length, period) in [(1, 1), (7, 5), (203, 29), (1024, 128), (1000, 128)] {
            let (tile, offsets, keys) = (words(length, 1), words(period, 2000), words(period, 3000));
            let mut fast = vec![0.0_f64; length as usize];
            let mut plain = fast.clone();
            for without_avx512 in [false, true] {
                WITHOUT_AVX512.store(without_avx512, Ordering::Relaxed);
                owen(&tile, &offsets, &keys, &mut fast);
                owen_body(&tile, &offsets, &keys, &mut plain);
                assert_eq!(fast, plain);
                shifted(&tile, &offsets, &mut fast);
                shifted_body(&tile, &offsets, &mut plain);
                assert_eq!(fast, plain);
            }
            WITHOUT_AVX512.store(false, Ordering::Relaxed);
        }
    }
}
