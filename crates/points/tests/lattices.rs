//! Lattices: the points are those of the definitions, and integrate as theory says.

use evenlight_points::construction::{self, korobov};
use evenlight_points::quality::lattice_criteria::{Space, squared_error, squared_error_of_net};
use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Options, Spec, kronecker, lattice, polynomial_lattice};
use evenlight_points::{PointSet, Seed};

fn build(name: &str, dims: usize, randomization: Randomization, options: Options) -> Box<dyn PointSet> {
    let spec = Spec { options, ..Spec::new(dims, randomization, Seed::new(1)) };
    sequences::build(name, &spec).expect("legal")
}

fn plain(name: &str, dims: usize, options: Options) -> Box<dyn PointSet> {
    build(name, dims, Randomization::None, options)
}

fn counted(n: u64) -> Options {
    Options { n: Some(n), ..Options::default() }
}

fn generated(n: Option<u64>, generator: &[u64]) -> Options {
    Options { n, generator: Some(generator.into()), ..Options::default() }
}

/// The coordinate in units of 2^-53.
fn units(x: f64) -> u64 {
    (x * 2f64.powi(53)) as u64
}

/// {i z / n} by the product of whole numbers: the 53 digits are those of the quotient, or one more in the last place.
#[test]
fn points_in_natural_order_are_exact_whatever_the_index() {
    for n in [1, 2, 3, 21, 1021, 1 << 20, 999_999_937, (1 << 47) - 115, 1 << 48] {
        let z = [1, 5, n - 1, 0x1234_5678_9abc_def1].map(|z| if korobov::coprime(z, n) { z } else { 1 });
        let points = plain("lattice", 4, generated(Some(n), &z));
        assert_eq!(points.len(), Some(n));
        for index in [0, 1, 2, n / 3, n / 2, n - 1].into_iter().filter(|&index| index < n) {
            for (dim, z) in z.into_iter().enumerate() {
                let residue = u128::from(index) * u128::from(z) % u128::from(n);
                let (quotient, rest) = ((residue << 53) / u128::from(n), (residue << 53) % u128::from(n));
                let above = u128::from(units(points.coord(index, dim))) - quotient;
                assert!(above == 0 || above == 1 && rest > 0, "{index} of {n}, dimension {dim}: {above}");
            }
        }
    }
}

#[test]
fn a_prefix_of_the_sequence_is_the_lattice_of_so_many_points() {
    for m in [0, 1, 5, 10] {
        let n = 1 << m;
        let sequence = plain("lattice", 6, Options::default());
        let finite = plain("lattice", 6, counted(n));
        let rows = |points: &dyn PointSet| {
            let row = |i| (0..6).map(|dim| units(points.coord(i, dim))).collect::<Vec<_>>();
            let mut rows: Vec<_> = (0..n).map(row).collect();
            rows.sort_unstable();
            rows
        };
        assert_eq!(rows(&*sequence), rows(&*finite), "2^{m}");
    }
}

#[test]
fn the_last_points_of_a_sequence_are_as_exact_as_the_first() {
    let alphas = kronecker::golden_ratios(3);
    let points = plain("kronecker", 3, Options::default());
    for index in [0, 1, 12_345, (1 << 53) + 1, u64::MAX] {
        for (dim, alpha) in alphas.iter().enumerate() {
            let exact = (alpha.wrapping_mul(u128::from(index)) >> 75) as u64;
            assert!(units(points.coord(index, dim)) - exact <= 1, "{index}, dimension {dim}");
        }
    }
    let points = plain("lattice", 2, generated(None, &[1, 0xdead_beef_1234_5677]));
    for index in [1, 3 << 40, u64::MAX] {
        let exact = index.reverse_bits().wrapping_mul(0xdead_beef_1234_5677) >> 11;
        assert_eq!(units(points.coord(index, 1)), exact);
    }
}

/// D* of any points of the plane: the largest difference over the corners of the grid that their coordinates make.
fn star_discrepancy(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let ends = |axis: usize| points.iter().map(move |point| point[axis]).chain([1.0]);
    let mut worst = 0.0_f64;
    for x in ends(0) {
        for y in ends(1) {
            let inside = |[a, b]: &&[f64; 2], closed: bool| {
                if closed { *a <= x && *b <= y } else { *a < x && *b < y }
            };
            let count = |closed| points.iter().filter(|point| inside(point, closed)).count() as f64 / n;
            worst = worst.max(count(true) - x * y).max(x * y - count(false));
        }
    }
    worst
}

/// Known discrepancies, computed independently by exact arithmetic.
#[test]
fn fibonacci_lattices_have_their_known_discrepancies() {
    for (n, known) in
        [(8, 0.234_375), (13, 0.165_680), (21, 0.108_844), (55, 0.044_958_7), (144, 0.020_061_7)]
    {
        let lattice = plain("fibonacci", 2, counted(n));
        let points: Vec<_> = (0..n).map(|i| [lattice.coord(i, 0), lattice.coord(i, 1)]).collect();
        assert!((star_discrepancy(&points) - known).abs() < 1e-6, "{n}: {}", star_discrepancy(&points));
    }
}

#[test]
fn korobov_points_are_powers_of_one_number() {
    let points = plain("korobov", 5, generated(Some(1021), &[76]));
    for (index, dim) in [(1, 0), (1, 3), (700, 4)] {
        let residue = (0..dim).fold(index, |residue, _| residue * 76 % 1021);
        assert!((points.coord(index, dim) - residue as f64 / 1021.0).abs() < 1e-15);
    }
}

#[test]
fn polynomial_lattices_are_products_of_polynomials() {
    let points = plain("polynomial_lattice", 4, Options::default());
    for (index, dim) in [(1_u64, 0), (6, 1), (777, 2), ((1 << 40) + 9, 3)] {
        let q = polynomial_lattice::default_polynomial(dim);
        let product = (0..64).filter(|k| index.reverse_bits() >> k & 1 == 1).fold(0, |sum, k| sum ^ (q << k));
        assert_eq!(units(points.coord(index, dim)), product >> 11);
    }
}

#[test]
fn refusals_name_what_is_allowed() {
    let refusal = |name: &str, options| {
        let spec = Spec { options, ..Spec::new(2, Randomization::Shift, Seed::new(0)) };
        sequences::build(name, &spec).err().expect("refused").to_string()
    };
    assert!(refusal("fibonacci", counted(100)).ends_with("a Fibonacci number, such as 89 or 144, not 100"));
    assert!(refusal("lattice", counted(1000)).ends_with("is given, such as 512 or 1024, not 1000"));
    assert!(refusal("lattice", generated(None, &[1, 4])).ends_with("odd numbers if n is not given, not 4"));
    assert!(refusal("lattice", generated(Some(9), &[1, 6])).ends_with("in common with n = 9, not 6"));
    assert!(refusal("lattice", generated(None, &[1])).ends_with("must be 2 numbers, not 1 numbers"));
    assert!(refusal("polynomial_lattice", generated(None, &[1, 2])).ends_with("with a constant term, not 2"));
    assert!(refusal("korobov", generated(Some(9), &[3])).ends_with("in common with n, not 3"));
    assert!(refusal("korobov", counted(1 << 21)).contains("must be given if n is above 1048576"));
    assert!(refusal("kronecker", generated(None, &[1])).ends_with("must be 2 numbers, not 1 numbers"));
}

/// The root mean squared error of a mean over 2^m points and 64 replicates.
fn rmse(randomization: Randomization, m: u32, f: impl Fn(&[f64]) -> f64, truth: f64) -> f64 {
    let (n, dims) = (1_usize << m, 4);
    let points = build("lattice", dims, randomization, Options::default());
    let mut rows = vec![0.0; n * dims];
    let squares = (0..64).map(|r| {
        points.reseeded(Seed::new(3).replicate(r)).fill(0..n as u64, &mut rows);
        (rows.chunks_exact(dims).map(&f).sum::<f64>() / n as f64 - truth).powi(2)
    });
    (squares.sum::<f64>() / 64.0).sqrt()
}

/// Slopes between 2^6 and 2^14 points of Π (1 + (e^x − e + 1) / (2 j²)), smooth and not periodic. An error of 64
/// replicates is known to 10 %, a slope over 8 doublings to 0.03; theory gives −1 and −2 up to powers of log n.
#[test]
fn the_tent_doubles_the_rate_for_smooth_integrands() {
    let f = |x: &[f64]| -> f64 {
        (1..)
            .zip(x)
            .map(|(j, x)| 1.0 + (x.exp() - std::f64::consts::E + 1.0) / f64::from(2 * j * j))
            .product()
    };
    let slope =
        |randomization| (rmse(randomization, 14, f, 1.0) / rmse(randomization, 6, f, 1.0)).log2() / 8.0;
    let (shifted, folded) = (slope(Randomization::Shift), slope(Randomization::ShiftTent));
    assert!((-1.15..-0.8).contains(&shifted), "{shifted}");
    assert!((-2.3..-1.6).contains(&folded), "{folded}");
}

/// Words that are spread evenly stay so: 2^14 of them, 256 in each of 64 bins.
#[test]
fn the_tent_keeps_the_uniform_distribution() {
    let apply = Randomization::ShiftTent.entry().apply;
    let mut counts = [0_u32; 64];
    (0..1_u64 << 14).for_each(|i| counts[(apply(i << 50, Seed::new(5)) >> 58) as usize] += 1);
    assert!(counts.iter().all(|count| count.abs_diff(256) <= 1), "{counts:?}");
}

/// Further digits of the default vector are random: 4 to 16 times as many points as were looked at in its construction
/// are far better than with zeros.
#[test]
fn the_default_vector_goes_on_beyond_its_construction() {
    let weights: Vec<_> = (1..=5).map(|j| 1.0 / f64::from(j * j)).collect();
    let error = |numbers: &dyn Fn(usize) -> u64, n| {
        let z: Vec<_> = (0..5).map(numbers).collect();
        squared_error(&z, n, &weights, Space::Sobolev).expect("valid")
    };
    let (designed, n) = (error(&lattice::default_number, 1 << 20), 1 << 22);
    let beyond = error(&lattice::default_number, n);
    assert!(beyond < designed / 4.0, "{beyond:e} after {designed:e}");
}

/// Among nets, in the criterion of digital shifts: a polynomial lattice for one number of points is better than Sobol', one
/// for all numbers of points not much worse.
#[test]
fn polynomial_lattices_are_good_in_their_criterion() {
    let (m, dims) = (10, 100);
    let weights: Vec<_> = (1..=dims).map(|j| 1.0 / (j * j) as f64).collect();
    let error = |name: &str, options| {
        let points = plain(name, dims, options);
        let mut rows = vec![0.0; dims << m];
        points.fill(0..1 << m, &mut rows);
        squared_error_of_net(&rows, &weights).expect("valid")
    };
    let constructed = construction::polynomial_lattice(1 << m, None, &weights).expect("valid");
    let fixed = error("polynomial_lattice", generated(None, &constructed));
    let [default, sobol] = ["polynomial_lattice", "sobol"].map(|name| error(name, Options::default()));
    assert!(fixed < 0.8 * sobol, "{fixed:e}, Sobol' {sobol:e}");
    assert!(default < 1.7 * fixed, "{default:e}, {fixed:e}");
}
