//! Laws that every pixel filter obeys: its samples are drawn from |f|, and their signed weights make them averages over f.

mod judge;
mod random;
mod stage;

use std::collections::BTreeSet;
use std::f64::consts::PI;

use evenlight_render::filter::{self, Filter};
use judge::{chi_square, level};
use random::Random;

/// A filter, its function and its radius.
struct Case {
    name: &'static str,
    filter: Filter,
    f: fn(f64) -> f64,
    radius: f64,
}

fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { (PI * x).sin() / (PI * x) }
}

/// Gaussian, lowered to zero at four standard deviations.
fn gaussian(x: f64, stddev: f64) -> f64 {
    (-0.5 * (x / stddev).powi(2)).exp() - (-8.0_f64).exp()
}

/// The two-parameter cubics of Mitchell & Netravali 1988, as a sum over the basis cubics.
fn cubic(x: f64, b: f64, c: f64) -> f64 {
    let x = x.abs();
    let spline = if x < 1.0 { 4.0 - 6.0 * x * x + 3.0 * x.powi(3) } else { (2.0 - x).powi(3) } / 6.0;
    let hermite = if x < 1.0 { 1.0 - 3.0 * x * x + 2.0 * x.powi(3) } else { 0.0 };
    let slope = if x < 1.0 { x * x * (1.0 - x) } else { (2.0 - x).powi(2) * (1.0 - x) };
    b * spline + (1.0 - b) * hermite + c * slope
}

/// Name in the reference values, function, radius.
type Line = (&'static str, fn(f64) -> f64, f64);

const FUNCTIONS: [Line; 10] = [
    ("box", |_| 1.0, 0.5),
    ("catmullrom", |x| cubic(x, 0.0, 0.5), 2.0),
    ("gaussian", |x| gaussian(x, 0.5), 2.0),
    ("lanczos", |x| sinc(x) * sinc(x / 3.0), 3.0),
    ("mitchell", |x| cubic(x, 1.0 / 3.0, 1.0 / 3.0), 2.0),
    ("tent", |x| 1.0 - x.abs(), 1.0),
    ("gaussian wide", |x| gaussian(x, 0.8), 3.2),
    ("lanczos two", |x| sinc(x) * sinc(x / 2.0), 2.0),
    ("mitchell sharp", |x| cubic(x, 0.1, 0.45), 2.0),
    ("tent wide", |x| 1.0 - x.abs() / 1.5, 1.5),
];

/// The filters of the reference file, which gives their XML.
fn cases() -> Vec<Case> {
    let xml = |wanted: &str| {
        let lines = include_str!("data/scene_reference.csv").lines();
        let line = lines.filter_map(|line| line.strip_prefix("filter,")?.split_once(','));
        line.filter(|(name, _)| *name == wanted).map(|(_, xml)| xml).next().expect("a line for it")
    };
    let case = |&(name, f, radius): &Line| {
        let film = format!("<film type='hdrfilm'>{}</film>", xml(name));
        let scene = stage::scene(&format!("<sensor type='perspective'>{film}</sensor>"));
        Case { name, filter: scene.film.filter, f, radius }
    };
    FUNCTIONS.iter().map(case).collect()
}

impl Case {
    /// Integral of `g(x) f(x)` between two places, by the midpoint rule.
    fn integral(&self, low: f64, high: f64, g: impl Fn(f64, f64) -> f64) -> f64 {
        let step = (high - low) / 2000.0;
        let values = (0..2000).map(|i| low + step * (f64::from(i) + 0.5)).map(|x| g(x, (self.f)(x)));
        values.sum::<f64>() * step
    }

    fn over_all(&self, g: impl Fn(f64, f64) -> f64) -> f64 {
        self.integral(-self.radius, self.radius, g)
    }

    /// Average over evenly spread numbers of the weight times a function of the offset.
    fn average(&self, g: impl Fn(f64) -> f64) -> f64 {
        let count = 1 << 16;
        let samples = (0..count).map(|i| self.filter.sample((i as f32 + 0.5) / count as f32));
        samples.map(|(x, weight)| f64::from(weight) * g(x.into())).sum::<f64>() / f64::from(count)
    }
}

#[test]
fn functions_agree_with_mitsuba() {
    let mut current = None;
    let mut compared = 0;
    for line in include_str!("data/scene_reference.csv").lines() {
        if line.starts_with(|first: char| first.is_ascii_alphabetic()) {
            let name = line.strip_prefix("filter,").and_then(|rest| rest.split(',').next());
            current =
                name.map(|name| FUNCTIONS.iter().find(|known| known.0 == name).expect("a known filter"));
        } else if let Some((name, f, radius)) = current {
            let row: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
            // Mitsuba approximates the exponential of its Gaussian
            let tolerance = if name.starts_with("gaussian") { 5e-4 } else { 1e-5 };
            assert!((f(row[0]) - row[1]).abs() < tolerance, "{name}: {} but {row:?}", f(row[0]));
            assert!((radius - row[2]).abs() < 1e-6, "{name}: {row:?}");
            compared += 1;
        }
    }
    assert!(compared >= 10 * FUNCTIONS.len());
}

#[test]
fn offsets_follow_the_absolute_value() {
    const BINS: usize = 64;
    const SAMPLES: usize = 200_000;
    for (number, case) in cases().iter().enumerate() {
        let total = case.over_all(|_, f| f.abs());
        let edge = |bin: usize| case.radius * (2.0 * bin as f64 / BINS as f64 - 1.0);
        let expected: Vec<f64> = (0..BINS)
            .map(|bin| case.integral(edge(bin), edge(bin + 1), |_, f| f.abs()) / total * SAMPLES as f64)
            .collect();
        let mut observed = vec![0.0; BINS];
        let mut random = Random(number as u64);
        for _ in 0..SAMPLES {
            let place = (f64::from(case.filter.sample(random.next()).0) / case.radius + 1.0) * 0.5;
            observed[((place * BINS as f64) as usize).min(BINS - 1)] += 1.0;
        }
        let p = chi_square(&expected, &observed);
        assert!(p > level(1e-4, FUNCTIONS.len()), "{}: p = {p}", case.name);
    }
}

#[test]
fn moments_are_those_of_the_function() {
    for case in cases() {
        let total = case.over_all(|_, f| f);
        assert!((case.average(|_| 1.0) - 1.0).abs() < 1e-4, "{}: {}", case.name, case.average(|_| 1.0));
        for (power, tolerance) in [(1, 1e-4), (2, 5e-4), (4, 1e-3)] {
            let exact = case.over_all(|x, f| f * (x / case.radius).powi(power)) / total;
            let ours = case.average(|x| (x / case.radius).powi(power));
            assert!((ours - exact).abs() < tolerance, "{}, moment {power}: {ours}, not {exact}", case.name);
        }
    }
}

#[test]
fn weights_have_one_size_and_the_sign_of_the_function() {
    for case in cases() {
        let size = case.over_all(|_, f| f.abs()) / case.over_all(|_, f| f);
        let step = 2.0 * case.radius / 256.0;
        for i in 0..10_000 {
            let (x, weight) = case.filter.sample(i as f32 / 10_000.0);
            assert!((f64::from(weight.abs()) - size).abs() < 2e-3 * size, "{}: {weight}", case.name);
            let (x, weight) = (f64::from(x), f64::from(weight));
            let nearby = [x - step, x, x + step].map(|x| (case.f)(x) * weight > 0.0);
            assert!(nearby.contains(&true), "{} at {x}: {weight}", case.name);
        }
    }
}

#[test]
fn offsets_stay_within_the_radius_and_reach_it() {
    for case in cases() {
        let radius = case.radius as f32;
        let extremes = [0.0, 1.0 - f32::EPSILON / 2.0].map(|u| case.filter.sample(u).0);
        assert!(extremes[0] >= -radius && extremes[1] <= radius, "{}: {extremes:?}", case.name);
        assert!(extremes[0] < -0.9 * radius && extremes[1] > 0.9 * radius, "{}: {extremes:?}", case.name);
        let offsets: Vec<f32> = (0..10_000).map(|i| case.filter.sample(i as f32 / 1e4).0).collect();
        assert!(offsets.is_sorted(), "{}: stratified numbers must stay stratified", case.name);
    }
}

#[test]
fn every_filter_is_tried() {
    let registered: BTreeSet<_> = filter::ALL.iter().map(|entry| entry.name).collect();
    assert_eq!(registered, cases().iter().map(|case| case.filter.name).collect());
}
