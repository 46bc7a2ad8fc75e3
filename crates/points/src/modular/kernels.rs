//! The inner loops of [`ModularPoints`](super::ModularPoints): a sum of words, folded or not, into the caches or past them.

use crate::convert::Unit;
use crate::instruction_sets::for_this_machine;
use crate::scramble::shift_tent::fold;
use crate::streaming::{LANES, Lanes, Stream, store};

/// What is added to the words of a tile: the offsets of some whole rows, over and over. The first [`LANES`] words
/// follow once more after the last, so that a vector may begin at any of them.
#[derive(Clone, Copy)]
pub(super) struct Period<'a> {
    /// The words without those that follow once more; at least [`LANES`].
    pub(super) words: usize,
    /// The offsets.
    pub(super) offsets: &'a [u64],
}

for_this_machine! {
    /// Points that are sums.
    summed = into_caches_summed<T: Unit>(tile: &[u64], period: Period<'_>, out: &mut [T])
}

for_this_machine! {
    /// Points that are folded sums.
    folded = into_caches_folded<T: Unit>(tile: &[u64], period: Period<'_>, out: &mut [T])
}

for_this_machine! {
    /// [`summed`], past the caches. [`LANES`] words follow the last of the tile.
    summed_past = past_caches_summed<T: Unit, VECTOR>(tile: &[u64], period: Period<'_>, out: &mut Stream<'_, T>)
}

for_this_machine! {
    /// [`folded`], past the caches. [`LANES`] words follow the last of the tile.
    folded_past = past_caches_folded<T: Unit, VECTOR>(tile: &[u64], period: Period<'_>, out: &mut Stream<'_, T>)
}

#[inline(always)]
fn into_caches_summed<T: Unit>(tile: &[u64], period: Period<'_>, out: &mut [T]) {
    into_caches::<T, false>(tile, period, out);
}

#[inline(always)]
fn into_caches_folded<T: Unit>(tile: &[u64], period: Period<'_>, out: &mut [T]) {
    into_caches::<T, true>(tile, period, out);
}

#[inline(always)]
fn past_caches_summed<T: Unit, const VECTOR: usize>(
    tile: &[u64],
    period: Period<'_>,
    out: &mut Stream<'_, T>,
) {
    past_caches::<T, VECTOR, false>(tile, period, out);
}

#[inline(always)]
fn past_caches_folded<T: Unit, const VECTOR: usize>(
    tile: &[u64],
    period: Period<'_>,
    out: &mut Stream<'_, T>,
) {
    past_caches::<T, VECTOR, true>(tile, period, out);
}

#[inline(always)]
fn number<T: Unit, const FOLD: bool>(word: u64, offset: u64) -> T {
    let sum = word.wrapping_add(offset);
    T::from_word(if FOLD { fold(sum) } else { sum })
}

#[inline(always)]
fn into_caches<T: Unit, const FOLD: bool>(tile: &[u64], period: Period<'_>, out: &mut [T]) {
    for (tile, out) in tile.chunks(period.words).zip(out.chunks_mut(period.words)) {
        for ((x, &word), &offset) in out.iter_mut().zip(tile).zip(period.offsets) {
            *x = number::<T, FOLD>(word, offset);
        }
    }
}

#[inline(always)]
fn past_caches<T: Unit, const VECTOR: usize, const FOLD: bool>(
    tile: &[u64],
    period: Period<'_>,
    out: &mut Stream<'_, T>,
) {
    let count = (tile.len() - LANES).min(out.places_left());
    let begun = out.lacking().min(count);
    if begun > 0 {
        out.write_part(&numbers::<T, FOLD>(lanes(tile), lanes(period.offsets)), begun);
    }
    let (mut at, mut phase) = (begun, begun);
    while count - at >= LANES {
        phase = if phase >= period.words { phase - period.words } else { phase };
        let lines = ((count - at) / LANES).min((period.words - phase).div_ceil(LANES));
        let (words, offsets) = (&tile[at..][..lines * LANES], &period.offsets[phase..][..lines * LANES]);
        let sources = words.as_chunks().0.iter().zip(offsets.as_chunks().0);
        for (to, (words, offsets)) in out.take_lines(lines).iter_mut().zip(sources) {
            store::<T, VECTOR>(&numbers::<T, FOLD>(words, offsets), to);
        }
        (at, phase) = (at + lines * LANES, phase + lines * LANES);
    }
    if at < count {
        phase = if phase >= period.words { phase - period.words } else { phase };
        let offsets = lanes(&period.offsets[phase..]);
        out.write_part(&numbers::<T, FOLD>(lanes(&tile[at..]), offsets), count - at);
    }
}

#[inline(always)]
fn lanes(words: &[u64]) -> &Lanes<u64> {
    words.first_chunk().expect("LANES words follow the last")
}

#[inline(always)]
fn numbers<T: Unit, const FOLD: bool>(words: &Lanes<u64>, offsets: &Lanes<u64>) -> Lanes<T> {
    std::array::from_fn(|i| number::<T, FOLD>(words[i], offsets[i]))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::instruction_sets::WIDEST;
    use crate::seed::mix;

    fn kernels_agree<T: Unit + PartialEq + std::fmt::Debug>(length: usize, words: usize, skip: usize) {
        let random = |n: usize, salt: u64| (0..n as u64).map(move |i| mix(i + salt));
        let tile: Vec<_> = random(length + LANES, 1).collect();
        let offsets: Vec<_> = random(words, 2000).cycle().take(words + LANES).collect();
        let period = Period { words, offsets: &offsets };
        let mut places = vec![T::default(); length + skip];
        let out = &mut places[skip..];
        for folds in [false, true] {
            let one = |(i, word): (usize, &u64)| {
                let sum = word.wrapping_add(offsets[i % words]);
                T::from_word(if folds { fold(sum) } else { sum })
            };
            let wanted: Vec<T> = tile[..length].iter().enumerate().map(one).collect();
            let into = if folds { folded } else { summed };
            into(&tile, period, out);
            assert_eq!(out, wanted, "{length} {words} {skip}");
            out.fill(T::default());
            let past = if folds { folded_past } else { summed_past };
            past(&tile, period, &mut Stream::new(out));
            assert_eq!(out, wanted, "{length} {words} {skip}, past the caches");
        }
    }

    /// The kernels of this machine against one word at a time, with lengths that no vector divides and arrays
    /// that begin in the middle of a line.
    #[test]
    fn instruction_sets_agree_to_the_bit() {
        for widest in [64, 32, 0] {
            WIDEST.store(widest, Ordering::Relaxed);
            for (length, words) in [(1, 16), (7, 17), (203, 29), (1024, 128), (1000, 128), (999, 333)] {
                for skip in 0..=LANES {
                    kernels_agree::<f64>(length, words, skip);
                    kernels_agree::<f32>(length, words, skip);
                }
            }
        }
        WIDEST.store(64, Ordering::Relaxed);
    }
}
