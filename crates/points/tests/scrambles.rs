//! Scrambles in base 2: bijections digit by digit, with the variance that theory gives them.

use evenlight_points::convert::unit_f64;
use evenlight_points::scramble::owen::{nested_uniform_scramble_32, nested_uniform_scramble_64};
use evenlight_points::scramble::{self, Randomization};
use evenlight_points::sequences::sobol::sobol;
use evenlight_points::{PointSet, Seed};

const SEEDS: u64 = 40_000;

#[test]
fn first_digits_depend_on_first_digits_only_and_are_permuted() {
    for entry in scramble::ALL.iter().filter(|entry| entry.nested) {
        for key in (0..20).map(Seed::new) {
            let mut seen = vec![false; 1 << 12];
            for prefix in 0..1_u64 << 12 {
                let junk = Seed::new(prefix).bits64() >> 12;
                let image = (entry.apply)(prefix << 52 | junk, key) >> 52;
                assert_eq!(image, (entry.apply)(prefix << 52, key) >> 52, "{}", entry.name);
                assert!(!std::mem::replace(&mut seen[image as usize], true), "{}: {image} twice", entry.name);
            }
        }
    }
    for seed in (0..20).map(|number| Seed::new(number).bits32()) {
        let image = |prefix: u32| nested_uniform_scramble_32(prefix << 20 | 0x9_a7e3, seed) >> 20;
        let mut images: Vec<_> = (0..1 << 12).map(image).collect();
        assert!(
            (0..1 << 12).all(|prefix| nested_uniform_scramble_32(prefix << 20, seed) >> 20 == image(prefix))
        );
        images.sort_unstable();
        assert!(images.into_iter().eq(0..1 << 12));
    }
}

#[test]
fn words_are_permuted_at_every_depth() {
    for k in 1..64 {
        let (a, b) = (0x0123_4567_89ab_cdef_u64, 0x0123_4567_89ab_cdef_u64 ^ (1 << (63 - k)));
        for seed in (0..50).map(|number| Seed::new(number).bits64()) {
            let difference = nested_uniform_scramble_64(a, seed) ^ nested_uniform_scramble_64(b, seed);
            assert_eq!(difference.leading_zeros(), k, "the first different digit stays the first");
        }
    }
}

/// The mean over seeds of the squared error of the mean of `f` over `n` words 0, 1/n, 2/n, …
fn squared_error(n: u64, truth: f64, mean: impl Fn(Seed) -> f64) -> f64 {
    let errors = (0..SEEDS).map(|r| (mean(Seed::new(n).replicate(r)) - truth).powi(2));
    errors.sum::<f64>() / SEEDS as f64
}

/// A. B. Owen (1997): stratification alone leaves the variance 1/(12 n³) for f(x) = x. With 40,000
/// seeds the measured ratio has a standard deviation below 0.01.
#[test]
fn owen_scrambling_in_one_dimension_has_the_exact_variance() {
    for m in [2_u32, 4, 6] {
        let n = 1_u64 << m;
        let scale = 12.0 * (n as f64).powi(3);
        let mean = |seed: Seed| -> f64 {
            let words = (0..n).map(|i| nested_uniform_scramble_64(i << (64 - m), seed.bits64()));
            words.map(unit_f64).sum::<f64>() / n as f64
        };
        let ratio = scale * squared_error(n, 0.5, mean);
        assert!((ratio - 1.0).abs() < 0.05, "64 bits, n = {n}: {ratio}");

        let mean = |seed: Seed| -> f64 {
            let words = (0..n as u32).map(|i| nested_uniform_scramble_32(i << (32 - m), seed.bits32()));
            words.map(|word| (f64::from(word) + 0.5) / 2f64.powi(32)).sum::<f64>() / n as f64
        };
        let ratio = scale * squared_error(n, 0.5, mean);
        assert!((ratio - 1.0).abs() < 0.05, "32 bits, n = {n}: {ratio}");
    }
}

/// The mean of n words i/n under a randomization: the variance theory gives it, relative to the one measured.
#[test]
fn every_randomization_has_its_exact_variance_in_one_dimension() {
    let known: [(Randomization, i32); 6] = [
        (Randomization::Shift, 2),
        (Randomization::DigitalShift, 2),
        (Randomization::Linear, 3),
        (Randomization::LinearIBinomial, 3),
        (Randomization::Owen, 3),
        (Randomization::OwenExact, 3),
    ];
    for (randomization, power) in known {
        let apply = randomization.entry().apply;
        for n in [4_u64, 16, 64] {
            let mean = |seed: Seed| -> f64 {
                let words = (0..n).map(|i| apply(i.reverse_bits(), seed));
                words.map(unit_f64).sum::<f64>() / n as f64
            };
            let ratio = 12.0 * (n as f64).powi(power) * squared_error(n, 0.5, mean);
            assert!((ratio - 1.0).abs() < 0.05, "{}, n = {n}: {ratio}", randomization.name());
        }
    }
}

/// The last cells are paired antithetically, so that the errors of f(x) = x cancel.
#[test]
fn the_striped_scramble_is_exact_for_the_mean_of_x() {
    let apply = Randomization::LinearStriped.entry().apply;
    for seed in (0..100).map(Seed::new) {
        let mean = (0..16_u64).map(|i| unit_f64(apply(i.reverse_bits(), seed))).sum::<f64>() / 16.0;
        assert!((mean - 0.5).abs() < 1e-12, "{mean}");
    }
}

/// For f(x, y) = xy and 2^m points of a (0, m, 2)-net, n³ Var = 7 (3m + 4) / 576. Heavier tails than in one dimension: 10 % is
/// five standard deviations of 8,000 replicates, and for linear scrambles, whose tails are heavier still, 20 %.
#[test]
fn nested_scrambles_in_two_dimensions_have_the_exact_variance() {
    let known = [
        (Randomization::Owen, 0.1),
        (Randomization::OwenExact, 0.1),
        (Randomization::Linear, 0.2),
        (Randomization::LinearIBinomial, 0.2),
    ];
    for (randomization, tolerance) in known {
        for m in 3..=7 {
            let n = 1_usize << m;
            let mut rows = vec![0.0; 2 * n];
            let errors = (0..8_000).map(|r| {
                sobol(2, randomization, Seed::new(m).replicate(r)).fill(0..n as u64, &mut rows);
                let mean = rows.chunks_exact(2).map(|x| x[0] * x[1]).sum::<f64>() / n as f64;
                (mean - 0.25).powi(2)
            });
            let variance = errors.sum::<f64>() / 8_000.0;
            let ratio = (n as f64).powi(3) * variance * 576.0 / (7 * (3 * m + 4)) as f64;
            assert!((ratio - 1.0).abs() < tolerance, "{}, m = {m}: {ratio}", randomization.name());
        }
    }
}
