//! The loop that engines of tiles share: the words of a tile, combined with what repeats along its rows, become numbers in memory.
//!
//! An engine says how it combines [`LANES`] words; the loop finds the words that belong together, whatever
//! the dimension and wherever an array begins, and writes whole lines, past the caches where that pays.

use crate::convert::Unit;
use crate::instruction_sets::for_this_machine;
use crate::streaming::{LANES, Lanes, Stream, store};

/// What is combined with the words of a tile: the offsets and keys of some whole rows, over and over.
/// The first [`LANES`] words follow once more after the last, so that a vector may begin at any of them.
#[derive(Clone, Copy)]
pub(crate) struct Period<'a, D> {
    /// The words without those that follow once more; at least [`LANES`].
    pub(crate) words: usize,
    /// What is added to the words of the tile, with or without carry.
    pub(crate) offsets: &'a [D],
    /// What a scramble adds and multiplies with, or its one key for each word; empty where there is none.
    pub(crate) keys: [&'a [D]; 2],
}

/// Some words of a tile, their offsets, and their keys if there are any.
pub(crate) type Group<'a, D> = [&'a Lanes<D>; 4];

/// What an engine does to the words of a tile.
pub(crate) trait Combine {
    /// What comes out.
    type Number: Unit;
    /// What the tile is made of.
    type Word: Copy;
    /// Some numbers. To become vector instructions, implementations are `#[inline(always)]`.
    fn numbers(group: Group<'_, Self::Word>) -> Lanes<Self::Number>;
}

for_this_machine! {
    /// Makes numbers of the words of a tile, which [`LANES`] more follow.
    write = write_body<C: Combine, VECTOR>(
        tile: &[C::Word], period: Period<'_, C::Word>, out: &mut Stream<'_, C::Number>)
}

#[inline(always)]
fn write_body<C: Combine, const VECTOR: usize>(
    tile: &[C::Word],
    period: Period<'_, C::Word>,
    out: &mut Stream<'_, C::Number>,
) {
    let count = (tile.len() - LANES).min(out.places_left());
    let begun = out.lacking().min(count);
    if begun > 0 {
        out.write_part(&C::numbers(period.group(tile, 0)), begun);
    }
    let (mut at, mut phase, past) = (begun, begun, out.past());
    while count - at >= LANES {
        phase = if phase >= period.words { phase - period.words } else { phase };
        let lines = ((count - at) / LANES).min((period.words - phase).div_ceil(LANES));
        let groups = period.groups(&tile[at..], phase, lines);
        for (to, group) in out.take_lines(lines).iter_mut().zip(groups) {
            store::<C::Number, VECTOR>(past, &C::numbers(group), to);
        }
        (at, phase) = (at + lines * LANES, phase + lines * LANES);
    }
    if at < count {
        phase = if phase >= period.words { phase - period.words } else { phase };
        out.write_part(&C::numbers(period.group(&tile[at..], phase)), count - at);
    }
}

impl<'a, D: Copy> Period<'a, D> {
    /// The first words of a tile, and what belongs to them from word `phase` on.
    #[inline(always)]
    fn group(self, tile: &'a [D], phase: usize) -> Group<'a, D> {
        let lanes = |words: &'a [D]| words.first_chunk().expect("LANES words follow the last");
        let [first, second] = self.all_keys().map(|keys| lanes(&keys[phase..]));
        [lanes(tile), lanes(&self.offsets[phase..]), first, second]
    }

    /// The same for that many groups.
    #[inline(always)]
    fn groups(self, tile: &'a [D], phase: usize, count: usize) -> impl Iterator<Item = Group<'a, D>> {
        let lanes = |words: &'a [D]| words[..count * LANES].as_chunks().0.iter();
        let [first, second] = self.all_keys().map(|keys| lanes(&keys[phase..]));
        let keys = first.zip(second);
        let words = lanes(tile).zip(lanes(&self.offsets[phase..]));
        words.zip(keys).map(|((words, offsets), (first, second))| [words, offsets, first, second])
    }

    /// Where there are no keys, offsets in their place: nobody looks at them.
    #[inline(always)]
    fn all_keys(self) -> [&'a [D]; 2] {
        self.keys.map(|keys| if keys.is_empty() { self.offsets } else { keys })
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::digital_net::kernels::{Added, Owen, Shifted};
    use crate::instruction_sets::WIDEST;
    use crate::modular::kernels::{Folded, Summed};
    use crate::seed::mix;
    use crate::unit::Digits;

    fn kernels_agree<C: Combine<Word: Digits, Number: PartialEq + Debug>>(shape: [usize; 3]) {
        let [length, words, skip] = shape;
        let random = |n: usize, salt: u64| (0..n as u64).map(move |i| C::Word::leading(mix(i + salt)));
        let periodic = |salt| random(words, salt).cycle().take(words + LANES).collect::<Vec<_>>();
        let tile: Vec<_> = random(length + LANES, 1).collect();
        let (offsets, first, second) = (periodic(2000), periodic(3000), periodic(4000));
        let period = Period { words, offsets: &offsets, keys: [&first, &second] };
        // one word at a time
        let one = |i: usize| {
            let all = [&tile[i], &offsets[i % words], &first[i % words], &second[i % words]];
            C::numbers(all.map(|word| [*word; LANES]).each_ref())[0]
        };
        let wanted: Vec<_> = (0..length).map(one).collect();
        for past in [false, true] {
            let mut places = vec![C::Number::default(); length + skip];
            let out = &mut places[skip..];
            write::<C>(&tile, period, &mut Stream::of(out, past && crate::instruction_sets::has_avx2()));
            assert_eq!(out, wanted, "{shape:?}, past the caches: {past}");
        }
    }

    fn all_agree<T: Unit + PartialEq + Debug>(shape: [usize; 3]) {
        kernels_agree::<Shifted<T>>(shape);
        kernels_agree::<Owen<T>>(shape);
        kernels_agree::<Added<T>>(shape);
        kernels_agree::<Summed<T>>(shape);
        kernels_agree::<Folded<T>>(shape);
    }

    /// The kernels of this machine against one word at a time, with lengths that no vector divides and arrays
    /// that begin in the middle of a line.
    #[test]
    fn instruction_sets_agree_to_the_bit() {
        for widest in [64, 32, 0] {
            WIDEST.store(widest, Ordering::Relaxed);
            for [length, words] in [[1, 16], [7, 17], [203, 29], [1024, 128], [1000, 128], [999, 333]] {
                for skip in 0..=LANES {
                    all_agree::<f64>([length, words, skip]);
                    all_agree::<f32>([length, words, skip]);
                }
            }
        }
        WIDEST.store(64, Ordering::Relaxed);
    }

    /// A stream that is fed in pieces of all lengths.
    #[test]
    fn a_stream_may_be_fed_in_pieces() {
        let mut places = [0.0_f32; 300];
        let mut stream = Stream::of(&mut places, crate::instruction_sets::has_avx2());
        let mut next = 0;
        for piece in 0_u16.. {
            let count = usize::from(piece % 23).min(300 - usize::from(next));
            let tile: Vec<_> = (next..).map(|i| u32::from(i) << 8).take(count + LANES).collect();
            let period = Period { words: LANES, offsets: &[0; 2 * LANES], keys: [&[]; 2] };
            write::<Shifted<f32>>(&tile, period, &mut stream);
            next += count as u16;
            if next == 300 {
                break;
            }
        }
        drop(stream);
        assert!((0_u32..).zip(places).all(|(i, x)| x == crate::convert::unit_f32(i << 8)));
    }
}
