//! Higher-order digital nets: the digits of several consecutive coordinates of a net in base 2, taken in turn.
//!
//! Interlacing α coordinates of a net to one gives integrands with α square-integrable mixed derivatives an error
//! that falls nearly as n^(−α), and as n^(−α − 1/2) once each of the α coordinates is scrambled, before they
//! are interlaced (J. Dick, *Higher order scrambled digital nets achieve the optimal rate of the root mean square
//! error for smooth integrands*, Ann. Statist. 39, 1372–1398, 2011).
//!
//! An affine randomization of the coordinates is one of the interlaced matrices, so that these points cost what those of
//! any net cost. For the others the coordinates are scrambled block by block, 32 digits of each, and then interlaced.
//!
//! Each of the α coordinates gives ⌊64 / α⌋ digits, at most 32: 32, 21, 16 or 12. A double shows the first 53 of them all.

use std::ops::Range;
use std::sync::Arc;

use super::kernels::interlaced as interlace_words;
use super::{BITS, DigitalNet};
use crate::convert::{Unit, unit_f64};
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

/// What coordinates can be interlaced at a time.
pub const ORDERS: std::ops::RangeInclusive<usize> = 2..=5;

/// The randomizations that act on the coordinates before they are interlaced, which is all but the shift modulo 1.
pub const ACCEPTS: &[Randomization] = &[
    Randomization::Owen,
    Randomization::OwenExact,
    Randomization::Linear,
    Randomization::LinearStriped,
    Randomization::LinearIBinomial,
    Randomization::DigitalShift,
    Randomization::None,
];

/// A net of interlaced coordinates, randomized before they were.
#[derive(Debug)]
pub struct InterlacedNet {
    order: usize,
    /// The coordinates that are interlaced, randomized.
    source: DigitalNet,
    /// The interlaced net, if its randomization could be built in.
    built_in: Option<DigitalNet>,
}

impl InterlacedNet {
    /// Interlaces each `order` consecutive coordinates of a net, given by the columns of its generating matrices.
    ///
    /// # Panics
    /// If the order is not 2 to 5, does not divide the number of matrices, or the randomization is a shift modulo 1.
    pub fn new<M: AsRef<[u64]>>(
        matrices: &[M],
        order: usize,
        randomization: Randomization,
        seed: Seed,
    ) -> Self {
        assert!(ORDERS.contains(&order), "an order is 2 to 5, not {order}");
        assert!(matrices.len().is_multiple_of(order), "{} coordinates by {order}", matrices.len());
        assert!(ACCEPTS.contains(&randomization), "{} of interlaced coordinates", randomization.name());
        Self::of(DigitalNet::finite(matrices, randomization, seed), order)
    }

    fn of(source: DigitalNet, order: usize) -> Self {
        let affine = source.randomization.entry().affine;
        let built_in = affine.then(|| {
            let columns: Arc<[u64]> = interlaced(&source.columns, order);
            DigitalNet {
                dims: source.dims / order,
                depth: source.depth,
                randomization: Randomization::None,
                plain: columns.clone(),
                columns,
                origin: interlaced(&source.origin, order),
                keys: vec![],
            }
        });
        Self { order, source, built_in }
    }

    /// [`PointSet::fill`] in either precision.
    fn fill_units<T: Unit>(&self, rows: Range<u64>, out: &mut [T]) {
        if let Some(net) = &self.built_in {
            return net.fill_units(rows, out);
        }
        check_length(&rows, self.dims(), out.len());
        let mut rest = out;
        self.source.for_each_leading_words(rows, |words| {
            let (part, later) = std::mem::take(&mut rest).split_at_mut(words.len() / self.order);
            interlace_words(words, self.order, part);
            rest = later;
        });
    }
}

/// Every `order` consecutive words as one.
fn interlaced<C: FromIterator<u64>>(words: &[u64], order: usize) -> C {
    words.chunks_exact(order).map(|words| interlace(words, order)).collect()
}

fn interlace(words: &[u64], order: usize) -> u64 {
    let leading = |r: usize| (words[r] >> (BITS - 32)) as u32;
    match order {
        2 => spread::<2>(&[0, 1].map(leading)),
        3 => spread::<3>(&[0, 1, 2].map(leading)),
        4 => spread::<4>(&[0, 1, 2, 3].map(leading)),
        _ => spread::<5>(&[0, 1, 2, 3, 4].map(leading)),
    }
}

/// The leading digits of `ORDER` words, in turn.
#[inline(always)]
pub(super) fn spread<const ORDER: usize>(words: &[u32; ORDER]) -> u64 {
    let mut all = 0;
    for &word in words {
        let mut spread = u64::from(word >> (32 - Places::<ORDER>::DIGITS));
        // Runs of 32, 16, 8, … digits are cut in halves, which move apart.
        for (mask, run) in Places::<ORDER>::MASKS.into_iter().zip([16, 8, 4, 2, 1]) {
            if run < Places::<ORDER>::DIGITS {
                spread = (spread | spread << (run * (ORDER - 1))) & mask;
            }
        }
        all = all << 1 | spread;
    }
    all << (64 - ORDER * Places::<ORDER>::DIGITS)
}

/// Where the digits of one of `ORDER` words go.
struct Places<const ORDER: usize>;

impl<const ORDER: usize> Places<ORDER> {
    /// The digits of each word that find a place.
    const DIGITS: usize = if ORDER == 2 { 32 } else { 64 / ORDER };

    /// The places of the digits when they are in runs of 16, 8, 4, 2 and 1 that begin at multiples of `ORDER` runs.
    const MASKS: [u64; 5] = [Self::runs(16), Self::runs(8), Self::runs(4), Self::runs(2), Self::runs(1)];

    const fn runs(run: usize) -> u64 {
        let (mut mask, mut digit) = (0, 0);
        while digit < Self::DIGITS {
            let place = digit / run * run * ORDER + digit % run;
            mask |= if place < 64 { 1 << place } else { 0 };
            digit += 1;
        }
        mask
    }
}

impl PointSet for InterlacedNet {
    fn dims(&self) -> usize {
        self.source.dims / self.order
    }

    fn len(&self) -> Option<u64> {
        self.source.len()
    }

    fn base(&self) -> Option<u64> {
        Some(2)
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        assert!(dim < self.dims(), "dimension {dim} of {}", self.dims());
        let mut words = [0; 5];
        for (r, word) in words[..self.order].iter_mut().enumerate() {
            *word = self.source.randomized_word(index, dim * self.order + r);
        }
        unit_f64(interlace(&words[..self.order], self.order))
    }

    fn generating_matrices(&self) -> Option<Vec<Vec<u64>>> {
        let columns: Arc<[u64]> = interlaced(&self.source.plain, self.order);
        let matrix = |dim| (0..self.source.depth).map(|k| columns[k * self.dims() + dim]).collect();
        Some((0..self.dims()).map(matrix).collect())
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        let DigitalNet { ref plain, depth, randomization, dims, .. } = self.source;
        Box::new(Self::of(
            DigitalNet::randomized(plain.clone(), depth, randomization, seed, dims),
            self.order,
        ))
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        self.fill_units(rows, out);
    }

    fn fill_f32(&self, rows: Range<u64>, out: &mut [f32]) {
        self.fill_units(rows, out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::mix;

    #[test]
    fn digits_are_taken_in_turn() {
        for order in ORDERS {
            let words: Vec<_> = (0..order as u64).map(mix).collect();
            let union = interlace(&words, order);
            for place in 0..60 {
                let digit = |word: u64, place: usize| word >> (63 - place) & 1;
                assert_eq!(
                    digit(union, place),
                    digit(words[place % order], place / order),
                    "{order}, {place}"
                );
            }
        }
    }
}
