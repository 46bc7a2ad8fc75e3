//! The inner loops of [`DigitalNet`](super::DigitalNet): what its scrambles make of the words of a tile.

use std::marker::PhantomData;

use super::interlaced::spread;
use crate::convert::{Digits, Unit};
use crate::instruction_sets::for_this_machine;
use crate::scramble::owen_exact::exact_scrambles;
use crate::streaming::{LANES, Lanes};
use crate::tiles::{Combine, Group, Period};

/// Points without a scramble, or with one that is in the matrices and the offsets.
pub(crate) struct Shifted<T>(PhantomData<T>);

/// Owen-scrambled points. Tile and offsets are reversed words.
pub(crate) struct Owen<T>(PhantomData<T>);

/// Points shifted modulo 1.
pub(crate) struct Added<T>(PhantomData<T>);

impl<T: Unit> Combine for Shifted<T> {
    type Number = T;
    type Word = T::Digits;
    #[inline(always)]
    fn numbers(group: Group<'_, T::Digits>) -> Lanes<T> {
        sums(group).map(T::from_digits)
    }
}

impl<T: Unit> Combine for Owen<T> {
    type Number = T;
    type Word = T::Digits;
    #[inline(always)]
    fn numbers(group: Group<'_, T::Digits>) -> Lanes<T> {
        let mut words = sums(group);
        T::Digits::owen(&mut words, group[2], group[3]);
        for word in &mut words {
            *word = word.reversed();
        }
        let mut numbers = [T::default(); _];
        for i in 0..LANES {
            numbers[i] = T::from_digits(words[i]);
        }
        numbers
    }
}

impl<T: Unit> Combine for Added<T> {
    type Number = T;
    type Word = u64;
    #[inline(always)]
    fn numbers(group: Group<'_, u64>) -> Lanes<T> {
        let words = sums(group);
        std::array::from_fn(|i| T::from_word(words[i].wrapping_add(group[2][i])))
    }
}

/// Words of a tile and their offsets, added without carry.
#[inline(always)]
fn sums<D: Digits>([words, offsets, ..]: Group<'_, D>) -> Lanes<D> {
    std::array::from_fn(|i| words[i] ^ offsets[i])
}

for_this_machine! {
    /// Points scrambled node by node. It is hundreds of instructions for a word, which loops over more words than
    /// [`Combine`] has serve best.
    owen_exact = owen_exact_body<T: Unit>(tile: &[u64], period: Period<'_, u64>, out: &mut [T])
}

/// Words that are scrambled node by node at a time.
const WORDS: usize = 32;

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

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::instruction_sets::WIDEST;
    use crate::seed::mix;

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
}
