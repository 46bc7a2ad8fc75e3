//! e^(−x), the same bits on every machine: additions and multiplications only, so that loops of it become vectors.

/// Adding and subtracting it rounds to a whole number.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// e^(−x) for x in [0, 700]; the relative error is below 10^-13.
#[inline(always)]
pub(super) fn decay(x: f64) -> f64 {
    let shifted = ROUND - x * std::f64::consts::LOG2_E;
    let whole = shifted - ROUND;
    let rest = -x - whole * std::f64::consts::LN_2;
    let mut sum = 1.0;
    for divisor in [11.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        sum = 1.0 + sum * rest * (1.0 / divisor);
    }
    // the whole number is in the low bits of the shifted one
    sum * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_exponential_function() {
        for i in 0..70_000 {
            let x = f64::from(i) * 0.01;
            assert!((decay(x) / (-x).exp() - 1.0).abs() < 2e-13, "{x}");
        }
    }
}
