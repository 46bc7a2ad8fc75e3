//! Single and double precision behind one name, so that a warp is written once for the renderer and for integration.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `f32` or `f64`.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The binary digits of a number just below 1.
    const DIGITS: u32;
    /// The distance from 1 to the next number.
    const EPSILON: Self;

    /// The nearest number in this precision.
    fn of(x: f64) -> Self;
    /// The same number in double precision.
    fn wide(self) -> f64;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The cube root.
    #[must_use]
    fn cbrt(self) -> Self;
    /// Sine and cosine of a number of turns in [0, 1).
    #[must_use]
    fn sin_cos_turns(self) -> (Self, Self);
    /// The direction of (x, y) in turns, in [0, 1].
    #[must_use]
    fn turns(y: Self, x: Self) -> Self;

    /// The next smaller number.
    #[must_use]
    fn next_down(self) -> Self;

    /// A number in this precision that stays below a limit when rounding would reach it.
    #[must_use]
    #[inline]
    fn under(x: f64, limit: f64) -> Self {
        let (x, limit) = (Self::of(x), Self::of(limit));
        if x < limit { x } else { limit.next_down() }
    }

    /// The larger of two numbers.
    #[must_use]
    #[inline]
    fn at_least(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// The smaller of two numbers.
    #[must_use]
    #[inline]
    fn at_most(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    /// The absolute value.
    #[must_use]
    #[inline]
    fn absolute(self) -> Self {
        self.at_least(-self)
    }
}

macro_rules! real {
    ($type:ty, $sin_cos_turns:expr) => {
        impl Real for $type {
            const DIGITS: u32 = Self::MANTISSA_DIGITS;
            const EPSILON: Self = Self::EPSILON;

            #[inline(always)]
            fn of(x: f64) -> Self {
                x as Self
            }
            #[inline(always)]
            fn wide(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn cbrt(self) -> Self {
                self.cbrt()
            }
            #[inline(always)]
            fn next_down(self) -> Self {
                self.next_down()
            }
            #[inline(always)]
            fn sin_cos_turns(self) -> (Self, Self) {
                $sin_cos_turns(self)
            }
            #[inline(always)]
            fn turns(y: Self, x: Self) -> Self {
                let turns = y.atan2(x) * (0.5 / std::f64::consts::PI) as Self;
                if turns < 0.0 { turns + 1.0 } else { turns }
            }
        }
    };
}

real!(f32, sin_cos_turns);
real!(f64, |turns: f64| (turns * (2.0 * std::f64::consts::PI)).sin_cos());

/// Sine and cosine of a number of turns in [0, 1), within 2 units in the last place of 1.
///
/// Taylor polynomials on an eighth of a turn to either side of the nearest quarter: a third of the time of the library's functions,
/// which must reduce any angle.
#[inline]
pub fn sin_cos_turns(turns: f32) -> (f32, f32) {
    let quarter = (turns * 4.0 + 0.5) as i32;
    let x = (turns - quarter as f32 * 0.25) * (2.0 * std::f32::consts::PI);
    let x2 = x * x;
    let sin = x + x * x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 - x2 * (1.0 / 5040.0 - x2 * (1.0 / 362_880.0))));
    let cos = 1.0 - x2 * (0.5 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 * (1.0 / 40_320.0))));
    // Swapped in odd quarters, and signs changed, without branches: which quarter it is cannot be predicted.
    let (sin, cos, quarter) = (sin.to_bits(), cos.to_bits(), quarter as u32);
    let swap = (sin ^ cos) & 0_u32.wrapping_sub(quarter & 1);
    let (sin, cos) = (sin ^ swap, cos ^ swap);
    (f32::from_bits(sin ^ (quarter & 2) << 30), f32::from_bits(cos ^ ((quarter + 1) & 2) << 30))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_have_the_right_sine_and_cosine() {
        for i in 0..100_000 {
            let turns = i as f32 / 100_000.0;
            let (sin, cos) = sin_cos_turns(turns);
            let (exact_sin, exact_cos) = (f64::from(turns) * 2.0 * std::f64::consts::PI).sin_cos();
            let error = (f64::from(sin) - exact_sin).abs().max((f64::from(cos) - exact_cos).abs());
            assert!(error < 2.4e-7, "{turns}: {error}");
        }
    }
}
