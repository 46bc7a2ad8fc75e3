//! The inner loops of [`DigitalNet`](super::DigitalNet).
//!
//! Two loops for the same numbers: one into the caches and one past them, each with and without the Owen hash.

use super::interlaced::spread;
use crate::convert::{Digits, Unit};
use crate::instruction_sets::for_this_machine;
use crate::scramble::owen_exact::exact_scrambles;
use crate::streaming::{LANES, Lanes, Stream, store};

/// What is combined with the words of a tile: the offsets and keys of some whole rows, over and over.
/// The first [`LANES`] words follow once more after the last, so that a vector may begin at any of them.
#[derive(Clone, Copy)]
pub(super) struct Period<'a, D> {
    /// The words without those that follow once more; at least [`LANES`].
    pub(super) words: usize,
    /// What is added to the words of the tile without carry.
    pub(super) offsets: &'a [D],
    /// What the Owen hash adds and multiplies with, or the one key of a randomization by word; empty without either.
    pub(super) keys: [&'a [D]; 2],
}

for_this_machine! {
    /// Points without a scramble, or with one that is in the matrices and the offsets.
    shifted = into_caches<T: Unit>(tile: &[T::Digits], period: Period<'_, T::Digits>, out: &mut [T])
}

for_this_machine! {
    /// Owen-scrambled points. Tile and offsets are reversed words.
    owen = into_caches_owen<T: Unit>(tile: &[T::Digits], period: Period<'_, T::Digits>, out: &mut [T])
}

for_this_machine! {
    /// [`shifted`], past the caches. [`LANES`] words follow the last of the tile.
    shifted_past = past_caches_shifted<T: Unit, VECTOR>(
        tile: &[T::Digits], period: Period<'_, T::Digits>, out: &mut Stream<'_, T>)
}

for_this_machine! {
    /// [`owen`], past the caches. [`LANES`] words follow the last of the tile.
    owen_past = past_caches_owen<T: Unit, VECTOR>(
        tile: &[T::Digits], period: Period<'_, T::Digits>, out: &mut Stream<'_, T>)
}

for_this_machine! {
    /// Points scrambled node by node.
    owen_exact = owen_exact_body<T: Unit>(tile: &[u64], period: Period<'_, u64>, out: &mut [T])
}

for_this_machine! {
    /// Points shifted modulo 1.
    added = added_body<T: Unit>(tile: &[u64], period: Period<'_, u64>, out: &mut [T])
}

for_this_machine! {
    /// Numbers from the digits of each `order` consecutive words in turn.
    interlaced = interlaced_body<T: Unit>(words: &[u32], order: usize, out: &mut [T])
}

#[inline(always)]
fn interlaced_body<T: Unit>(words: &[u32], order: usize, out: &mut [T]) {
    match order {
        2 => interlaced_by::<T, 2>(words, out),
        3 => interlaced_by::<T, 3>(words, out),
        4 => interlaced_by::<T, 4>(words, out),
        _ => interlaced_by::<T, 5>(words, out),
    }
}

#[inline(always)]
fn interlaced_by<T: Unit, const ORDER: usize>(words: &[u32], out: &mut [T]) {
    for (x, words) in out.iter_mut().zip(words.as_chunks::<ORDER>().0) {
        *x = T::from_word(spread::<ORDER>(words));
    }
}

#[inline(always)]
fn owen_exact_body<T: Unit>(tile: &[u64], period: Period<'_, u64>, out: &mut [T]) {
    let mut row = period.offsets.iter().zip(period.keys[0]).take(period.words).cycle();
    for (tile, out) in tile.chunks(WORDS).zip(out.chunks_mut(WORDS)) {
        let (mut words, mut word_keys) = ([0; WORDS], [0; WORDS]);
        let places = words.iter_mut().zip(&mut word_keys).zip(tile).take(out.len());
        for (((word, word_key), tile), (offset, key)) in places.zip(&mut row) {
            (*word, *word_key) = (tile ^ offset, *key);
        }
        exact_scrambles(&mut words, &word_keys);
        out.iter_mut().zip(words).for_each(|(x, word)| *x = T::from_word(word));
    }
}

#[inline(always)]
fn added_body<T: Unit>(tile: &[u64], period: Period<'_, u64>, out: &mut [T]) {
    for (tile, out) in tile.chunks(period.words).zip(out.chunks_mut(period.words)) {
        for (((x, word), offset), &key) in out.iter_mut().zip(tile).zip(period.offsets).zip(period.keys[0]) {
            *x = T::from_word((word ^ offset).wrapping_add(key));
        }
    }
}

/// Words that are scrambled node by node at a time.
const WORDS: usize = 32;

#[inline(always)]
fn into_caches<T: Unit>(tile: &[T::Digits], period: Period<'_, T::Digits>, out: &mut [T]) {
    for (tile, out) in tile.chunks(period.words).zip(out.chunks_mut(period.words)) {
        for ((x, &word), &offset) in out.iter_mut().zip(tile).zip(period.offsets) {
            *x = T::from_digits(word ^ offset);
        }
    }
}

#[inline(always)]
fn into_caches_owen<T: Unit>(tile: &[T::Digits], period: Period<'_, T::Digits>, out: &mut [T]) {
    let [addends, factors] = period.keys;
    for (tile, out) in tile.chunks(period.words).zip(out.chunks_mut(period.words)) {
        let keys = addends.iter().zip(factors);
        for (((x, &word), &offset), (&addend, &factor)) in
            out.iter_mut().zip(tile).zip(period.offsets).zip(keys)
        {
            *x = T::from_digits((word ^ offset).owen(addend, factor).reversed());
        }
    }
}

#[inline(always)]
fn past_caches_shifted<T: Unit, const VECTOR: usize>(
    tile: &[T::Digits],
    period: Period<'_, T::Digits>,
    out: &mut Stream<'_, T>,
) {
    past_caches::<T, VECTOR, false>(tile, period, out);
}

#[inline(always)]
fn past_caches_owen<T: Unit, const VECTOR: usize>(
    tile: &[T::Digits],
    period: Period<'_, T::Digits>,
    out: &mut Stream<'_, T>,
) {
    past_caches::<T, VECTOR, true>(tile, period, out);
}

#[inline(always)]
fn past_caches<T: Unit, const VECTOR: usize, const OWEN: bool>(
    tile: &[T::Digits],
    period: Period<'_, T::Digits>,
    out: &mut Stream<'_, T>,
) {
    let count = (tile.len() - LANES).min(out.places_left());
    let begun = out.lacking().min(count);
    if begun > 0 {
        out.write_part(&scrambled::<T, OWEN>(lanes(tile), period.lanes::<OWEN>(0)), begun);
    }
    let (mut at, mut phase) = (begun, begun);
    while count - at >= LANES {
        phase = if phase >= period.words { phase - period.words } else { phase };
        let lines = ((count - at) / LANES).min((period.words - phase).div_ceil(LANES));
        let words = tile[at..][..lines * LANES].as_chunks().0;
        let around = period.lines::<OWEN>(phase, lines);
        for ((to, words), around) in out.take_lines(lines).iter_mut().zip(words).zip(around) {
            store::<T, VECTOR>(&scrambled::<T, OWEN>(words, around), to);
        }
        (at, phase) = (at + lines * LANES, phase + lines * LANES);
    }
    if at < count {
        phase = if phase >= period.words { phase - period.words } else { phase };
        out.write_part(&scrambled::<T, OWEN>(lanes(&tile[at..]), period.lanes::<OWEN>(phase)), count - at);
    }
}

/// Offsets and keys of as many words as are made together.
type Around<'a, D> = (&'a Lanes<D>, [&'a Lanes<D>; 2]);

impl<'a, D> Period<'a, D> {
    /// From word `phase` on.
    #[inline(always)]
    fn lanes<const OWEN: bool>(self, phase: usize) -> Around<'a, D> {
        let offsets = lanes(&self.offsets[phase..]);
        (offsets, if OWEN { self.keys.map(|keys| lanes(&keys[phase..])) } else { [offsets; 2] })
    }

    /// From word `phase` on, as often as there are lines.
    #[inline(always)]
    fn lines<const OWEN: bool>(self, phase: usize, lines: usize) -> impl Iterator<Item = Around<'a, D>> {
        let part = |words: &'a [D]| -> &'a [Lanes<D>] { words[phase..][..lines * LANES].as_chunks().0 };
        let [addends, factors] = if OWEN { self.keys } else { [self.offsets; 2] }.map(part);
        part(self.offsets).iter().zip(addends.iter().zip(factors)).map(|(offsets, (a, f))| (offsets, [a, f]))
    }
}

#[inline(always)]
fn lanes<D>(words: &[D]) -> &Lanes<D> {
    words.first_chunk().expect("LANES words follow the last")
}

#[inline(always)]
fn scrambled<T: Unit, const OWEN: bool>(words: &Lanes<T::Digits>, around: Around<'_, T::Digits>) -> Lanes<T> {
    let (offsets, [addends, factors]) = around;
    std::array::from_fn(|i| {
        let word = words[i] ^ offsets[i];
        T::from_digits(if OWEN { word.owen(addends[i], factors[i]).reversed() } else { word })
    })
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::instruction_sets::WIDEST;
    use crate::seed::mix;

    /// What the kernels should do, one word at a time.
    fn expected<T: Unit>(tile: &[T::Digits], period: Period<'_, T::Digits>, owen: bool) -> Vec<T> {
        let one = |(i, &word): (usize, &T::Digits)| {
            let i = i % period.words;
            let word = word ^ period.offsets[i];
            let [addends, factors] = period.keys;
            T::from_digits(if owen { word.owen(addends[i], factors[i]).reversed() } else { word })
        };
        tile.iter().enumerate().map(one).collect()
    }

    fn kernels_agree<T: Unit + PartialEq + std::fmt::Debug>(length: usize, words: usize, skip: usize) {
        let random = |n: usize, salt: u64| (0..n as u64).map(move |i| T::Digits::leading(mix(i + salt)));
        let periodic = |salt| random(words, salt).cycle().take(words + LANES).collect::<Vec<_>>();
        let tile: Vec<_> = random(length + LANES, 1).collect();
        let (offsets, addends, factors) = (periodic(2000), periodic(3000), periodic(4000));
        let period = Period { words, offsets: &offsets, keys: [&addends, &factors] };
        let mut places = vec![T::default(); length + skip];
        let out = &mut places[skip..];
        for scramble in [false, true] {
            let wanted = expected::<T>(&tile[..length], period, scramble);
            let into = if scramble { owen } else { shifted };
            into(&tile, period, out);
            assert_eq!(out, wanted, "{length} {words} {skip}");
            out.fill(T::default());
            let past = if scramble { owen_past } else { shifted_past };
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

    /// Digits in turn, one at a time, against the kernels of this machine.
    #[test]
    fn instruction_sets_agree_on_interlaced_digits() {
        let words: Vec<_> = (0..1030).map(|i| mix(i) as u32).collect();
        for order in 2..=5 {
            let taken = |words: &[u32]| {
                (0..60)
                    .fold(0, |all, i| all | u64::from(words[i % order] >> (31 - i / order) & 1) << (63 - i))
            };
            let wanted: Vec<_> = words.chunks_exact(order).map(taken).map(f64::from_word).collect();
            for widest in [64, 32, 0] {
                WIDEST.store(widest, Ordering::Relaxed);
                let (mut double, mut single) = (vec![0.0; wanted.len()], vec![0.0_f32; wanted.len()]);
                interlaced(&words, order, &mut double);
                interlaced(&words, order, &mut single);
                assert_eq!(double, wanted, "order {order}");
                let singles = wanted.iter().map(|&x| crate::convert::truncate_to_f32(x));
                assert!(singles.eq(single), "order {order}");
            }
        }
        WIDEST.store(64, Ordering::Relaxed);
    }

    /// A stream that is fed in pieces of all lengths.
    #[test]
    fn a_stream_may_be_fed_in_pieces() {
        let mut places = [0.0_f32; 300];
        let mut stream = Stream::new(&mut places);
        let mut next = 0;
        for piece in 0_u16.. {
            let count = usize::from(piece % 23).min(300 - usize::from(next));
            let tile: Vec<_> = (next..).map(|i| u32::from(i) << 8).take(count + LANES).collect();
            let period = Period { words: LANES, offsets: &[0; 2 * LANES], keys: [&[]; 2] };
            shifted_past(&tile, period, &mut stream);
            next += count as u16;
            if next == 300 {
                break;
            }
        }
        drop(stream);
        assert!((0_u32..).zip(places).all(|(i, x)| x == crate::convert::unit_f32(i << 8)));
    }
}
