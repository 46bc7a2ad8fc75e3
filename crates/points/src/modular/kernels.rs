//! What lattices make of the words of a tile: sums, folded or not.

use std::marker::PhantomData;

use crate::convert::Unit;
use crate::scramble::shift_tent::fold;
use crate::streaming::Lanes;
use crate::tiles::{Combine, Group};

/// Points that are sums.
pub(crate) struct Summed<T>(PhantomData<T>);

/// Points that are folded sums.
pub(crate) struct Folded<T>(PhantomData<T>);

impl<T: Unit> Combine for Summed<T> {
    type Number = T;
    type Word = u64;
    #[inline(always)]
    fn numbers([words, offsets, ..]: Group<'_, u64>) -> Lanes<T> {
        std::array::from_fn(|i| T::from_word(words[i].wrapping_add(offsets[i])))
    }
}

impl<T: Unit> Combine for Folded<T> {
    type Number = T;
    type Word = u64;
    #[inline(always)]
    fn numbers([words, offsets, ..]: Group<'_, u64>) -> Lanes<T> {
        std::array::from_fn(|i| T::from_word(fold(words[i].wrapping_add(offsets[i]))))
    }
}
