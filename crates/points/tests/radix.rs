//! Sequences in any base: their definitions, nets that stay nets, variances that theory gives.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Options, Spec};
use evenlight_points::{PointSet, Seed};

/// All that keep nets.
const NESTED: [&str; 8] = [
    "none",
    "owen",
    "owen_exact",
    "linear",
    "linear_striped",
    "linear_i_binomial",
    "digital_shift",
    "digit_permutation",
];

fn try_build(
    name: &str,
    dims: usize,
    scramble: &str,
    base: Option<u32>,
) -> Result<Box<dyn PointSet>, String> {
    let options = Options { base, n: (name == "hammersley").then_some(512), ..Options::default() };
    let randomization = Randomization::named(scramble).expect("known");
    let spec = Spec { options, ..Spec::new(dims, randomization, Seed::new(5)) };
    sequences::build(name, &spec).map_err(|error| error.to_string())
}

fn build(name: &str, dims: usize, scramble: &str, base: u32) -> Box<dyn PointSet> {
    let takes_base = !["halton", "hammersley"].contains(&name);
    try_build(name, dims, scramble, takes_base.then_some(base)).expect("valid")
}

/// The digits of an index, the least significant first.
fn digits(mut index: u64, base: u64) -> Vec<u64> {
    let mut digits = Vec::new();
    while index > 0 {
        digits.push(index % base);
        index /= base;
    }
    digits
}

/// Digits after the point as a number, from the last to the first so that nothing is lost.
fn after_the_point(digits: &[u64], base: u64) -> f64 {
    digits.iter().rev().fold(0.0, |value, &digit| (value + digit as f64) / base as f64)
}

const INDICES: [u64; 9] = [0, 1, 5, 1000, 4095, 4096, 123_456_789, (1 << 40) + 7, u64::MAX];

#[test]
fn radical_inverses_are_those_of_the_definition() {
    for base in [2, 3, 4, 6, 10, 67, 4093, 4099, 65_536] {
        let points = build("van_der_corput", 1, "none", base);
        for index in INDICES {
            let (found, expected) =
                (points.coord(index, 0), after_the_point(&digits(index, base.into()), base.into()));
            assert!((found - expected).abs() < 4e-16, "base {base}, {index}: {found}, not {expected}");
        }
    }
    let halton = build("halton", 600, "none", 0);
    for (dim, base) in [(0, 2), (1, 3), (2, 5), (63, 311), (599, 4409)] {
        for index in INDICES {
            let expected = after_the_point(&digits(index, base), base);
            assert!((halton.coord(index, dim) - expected).abs() < 4e-16, "base {base}, {index}");
        }
    }
}

/// H. Faure (1982): the digits of coordinate j + 1 are sums of binomial coefficients times those of coordinate j.
#[test]
fn faure_points_are_those_of_the_definition() {
    for (base, dims) in [(2, 2), (3, 3), (5, 5), (7, 4), (67, 64)] {
        let points = build("faure", dims, "none", base);
        let base = u64::from(base);
        for index in INDICES {
            let mut digits = digits(index, base);
            for dim in 0..dims {
                let expected = after_the_point(&digits, base);
                let found = points.coord(index, dim);
                assert!((found - expected).abs() < 4e-16, "base {base}, dimension {dim}, {index}: {found}");
                let next = (0..digits.len()).map(|row| {
                    let mut binomial = 1_u128; // (column over row), exact in 128 bits
                    let terms = (row..digits.len()).map(|column| {
                        if column > row {
                            binomial = binomial * column as u128 / (column - row) as u128;
                        }
                        (binomial % u128::from(base)) as u64 * digits[column]
                    });
                    terms.sum::<u64>() % base
                });
                digits = next.collect();
            }
        }
    }
    let points = build("faure", 5, "none", 5);
    for (index, row) in [(1, [0.2; 5]), (5, [0.04, 0.24, 0.44, 0.64, 0.84])] {
        assert!((0..5).all(|dim| (points.coord(index, dim) - row[dim]).abs() < 1e-15));
    }
    let points = try_build("faure", 6, "none", None).expect("valid");
    assert_eq!(points.base(), Some(7));
}

/// All ways to write `sum` as an ordered sum of `parts` numbers from 0 on.
fn compositions(sum: u32, parts: usize) -> Vec<Vec<u32>> {
    if parts == 1 {
        return vec![vec![sum]];
    }
    let rest = |first| {
        compositions(sum - first, parts - 1).into_iter().map(move |rest| [vec![first], rest].concat())
    };
    (0..=sum).flat_map(rest).collect()
}

/// Whether each interval of volume base^(t − m) holds base^t of the base^m points from index `block * base^m` on.
fn is_net(points: &dyn PointSet, base: u64, [m, t]: [u32; 2], block: u64) -> bool {
    let n = base.pow(m);
    let mut rows = vec![0.0; n as usize * points.dims()];
    points.fill(block * n..(block + 1) * n, &mut rows);
    compositions(m - t, points.dims()).iter().all(|depths| {
        let mut counts = vec![0; base.pow(m - t) as usize];
        for row in rows.chunks_exact(points.dims()) {
            let cell = row.iter().zip(depths).fold(0, |cell, (x, &depth)| {
                let cells = base.pow(depth);
                // points that are not random lie on the edges of cells, cut off below them
                cell * cells + (x * cells as f64 + 1e-9) as u64
            });
            counts[cell as usize] += 1;
        }
        counts.iter().all(|&count| count == base.pow(t))
    })
}

#[test]
fn nets_stay_nets_under_all_nested_scrambles() {
    // The t of Niederreiter's is the sum of degrees less 1: x, x + 1, x + 2, x² + 1 in base 3.
    let nets: [(&str, usize, u32, [u32; 2]); 9] = [
        ("faure", 5, 5, [3, 0]),
        ("faure", 2, 2, [8, 0]),
        ("faure", 3, 3, [5, 0]),
        ("faure", 3, 7, [3, 0]),
        ("niederreiter", 2, 2, [8, 0]),
        ("niederreiter", 3, 2, [7, 1]),
        ("niederreiter", 3, 3, [5, 0]),
        ("niederreiter", 4, 3, [5, 1]),
        ("niederreiter", 5, 5, [3, 0]),
    ];
    for (name, dims, base, quality) in nets {
        for scramble in NESTED {
            let points = build(name, dims, scramble, base);
            assert_eq!(points.base(), Some(base.into()));
            for block in [0, 1, 30, 1 << 20] {
                assert!(
                    is_net(&*points, base.into(), quality, block),
                    "{name}, base {base}, {scramble}, {block}"
                );
            }
        }
    }
}

/// An axis of a sequence, alone.
struct Axis(Box<dyn PointSet>, usize);

impl PointSet for Axis {
    fn dims(&self) -> usize {
        1
    }
    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self(self.0.reseeded(seed), self.1))
    }
    fn coord(&self, index: u64, _: usize) -> f64 {
        self.0.coord(index, self.1)
    }
}

#[test]
fn single_coordinates_are_as_even_as_they_can_be() {
    for scramble in NESTED {
        for (dim, base) in (0..).zip([2, 3, 5, 7, 11, 13, 17]) {
            let points = Axis(build("halton", 7, scramble, 0), dim);
            assert!([0, 1, 1000].into_iter().all(|block| is_net(&points, base, [3, 0], block)), "{scramble}");
        }
        let points = Axis(build("hammersley", 2, scramble, 0), 0);
        assert!(is_net(&points, 2, [9, 0], 0), "{scramble}");
    }
    assert!(NESTED.iter().all(|scramble| is_net(&*build("hammersley", 2, scramble, 0), 2, [9, 0], 0)));
    for scramble in NESTED.into_iter().filter(|scramble| !scramble.starts_with("linear")) {
        for base in [4, 6, 10, 12] {
            let points = build("van_der_corput", 1, scramble, base);
            assert!(
                [0, 1, 1000].into_iter().all(|block| is_net(&*points, base.into(), [3, 0], block)),
                "{base}"
            );
        }
    }
}

/// The mean over seeds of the squared error of the mean of `f` over the first `n` rows, and its standard error.
fn squared_error(points: &dyn PointSet, n: u64, f: fn(&[f64]) -> f64, truth: f64, seeds: u64) -> [f64; 2] {
    let mut rows = vec![0.0; n as usize * points.dims()];
    let (mut sum, mut squares) = (0.0, 0.0);
    for seed in (0..seeds).map(|r| Seed::new(n).replicate(r)) {
        points.reseeded(seed).fill(0..n, &mut rows);
        let error = rows.chunks_exact(points.dims()).map(f).sum::<f64>() / n as f64 - truth;
        sum += error * error;
        squares += error.powi(4);
    }
    let mean = sum / seeds as f64;
    [mean, ((squares / seeds as f64 - mean * mean) / seeds as f64).sqrt()]
}

/// Stratification alone decides in one dimension: 12 n³ Var = 1 for a nested scramble of n = b^m points, in any base, since each
/// point is uniform in a cell of its own and pairs of points are uncorrelated there. One shift of all points that is uniform
/// in a cell leaves 12 n² Var = 1.
#[test]
fn every_randomization_has_its_exact_variance_in_one_dimension() {
    let known = [
        ("owen", 3),
        ("owen_exact", 3),
        ("linear", 3),
        ("linear_i_binomial", 3),
        ("digital_shift", 2),
        ("digit_permutation", 2),
        ("shift", 2),
    ];
    for (scramble, power) in known {
        for (base, m) in [(3, 1), (3, 3), (5, 2), (11, 1), (10, 1), (6, 2)] {
            if scramble.starts_with("linear") && [6, 10].contains(&base) {
                continue;
            }
            let n = u64::from(base).pow(m);
            let points = build("van_der_corput", 1, scramble, base);
            let errors = squared_error(&*points, n, |x| x[0], 0.5, 10_000);
            let [ratio, deviation] = errors.map(|error| error * 12.0 * (n as f64).powi(power));
            // five standard errors: one false alarm in 1.7 million, and there are forty of these
            assert!((ratio - 1.0).abs() < 5.0 * deviation, "{scramble}, {n} points: {ratio} ± {deviation}");
        }
    }
}

/// The last cells are balanced digit by digit, so that the errors of f(x) = x cancel.
#[test]
fn the_striped_scramble_is_exact_for_the_mean_of_x() {
    for (base, n) in [(3, 27), (5, 25), (11, 11)] {
        let points = build("van_der_corput", 1, "linear_striped", base);
        assert!(squared_error(&*points, n, |x| x[0], 0.5, 50)[0].sqrt() < 1e-15);
    }
}

/// For f(x, y) = xy and n = b^m points of a (0, m, 2)-net, from A. B. Owen's formula (1997): the main effects leave 1 / (24 n³), and
/// the interaction of digit k of x and digit l of y has the variance c b^(−2 (k + l + 2)) with c = ((b² − 1) / 12)², and the gain
/// 0 for k + l + 2 ≤ m, b / (b − 1) for k + l + 1 = m and 1 beyond. In base 2 that is 7 (3m + 4) / 576.
#[test]
fn nested_scrambles_in_two_dimensions_have_the_exact_variance() {
    for scramble in ["owen", "owen_exact", "linear", "linear_i_binomial"] {
        for (base, m) in [(2, 5), (3, 2), (3, 4), (5, 2), (5, 3)] {
            let (b, n) = (f64::from(base), u64::from(base).pow(m));
            let square = b * b - 1.0;
            let (partly, fully) =
                (f64::from(m) / (b * (b - 1.0)), (f64::from(m + 1) + 1.0 / square) / (b * b * square));
            let theory = 1.0 / 24.0 + (square / 12.0).powi(2) * (partly + fully);
            let points = build("faure", 2, scramble, base);
            let errors = squared_error(&*points, n, |x| x[0] * x[1], 0.25, 10_000);
            let [found, deviation] = errors.map(|error| error * (n as f64).powi(3));
            assert!((found - theory).abs() < 5.0 * deviation, "{scramble}, {n} points: {found} for {theory}");
        }
    }
}

#[test]
fn wrong_bases_are_refused_with_what_is_allowed() {
    let message =
        |name, dims, scramble, base| try_build(name, dims, scramble, Some(base)).err().expect("refused");
    assert_eq!(
        message("van_der_corput", 1, "owen", 1),
        "option 'base' of sequence 'van_der_corput' must be from 2 to 65536, not 1"
    );
    assert_eq!(
        message("van_der_corput", 1, "linear", 10),
        "option 'base' of sequence 'van_der_corput' must be a prime with scramble 'linear', not 10"
    );
    assert_eq!(
        message("faure", 6, "owen", 5),
        "option 'base' of sequence 'faure' must be a prime from 6 to 65521, not 5"
    );
    assert_eq!(
        message("niederreiter", 6, "owen", 9),
        "option 'base' of sequence 'niederreiter' must be a prime from 2 to 65521, not 9"
    );
    let error = try_build("van_der_corput", 2, "owen", None).err().expect("refused");
    assert_eq!(error, "sequence 'van_der_corput' has 1 to 1 dimensions, not 2");
    assert_eq!(message("halton", 2, "owen", 3), "sequence 'halton' has no option 'base'; it has none");
}

/// Tables, which long fills make, do not change a number.
#[test]
fn tables_do_not_change_a_number() {
    for name in ["halton", "faure", "niederreiter"] {
        for scramble in ["owen", "owen_exact", "linear", "digit_permutation", "shift"] {
            let [long, short] = [0, 1].map(|_| build(name, 11, scramble, 11));
            let mut rows = vec![0.0; 11 * 5000];
            long.fill(3000..8000, &mut rows);
            for (i, row) in rows.chunks_exact(11).enumerate().step_by(7) {
                assert!(
                    (0..11).all(|dim| short.coord(3000 + i as u64, dim) == row[dim]),
                    "{name}, {scramble}"
                );
            }
        }
    }
}
