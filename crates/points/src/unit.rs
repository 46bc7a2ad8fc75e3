//! Numbers and words in the two precisions that points come in, for loops that serve both.

use std::ops::{BitXor, BitXorAssign};

use crate::convert::{unit_f32, unit_f64};
use crate::owen_hash as owen;
use crate::streaming::Lanes;

/// A floating-point number made of the first digits of a word, for loops in either precision; or these digits.
pub(crate) trait Unit: Copy + Default + Send {
    /// A word with the digits that this precision can show, and few more.
    type Digits: Digits;
    fn from_digits(digits: Self::Digits) -> Self;

    #[inline(always)]
    fn from_word(word: u64) -> Self {
        Self::from_digits(Self::Digits::leading(word))
    }
}

impl Unit for f64 {
    type Digits = u64;
    #[inline(always)]
    fn from_digits(digits: u64) -> Self {
        unit_f64(digits)
    }
}

impl Unit for f32 {
    type Digits = u32;
    #[inline(always)]
    fn from_digits(digits: u32) -> Self {
        unit_f32(digits)
    }
}

/// The first digits themselves, for loops that go on with them.
impl Unit for u32 {
    type Digits = Self;
    #[inline(always)]
    fn from_digits(digits: Self) -> Self {
        digits
    }
}

/// A word of digits, the first of them in its most significant bit. Half a word takes half the time.
pub(crate) trait Digits: Copy + Default + Sync + Send + BitXor<Output = Self> + BitXorAssign {
    /// The first digits of a full word.
    fn leading(word: u64) -> Self;
    /// The digits in reverse order.
    fn reversed(self) -> Self;
    /// The two halves of an Owen key, for [`Digits::owen`].
    fn owen_key(seed: u64) -> (Self, Self);
    /// Replaces reversed digits by their Owen hash.
    fn owen(words: &mut Lanes<Self>, addends: &Lanes<Self>, multipliers: &Lanes<Self>);
}

impl Digits for u64 {
    #[inline(always)]
    fn leading(word: u64) -> Self {
        word
    }
    #[inline(always)]
    fn reversed(self) -> Self {
        self.reverse_bits()
    }
    #[inline(always)]
    fn owen_key(seed: u64) -> (Self, Self) {
        owen::key_64(seed)
    }
    #[inline(always)]
    fn owen(words: &mut Lanes<Self>, addends: &Lanes<Self>, multipliers: &Lanes<Self>) {
        owen::keyed_64_each(words, addends, multipliers);
    }
}

impl Digits for u32 {
    #[inline(always)]
    fn leading(word: u64) -> Self {
        (word >> 32) as Self
    }
    #[inline(always)]
    fn reversed(self) -> Self {
        self.reverse_bits()
    }
    #[inline(always)]
    fn owen_key(seed: u64) -> (Self, Self) {
        let (addend, multiplier) = owen::key_64(seed);
        (addend as Self, multiplier as Self)
    }
    #[inline(always)]
    fn owen(words: &mut Lanes<Self>, addends: &Lanes<Self>, multipliers: &Lanes<Self>) {
        owen::keyed_64_low_each(words, addends, multipliers);
    }
}
