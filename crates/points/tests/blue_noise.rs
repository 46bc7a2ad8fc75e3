//! Blue noise: distances of every beginning, masks by their definition, orders of pixels; spectra are judged from Python.

use std::num::NonZeroUsize;

use evenlight_points::Seed;
use evenlight_points::blue_noise::{self, Request, gaussian, pixel_order, void_and_cluster};
use evenlight_points::convert::unit_f64;

fn request(n: usize, dims: usize, effort: u32) -> Request {
    Request { n, dims, effort, seed: Seed::new(3), workers: NonZeroUsize::MIN }
}

fn random(count: usize) -> Vec<f64> {
    (0..count as u64).map(|i| unit_f64(Seed::new(4).dimension(i).bits64())).collect()
}

fn points(name: &str, request: &Request) -> Vec<f64> {
    blue_noise::points(name, request).expect("a request that can be met")
}

fn torus_distance(a: &[f64], b: &[f64]) -> f64 {
    let along = |(a, b): (&f64, &f64)| (a - b).abs().min(1.0 - (a - b).abs());
    a.iter().zip(b).map(along).map(|along| along * along).sum::<f64>().sqrt()
}

/// The distance of each point to the nearest of those before.
fn distances_to_earlier(x: &[f64], dims: usize) -> Vec<f64> {
    let rows: Vec<_> = x.chunks_exact(dims).collect();
    let nearest = |i: usize| {
        rows[..i].iter().map(|earlier| torus_distance(rows[i], earlier)).fold(f64::INFINITY, f64::min)
    };
    (0..rows.len()).map(nearest).collect()
}

/// The smallest distance within the first n points for each n, in units of the densest packing of the plane.
fn packed(x: &[f64]) -> Vec<f64> {
    let mut least = f64::INFINITY;
    let distances = distances_to_earlier(x, 2);
    let scaled = |(n, distance): (usize, f64)| {
        least = least.min(distance);
        least / (2.0 / (3.0_f64.sqrt() * n as f64)).sqrt()
    };
    (1..).zip(distances).map(scaled).skip(1).collect()
}

/// Random points have a smallest distance of the order of 1/n, darts have 0.6 to 0.75 of the densest packing, and one point more can make
/// the distance of the next step at worst: 2^(-1/8) of it.
#[test]
fn every_beginning_keeps_its_distance() {
    for (name, least) in [("poisson_disk", 0.52), ("sample_elimination", 0.5)] {
        let effort = blue_noise::ALL.iter().find(|entry| entry.name == name).expect("a member").effort.1;
        let worst = packed(&points(name, &request(700, 2, effort))).into_iter().skip(8).fold(1.0, f64::min);
        assert!(worst > least, "{name}: {worst}");
    }
}

#[test]
fn darts_go_on_where_they_stopped() {
    for dims in 1..=5 {
        let all = points("poisson_disk", &request(200, dims, 4));
        for n in [0, 1, 2, 57] {
            assert_eq!(points("poisson_disk", &request(n, dims, 4)), all[..n * dims]);
        }
    }
}

#[test]
fn points_are_in_the_cube_and_as_many_as_asked() {
    for entry in blue_noise::ALL {
        for dims in 1..=blue_noise::MOST_DIMS {
            for n in [0, 1, 2, 3, 40] {
                let x = points(entry.name, &request(n, dims, 3));
                assert_eq!(x.len(), n * dims, "{}", entry.name);
                assert!(x.iter().all(|x| (0.0..1.0).contains(x)), "{}", entry.name);
                assert!(n < 2 || distances_to_earlier(&x, dims)[1..].iter().all(|&distance| distance > 0.0));
            }
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let alone = request(5000, 2, 3);
    let together = Request { workers: 3.try_into().expect("not zero"), ..alone };
    for entry in blue_noise::ALL {
        assert_eq!(points(entry.name, &alone), points(entry.name, &together), "{}", entry.name);
    }
}

/// The sum of a Gaussian as wide as a point's share over all pairs, in units of what a constant density has, less 1.
fn excess(x: &[f64], dims: usize) -> f64 {
    let rows: Vec<_> = x.chunks_exact(dims).collect();
    let width = (rows.len() as f64).powf(-1.0 / dims as f64);
    let weight = |distance: f64| (-0.5 * (distance / width).powi(2)).exp();
    let sum: f64 = rows.iter().flat_map(|a| rows.iter().map(|b| weight(torus_distance(a, b)))).sum();
    let along: f64 = (0..10_000).map(|i| weight((f64::from(i) + 0.5) / 10_000.0 - 0.5) / 10_000.0).sum();
    sum / (along.powi(dims as i32) * (rows.len() as f64).powi(2)) - 1.0
}

/// Long waves decay slowly, as heat does, so that small sets are near their end after 150 steps. The Gaussian ends at half the torus,
/// which leaves it not quite without negative frequencies.
#[test]
fn relaxed_points_have_the_energy_of_an_even_gray() {
    for (dims, n) in [(1, 12), (2, 100), (3, 200)] {
        let mut x: Vec<f64> = random(n * dims);
        let start = excess(&x, dims);
        gaussian::relax(&mut x, dims, 150, NonZeroUsize::MIN).expect("points of the torus");
        let end = excess(&x, dims);
        assert!((-0.02 * start..0.05 * start).contains(&end), "dims = {dims}: {end}, after {start}");
    }
}

/// How full the surroundings of a pixel are, summed anew over all periods that matter.
fn fullness(sizes: [usize; 2], taken: &[usize], pixel: usize) -> f64 {
    let along = |axis: usize, a: usize, b: usize| -> f64 {
        let size = sizes[axis] as f64;
        let weight = |image: i32| (a as f64 - b as f64 + f64::from(image) * size).powi(2) / -4.5;
        (-12..=12).map(|image| weight(image).exp()).sum()
    };
    let one = |other: usize| {
        along(0, pixel / sizes[1], other / sizes[1]) * along(1, pixel % sizes[1], other % sizes[1])
    };
    taken.iter().map(|&other| one(other)).sum()
}

/// From a tenth on every pixel is the largest void; what is cut off of the Gaussian, e^(−18) of its height, may decide between equals.
#[test]
fn masks_fill_their_largest_voids() {
    for sizes in [[16, 16], [7, 23], [1, 30], [31, 2]] {
        let pixels = sizes[0] * sizes[1];
        let ranks = void_and_cluster::ranks(sizes[0], sizes[1], Seed::new(5)).expect("a small mask");
        let mut order = vec![0; pixels];
        ranks.iter().enumerate().for_each(|(pixel, &rank)| order[rank as usize] = pixel);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..pixels));
        for rank in pixels.div_ceil(10)..pixels {
            let free = |pixel: &&usize| fullness(sizes, &order[..rank], **pixel);
            let least = order[rank..].iter().map(|pixel| free(&pixel)).fold(f64::INFINITY, f64::min);
            assert!(fullness(sizes, &order[..rank], order[rank]) < least + 1e-6, "{sizes:?}, rank {rank}");
        }
    }
}

#[test]
fn the_first_pixels_of_a_mask_are_far_apart() {
    let side = 64;
    let ranks = void_and_cluster::ranks(side, side, Seed::new(8)).expect("a small mask");
    let mut order = vec![0; side * side];
    ranks.iter().enumerate().for_each(|(pixel, &rank)| order[rank as usize] = pixel);
    let centers = order[..256].iter().flat_map(|pixel| [pixel / side, pixel % side]);
    let x: Vec<f64> = centers.map(|at| (at as f64 + 0.5) / side as f64).collect();
    // places of a grid: the distance of the densest packing is missed by up to a pixel's diagonal
    for (n, packed) in (2..).zip(packed(&x)) {
        assert!(packed > 0.5, "{n}: {packed}");
    }
}

#[test]
fn squares_of_pixels_share_a_range_of_places() {
    for (curve, shuffle) in [("morton", None), ("hilbert", None), ("hilbert", Some(2)), ("morton", Some(3))] {
        let places = pixel_order::places(curve, [32, 32], shuffle.map(Seed::new)).expect("a small image");
        for bits in 0..=5 {
            let side = 1 << bits;
            for (row, column) in
                (0..32).step_by(side).flat_map(|row| (0..32).step_by(side).map(move |column| (row, column)))
            {
                let mut inside: Vec<u64> = (row..row + side)
                    .flat_map(|row| (column..column + side).map(move |column| (row, column)))
                    .map(|(row, column)| places[row * 32 + column])
                    .collect();
                inside.sort_unstable();
                let first = inside[0];
                assert!(first.is_multiple_of(1 << (2 * bits)), "{curve}");
                assert!(inside.into_iter().eq(first..first + (1 << (2 * bits))), "{curve}");
            }
        }
        let part = pixel_order::places(curve, [20, 27], shuffle.map(Seed::new)).expect("a small image");
        assert!((0..20 * 27).all(|at| part[at] == places[at / 27 * 32 + at % 27]), "{curve}");
    }
}

#[test]
fn mistakes_are_named() {
    let message =
        |name: &str, request: &Request| blue_noise::points(name, request).expect_err("a mistake").to_string();
    assert_eq!(
        message("pink", &request(1, 2, 1)),
        "unknown blue noise 'pink'; known: poisson_disk, sample_elimination, gaussian"
    );
    assert_eq!(message("gaussian", &request(1, 9, 1)), "blue noise has 1 to 8 dimensions, not 9");
    assert_eq!(message("gaussian", &request(1, 2, 0)), "steps must be at least 1, not 0");
    assert!(message("poisson_disk", &request(1 << 30, 2, 9)).contains("points times darts must be at most"));
    assert!(void_and_cluster::ranks(0, 5, Seed::new(1)).is_err());
    assert!(void_and_cluster::ranks(5000, 5000, Seed::new(1)).is_err());
    assert!(pixel_order::places("peano", [2, 2], None).is_err());
    assert!(pixel_order::places("morton", [1 << 17, 2], None).is_err());
    assert!(gaussian::relax(&mut vec![1.0], 1, 1, NonZeroUsize::MIN).is_err());
}
