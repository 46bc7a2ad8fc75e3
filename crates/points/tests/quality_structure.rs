//! Triangles, nets, gain coefficients and boxes anywhere: known numbers, theorems, and definitions tried one by one.

use evenlight_points::Seed;
use evenlight_points::convert::unit_f64;
use evenlight_points::quality::Rows;
use evenlight_points::quality::dispersion::dispersion;
use evenlight_points::quality::extreme::extreme_discrepancy;
use evenlight_points::quality::nets::{gain_coefficient, smallest_t};
use evenlight_points::quality::star::{Settings, star_discrepancy};
use evenlight_points::quality::triangle::{Sets, triangle_discrepancy};
use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Spec};

fn random(seed: u64, numbers: usize) -> Vec<f64> {
    (0..numbers as u64).map(|i| unit_f64(Seed::new(seed).dimension(i).bits64())).collect()
}

fn points(name: &str, dims: usize, n: usize, scramble: Randomization, seed: u64) -> Vec<f64> {
    let mut numbers = vec![0.0; n * dims];
    let spec = Spec::new(dims, scramble, Seed::new(seed));
    sequences::build(name, &spec).expect("a sequence").fill(0..n as u64, &mut numbers);
    numbers
}

/// The triangular van der Corput points of Basu and Owen by their definition: corners replaced digit by digit.
fn triangular_van_der_corput(index: u32) -> [f64; 3] {
    let middle = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| 0.5 * (a[i] + b[i]));
    let [mut a, mut b, mut c] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut rest = index;
    while rest > 0 {
        (a, b, c) = match rest % 4 {
            0 => (middle(b, c), middle(a, c), middle(a, b)),
            1 => (a, middle(a, b), middle(a, c)),
            2 => (middle(a, b), b, middle(b, c)),
            _ => (middle(a, c), middle(b, c), c),
        };
        rest /= 4;
    }
    std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3.0)
}

fn parallelograms(points: &[[f64; 3]]) -> f64 {
    triangle_discrepancy(points, Sets::Parallelograms).expect("points of the triangle").worst.value
}

/// 2 / (3 √n) − 1 / (9 n) at n = 4^k, far inside the theorem's 2 / √n − 1 / n.
#[test]
fn triangular_van_der_corput_points_have_their_discrepancy() {
    let all: Vec<_> = (0..1 << 14).map(triangular_van_der_corput).collect();
    assert!((parallelograms(&all[..1]) - 7.0 / 9.0).abs() < 1e-12);
    for k in 1..8 {
        let n = 1 << (2 * k);
        let wanted = 2.0 / (3.0 * (n as f64).sqrt()) - 1.0 / (9.0 * n as f64);
        assert!((parallelograms(&all[..n]) - wanted).abs() < 1e-9, "n = {n}");
    }
    for (n, wanted) in [(10, 0.305556), (100, 0.088611), (1000, 0.027163)] {
        assert!((parallelograms(&all[..n]) - wanted).abs() < 1e-6, "n = {n}");
    }
    for n in 1..300 {
        assert!(parallelograms(&all[..n]) <= 1.1 / (n as f64).sqrt(), "n = {n}");
    }
}

/// Both families by their definition: areas by formula, every s and t at a coordinate or at 1.
fn sets_by_definition(points: &[[f64; 3]], sets: Sets) -> f64 {
    let mut worst = 0_f64;
    for v in 0..3 {
        for p in (0..3).filter(|&p| p != v) {
            let q = 3 - v - p;
            let seen = |point: &[f64; 3]| match sets {
                Sets::Parallelograms => (point[p], point[q]),
                Sets::Trapezoids => (point[p], 1.0 - point[v]),
            };
            let area = |s: f64, t: f64| match sets {
                Sets::Parallelograms if s + t <= 1.0 => 2.0 * s * t,
                Sets::Parallelograms => 1.0 - (1.0 - s).powi(2) - (1.0 - t).powi(2),
                Sets::Trapezoids if s >= t => t * t,
                Sets::Trapezoids => s * (2.0 * t - s),
            };
            let seen: Vec<_> = points.iter().map(seen).collect();
            for s in seen.iter().map(|point| point.0).chain([1.0]) {
                for t in seen.iter().map(|point| point.1).chain([1.0]) {
                    let share = |inside: &dyn Fn(f64, f64) -> bool| {
                        seen.iter().filter(|point| inside(point.0, point.1)).count() as f64
                            / seen.len() as f64
                    };
                    worst = worst.max(area(s, t) - share(&|x, y| x < s - 1e-13 && y < t - 1e-13));
                    worst = worst.max(share(&|x, y| x <= s + 1e-13 && y <= t + 1e-13) - area(s, t));
                }
            }
        }
    }
    worst
}

#[test]
fn triangle_discrepancies_are_those_of_their_definition() {
    for case in 0..300_u64 {
        let n = 1 + case as usize % 25;
        let coordinates = random(case, 2 * n);
        let point = |u: &[f64]| {
            let u = if case % 3 == 0 {
                [(u[0] * 5.0).floor() / 4.0, (u[1] * 5.0).floor() / 4.0]
            } else {
                [u[0], u[1]]
            };
            let root = u[0].sqrt();
            [1.0 - root, root * (1.0 - u[1]), root * u[1]]
        };
        let found: Vec<_> = coordinates.chunks(2).map(point).collect();
        for sets in [Sets::Parallelograms, Sets::Trapezoids] {
            let (value, wanted) = (
                triangle_discrepancy(&found, sets).expect("points of the triangle").worst.value,
                sets_by_definition(&found, sets),
            );
            assert!((value - wanted).abs() < 1e-12, "case {case}, {sets:?}: {value} {wanted}");
        }
    }
    let outside =
        triangle_discrepancy(&[[0.5, 0.6, -0.1]], Sets::Trapezoids).expect_err("refused").to_string();
    assert!(outside.contains("point 0 is not in the triangle"), "{outside}");
}

/// Quality of the first 2^m Sobol' points with the directions of Joe and Kuo, m = 1, 2, …
#[test]
fn counting_finds_the_t_of_sobol_points() {
    let known: [(usize, &[u32]); 6] = [
        (2, &[0, 0, 0, 0, 0, 0, 0, 0]),
        (3, &[0, 1, 1, 1, 1, 1, 1, 1, 1]),
        (4, &[0, 1, 2, 2, 2, 2, 2, 3, 3]),
        (5, &[0, 1, 2, 2, 2, 3, 3, 3]),
        (6, &[0, 1, 2, 3, 2, 3, 3, 4]),
        (7, &[0, 1, 2, 3, 2, 3, 3, 4]),
    ];
    for (dims, wanted) in known {
        for (m, &t) in (1..).zip(wanted) {
            for scramble in [Randomization::None, Randomization::Owen] {
                let numbers = points("sobol", dims, 1 << m, scramble, 3);
                assert_eq!(
                    smallest_t(&Rows::new(&numbers, dims).expect("points"), 2),
                    Ok(t),
                    "m = {m}, s = {dims}"
                );
            }
        }
    }
}

/// Faure's points in base 5 by Pascal's matrix, the first 125 of them: a (0, 3, 5)-net.
fn faure() -> Vec<f64> {
    let pascal = [[1, 1, 1], [0, 1, 2], [0, 0, 1]];
    let mut numbers = Vec::new();
    for index in 0..125_usize {
        let mut digits = [index % 5, index / 5 % 5, index / 25];
        for _ in 0..5 {
            numbers.push((digits[0] * 25 + digits[1] * 5 + digits[2]) as f64 / 125.0);
            digits = std::array::from_fn(|row| (0..3).map(|k| pascal[row][k] * digits[k]).sum::<usize>() % 5);
        }
    }
    numbers
}

#[test]
fn counting_works_in_other_bases_and_refuses_other_counts() {
    let numbers = faure();
    assert_eq!(smallest_t(&Rows::new(&numbers, 5).expect("points"), 5), Ok(0));
    // three coordinates of one point moved within their fifths: no longer even at the finer levels
    let mut moved = numbers.clone();
    moved[5] = numbers[5] + 0.04;
    assert!(smallest_t(&Rows::new(&moved, 5).expect("points"), 5).is_ok_and(|t| t > 0));
    let message = smallest_t(&Rows::new(&numbers, 5).expect("points"), 2).expect_err("refused").to_string();
    assert_eq!(message, "a net in base 2 has a power of 2 of points, not 125");
}

/// The sum over pairs by its definition.
fn gain_by_definition(numbers: &[f64], dims: usize, levels: &[Option<u32>], base: f64) -> f64 {
    let cell = |x: f64, level: u32| (x * base.powi(level as i32) + 1e-9).floor();
    let mut sum = 0.0;
    for x in numbers.chunks(dims) {
        for y in numbers.chunks(dims) {
            let mut product = 1.0;
            for (dim, level) in levels.iter().enumerate() {
                if let Some(k) = *level {
                    let same = |level| f64::from(u8::from(cell(x[dim], level) == cell(y[dim], level)));
                    product *= base * same(k + 1) - same(k);
                }
            }
            sum += product;
        }
    }
    let size = levels.iter().flatten().count() as i32;
    sum / ((numbers.len() / dims) as f64 * (base - 1.0).powi(size))
}

#[test]
fn gain_coefficients_are_those_of_their_definition() {
    for case in 0..60_u64 {
        let (dims, base) = (1 + case as usize % 3, [2, 3, 5][case as usize % 3]);
        let numbers = random(case, dims * 40);
        let level = |j: u64| (case + j).is_multiple_of(4).then_some((case as u32 + 2 * j as u32) % 3);
        let mut levels: Vec<_> = (1..=dims as u64).map(level).collect();
        levels[0] = levels[0].or(Some(1));
        let found = gain_coefficient(&Rows::new(&numbers, dims).expect("points"), &levels, base);
        let wanted = gain_by_definition(&numbers, dims, &levels, f64::from(base));
        assert!((found.expect("legal levels") - wanted).abs() < 1e-9, "case {case}, {levels:?}");
    }
}

/// Z. Pan and A. Owen, *The nonzero gain coefficients of Sobol's sequences are always powers of two*, J. Complexity 75, 2023: 0 or
/// a power of two of at most 2^{t + |u| − 1}, and 0 where |u| + Σ k ≤ m − t.
#[test]
fn gains_of_sobol_points_are_powers_of_two() {
    let mut largest = 0.0_f64;
    for (dims, m) in (1..=5).flat_map(|dims| (1..=5).map(move |m| (dims, m))) {
        largest = largest.max(largest_gain(dims, m));
    }
    assert_eq!(largest, 16.0);
}

/// The largest gain of all vectors of levels up to m, each of them checked.
fn largest_gain(dims: usize, m: u32) -> f64 {
    let numbers = points("sobol", dims, 1 << m, Randomization::None, 0);
    let rows = Rows::new(&numbers, dims).expect("points");
    let t = smallest_t(&rows, 2).expect("a net");
    let mut largest = 0.0_f64;
    let choices = m + 2;
    for code in 1..choices.pow(dims as u32) {
        let digit = |dim| code / choices.pow(dim) % choices;
        let levels: Vec<Option<u32>> = (0..dims as u32).map(|dim| digit(dim).checked_sub(1)).collect();
        let gain = gain_coefficient(&rows, &levels, 2).expect("legal levels");
        let size = levels.iter().flatten().count() as u32;
        if size + levels.iter().flatten().sum::<u32>() <= m - t {
            assert_eq!(gain, 0.0, "{levels:?}");
        }
        assert!(
            gain == 0.0 || gain.log2().fract() == 0.0 && gain <= 2_f64.powi((t + size) as i32 - 1),
            "{levels:?}"
        );
        largest = largest.max(gain);
    }
    largest
}

/// All boxes between coordinates of points, 0 and 1.
fn boxes(numbers: &[f64], dims: usize, mut visit: impl FnMut(&[[f64; 2]])) {
    let lines: Vec<Vec<f64>> = (0..dims)
        .map(|dim| numbers.chunks(dims).map(|point| point[dim]).chain([0.0, 1.0]).collect())
        .collect();
    let pairs: Vec<Vec<[f64; 2]>> = lines
        .iter()
        .map(|line| {
            line.iter().flat_map(|&a| line.iter().map(move |&b| [a, b])).filter(|[a, b]| a <= b).collect()
        })
        .collect();
    for mut number in 0..pairs.iter().map(Vec::len).product::<usize>() {
        let sides: Vec<[f64; 2]> = pairs
            .iter()
            .map(|pairs| {
                let at = number % pairs.len();
                number /= pairs.len();
                pairs[at]
            })
            .collect();
        visit(&sides);
    }
}

#[test]
fn boxes_anywhere_are_as_bad_as_trying_all_of_them_says() {
    for case in 0..120_u64 {
        let dims = 1 + case as usize % 3;
        let n = 1 + case as usize % [30, 12, 5][dims - 1];
        let mut numbers = random(case, n * dims);
        if case % 2 == 0 {
            numbers = numbers.iter().map(|x| (x * 4.0).floor() / 3.0).collect();
        }
        let (mut worst, mut largest_empty) = (0_f64, 0_f64);
        boxes(&numbers, dims, |sides| {
            let volume: f64 = sides.iter().map(|[a, b]| b - a).product();
            let share = |closed: bool| {
                let inside = |point: &&[f64]| {
                    point
                        .iter()
                        .zip(sides)
                        .all(|(x, [a, b])| if closed { a <= x && x <= b } else { a < x && x < b })
                };
                numbers.chunks(dims).filter(inside).count() as f64 / n as f64
            };
            worst = worst.max(volume - share(false)).max(share(true) - volume);
            if share(false) == 0.0 {
                largest_empty = largest_empty.max(volume);
            }
        });
        let rows = Rows::new(&numbers, dims).expect("points");
        let (extreme, empty) =
            (extreme_discrepancy(&rows), dispersion(&rows, false, 100_000).expect("few boxes"));
        assert!((extreme.value - worst).abs() < 1e-14, "case {case}: {} {worst}", extreme.value);
        assert!(
            (empty.volume - largest_empty).abs() < 1e-14,
            "case {case}: {} {largest_empty}",
            empty.volume
        );
        let star =
            star_discrepancy(&rows, &Settings::default(), &mut |_| true).expect("legal").expect("an answer");
        assert!(
            star.value <= extreme.value + 1e-14
                && extreme.value <= 2_f64.powi(dims as i32) * star.value + 1e-14
        );
    }
}

/// The largest empty box of the torus by its definition: sides from any coordinate to any other, or all around.
fn largest_empty_on_torus(numbers: &[f64], dims: usize) -> f64 {
    let sides: Vec<Vec<[f64; 2]>> = (0..dims)
        .map(|dim| {
            let line: Vec<f64> = numbers.chunks(dims).map(|point| point[dim] % 1.0).collect();
            let pair = |&a: &f64| line.iter().map(move |&b| [a, if b > a { b } else { b + 1.0 }]);
            line.iter().flat_map(pair).chain([[-1.0, 2.0]]).collect()
        })
        .collect();
    let mut largest = 0.0_f64;
    for mut number in 0..sides.iter().map(Vec::len).product::<usize>() {
        let take = |sides: &Vec<[f64; 2]>| {
            let at = number % sides.len();
            number /= sides.len();
            sides[at]
        };
        let chosen: Vec<_> = sides.iter().map(take).collect();
        let inside = |point: &[f64]| {
            let within = |(x, [a, b]): (&f64, &[f64; 2])| {
                let x = x % 1.0;
                a < &x && &x < b || a < &(x + 1.0) && &(x + 1.0) < b
            };
            point.iter().zip(&chosen).all(within)
        };
        if !numbers.chunks(dims).any(inside) {
            largest = largest.max(chosen.iter().map(|[a, b]| (b - a).min(1.0)).product());
        }
    }
    largest
}

#[test]
fn empty_boxes_of_the_torus_are_as_large_as_trying_all_of_them_says() {
    for case in 0..90_u64 {
        let dims = 1 + case as usize % 3;
        let n = 1 + case as usize % [30, 12, 6][dims - 1];
        let mut numbers = random(case, n * dims);
        if case % 2 == 0 {
            numbers = numbers.iter().map(|x| (x * 4.0).floor() / 3.0).collect();
        }
        let rows = Rows::new(&numbers, dims).expect("points");
        let found = dispersion(&rows, true, 100_000).expect("few boxes");
        let wanted = largest_empty_on_torus(&numbers, dims);
        assert!((found.volume - wanted).abs() < 1e-14, "case {case}: {} {wanted}", found.volume);
        let inside = dispersion(&rows, false, 100_000).expect("few boxes").volume;
        assert!(inside <= found.volume + 1e-14);
        let sides = found.lower.iter().zip(&found.upper);
        assert!((sides.map(|(a, b)| b - a).product::<f64>() - found.volume).abs() < 1e-14);
    }
}

#[test]
fn a_search_for_empty_boxes_that_would_be_too_long_is_refused() {
    let numbers = points("halton", 2, 500, Randomization::None, 0);
    let message =
        dispersion(&Rows::new(&numbers, 2).expect("points"), false, 100).expect_err("refused").to_string();
    assert!(message.starts_with("more than 100 boxes"), "{message}");
}
