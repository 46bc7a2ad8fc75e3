//! Digits to floating-point numbers in [0, 1), by truncation.
//!
//! Rounding to nearest would turn a word of all ones into exactly 1.0, and a renderer or an inverse
//! distribution function that meets 1.0 returns an infinity. Truncation cannot: the largest results
//! are 1 − 2⁻⁵³ and 1 − 2⁻²⁴. It also keeps every point inside its elementary interval.

use std::ops::{BitXor, BitXorAssign};

use crate::scramble::owen;

/// The upper 53 bits of a word as a number in [0, 1).
///
/// ```
/// use evenlight_points::convert::unit_f64;
/// assert_eq!(unit_f64(1 << 63), 0.5);
/// assert!(unit_f64(u64::MAX) < 1.0);
/// ```
#[inline]
pub fn unit_f64(word: u64) -> f64 {
    (word >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// The upper 24 bits of a word as a number in [0, 1).
///
/// ```
/// use evenlight_points::convert::unit_f32;
/// assert_eq!(unit_f32(1 << 31), 0.5);
/// assert!(unit_f32(u32::MAX) < 1.0);
/// ```
#[inline]
pub fn unit_f32(word: u32) -> f32 {
    // The signed conversion is the one that vector units have.
    (word >> 8) as i32 as f32 * (1.0 / (1_u32 << 24) as f32)
}

/// A number in [0, 1) with its bits below 2⁻²⁴ cut off, which the plain cast would round up to 1.
///
/// ```
/// use evenlight_points::convert::truncate_to_f32;
/// assert!(truncate_to_f32(1.0 - 1e-12) < 1.0);
/// ```
#[inline]
pub fn truncate_to_f32(unit: f64) -> f32 {
    (unit * f64::from(1_u32 << 24)) as i32 as f32 * (1.0 / (1_u32 << 24) as f32)
}

/// A floating-point number made of the first digits of a word, for loops in either precision.
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

/// A word of digits, the first of them in its most significant bit. Half a word takes half the time.
pub(crate) trait Digits: Copy + Default + Sync + Send + BitXor<Output = Self> + BitXorAssign {
    /// The first digits of a full word.
    fn leading(word: u64) -> Self;
    /// The digits in reverse order.
    fn reversed(self) -> Self;
    /// The two halves of an Owen key, for [`Digits::owen`].
    fn owen_key(seed: u64) -> (Self, Self);
    /// The Owen hash of reversed digits.
    fn owen(self, addend: Self, multiplier: Self) -> Self;
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
    fn owen(self, addend: Self, multiplier: Self) -> Self {
        owen::keyed_64(self, addend, multiplier)
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
    fn owen(self, addend: Self, multiplier: Self) -> Self {
        owen::keyed_64_low(self, addend, multiplier)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_near_the_end_stay_below_one_and_in_their_intervals() {
        for bit in 0..64 {
            let word = u64::MAX << bit;
            let (double, single) = (f64::from_word(word), f32::from_word(word));
            assert!(double < 1.0 && single < 1.0 && f64::from(single) <= double, "{word:x}");
            // The interval of the leading ones: [1 − 2^(bit − 64), 1).
            assert!(double >= 1.0 - 2f64.powi((bit - 64).max(-53)), "{word:x}");
            assert_eq!(truncate_to_f32(double), single);
        }
    }
}
