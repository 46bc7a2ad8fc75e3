//! How surprising a random result is.
#![allow(dead_code, unreachable_pub, reason = "every test binary uses a part of it")]

/// The level of each of `count` independent tests that together raise a false alarm with probability `total` (Šidák 1967).
pub fn level(total: f64, count: usize) -> f64 {
    -((-total).ln_1p() / count as f64).exp_m1()
}

/// Probability of counts as far from what is expected as these, or further. The last bin takes in those that expect few.
pub fn chi_square(expected: &[f64], observed: &[f64]) -> f64 {
    let (mut sum, mut bins, mut rest) = (0.0, 0.0_f64, (0.0, 0.0));
    for (e, o) in expected.iter().zip(observed) {
        if *e < 10.0 {
            rest = (rest.0 + e, rest.1 + o);
        } else {
            sum += (o - e) * (o - e) / e;
            bins += 1.0;
        }
    }
    if rest.0 > 10.0 {
        sum += (rest.1 - rest.0) * (rest.1 - rest.0) / rest.0;
        bins += 1.0;
    } else if rest.1 > rest.0 + 40.0 {
        return 0.0;
    }
    if bins > 1.0 { chi_square_tail(sum, bins - 1.0) } else { 1.0 }
}

/// The normal approximation of Wilson & Hilferty 1931.
fn chi_square_tail(sum: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let z = ((sum / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    // complementary error function (Abramowitz & Stegun 7.1.26)
    let x = z.abs() / std::f64::consts::SQRT_2;
    let t = 1.0 / (1.0 + 0.3275911 * x);
    let coefficients = [1.061405429, -1.453152027, 1.421413741, -0.284496736, 0.254829592];
    let half = 0.5 * coefficients.iter().fold(0.0, |sum, c| sum * t + c) * t * (-x * x).exp();
    if z > 0.0 { half } else { 1.0 - half }
}

/// Student's t is exceeded in absolute value with this probability.
pub fn student_tail(t: f64, freedom: u32) -> f64 {
    // with t = sqrt(freedom) tan a, the density is that of a, in proportion to cos(a) ^ (freedom - 1)
    let integral = |from: f64, to: f64| {
        let steps = 2000;
        let width = (to - from) / f64::from(steps);
        let value = |i: i32| (from + width * (f64::from(i) + 0.5)).cos().powi(freedom as i32 - 1);
        (0..steps).map(value).sum::<f64>() * width
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    integral((t.abs() / f64::from(freedom).sqrt()).atan(), quarter) / integral(0.0, quarter)
}

/// Mean and standard error of independent replicates.
pub fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (mean, (squares / (count * (count - 1.0))).sqrt())
}

#[test]
fn known_quantiles() {
    // tables of Student's t and of chi-square
    assert!((student_tail(2.131, 15) - 0.05).abs() < 1e-4);
    assert!((student_tail(4.073, 15) - 0.001).abs() < 1e-5);
    assert!((student_tail(2.365, 7) - 0.05).abs() < 1e-4);
    assert!((chi_square_tail(124.342, 100.0) - 0.05).abs() < 1e-3);
    assert!((level(0.05, 10) - 0.005_116).abs() < 1e-6);
}
