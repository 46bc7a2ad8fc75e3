//! Higher-order nets: their digits, and the rates at which their errors fall.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::interlaced_sobol::interlaced_sobol;
use evenlight_points::sequences::sobol::sobol;
use evenlight_points::{PointSet, Seed};

/// Digit `place` of a number.
fn digit(x: f64, place: i32) -> u64 {
    (x * 2f64.powi(place + 1)) as u64 & 1
}

/// Scramble first, then interlace: whatever is built into the matrices, the digits are those of scrambled Sobol' coordinates.
#[test]
fn digits_are_those_of_scrambled_coordinates_in_turn() {
    for randomization in Randomization::BASE_2.iter().filter(|&&known| known != Randomization::Shift) {
        for order in 2..=5 {
            let [points, plain]: [Box<dyn PointSet>; 2] = [
                Box::new(interlaced_sobol(3, order, *randomization, Seed::new(7))),
                Box::new(sobol(3 * order, *randomization, Seed::new(7))),
            ];
            for index in [0, 1, 2, 1000, 123_457, (1 << 33) + 7] {
                for dim in 0..3 {
                    let x = points.coord(index, dim);
                    for place in 0..53 {
                        let source = plain.coord(index, dim * order + place % order);
                        let wanted = digit(source, (place / order) as i32);
                        assert_eq!(
                            digit(x, place as i32),
                            wanted,
                            "{}, {order}, {index}",
                            randomization.name()
                        );
                    }
                }
            }
        }
    }
}

/// The root mean squared error of the mean of f, whose integral is 1, over replicates.
fn rmse(
    build: impl Fn(Seed) -> Box<dyn PointSet>,
    n: usize,
    replicates: u64,
    f: impl Fn(&[f64]) -> f64,
) -> f64 {
    let errors = (0..replicates).map(|r| {
        let points = build(Seed::new(5).replicate(r));
        let mut rows = vec![0.0; n * points.dims()];
        points.fill(0..n as u64, &mut rows);
        (rows.chunks_exact(points.dims()).map(&f).sum::<f64>() / n as f64 - 1.0).powi(2)
    });
    (errors.sum::<f64>() / replicates as f64).sqrt()
}

fn interlaced(dims: usize, order: usize, randomization: Randomization, seed: Seed) -> Box<dyn PointSet> {
    if order == 1 {
        return Box::new(sobol(dims, randomization, seed));
    }
    Box::new(interlaced_sobol(dims, order, randomization, seed))
}

/// The slope of the least-squares line through log2 of the errors for n = 2^low … 2^high.
fn slope(low: u32, high: u32, error: impl Fn(usize) -> f64) -> f64 {
    let values: Vec<_> = (low..=high).map(|m| (f64::from(m), error(1 << m).log2())).collect();
    let mean = |part: fn(&(f64, f64)) -> f64| values.iter().map(part).sum::<f64>() / values.len() as f64;
    let (x, y) = (mean(|v| v.0), mean(|v| v.1));
    let covariance = values.iter().map(|v| (v.0 - x) * (v.1 - y)).sum::<f64>();
    covariance / values.iter().map(|v| (v.0 - x).powi(2)).sum::<f64>()
}

/// J. Dick (2008, 2011) for x e^x in one dimension: n^(−α) as they are, and n^(−α − 1/2) scrambled. An independent
/// computation for this project measured −1.0, −1.94 and −3.2, and −1.66, −2.32 and −3.26 over 60 replicates; with as
/// many, a slope over five octaves has a standard error of about 0.1. Linear scrambles have tails so heavy that 60 replicates
/// miss what makes most of the error: their slopes are only bounded from above.
#[test]
fn errors_in_one_dimension_fall_with_the_order() {
    let f = |x: &[f64]| x[0] * x[0].exp();
    for (order, low, high) in [(1, -1.1, -0.9), (2, -2.2, -1.75), (3, -3.6, -2.8)] {
        let found = slope(4, 9, |n| rmse(|seed| interlaced(1, order, Randomization::None, seed), n, 1, f));
        assert!((low..high).contains(&found), "order {order}, no scramble: {found}");
    }
    for randomization in [Randomization::Owen, Randomization::OwenExact, Randomization::Linear] {
        for (order, low, high) in [(1, -1.9, -1.3), (2, -2.9, -2.0), (3, -4.0, -2.8)] {
            let found = slope(4, 9, |n| rmse(|seed| interlaced(1, order, randomization, seed), n, 60, f));
            let low = if randomization == Randomization::Linear { -5.0 } else { low };
            assert!((low..high).contains(&found), "order {order}, {}: {found}", randomization.name());
        }
    }
}

/// A smooth product in two dimensions: beyond the −3/2 that scrambled Sobol' points reach, and beyond −2.
#[test]
fn errors_of_smooth_functions_of_several_variables_fall_faster_than_those_of_sobol() {
    let f = |x: &[f64]| x.iter().map(|x| x * x.exp()).product::<f64>();
    for randomization in [Randomization::Owen, Randomization::Linear] {
        let found = [1, 2, 3]
            .map(|order| slope(8, 14, |n| rmse(|seed| interlaced(2, order, randomization, seed), n, 30, f)));
        let name = randomization.name();
        assert!((-1.8..-1.25).contains(&found[0]), "order 1, {name}: {found:?}");
        assert!(found[1] < -2.0 && found[2] < -2.0, "orders 2 and 3, {name}: {found:?}");
    }
}

/// What a shift modulo 1 would do to the order is said while building.
#[test]
#[should_panic(expected = "shift of interlaced coordinates")]
fn a_shift_modulo_one_is_refused() {
    interlaced_sobol(1, 2, Randomization::Shift, Seed::new(0));
}
