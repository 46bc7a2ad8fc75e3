//! Statistics that need optimized code:
//! `cargo test --release -p evenlight-points --features statistics --test statistics`.
//!
//! Bounds are at least five standard deviations of the measured quantity wide; seeds are fixed.
#![cfg(feature = "statistics")]

use evenlight_points::convert::unit_f64;
use evenlight_points::scramble::Randomization;
use evenlight_points::scramble::owen::{nested_uniform_scramble_32, nested_uniform_scramble_64};
use evenlight_points::sequences::sobol::sobol;
use evenlight_points::sequences::{self, Spec};
use evenlight_points::{PointSet, Seed};

/// 12 n³ times the variance of the mean of x, which is 1 for a nested uniform scramble.
fn variance_ratio(n: u64, seeds: u64, mean: impl Fn(Seed) -> f64) -> f64 {
    let errors = (0..seeds).map(|r| (mean(Seed::new(n + 1).replicate(r)) - 0.5).powi(2));
    12.0 * (n as f64).powi(3) * errors.sum::<f64>() / seeds as f64
}

/// The hashed bits of the tree behave like independent ones in larger nets as well. 200,000 seeds
/// leave a standard deviation of 0.003.
#[test]
fn owen_hashes_keep_the_exact_variance_in_larger_nets() {
    for m in [2, 3, 4, 5, 6, 8, 10] {
        let n = 1_u64 << m;
        let mean = |seed: Seed| -> f64 {
            let words = (0..n).map(|i| nested_uniform_scramble_64(i << (64 - m), seed.bits64()));
            words.map(unit_f64).sum::<f64>() / n as f64
        };
        let long = variance_ratio(n, 200_000, mean);
        let mean = |seed: Seed| -> f64 {
            let words = (0..n as u32).map(|i| nested_uniform_scramble_32(i << (32 - m), seed.bits32()));
            words.map(|word| (f64::from(word) + 0.5) / 2f64.powi(32)).sum::<f64>() / n as f64
        };
        let short = variance_ratio(n, 200_000, mean);
        assert!((long - 1.0).abs() < 0.03, "64 bits, n = {n}: {long}");
        assert!((short - 1.0).abs() < 0.06, "32 bits, n = {n}: {short}");
    }
}

/// The bit that flips digit `level` below a prefix, over seeds: fair, and uncorrelated between prefixes.
#[test]
fn bits_of_the_scrambling_tree_are_fair_and_uncorrelated() {
    const SEEDS: u64 = 100_000;
    let flip = |prefix: u64, level: u32, seed: Seed| -> i64 {
        let word = if level == 0 { 0 } else { prefix << (64 - level) };
        1 - 2 * (nested_uniform_scramble_64(word, seed.bits64()) >> (63 - level) & 1) as i64
    };
    // A sum of N fair signs stays within 5.5 √N but for one time in 2.6·10^7; there are 2,650 sums.
    let bound = (5.5 * (SEEDS as f64).sqrt()) as i64;
    for level in 0..53 {
        for pair in 0..25 {
            let mask = (1_u64 << level) - 1;
            let a = Seed::new(pair).split(20, 0).bits64() & mask;
            // Neighbors in the tree as well as distant prefixes.
            let b = if pair < 12 && level > 0 { a ^ (1 << (pair % u64::from(level))) } else { !a & mask };
            let (mut sum, mut product) = (0, 0);
            for seed in (0..SEEDS).map(|r| Seed::new(99).replicate(r)) {
                let (x, y) = (flip(a, level, seed), flip(b, level, seed));
                (sum, product) = (sum + x, product + x * y);
            }
            assert!(sum.abs() < bound, "level {level}, prefix {a:b}: {sum}");
            assert!(a == b || product.abs() < bound, "level {level}, prefixes {a:b} and {b:b}: {product}");
        }
    }
}

/// For f(x, y) = xy, n³ Var = 7 (3m + 4) / 576 also for larger nets.
#[test]
fn owen_scrambling_in_two_dimensions_has_the_exact_variance() {
    for m in [8, 10] {
        let n = 1_usize << m;
        let mut rows = vec![0.0; 2 * n];
        let errors = (0..40_000).map(|r| {
            sobol(2, Randomization::Owen, Seed::new(m).replicate(r)).fill(0..n as u64, &mut rows);
            let mean = rows.chunks_exact(2).map(|x| x[0] * x[1]).sum::<f64>() / n as f64;
            (mean - 0.25).powi(2)
        });
        let ratio = (n as f64).powi(3) * errors.sum::<f64>() / 40_000.0 * 576.0 / (7 * (3 * m + 4)) as f64;
        assert!((ratio - 1.0).abs() < 0.05, "m = {m}: {ratio}");
    }
}

/// Root mean squared error for a smooth product in three dimensions, from n = 2^6 to 2^12: slope −1/2
/// for independent points, near −3/2 for Owen-scrambled Sobol' points, about −1 or better for Halton.
#[test]
fn errors_fall_as_fast_as_claimed() {
    for (name, low, high) in [("independent", -0.6, -0.4), ("sobol", -1.65, -1.3), ("halton", -1.6, -0.95)] {
        let rmse = |n: usize| {
            let mut rows = vec![0.0; 3 * n];
            let errors = (0..1_000).map(|r| {
                let scramble = if name == "independent" { Randomization::None } else { Randomization::Owen };
                let points = sequences::build(name, &Spec::new(3, scramble, Seed::new(5).replicate(r)))
                    .expect("valid");
                points.fill(0..n as u64, &mut rows);
                let f = |x: &[f64]| x.iter().map(|x| x * x.exp()).product::<f64>();
                (rows.chunks_exact(3).map(f).sum::<f64>() / n as f64 - 1.0).powi(2)
            });
            (errors.sum::<f64>() / 1_000.0).sqrt()
        };
        let slope = (rmse(1 << 12) / rmse(1 << 6)).log2() / 6.0;
        assert!((low..high).contains(&slope), "{name}: {slope}");
    }
}
