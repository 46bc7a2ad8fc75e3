//! The L2 family against its definitions, known numbers, other algorithms, threads and chance.

use std::num::NonZeroUsize;

use evenlight_points::Seed;
use evenlight_points::convert::unit_f64;
use evenlight_points::quality::Rows;
use evenlight_points::quality::l2::{Algorithm, Measure, Request, l2_discrepancy};
use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Spec};

fn squared(numbers: &[f64], dims: usize, measure: Measure) -> f64 {
    summed(numbers, dims, measure, None, Algorithm::Pairs)
}

fn summed(
    numbers: &[f64],
    dims: usize,
    measure: Measure,
    weights: Option<&[f64]>,
    algorithm: Algorithm,
) -> f64 {
    let request = Request { measure, weights, algorithm, workers: NonZeroUsize::MIN };
    l2_discrepancy(&Rows::new(numbers, dims).expect("points"), &request).expect("a legal request")
}

/// Independent points.
fn random(seed: u64, numbers: usize) -> Vec<f64> {
    (0..numbers as u64).map(|i| unit_f64(Seed::new(seed).dimension(i).bits64())).collect()
}

/// The kernel of a measure as its papers write it, and its means over one and both arguments.
fn published(measure: Measure, w: f64) -> (impl Fn(f64, f64) -> f64, impl Fn(f64) -> f64, f64) {
    let kernel = move |x: f64, y: f64| {
        let (zx, zy, delta) = ((x - 0.5).abs(), (y - 0.5).abs(), (x - y).abs());
        match measure {
            Measure::Star => 1.0 - x.max(y),
            Measure::WeightedStar => 1.0 + w * (1.0 - x.max(y)),
            Measure::Centered => 1.0 + w * (0.5 * zx + 0.5 * zy - 0.5 * delta),
            Measure::WrapAround => 1.0 + w * (0.5 - delta * (1.0 - delta)),
            Measure::Mixture => {
                1.0 + w * (0.875 - 0.25 * zx - 0.25 * zy - 0.75 * delta + 0.5 * delta * delta)
            }
            Measure::Symmetric => 1.0 + w * (1.0 - 2.0 * delta),
            Measure::Periodic => 0.5 - delta + delta * delta,
            Measure::Extreme => x.min(y) - x * y,
        }
    };
    // the kernels are polynomials of degree 2 or less on either side of y = x and y = ½
    let mean = move |x: f64| {
        let mut edges = [0.0, x.min(0.5), x.max(0.5), 1.0];
        edges.sort_by(f64::total_cmp);
        let simpson =
            |a: f64, b: f64| (b - a) / 6.0 * (kernel(x, a) + 4.0 * kernel(x, 0.5 * (a + b)) + kernel(x, b));
        edges.windows(2).map(|edge| simpson(edge[0], edge[1])).sum::<f64>()
    };
    // `mean` is a polynomial of degree 3 or less on either side of ½
    let total = [(0.0, 0.5), (0.5, 1.0)]
        .map(|(a, b): (f64, f64)| (b - a) / 6.0 * (mean(a) + 4.0 * mean(0.5 * (a + b)) + mean(b)));
    (kernel, mean, total.iter().sum())
}

fn by_definition(numbers: &[f64], dims: usize, measure: Measure, weights: &[f64]) -> f64 {
    let n = (numbers.len() / dims) as f64;
    let published: Vec<_> = weights.iter().map(|&w| published(measure, w)).collect();
    let pairs = numbers.chunks(dims).flat_map(|x| numbers.chunks(dims).map(move |y| (x, y)));
    let kernels =
        pairs.map(|(x, y)| (0..dims).map(|j| published[j].0(x[j], y[j])).product::<f64>()).sum::<f64>();
    let singles =
        numbers.chunks(dims).map(|x| (0..dims).map(|j| published[j].1(x[j])).product::<f64>()).sum::<f64>();
    published.iter().map(|one| one.2).product::<f64>() - 2.0 * singles / n + kernels / (n * n)
}

#[test]
fn every_measure_is_its_published_kernel_with_means_by_quadrature() {
    for (case, measure) in (0..).zip([Measure::ALL; 6].concat()) {
        let (dims, n) = (1 + case as usize % 5, 1 + case as usize * 7 % 90);
        let mut numbers = random(case, n * dims);
        numbers[..dims].fill(if case % 2 == 0 { 0.0 } else { 1.0 });
        let ones = vec![1.0; dims];
        let wanted = by_definition(&numbers, dims, measure, &ones);
        assert!((squared(&numbers, dims, measure) - wanted).abs() < 1e-12, "{measure:?}, {n} × {dims}");
        let weights: Vec<f64> = (0..dims).map(|j| [0.0, 0.5, 2.0][j % 3]).collect();
        if !matches!(measure, Measure::Star | Measure::Periodic | Measure::Extreme) {
            let wanted = by_definition(&numbers, dims, measure, &weights);
            let found = summed(&numbers, dims, measure, Some(&weights), Algorithm::Pairs);
            assert!((found - wanted).abs() < 1e-12, "{measure:?}, weights {weights:?}");
        }
    }
}

#[test]
fn divide_and_conquer_sums_the_same_pairs() {
    for (case, measure) in (0..).zip([Measure::ALL; 3].concat()) {
        let (dims, n) = (1 + case as usize % 4, 600 + 37 * case as usize);
        let mut numbers = random(case, n * dims);
        if case % 3 == 0 {
            numbers = numbers.iter().map(|x| (x * 8.0).floor() / 8.0).collect();
        }
        let pairs = squared(&numbers, dims, measure);
        let halves = summed(&numbers, dims, measure, None, Algorithm::Halves);
        assert!((pairs - halves).abs() < 1e-12, "{measure:?}, {n} × {dims}: {pairs} {halves}");
    }
}

/// The six-point design of the examples of several papers.
#[test]
fn known_numbers() {
    let design = [(1, 3), (2, 6), (3, 2), (4, 5), (5, 1), (6, 4)];
    let numbers: Vec<f64> =
        design.iter().flat_map(|&(x, y)| [x, y].map(|x| (f64::from(x) - 0.5) / 6.0)).collect();
    let known = [
        (Measure::Centered, 0.008142039609053464),
        (Measure::WrapAround, 0.016846707818929),
        (Measure::Mixture, 0.014895592206789),
        (Measure::Star, 0.068336062125581 * 0.068336062125581),
    ];
    for (measure, wanted) in known {
        let found = squared(&numbers, 2, measure);
        assert!((found - wanted).abs() < 1e-14, "{measure:?}: {found}");
    }
}

/// J. Halton and S. Zaremba, *The extreme and L2 discrepancies of some plane sets*, Monatsh. Math. 73, 1969.
#[test]
fn hammersley_points_have_the_discrepancy_of_halton_and_zaremba() {
    let mut coordinates = vec![0.0; 1 << 12];
    let spec = Spec::new(1, Randomization::None, Seed::new(0));
    sequences::build("halton", &spec).expect("a sequence").fill(0..1 << 12, &mut coordinates);
    for m in 1..13 {
        let n = 1_usize << m;
        let numbers: Vec<f64> = (0..n).flat_map(|i| [i as f64 / n as f64, coordinates[i]]).collect();
        let (m, n) = (f64::from(m), n as f64);
        let wanted = m * m / 64.0 + 29.0 * m / 192.0 + 3.0 / 8.0 - m / (16.0 * n) + 1.0 / (4.0 * n)
            - 1.0 / (72.0 * n * n);
        for algorithm in [Algorithm::Pairs, Algorithm::Halves] {
            let found = n * n * summed(&numbers, 2, Measure::Star, None, algorithm);
            // n² times the rounding of numbers of about 0.1
            assert!((found - wanted).abs() < 1e-15 * n * n + 1e-12, "n = {n}: {found} {wanted}");
        }
    }
}

/// Means over independent points. 4,000 sets leave a standard error of 0.5 % or less; five of them with a fixed seed.
#[test]
fn independent_points_have_the_expected_means() {
    let (n, dims, sets) = (32, 3, 4000);
    for measure in Measure::ALL {
        let (mut sum, mut squares) = (0.0, 0.0);
        for set in 0..sets {
            let found = squared(&random(1000 + set, n * dims), dims, measure);
            sum += found;
            squares += found * found;
        }
        let mean = sum / sets as f64;
        let error = ((squares / sets as f64 - mean * mean) / sets as f64).sqrt();
        // the mean of k(x, x) less the mean of k(x, y)
        let (diagonal, both): (f64, f64) = match measure {
            Measure::Star | Measure::Periodic => (0.5, 1.0 / 3.0),
            Measure::WeightedStar | Measure::WrapAround => (1.5, 4.0 / 3.0),
            Measure::Centered => (1.25, 13.0 / 12.0),
            Measure::Mixture => (1.75, 19.0 / 12.0),
            Measure::Symmetric => (2.0, 4.0 / 3.0),
            Measure::Extreme => (1.0 / 6.0, 1.0 / 12.0),
        };
        let wanted = (diagonal.powi(3) - both.powi(3)) / n as f64;
        assert!((mean - wanted).abs() < 5.0 * error, "{measure:?}: {mean} {wanted} ± {error}");
        assert!(error < 0.02 * wanted);
    }
}

#[test]
fn threads_change_no_bit() {
    let numbers = random(5, 3 * 2000);
    let rows = Rows::new(&numbers, 3).expect("points");
    for measure in Measure::ALL {
        let with = |workers| {
            let workers = NonZeroUsize::new(workers).expect("not 0");
            let request = Request { measure, weights: None, algorithm: Algorithm::Pairs, workers };
            l2_discrepancy(&rows, &request).expect("a legal request").to_bits()
        };
        assert_eq!(with(1), with(2));
        assert_eq!(with(1), with(5));
    }
}

#[test]
fn wrong_weights_are_refused() {
    let said = |measure, weights: &[f64]| {
        let request = Request {
            measure,
            weights: Some(weights),
            algorithm: Algorithm::Auto,
            workers: NonZeroUsize::MIN,
        };
        l2_discrepancy(&Rows::new(&[0.5, 0.5], 2).expect("points"), &request)
            .expect_err("refused")
            .to_string()
    };
    assert!(said(Measure::Star, &[1.0, 1.0]).contains("'L2-star' has no weights"));
    assert_eq!(said(Measure::Centered, &[1.0]), "1 weights for 2 dimensions");
    assert_eq!(said(Measure::Mixture, &[1.0, -0.5]), "weights must be finite and at least 0, not -0.5");
    assert!(Measure::named("L3").expect_err("unknown").to_string().contains("known: CD, WD, MD, L2-star"));
}
