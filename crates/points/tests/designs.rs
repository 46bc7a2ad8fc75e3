//! Laws of the finite designs: strata counted exactly, and variances against theory.

use std::collections::HashSet;

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::correlated_multi_jittered::correlated_multi_jittered;
use evenlight_points::sequences::dyadic::dyadic;
use evenlight_points::sequences::latin_hypercube::LatinHypercube;
use evenlight_points::sequences::multi_jittered::multi_jittered;
use evenlight_points::sequences::orthogonal_array::OrthogonalArray;
use evenlight_points::sequences::progressive_multi_jittered::progressive_multi_jittered;
use evenlight_points::sequences::stratified::Stratified;
use evenlight_points::sequences::sz::sz;
use evenlight_points::{PointSet, Seed};

/// All points, as the cells of a grid with `sides` cells along the given coordinates.
fn cells(points: &dyn PointSet, rows: std::ops::Range<u64>, sides: &[(usize, u64)]) -> Vec<Vec<u64>> {
    let mut out = vec![0.0; (rows.end - rows.start) as usize * points.dims()];
    points.fill(rows, &mut out);
    // Exact: coordinates have 53 binary digits.
    let cell = |x: f64, n: u64| (((x * 2f64.powi(53)) as u128 * u128::from(n)) >> 53) as u64;
    out.chunks_exact(points.dims()).map(|x| sides.iter().map(|&(dim, n)| cell(x[dim], n)).collect()).collect()
}

/// Whether every cell of a grid holds the same number of points.
fn is_even(points: &dyn PointSet, rows: std::ops::Range<u64>, sides: &[(usize, u64)]) -> bool {
    let total: u64 = sides.iter().map(|&(_, n)| n).product();
    let each = (rows.end - rows.start) / total;
    let mut found = cells(points, rows, sides);
    found.sort_unstable();
    let counts: Vec<_> = found.chunk_by(|a, b| a == b).map(|same| same.len() as u64).collect();
    counts.len() as u64 == total && counts.iter().all(|&count| count == each)
}

#[test]
fn a_latin_hypercube_has_one_point_in_each_slice() {
    for n in [1, 2, 3, 7, 64, 100, 1009, 1 << 12, 10_007] {
        let points = LatinHypercube::new(5, n, Seed::new(n));
        assert!((0..5).all(|dim| is_even(&points, 0..n, &[(dim, n)])), "{n}");
    }
}

#[test]
fn stratified_points_have_one_in_each_cell() {
    for (dims, side) in [(1, 100_u64), (2, 1), (2, 7), (2, 64), (3, 10), (5, 3), (10, 2)] {
        let n = side.pow(dims as u32);
        let points = Stratified::new(dims, n, Seed::new(n));
        let sides: Vec<_> = (0..dims).map(|dim| (dim, side)).collect();
        assert!(is_even(&points, 0..n, &sides), "{side}^{dims}");
    }
}

#[test]
fn multi_jittered_pairs_are_even_on_the_grid_and_on_both_axes() {
    for (columns, rows) in [(1, 1), (7, 1), (2, 1), (3, 2), (4, 4), (10, 10), (25, 17), (37, 31)] {
        let n = columns * rows;
        for points in [multi_jittered(6, n, Seed::new(n)), correlated_multi_jittered(6, n, Seed::new(n))] {
            for x in [0, 2, 4] {
                assert!(is_even(&points, 0..n, &[(x, columns), (x + 1, rows)]), "{columns} × {rows}");
                assert!(is_even(&points, 0..n, &[(x, n)]) && is_even(&points, 0..n, &[(x + 1, n)]), "{n}");
            }
        }
    }
}

/// In the correlated kind, all columns order their rows alike.
#[test]
fn correlation_is_what_the_name_says() {
    let orders = |points: &dyn PointSet| {
        let mut found = cells(points, 0..256, &[(0, 16), (1, 16), (0, 256)]);
        found.sort_by_key(|cell| cell[2]);
        let rows: HashSet<Vec<u64>> =
            found.chunks(16).map(|column| column.iter().map(|cell| cell[1]).collect()).collect();
        rows.len()
    };
    assert_eq!(orders(&correlated_multi_jittered(2, 256, Seed::new(1))), 1);
    assert_eq!(orders(&multi_jittered(2, 256, Seed::new(1))), 16);
}

#[test]
fn orthogonal_arrays_are_even_in_all_pairs_and_triples() {
    for (p, strength) in [(2, 2), (3, 2), (7, 2), (13, 2), (2, 3), (3, 3), (5, 3), (7, 3)] {
        let (n, dims) = (p * p * if strength == 3 { p } else { 1 }, p as usize + 1);
        let points = OrthogonalArray::new(dims, p, strength, Seed::new(n));
        for a in 0..dims {
            assert!(is_even(&points, 0..n, &[(a, n)]), "{p}^{strength}, axis {a}");
            for b in 0..a {
                assert!(is_even(&points, 0..n, &[(a, p), (b, p)]), "{p}^{strength}, pair {a}, {b}");
                let all = (0..b).all(|c| strength < 3 || is_even(&points, 0..n, &[(a, p), (b, p), (c, p)]));
                assert!(all, "{p}^{strength}, triples with {a}, {b}");
            }
        }
    }
}

/// Every elementary interval of every pair, in the first and in later blocks of 2^m, whatever the scramble.
#[test]
fn dyadic_pairs_fill_every_elementary_interval() {
    let randomizations = [Randomization::None, Randomization::Linear, Randomization::Owen];
    let nets: Vec<_> =
        (randomizations.map(|randomization| dyadic(8, randomization, Seed::new(3))).into_iter())
            .chain(randomizations.map(|randomization| sz(8, randomization, Seed::new(3))))
            .chain([progressive_multi_jittered(8, Randomization::Owen, Seed::new(3))])
            .collect();
    for net in &nets {
        for (m, x, block) in [(1, 0, 0), (5, 2, 0), (8, 4, 0), (8, 6, 5), (10, 0, 1), (11, 6, 0)] {
            let rows = block << m..(block + 1) << m;
            let even = |k: u32| is_even(net, rows.clone(), &[(x, 1 << k), (x + 1, 1 << (m - k))]);
            assert!((0..=m).all(even), "2^{m} points of dimension {x}, block {block}");
        }
    }
}

#[test]
fn nested_nets_are_even_in_quadruples() {
    let points = sz(8, Randomization::Owen, Seed::new(4));
    for first in [0, 4] {
        let sides = |k: [u64; 4]| (0..4).map(|i| (first + i, k[i])).collect::<Vec<_>>();
        for k in [[4, 4, 4, 4], [256, 1, 1, 1], [16, 4, 4, 1], [1, 16, 1, 16], [1, 4, 4, 16], [1, 1, 64, 4]] {
            assert!(is_even(&points, 0..256, &sides(k)), "{k:?} from {first}");
            assert!(is_even(&points, 768..1024, &sides(k)), "{k:?} from {first}, later");
        }
    }
}

/// The mean squared error of the mean of `f`, whose integral is 0, over `replicates` sets of points.
fn variance(replicates: u64, build: impl Fn(Seed) -> Box<dyn PointSet>, f: impl Fn(&[f64]) -> f64) -> f64 {
    let mut out = Vec::new();
    let errors = (0..replicates).map(|r| {
        let points = build(Seed::new(2026).replicate(r));
        let n = points.len().expect("designs are finite");
        out.resize(n as usize * points.dims(), 0.0);
        points.fill(0..n, &mut out);
        (out.chunks_exact(points.dims()).map(&f).sum::<f64>() / n as f64).powi(2)
    });
    errors.sum::<f64>() / replicates as f64
}

/// Sum of (x − ½): one point at random in each of n slices leaves d/(12 n³); in each of k slices n/k points
/// leave d/(12 n k²). The mean of 4,000 squares of nearly normal numbers has a relative deviation of 0.022.
#[test]
fn sums_have_the_variance_of_their_slices() {
    let sum = |x: &[f64]| x.iter().sum::<f64>() - x.len() as f64 / 2.0;
    let check = |name: &str, n: f64, slices: f64, build: &dyn Fn(Seed) -> Box<dyn PointSet>| {
        let ratio = variance(4_000, build, sum) * 12.0 * n * slices * slices / 4.0;
        assert!((ratio - 1.0).abs() < 0.11, "{name}: {ratio}");
    };
    check("latin hypercube", 50.0, 50.0, &|seed| Box::new(LatinHypercube::new(4, 50, seed)));
    check("multi-jittered", 30.0, 30.0, &|seed| Box::new(multi_jittered(4, 30, seed)));
    check("correlated", 30.0, 30.0, &|seed| Box::new(correlated_multi_jittered(4, 30, seed)));
    check("strength 2", 49.0, 49.0, &|seed| Box::new(OrthogonalArray::new(4, 7, 2, seed)));
    check("strength 3", 27.0, 27.0, &|seed| Box::new(OrthogonalArray::new(4, 3, 3, seed)));
    check("stratified", 81.0, 3.0, &|seed| Box::new(Stratified::new(4, 81, seed)));
}

/// (x − ½)(y − ½): of two independent uniform permutations, the mean of products of slice centers has
/// variance s⁴/(n − 1) with s² = (1 − 1/n²)/12, and the places within slices add (2 s²/12n² + 1/144n⁴)/n.
/// The fourth moments of nearly normal means leave 0.016 of 8,000 replicates.
#[test]
fn products_over_a_latin_hypercube_have_the_variance_of_random_matchings() {
    let product = |x: &[f64]| (x[0] - 0.5) * (x[1] - 0.5);
    for n in [2_u64, 3, 5, 8, 20, 65] {
        let count = n as f64;
        let s2 = (1.0 - 1.0 / count.powi(2)) / 12.0;
        let within = 1.0 / (12.0 * count * count);
        let expected = s2 * s2 / (count - 1.0) + (2.0 * s2 * within + within * within) / count;
        let found = variance(8_000, |seed| Box::new(LatinHypercube::new(2, n, seed)), product);
        assert!((found / expected - 1.0).abs() < 0.12, "n = {n}: {}", found / expected);
    }
}

/// Strength 2 removes what a Latin hypercube leaves of a product of two coordinates, but not of three;
/// strength 3 removes that as well. On the p × p grid, what is left of (x − ½)(y − ½) is about
/// 2 (1/12)(1/12p²)/n, so that the ratio is about 2/p² (and for three coordinates 3/p²).
#[test]
fn strength_removes_interactions() {
    let array =
        |p, strength| move |seed| Box::new(OrthogonalArray::new(4, p, strength, seed)) as Box<dyn PointSet>;
    let hypercube = |n| move |seed| Box::new(LatinHypercube::new(4, n, seed)) as Box<dyn PointSet>;
    let pair = |x: &[f64]| (x[1] - 0.5) * (x[3] - 0.5);
    let triple = |x: &[f64]| (x[0] - 0.5) * (x[1] - 0.5) * (x[2] - 0.5);
    let gain = |a: f64, b: f64| a / b;
    let two = gain(variance(1_000, array(11, 2), pair), variance(1_000, hypercube(121), pair));
    assert!(two < 0.06, "{two}");
    let three = gain(variance(500, array(7, 3), triple), variance(500, hypercube(343), triple));
    assert!(three < 0.2, "{three}");
    let not_removed = gain(variance(1_000, array(11, 2), triple), variance(1_000, hypercube(121), triple));
    assert!((0.5..2.0).contains(&not_removed), "{not_removed}");
}

/// For smooth functions of two coordinates, n² Var of jittered points tends to the mean of |∇f|²/12:
/// for xy that is (⅓ + ⅓)/12 = 1/18.
#[test]
fn jittered_points_have_the_variance_of_their_cells() {
    let product = |x: &[f64]| x[0] * x[1] - 0.25;
    let found =
        variance(4_000, |seed| Box::new(Stratified::new(2, 400, seed)), product) * 400.0 * 400.0 * 18.0;
    assert!((found - 1.0).abs() < 0.11, "{found}");
}

/// Points of a row are uniform over seeds, two rows of one coordinate never share a slice, and the
/// slices of two coordinates are independent: Pearson's statistic within 5 standard deviations.
#[test]
fn single_points_are_uniform_over_seeds() {
    type Build = fn(Seed) -> Box<dyn PointSet>;
    let designs: [(&str, Build); 6] = [
        ("latin_hypercube", |seed| Box::new(LatinHypercube::new(4, 48, seed))),
        ("stratified", |seed| Box::new(Stratified::new(4, 16, seed))),
        ("multi_jittered", |seed| Box::new(multi_jittered(4, 24, seed))),
        ("correlated_multi_jittered", |seed| Box::new(correlated_multi_jittered(4, 24, seed))),
        ("orthogonal_array 2", |seed| Box::new(OrthogonalArray::new(4, 5, 2, seed))),
        ("orthogonal_array 3", |seed| Box::new(OrthogonalArray::new(4, 3, 3, seed))),
    ];
    for (name, build) in designs {
        for (index, a, b) in [(0, 0, 1), (1, 1, 2), (11, 3, 0), (15, 2, 3)] {
            let mut counts = [0.0; 256];
            for r in 0..20_000 {
                let points = build(Seed::new(5).replicate(r));
                let bin = |dim| (points.coord(index, dim) * 16.0) as usize;
                counts[bin(a) * 16 + bin(b)] += 1.0;
            }
            let expected = 20_000.0 / 256.0;
            let statistic: f64 = counts.iter().map(|count: &f64| (count - expected).powi(2) / expected).sum();
            assert!((statistic - 255.0).abs() < 5.0 * 510f64.sqrt(), "{name}, point {index}: {statistic}");
        }
    }
}
