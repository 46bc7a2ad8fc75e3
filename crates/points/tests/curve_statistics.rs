//! Rates of convergence along the Hilbert curve, as He and Owen (2016) prove them:
//! `cargo test --release -p evenlight-points --features statistics --test curve_statistics`.
#![cfg(feature = "statistics")]

use evenlight_points::Seed;
use evenlight_points::quality::Rows;
use evenlight_points::quality::star::{Kind, Settings, star_discrepancy};
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

/// −1/d, by least squares over counts half an octave apart.
#[test]
fn discrepancies_fall_as_the_side_of_a_cell() {
    for (dims, least, octaves) in [(2, 32, 7), (3, 8, 6), (4, 16, 4)] {
        let counts =
            (0..=2 * octaves).map(|k| (f64::from(least) * 2f64.powf(f64::from(k) / 2.0)).round() as u64);
        let star = |n: u64| {
            let mut x = vec![0.0; dims * n as usize];
            fill(dims, Source::Centered(n), 0, &mut x);
            let rows = Rows::new(&x, dims).expect("points");
            let found = star_discrepancy(&rows, &Settings::default(), &mut |_| true).expect("legal");
            let found = found.expect("an answer");
            assert_eq!(found.kind, Kind::Exact, "{n} points in {dims} dimensions");
            found.value
        };
        let slope = slope(&counts.map(|n| (n as f64, star(n))).collect::<Vec<_>>());
        eprintln!("d = {dims}: {slope:.3}");
        assert!((slope + 1.0 / dims as f64).abs() < 0.1, "d = {dims}: {slope}");
    }
}
