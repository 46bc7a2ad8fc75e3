//! Digits to floating-point numbers in [0, 1), by truncation.
//!
//! Rounding to nearest would turn a word of all ones into exactly 1.0, and a renderer or an inverse
//! distribution function that meets 1.0 returns an infinity. Truncation cannot: the largest results
//! are 1 − 2⁻⁵³ and 1 − 2⁻²⁴. It also keeps every point inside its elementary interval.

#[cfg(feature = "std")]
pub(crate) use crate::unit::{Digits, Unit};

/// The upper 53 bits of a word as a number in [0, 1).
///
/// ```
/// use evenlight_points::convert::unit_f64;
/// assert_eq!(unit_f64(1 << 63), 0.5);
/// assert!(unit_f64(u64::MAX) < 1.0);
/// ```
#[inline]
pub fn unit_f64(word: u64) -> f64 {
    // The upper half of the word after 2^20, the next 21 bits in their places after 2^-12: additions of exact numbers, which all
    // vector units have, where only the newest convert 64-bit integers.
    let upper = f64::from_bits(word >> 32 | (1023 + 20) << 52);
    let lower = f64::from_bits(word & 0xffff_f800 | (1023 - 12) << 52);
    (upper - (f64::from(1 << 20) + 1.0 / 4096.0)) + lower
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_the_upper_53_bits() {
        for word in (0..10_000).map(crate::seed::mix).chain([
            0,
            1,
            u64::MAX,
            1 << 63,
            1 << 11,
            (1 << 32) - 1,
            1 << 32,
        ]) {
            assert_eq!(unit_f64(word), (word >> 11) as f64 / (1_u64 << 53) as f64, "{word}");
        }
    }

    #[test]
    fn words_near_the_end_stay_below_one_and_in_their_intervals() {
        for bit in 0..64 {
            let word = u64::MAX << bit;
            let (double, single) = (unit_f64(word), unit_f32((word >> 32) as u32));
            assert!(double < 1.0 && single < 1.0 && f64::from(single) <= double, "{word:x}");
            // The interval of the leading ones: [1 − 2^(bit − 64), 1).
            assert!(double >= 1.0 - 2f64.powi((bit - 64).max(-53)), "{word:x}");
            assert_eq!(truncate_to_f32(double), single);
        }
    }
}
