//! Rates of convergence along the Hilbert curve, as He and Owen (2016) prove them:
//! `cargo test --release -p evenlight-points --features statistics --test curve_statistics`.
#![cfg(feature = "statistics")]

mod anchored;

use anchored::anchored_discrepancy;
use evenlight_points::Seed;
use evenlight_points::warp::curve::named;
use evenlight_points::warp::curve::points::{CurvePoints, Source};

fn fill(dims: usize, source: Source, seed: u64, out: &mut [f64]) {
    CurvePoints::new(named("hilbert").expect("it is in the list"), dims, source, Seed::new(seed))
        .fill(0, out);
}

/// The slope of the least squares line through logarithms.
fn slope(pairs: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = pairs.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) =
        (logs.iter().map(|p| p.0).sum::<f64>() / count, logs.iter().map(|p| p.1).sum::<f64>() / count);
    let above = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>();
    above / logs.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// The variance of a mean over seeds, about its own mean: with 300 of them 8 %.
fn variance(dims: usize, source: Source, n: u64, f: fn(&[f64]) -> f64) -> f64 {
    const SEEDS: u64 = 300;
    let mut x = vec![0.0; n as usize * dims];
    let means: Vec<_> = (0..SEEDS)
        .map(|seed| {
            fill(dims, source, 1_000_003 * n + seed, &mut x);
            x.chunks_exact(dims).map(f).sum::<f64>() / n as f64
        })
        .collect();
    let mean = means.iter().sum::<f64>() / SEEDS as f64;
    means.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (SEEDS - 1) as f64
}

fn lipschitz(x: &[f64]) -> f64 {
    x.iter().map(|x| x.exp()).sum()
}

fn jumping(x: &[f64]) -> f64 {
    if x.iter().map(|x| x * x).sum::<f64>() < 0.8 { 1.0 + x[0] } else { 0.0 }
}

/// −1 − 2/d without and −1 − 1/d with a jump, at n = 100 · 2^k, stratified and scrambled. The slopes have standard errors of 0.025.
#[test]
fn variances_fall_at_the_proven_rates_at_any_n() {
    for dims in [2, 3, 4] {
        let d = dims as f64;
        for (name, f, expected) in
            [("lipschitz", lipschitz as fn(&[f64]) -> f64, -1.0 - 2.0 / d), ("jump", jumping, -1.0 - 1.0 / d)]
        {
            for source in [Source::Stratified, |_| Source::Owen] {
                let pairs: Vec<_> = (0..8)
                    .map(|k| 100 << k)
                    .map(|n: u64| (n as f64, variance(dims, source(n), n, f)))
                    .collect();
                let slope = slope(&pairs);
                eprintln!("{name}, d = {dims}, {:?}: {slope:.3}, not {expected:.3}", source(100));
                assert!((slope - expected).abs() < 0.1, "{name}, d = {dims}: {slope}, not {expected}");
            }
        }
    }
}

/// −1/d: in two dimensions from 32 to 4096 points, in three from 8 to 216.
#[test]
fn discrepancies_fall_as_the_side_of_a_cell() {
    let square = |n: u64| {
        let mut x = vec![0.0; 2 * n as usize];
        fill(2, Source::Centered(n), 0, &mut x);
        anchored_discrepancy(x.as_chunks().0, |s, t| s * t)
    };
    let counts = (0..15).map(|k| (32.0 * 2f64.powf(f64::from(k) / 2.0)).round() as u64);
    let flat = slope(&counts.map(|n| (n as f64, square(n))).collect::<Vec<_>>());
    assert!((flat + 0.5).abs() < 0.05, "{flat}");

    let counts = (0..12).map(|k| (8.0 * 27f64.powf(f64::from(k) / 11.0)).round() as u64);
    let cube = slope(&counts.map(|n| (n as f64, cube_discrepancy(n))).collect::<Vec<_>>());
    assert!((cube + 1.0 / 3.0).abs() < 0.1, "{cube}");
}

/// The star discrepancy in three dimensions, by slices: points below each height are judged as pairs, counted over all n.
fn cube_discrepancy(n: u64) -> f64 {
    let mut x = vec![0.0; 3 * n as usize];
    fill(3, Source::Centered(n), 0, &mut x);
    let points = x.as_chunks::<3>().0;
    let mut worst = 0.0_f64;
    let bounds = |axis: usize| points.iter().map(move |point| point[axis]).chain([1.0]);
    for r in bounds(0) {
        for s in bounds(1) {
            let mut last: Vec<_> = points
                .iter()
                .filter(|p| p[0] <= r && p[1] <= s)
                .map(|p| (p[2], p[0] < r && p[1] < s))
                .collect();
            last.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let (mut closed, mut open) = (0, 0);
            for run in last.chunk_by(|a, b| a.0 == b.0) {
                worst = worst.max(r * s * run[0].0 - f64::from(open) / n as f64);
                closed += run.len() as i32;
                open += run.iter().filter(|item| item.1).count() as i32;
                worst = worst.max(f64::from(closed) / n as f64 - r * s * run[0].0);
            }
            worst = worst.max(r * s - f64::from(open) / n as f64);
        }
    }
    worst
}
