//! The inner loops of [`DigitalNet`](super::DigitalNet).

use crate::convert::Unit;
use crate::instruction_sets::for_this_machine;
use crate::scramble::owen::owen_hash_reversed_64;
use crate::scramble::owen_exact::exact_scrambles;

for_this_machine! {
    /// Points whose randomization is part of the tile and the offset.
    ///
    /// `period` holds the offsets of some whole rows, and `tile` at least as many words as `out`.
    shifted = shifted_body<T: Unit>(tile: &[u64], period: &[u64], out: &mut [T])
}

for_this_machine! {
    /// Owen-scrambled points. `tile` and `period` hold reversed words, `keys` go with `period`.
    owen = owen_body<T: Unit>(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [T])
}

for_this_machine! {
    /// Points scrambled node by node. `keys` go with `period`.
    owen_exact = owen_exact_body<T: Unit>(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [T])
}

for_this_machine! {
    /// Points shifted modulo 1. `keys`, the shifts, go with `period`.
    added = added_body<T: Unit>(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [T])
}

/// Words that are scrambled node by node at a time.
const LANES: usize = 32;

#[inline(always)]
fn shifted_body<T: Unit>(tile: &[u64], period: &[u64], out: &mut [T]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        for ((x, word), offset) in out.iter_mut().zip(tile).zip(period) {
            *x = T::from_word(word ^ offset);
        }
    }
}

#[inline(always)]
fn owen_body<T: Unit>(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [T]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        for (((x, word), offset), &key) in out.iter_mut().zip(tile).zip(period).zip(keys) {
            *x = T::from_word(owen_hash_reversed_64(word ^ offset, key).reverse_bits());
        }
    }
}

#[inline(always)]
fn owen_exact_body<T: Unit>(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [T]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        let parts = tile.chunks(LANES).zip(period.chunks(LANES)).zip(keys.chunks(LANES));
        for (((tile, offsets), keys), out) in parts.zip(out.chunks_mut(LANES)) {
            let (mut words, mut lane_keys) = ([0; LANES], [0; LANES]);
            words.iter_mut().zip(tile).zip(offsets).for_each(|((word, tile), offset)| *word = tile ^ offset);
            lane_keys[..keys.len()].copy_from_slice(keys);
            exact_scrambles(&mut words, &lane_keys);
            out.iter_mut().zip(words).for_each(|(x, word)| *x = T::from_word(word));
        }
    }
}

#[inline(always)]
fn added_body<T: Unit>(tile: &[u64], period: &[u64], keys: &[u64], out: &mut [T]) {
    for (tile, out) in tile.chunks(period.len()).zip(out.chunks_mut(period.len())) {
        for (((x, word), offset), &key) in out.iter_mut().zip(tile).zip(period).zip(keys) {
            *x = T::from_word((word ^ offset).wrapping_add(key));
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
                owen_exact(&tile, &offsets, &keys, &mut fast);
                owen_exact_body(&tile, &offsets, &keys, &mut plain);
                assert_eq!(fast, plain);
                added(&tile, &offsets, &keys, &mut fast);
                added_body(&tile, &offsets, &keys, &mut plain);
                assert_eq!(fast, plain);
            }
            WITHOUT_AVX512.store(false, Ordering::Relaxed);
        }
    }
}
