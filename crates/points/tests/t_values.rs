//! Quality parameters of the nets, as in the literature, and of any nets, as their definition has it.

use evenlight_points::quality::{t_value, t_value_in_base};
use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::sobol::direction_numbers;
use evenlight_points::sequences::{self, Spec};
use evenlight_points::{Error, Seed};

fn matrices(name: &str, dims: usize) -> Vec<Vec<u64>> {
    let spec = Spec::new(dims, Randomization::None, Seed::new(0));
    sequences::build(name, &spec).expect("valid").generating_matrices().expect("a net")
}

fn t_values(matrices: &[Vec<u64>], until: u32) -> Vec<u32> {
    (1..=until).map(|m| t_value(matrices, m).expect("valid")).collect()
}

/// Joe-Kuo points, m = 1, 2, …: an independent computation for this project.
#[test]
fn sobol_has_the_known_values() {
    let known: [(usize, &[u32]); 6] = [
        (2, &[0; 30]),
        (3, &[0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]),
        (4, &[0, 1, 2, 2, 2, 2, 2, 3, 3, 2, 2, 3]),
        (5, &[0, 1, 2, 2, 2, 3, 3, 3, 3, 3, 4, 4]),
        (6, &[0, 1, 2, 3, 2, 3, 3, 4, 4, 4]),
        (7, &[0, 1, 2, 3, 2, 3, 3, 4, 5, 5]),
    ];
    for (dims, t) in known {
        assert_eq!(t_values(&matrices("sobol", dims), t.len() as u32), t, "s = {dims}");
    }
}

/// I. M. Sobol's property A′ of five successive dimensions: the first two digits of the first 2^10 points take all values. It is
/// what the numbers of `sobol_tkrg` were made for, and what those of `sobol` were not.
#[test]
fn five_successive_dimensions_of_sobol_tkrg_have_property_a_prime() {
    let invertible = |block: &[Vec<u64>]| {
        let row = |matrix: &[u64], r: u32| (0..10).map(|k| (matrix[k] >> (63 - r) & 1) << k).sum::<u64>();
        let mut rows: Vec<_> = block.iter().flat_map(|matrix| [row(matrix, 0), row(matrix, 1)]).collect();
        (0..10).all(|k| {
            let pivot = rows.iter().position(|row| row >> k & 1 == 1).map(|i| rows.swap_remove(i));
            rows.iter_mut().filter(|row| **row >> k & 1 == 1).for_each(|row| *row ^= pivot.unwrap_or(0));
            pivot.is_some()
        })
    };
    let fail = |name, dims| matrices(name, dims).windows(5).filter(|block| !invertible(block)).count();
    assert_eq!((fail("sobol_tkrg", 50_000), fail("sobol", 21_201)), (0, 15_075));
}

/// I. M. Sobol' (1967): t is at most the sum of the degrees of the polynomials, less 1 each.
#[test]
fn sobol_keeps_its_bound() {
    let bounds = [0, 0, 1, 3, 5, 8, 11, 15, 19, 23, 27, 31, 35, 40, 45, 50, 55, 60, 65, 71];
    for (dims, bound) in (1..).zip(bounds) {
        let most = t_values(&matrices("sobol", dims), 18).into_iter().max();
        assert!(most.is_some_and(|most| most <= bound), "s = {dims}: {most:?}");
    }
}

/// H. Niederreiter and C. Xing (1996): t is the genus of a field with s + 1 rational places: 1 to 6, 8 and 9. It is
/// reached, and never passed. In twelve dimensions, where the least genus is 10, Pirsic's matrices have 11.
#[test]
fn niederreiter_xing_has_the_genus_of_its_field() {
    for (dims, genus, m) in [
        (1, 0, 30),
        (2, 0, 30),
        (3, 1, 25),
        (4, 1, 24),
        (5, 2, 22),
        (6, 3, 22),
        (7, 4, 20),
        (8, 5, 18),
        (9, 6, 18),
    ] {
        let most = t_values(&matrices("niederreiter_xing", dims), m).into_iter().max();
        assert_eq!(most, Some(genus), "s = {dims}");
    }
    for (dims, genus, m) in [(10, 8, 20), (11, 9, 20), (12, 10, 20)] {
        assert_eq!(
            t_values(&matrices("niederreiter_xing", dims), m).into_iter().max(),
            Some(genus),
            "s = {dims}"
        );
    }
    assert_eq!(t_value(&matrices("niederreiter_xing", 12), 22), Ok(11));
}

/// At 2^18 points, up to the eleven dimensions in which the matrices keep what the theory promises.
#[test]
fn niederreiter_xing_is_better_than_sobol_in_four_to_eleven_dimensions() {
    for dims in 4..=11 {
        let [xing, sobol] =
            ["niederreiter_xing", "sobol"].map(|name| t_value(&matrices(name, dims), 18).expect("valid"));
        assert!(xing < sobol, "s = {dims}: {xing}, {sobol}");
    }
}

/// Pairs in base 2 have t = 0 at every m.
#[test]
fn pairs_are_perfect() {
    for name in ["dyadic", "sz"] {
        for pair in matrices(name, 64).chunks(2) {
            assert!((1..=64).all(|m| t_value(pair, m) == Ok(0)), "{name}");
        }
    }
}

/// The rows of a Niederreiter matrix in base 2: the digits of x^u / p^q for u below the degree e and q = 1, 2, …
/// (H. Niederreiter 1988). A polynomial is a bit mask.
fn niederreiter(p: u64, size: usize) -> Vec<Vec<u32>> {
    let times = |a: u128| (0..64).filter(|k| p >> k & 1 == 1).fold(0, |sum, k| sum ^ a << k);
    let degree = p.ilog2() as usize;
    let mut power = 1;
    let mut rows = vec![];
    for row in 0..size {
        if row % degree == 0 {
            power = times(power);
        }
        let mut rest = 1_u128 << (row % degree);
        let mut digit = || {
            rest <<= 1;
            let one = rest >> power.ilog2() & 1;
            rest ^= power * one;
            one as u32
        };
        rows.push((0..size).map(|_| digit()).collect());
    }
    rows
}

/// J. Dick and H. Niederreiter, *On the exact t-value of Niederreiter and Sobol' sequences*, J. Complexity 24 (2008): t of a
/// Niederreiter sequence is the sum of the degrees less 1 each, which some m reaches and none passes.
#[test]
fn niederreiter_has_the_sum_of_degrees() {
    let polynomials = [0b10, 0b11, 0b111, 0b1011, 0b1101, 0b1_0011, 0b1_1001, 0b1_1111];
    for (dims, exact) in (1..).zip([0, 0, 1, 3, 5, 8, 11, 14]) {
        let matrices: Vec<_> = polynomials[..dims].iter().map(|&p| niederreiter(p, 16)).collect();
        let most = (1..=16).map(|m| t_value_in_base(2, &matrices, m).expect("valid")).max().expect("some");
        assert!(most <= exact && (dims > 6 || most == exact), "s = {dims}: {most}, not {exact}");
    }
}

/// H. Faure (1982): powers of Pascal's matrix in a prime base of at least s have t = 0.
#[test]
fn faure_is_perfect_in_its_base() {
    for (base, m) in [(2_u32, 20_usize), (3, 9), (5, 6), (7, 5), (13, 3)] {
        // Row i, column j of power a: C(j, i) a^(j − i).
        let pascal = |a: u32| {
            let mut rows = vec![vec![0; m]; m];
            rows[0][0] = 1;
            for j in 1..m {
                for i in 0..=j {
                    let above = if i > 0 { rows[i - 1][j - 1] } else { 0 };
                    rows[i][j] = (above + a * rows[i][j - 1]) % base;
                }
            }
            rows
        };
        let faure: Vec<_> = (0..base).map(pascal).collect();
        assert_eq!(t_value_in_base(base, &faure, m as u32), Ok(0), "base {base}");
        let twice = [faure[1].clone(), faure[1].clone()];
        assert_eq!(t_value_in_base(base, &twice, m as u32), Ok(m as u32 - 1), "base {base}, twice the same");
    }
}

/// The definition: the largest k such that every box of volume b^(−k) with sides `b^(−d_j)` holds the same number of points.
fn by_counting(base: u32, matrices: &[Vec<Vec<u32>>], m: u32) -> u32 {
    let digits = |mut i: u32| std::array::from_fn::<u32, 12, _>(|_| (i % base, i /= base).0);
    let coordinate = |matrix: &Vec<Vec<u32>>, i: u32, depth: u32| {
        let row = |row: &Vec<u32>| row.iter().zip(digits(i)).map(|(x, y)| x * y).sum::<u32>() % base;
        matrix.iter().take(depth as usize).fold(0, |cell, entries| cell * base + row(entries))
    };
    let even = |depths: &[u32]| {
        let volume: u32 = depths.iter().sum();
        let mut counts = vec![0; base.pow(volume) as usize];
        for i in 0..base.pow(m) {
            let cells = matrices.iter().zip(depths);
            let cell = cells.fold(0, |cell, (matrix, &d)| cell * base.pow(d) + coordinate(matrix, i, d));
            counts[cell as usize] += 1;
        }
        counts.iter().all(|&count| count == base.pow(m - volume))
    };
    let all_even = |k: u32| (0..=k).all(|a| (0..=k - a).all(|b| even(&[a, b, k - a - b])));
    m - (0..=m).take_while(|&k| all_even(k)).last().expect("the whole cube holds all")
}

/// Random matrices, whose t is anything from 0 to m.
#[test]
fn values_are_those_of_counting() {
    let mut seen = std::collections::BTreeSet::new();
    for (base, m) in [(2, 5), (2, 7), (3, 4), (5, 3)] {
        for seed in 0..40 {
            let random = |j: u32| -> Vec<Vec<u32>> {
                let digit = |r, k| Seed::new(seed).split(r, k).dimension(u64::from(j)).bits32() % base;
                // Upper triangles now and then, so that small values of t come about.
                let entry = |r: u32, k: u32| match r.cmp(&k) {
                    std::cmp::Ordering::Greater if seed % 2 == 0 => 0,
                    std::cmp::Ordering::Equal if seed % 2 == 0 => 1,
                    _ => digit(r.into(), k.into()),
                };
                (0..m).map(|r| (0..m).map(|k| entry(r, k)).collect()).collect()
            };
            let matrices: Vec<_> = (0..3).map(random).collect();
            let t = by_counting(base, &matrices, m);
            assert_eq!(t_value_in_base(base, &matrices, m), Ok(t), "base {base}, {matrices:?}");
            if base == 2 {
                let word = |matrix: &Vec<Vec<u32>>, k: usize| {
                    matrix.iter().fold(0, |word, row| word << 1 | u64::from(row[k])) << (64 - m)
                };
                let columns = |matrix| (0..m as usize).map(|k| word(matrix, k)).collect::<Vec<_>>();
                assert_eq!(t_value(&matrices.iter().map(columns).collect::<Vec<_>>(), m), Ok(t));
            }
            seen.insert(t);
        }
    }
    assert!(seen.len() > 4, "{seen:?}");
}

#[test]
fn what_is_no_net_is_refused() {
    let sobol = [direction_numbers(0)];
    let message = |found: Result<u32, Error>| found.expect_err("refused").to_string();
    assert_eq!(message(t_value(&sobol, 65)), "m must be 0 to 64, the size of the matrices, not 65");
    assert_eq!(message(t_value(&[[0_u64; 3]], 4)), "m must be 0 to 3, the size of the matrices, not 4");
    assert_eq!(message(t_value::<Vec<u64>>(&[], 1)), "a net has at least one matrix");
    let none = [vec![vec![0, 0], vec![0]]];
    assert_eq!(message(t_value_in_base(3, &none, 2)), "m must be 0 to 1, the size of the matrices, not 2");
    assert_eq!(message(t_value_in_base(4, &none, 1)), "the base of a net must be a prime below 2^16, not 4");
    assert_eq!(t_value(&sobol, 0), Ok(0));
    assert_eq!(t_value(&[[0_u64; 3]], 3), Ok(3));
}
