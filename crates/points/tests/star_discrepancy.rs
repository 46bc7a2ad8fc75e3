//! The star discrepancy against brute force over all critical boxes, known numbers, and itself on several threads.

use std::num::NonZeroUsize;

use evenlight_points::Seed;
use evenlight_points::convert::unit_f64;
use evenlight_points::quality::Rows;
use evenlight_points::quality::bracketing::Limits;
use evenlight_points::quality::local::local_discrepancy;
use evenlight_points::quality::star::{Kind, Method, Settings, Star, star_discrepancy};
use evenlight_points::quality::threshold_accepting::Effort;
use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Spec};

fn star(numbers: &[f64], dims: usize, settings: Settings) -> Star {
    let rows = Rows::new(numbers, dims).expect("points");
    star_discrepancy(&rows, &settings, &mut |_| true).expect("legal settings").expect("not stopped")
}

fn with(method: Method) -> Settings {
    Settings { method, ..Settings::default() }
}

/// The definition itself: every box whose faces are at coordinates of points or at 1, open and closed.
fn brute_force(numbers: &[f64], dims: usize) -> f64 {
    let points: Vec<&[f64]> = numbers.chunks(dims).collect();
    let lines: Vec<Vec<f64>> =
        (0..dims).map(|dim| points.iter().map(|point| point[dim]).chain([1.0]).collect()).collect();
    let boxes = lines.iter().map(Vec::len).product::<usize>();
    let mut worst = 0_f64;
    for number in 0..boxes {
        let mut rest = number;
        let corner: Vec<f64> = lines
            .iter()
            .map(|line| {
                let at = rest % line.len();
                rest /= line.len();
                line[at]
            })
            .collect();
        let volume: f64 = corner.iter().product();
        let open = points.iter().filter(|point| point.iter().zip(&corner).all(|(x, c)| x < c)).count();
        let closed = points.iter().filter(|point| point.iter().zip(&corner).all(|(x, c)| x <= c)).count();
        let n = points.len() as f64;
        worst = worst.max(volume - open as f64 / n).max(closed as f64 / n - volume);
    }
    worst
}

/// Points of one of four kinds: in general position, on a coarse grid with both ends, with duplicates, clustered.
fn case(number: u64, most: usize, dims: usize) -> Vec<f64> {
    let seed = Seed::new(number);
    let uniform = |i: usize| unit_f64(seed.dimension(i as u64).bits64());
    let n = 1 + (unit_f64(seed.bits64()) * most as f64) as usize;
    let one = |i: usize| match number % 4 {
        0 => uniform(i),
        1 => (uniform(i) * 5.0).floor() / 4.0,
        2 => uniform(i % (dims * n.div_ceil(2))),
        _ => uniform(i) * uniform(i + 1000),
    };
    (0..n * dims).map(one).collect()
}

/// 1,200 cases; with ties and duplicates in half of them.
#[test]
fn exact_methods_agree_with_brute_force() {
    let shapes = [(1, 40, 200), (2, 24, 400), (3, 12, 300), (4, 7, 200), (5, 4, 100)];
    let mut cases = 0;
    for (dims, most, count) in shapes {
        for number in 0..count {
            let numbers = case(number + 10_000 * dims as u64, most, dims);
            let wanted = brute_force(&numbers, dims);
            for method in [Method::Auto, Method::Dem, Method::Bracketing] {
                if dims == 1 && method == Method::Dem {
                    continue;
                }
                let effort = Effort { trials: 2, steps: 64 };
                let found = star(&numbers, dims, Settings { effort, ..with(method) });
                assert_eq!(found.kind, Kind::Exact);
                assert!(
                    (found.value - wanted).abs() < 1e-14,
                    "{method:?}, case {number} in {dims} dimensions: {} instead of {wanted}",
                    found.value
                );
                check_box(&numbers, dims, &found);
            }
            cases += 1;
        }
    }
    assert_eq!(cases, 1200);
}

/// The box that is returned has the discrepancy that is returned.
fn check_box(numbers: &[f64], dims: usize, star: &Star) {
    let (rows, corner) = (Rows::new(numbers, dims), Rows::new(&star.worst.corner, dims));
    let local = local_discrepancy(&rows.expect("points"), &corner.expect("a corner"), star.worst.closed);
    let local = local.expect("same dimensions")[0] * if star.worst.closed { 1.0 } else { -1.0 };
    assert!((local - star.worst.value).abs() < 1e-14, "{local} {star:?}");
}

/// Boxes from below, brackets from above; the exact value in between.
#[test]
fn bounds_are_on_their_sides() {
    let mut found = 0;
    for number in 0..40 {
        let dims = 3 + number as usize % 3;
        let numbers = case(number, 60, dims);
        let exact = star(&numbers, dims, with(Method::Dem)).value;
        let lower = star(&numbers, dims, with(Method::ThresholdAccepting));
        let limits = Limits { brackets: 300, width: 0.0 };
        let upper = star(&numbers, dims, Settings { limits, ..with(Method::Bracketing) });
        assert_eq!(lower.kind, Kind::Lower);
        assert!(lower.value <= exact + 1e-14 && upper.value >= exact - 1e-14, "case {number}");
        assert!((upper.worst.value - exact) <= 1e-14);
        check_box(&numbers, dims, &lower);
        // on so few points the walks mostly find the worst box, or one that is nearly as bad
        assert!(lower.value > 0.9 * exact, "case {number}: {} of {exact}", lower.value);
        found += usize::from(lower.value > exact - 1e-12);
    }
    assert!(found >= 30, "{found}");
}

#[test]
fn a_bracket_of_some_width_stops_early_and_holds() {
    let numbers = points("halton", 4, 200);
    let exact = star(&numbers, 4, with(Method::Dem)).value;
    let limits = Limits { width: 0.03, ..Limits::default() };
    let upper = star(&numbers, 4, Settings { limits, ..with(Method::Bracketing) });
    assert_eq!(upper.kind, Kind::Upper);
    assert!(upper.value >= exact && upper.value <= exact + 0.03 && upper.worst.value + 0.03 >= upper.value);
}

fn points(name: &str, dims: usize, n: usize) -> Vec<f64> {
    let spec = Spec::new(dims, Randomization::None, Seed::new(0));
    let mut numbers = vec![0.0; n * dims];
    sequences::build(name, &spec).expect("a sequence").fill(0..n as u64, &mut numbers);
    numbers
}

#[test]
fn known_numbers_of_one_dimension() {
    for (n, wanted) in
        [(3, 1.5), (5, 1.75), (13, 2.125), (21, 2.4375), (43, 2.78125), (85, 3.109375), (171, 3.4453125)]
    {
        let found = star(&points("halton", 1, n), 1, Settings::default()).value;
        assert!((found * n as f64 - wanted).abs() < 1e-12, "n = {n}");
    }
    for k in 0..12 {
        assert!(
            (star(&points("sobol", 1, 1 << k), 1, Settings::default()).value * f64::from(1 << k) - 1.0).abs()
                < 1e-12
        );
    }
}

/// J. Halton and S. Zaremba, *The extreme and L2 discrepancies of some plane sets*, Monatsh. Math. 73, 1969.
#[test]
fn hammersley_points_have_the_discrepancy_of_halton_and_zaremba() {
    for m in 2..15 {
        let n = 1_usize << m;
        let van_der_corput = points("halton", 1, n);
        let numbers: Vec<f64> = (0..n).flat_map(|i| [i as f64 / n as f64, van_der_corput[i]]).collect();
        let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
        let wanted = f64::from(m) / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * n as f64);
        let found = star(&numbers, 2, Settings::default());
        assert!((found.value * n as f64 - wanted).abs() < 1e-9, "m = {m}");
        check_box(&numbers, 2, &found);
    }
}

#[test]
fn grids_lattices_and_single_points() {
    for m in 1..40 {
        let center = |i: usize| (i as f64 + 0.5) / m as f64;
        let numbers: Vec<f64> = (0..m * m).flat_map(|i| [center(i / m), center(i % m)]).collect();
        let m = m as f64;
        assert!((star(&numbers, 2, Settings::default()).value - (1.0 / m - 0.25 / (m * m))).abs() < 1e-12);
    }
    let lattices =
        [(8, 5, 0.234375), (13, 8, 0.165680), (21, 13, 0.108844), (34, 21, 0.0709343), (55, 34, 0.0449587)];
    for (n, previous, wanted) in [&lattices[..], &[(89, 55, 0.0310567), (144, 89, 0.0200617)]].concat() {
        let share = |i: usize| (i % n) as f64 / n as f64;
        let numbers: Vec<f64> = (0..n).flat_map(|i| [share(i), share(i * previous)]).collect();
        assert!((star(&numbers, 2, Settings::default()).value - wanted).abs() < 1e-6, "n = {n}");
    }
    for dims in 1..9 {
        let found = star(&vec![0.5; dims], dims, Settings::default());
        assert_eq!((found.value, found.kind), (1.0 - 0.5_f64.powi(dims as i32), Kind::Exact));
    }
}

/// Values that an independent program found; tolerance: the last digit.
#[test]
fn known_numbers_of_sequences() {
    let known: [(&str, usize, usize, f64, f64); 16] = [
        ("sobol", 2, 16, 0.171875, 1e-6),
        ("sobol", 2, 64, 0.053711, 1e-6),
        ("sobol", 2, 256, 0.014587, 1e-6),
        ("sobol", 2, 1024, 0.0042992, 1e-7),
        ("sobol", 3, 16, 0.217773, 1e-6),
        ("sobol", 3, 32, 0.129883, 1e-6),
        ("sobol", 3, 64, 0.078690, 1e-6),
        ("sobol", 3, 128, 0.047516, 1e-6),
        ("sobol", 4, 16, 0.250122, 1e-6),
        ("sobol", 4, 32, 0.168335, 1e-6),
        ("halton", 2, 16, 0.201389, 1e-6),
        ("halton", 2, 256, 0.018760, 1e-6),
        ("halton", 3, 16, 0.275, 1e-6),
        ("halton", 3, 32, 0.169583, 1e-6),
        ("halton", 3, 64, 0.097042, 1e-6),
        ("halton", 3, 100, 0.0675, 1e-6),
    ];
    for (name, dims, n, wanted, tolerance) in known {
        let found = star(&points(name, dims, n), dims, Settings::default());
        assert_eq!(found.kind, Kind::Exact);
        assert!((found.value - wanted).abs() <= tolerance, "{name}, d = {dims}, n = {n}: {}", found.value);
    }
}

/// The first 125 points of Faure's sequence in base 5: digits of the index times powers of Pascal's matrix.
#[test]
fn known_numbers_of_faure_points() {
    let pascal = [[1, 1, 1], [0, 1, 2], [0, 0, 1]];
    let coordinate = |index: usize, power: u32| {
        let mut digits = [index % 5, index / 5 % 5, index / 25];
        for _ in 0..power {
            digits = std::array::from_fn(|row| (0..3).map(|k| pascal[row][k] * digits[k]).sum::<usize>() % 5);
        }
        digits.iter().rev().fold(0.0, |x, &digit| (x + digit as f64) / 5.0)
    };
    for (dims, wanted, tolerance) in [(2, 0.033792, 1e-6), (3, 0.0521303, 1e-7)] {
        let numbers: Vec<f64> = (0..125)
            .flat_map(|i| (0..dims as u32).map(move |j| (i, j)))
            .map(|(i, j)| coordinate(i, j))
            .collect();
        let found = star(&numbers, dims, with(Method::Dem)).value;
        assert!((found - wanted).abs() <= tolerance, "d = {dims}: {found}");
    }
}

#[test]
fn sweep_and_search_agree_on_many_points() {
    for number in 0..8 {
        let numbers = case(number, 3000, 2);
        let (sweep, dem) = (star(&numbers, 2, with(Method::Sweep)), star(&numbers, 2, with(Method::Dem)));
        assert!((sweep.value - dem.value).abs() < 1e-13, "case {number}");
    }
}

#[test]
fn the_number_of_threads_changes_nothing_and_a_search_can_be_stopped() {
    let numbers = points("halton", 4, 150);
    let alone = star(&numbers, 4, with(Method::Dem));
    for workers in [2, 3, 7].map(|workers| NonZeroUsize::new(workers).expect("not 0")) {
        assert_eq!(star(&numbers, 4, Settings { workers, ..with(Method::Dem) }), alone);
    }
    let rows = Rows::new(&numbers, 4).expect("points");
    let mut parts = Vec::new();
    let stopped = star_discrepancy(&rows, &with(Method::Dem), &mut |part| {
        parts.push(part);
        parts.len() < 3
    });
    assert_eq!(stopped, Ok(None));
    assert!(parts.is_sorted() && parts.len() >= 3 && parts[2] < 1.0, "{parts:?}");
}

#[test]
fn what_cannot_be_done_is_refused() {
    let message = |numbers: &[f64], dims, method| {
        let rows = Rows::new(numbers, dims)?;
        star_discrepancy(&rows, &with(method), &mut |_| true).map(|_| ())
    };
    let said = |result: Result<(), evenlight_points::Error>| result.expect_err("refused").to_string();
    assert_eq!(said(message(&[], 2, Method::Auto)), "0 numbers are no points of 2 dimensions");
    assert_eq!(
        said(message(&[0.5, f64::NAN], 2, Method::Auto)),
        "coordinate 1 of point 0 must be in [0, 1], not NaN"
    );
    assert_eq!(
        said(message(&[0.5; 3], 3, Method::Sweep)),
        "method 'sweep' is for 1 or 2 dimensions, not 3; use 'dem'"
    );
    assert!(said(Method::named("guess").map(|_| ())).contains("known: auto, sweep, dem"));
}
