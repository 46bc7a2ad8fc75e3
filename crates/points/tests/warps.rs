//! Laws of the warps: every registered warp, on examples whose domains have coordinates of their own.

mod warp_domains;

use evenlight_points::Seed;
use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Spec};
use evenlight_points::warp::rows::{AnyRows, Rows};
use evenlight_points::warp::{self, Options};
use warp_domains::{Domain, all};

fn built(entry: &warp::Entry, options: &Options) -> Box<dyn AnyRows> {
    warp::build(entry.name, options).unwrap_or_else(|error| panic!("{error}"))
}

/// Independent numbers in rows, in [0, 1).
fn uniform(rows: usize, columns: usize, seed: u64) -> Vec<f64> {
    let spec = Spec::new(columns, Randomization::None, Seed::new(seed));
    let points = sequences::build("independent", &spec).expect("there is no wrong number of dimensions");
    let mut u = vec![0.0; rows * columns];
    points.fill(0..rows as u64, &mut u);
    u
}

fn map(warp: &dyn Rows<f64>, u: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; u.len() / warp.inputs() * warp.outputs()];
    warp.map(u, &mut x);
    x
}

fn invert(warp: &dyn Rows<f64>, x: &[f64]) -> Vec<f64> {
    let mut u = vec![0.0; x.len() / warp.outputs() * warp.inputs()];
    warp.invert(x, &mut u);
    u
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}

#[test]
fn inverses_undo_maps_in_double_precision() {
    for (entry, options, _) in all() {
        let warp = built(entry, &options);
        let u = uniform(20_000, warp.inputs(), 1);
        let x = map(&*warp, &u);
        let back = invert(&*warp, &x);
        let error = if entry.folds {
            largest_difference(&map(&*warp, &back), &x)
        } else {
            largest_difference(&back, &u)
        };
        assert!(error <= 1e-12, "{} {options:?}: {error:e}", entry.name);
    }
}

/// The numbers differ by 10⁻⁶ at most, or by what one unit in the last place of the point makes of them.
#[test]
fn inverses_undo_maps_in_single_precision() {
    for (entry, options, _) in all() {
        let warp = built(entry, &options);
        let (inputs, outputs) = (warp.inputs(), warp.outputs());
        let u: Vec<_> =
            uniform(20_000, inputs, 2).into_iter().map(evenlight_points::convert::truncate_to_f32).collect();
        let (mut x, mut back) = (vec![0_f32; u.len() / inputs * outputs], vec![0_f32; u.len()]);
        Rows::<f32>::map(&*warp, &u, &mut x);
        Rows::<f32>::invert(&*warp, &x, &mut back);
        if entry.folds {
            let mut again = x.clone();
            Rows::<f32>::map(&*warp, &back, &mut again);
            let error = x.iter().zip(&again).fold(0.0, |most, (a, b)| f32::max(most, (a - b).abs()));
            assert!(error <= 1e-6, "{} {options:?}: {error:e}", entry.name);
            continue;
        }
        for ((u, x), back) in u.chunks(inputs).zip(x.chunks(outputs)).zip(back.chunks(inputs)) {
            let error = u.iter().zip(back).fold(0.0, |most, (a, b)| f32::max(most, (a - b).abs()));
            let allowed = if error > 1e-6 { blur(&*warp, x) } else { 1e-6 };
            assert!(f64::from(error) <= allowed, "{} {options:?} at {u:?}: {error:e}", entry.name);
        }
    }
}

/// How far the numbers of a point move when its coordinates move by one unit in their last place in single precision.
fn blur(warp: &dyn Rows<f64>, x: &[f32]) -> f64 {
    let x: Vec<_> = x.iter().copied().map(f64::from).collect();
    let still = invert(warp, &x);
    let moved = |axis: usize, step: f64| {
        let mut x = x.clone();
        x[axis] *= 1.0 + step;
        largest_difference(&invert(warp, &x), &still)
    };
    let step = f64::from(f32::EPSILON);
    (0..x.len()).map(|axis| moved(axis, step).max(moved(axis, -step))).sum::<f64>() * 2.0
}

/// Cells for each axis, and places in each cell for each axis.
fn grid(dims: usize) -> (usize, usize) {
    match dims {
        1 => (256, 512),
        2 => (20, 48),
        _ => (8, 12),
    }
}

/// The number of a cell from the places of each axis.
fn cell(place: &[f64], cells: usize) -> usize {
    place.iter().fold(0, |cell, s| cell * cells + ((s * cells as f64) as usize).min(cells - 1))
}

/// The integral of the density over every cell of the domain, by the midpoint rule.
fn masses(warp: &dyn Rows<f64>, domain: &Domain) -> Vec<f64> {
    let (cells, within) = grid(domain.dims);
    let side = cells * within;
    let mut masses = vec![0.0; cells.pow(domain.dims as u32)];
    let volume = (side as f64).powi(domain.dims as i32);
    for number in 0..side.pow(domain.dims as u32) {
        let digit = |axis: usize| number / side.pow(axis as u32) % side;
        let place: Vec<_> = (0..domain.dims).map(|axis| (digit(axis) as f64 + 0.5) / side as f64).collect();
        let (x, jacobian) = (domain.point)(&place);
        let mut density = [0.0];
        warp.density(&x, &mut density);
        masses[cell(&place, cells)] += density[0] * jacobian / volume;
    }
    masses
}

/// The probability of a sum of squares as large as this, or larger, by the approximation of Wilson and Hilferty (1931).
fn tail(sum: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let z = ((sum / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    // an upper bound of the normal tail
    if z > 1.0 { (-0.5 * z * z).exp() / (z * (2.0 * std::f64::consts::PI).sqrt()) } else { 1.0 }
}

/// A million points; over fewer than 100 examples, correct warps and fresh seeds would fail one run in ten thousand.
#[test]
fn densities_integrate_to_one_and_are_those_of_mapped_points() {
    const POINTS: usize = 1_000_000;
    for (entry, options, domain) in all() {
        let warp = built(entry, &options);
        let masses = masses(&*warp, &domain);
        let total = masses.iter().sum::<f64>();
        assert!((total - 1.0).abs() < 1e-3, "{} {options:?}: the density integrates to {total}", entry.name);

        let x = map(&*warp, &uniform(POINTS, warp.inputs(), 3));
        let mut counts = vec![0.0; masses.len()];
        for x in x.chunks(warp.outputs()) {
            counts[cell(&(domain.place)(x), grid(domain.dims).0)] += 1.0;
        }
        let (mut sum, mut bins) = (0.0, 0.0);
        for (mass, count) in masses.iter().zip(counts) {
            let expected = mass / total * POINTS as f64;
            if expected > 5.0 {
                (sum, bins) = (sum + (count - expected).powi(2) / expected, bins + 1.0);
            } else {
                assert!(count < 60.0, "{} {options:?}: {count} where {expected} are expected", entry.name);
            }
        }
        let p = tail(sum, bins - 1.0);
        assert!(p > 1e-6, "{} {options:?}: chi-square {sum} in {bins} cells", entry.name);
    }
}

/// Mapped points have positive density, numbers stay in [0, 1], in both precisions and at the ends of the cube.
#[test]
fn every_mapped_point_has_positive_density() {
    for (entry, options, _) in all() {
        let warp = built(entry, &options);
        let inputs = warp.inputs();
        let mut u = uniform(5000, inputs, 4);
        for (place, end) in [0.0, 0.5, 1.0 - 2f64.powi(-53), 2f64.powi(-53)].into_iter().enumerate() {
            u[place * inputs..][..inputs].fill(end);
        }
        let x = map(&*warp, &u);
        let mut density = vec![0.0; u.len() / inputs];
        Rows::<f64>::density(&*warp, &x, &mut density);
        assert!(density.iter().all(|&d| d > 0.0), "{} {options:?}", entry.name);
        assert!(invert(&*warp, &x).iter().all(|u| (0.0..=1.0).contains(u)), "{} {options:?}", entry.name);

        let u: Vec<_> = u.into_iter().map(evenlight_points::convert::truncate_to_f32).collect();
        let (mut x, mut density) =
            (vec![0_f32; u.len() / inputs * warp.outputs()], vec![0_f32; u.len() / inputs]);
        Rows::<f32>::map(&*warp, &u, &mut x);
        Rows::<f32>::density(&*warp, &x, &mut density);
        assert!(density.iter().all(|&d| d > 0.0), "{} {options:?} in single precision", entry.name);
    }
}

#[test]
fn mistakes_are_named() {
    let message = |name, options| warp::build(name, &options).err().map(|error| error.to_string());
    let unknown = message("nowhere", Options::default()).expect("there is no such warp");
    assert!(unknown.starts_with("unknown warp 'nowhere'; known: triangle_root, "), "{unknown}");
    let options = Options { radius: Some(1.0), ..Options::default() };
    let wrong = message("triangle_root", options).expect("it has no radius");
    assert_eq!(wrong, "warp 'triangle_root' has no option 'radius'; it has: none");
}
