//! The error function and its inverse in single precision: what Gaussian surface slopes need.

#![allow(clippy::excessive_precision, reason = "coefficients keep the digits of their papers")]

/// Error function; absolute error 1.5e-7 (Abramowitz & Stegun 1964, formula 7.1.26).
#[inline]
pub(crate) fn erf(x: f32) -> f32 {
    let a = x.abs();
    if a > 4.0 {
        return 1.0_f32.copysign(x); // 1 - erf(4) is 1.5e-8; an exponential that underflows would be slow
    }
    let t = 1.0 / (1.0 + 0.3275911 * a);
    let coefficients = [1.061405429_f32, -1.453152027, 1.421413741, -0.284496736, 0.254829592];
    let polynomial = coefficients.iter().fold(0.0, |sum, coefficient| sum * t + coefficient) * t;
    (1.0 - polynomial * (-a * a).exp()).copysign(x)
}

/// Inverse error function for `|x| < 1` (Giles 2011, "Approximating the erfinv function", GPU Computing Gems).
#[inline]
pub(crate) fn erf_inverse(x: f32) -> f32 {
    let w = -((1.0 - x) * (1.0 + x)).ln();
    if w < 5.0 {
        let coefficients = [
            2.81022636e-08_f32,
            3.43273939e-07,
            -3.5233877e-06,
            -4.39150654e-06,
            0.00021858087,
            -0.00125372503,
            -0.00417768164,
            0.246640727,
            1.50140941,
        ];
        coefficients.iter().fold(0.0, |sum, coefficient| sum * (w - 2.5) + coefficient) * x
    } else {
        let coefficients = [
            -0.000200214257_f32,
            0.000100950558,
            0.00134934322,
            -0.00367342844,
            0.00573950773,
            -0.0076224613,
            0.00943887047,
            1.00167406,
            2.83297682,
        ];
        coefficients.iter().fold(0.0, |sum, coefficient| sum * (w.sqrt() - 3.0) + coefficient) * x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_and_round_trips() {
        assert!((erf(0.5) - 0.5204999).abs() < 1e-6 && (erf(-1.0) + 0.8427008).abs() < 1e-6);
        for i in -99..100 {
            let y = i as f32 / 100.0;
            assert!((erf(erf_inverse(y)) - y).abs() < 1e-6, "{y}");
        }
        assert!((erf_inverse(0.999_99) - 3.123413).abs() < 1e-2);
    }
}
