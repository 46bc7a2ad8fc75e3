//! Laws of the families: every registered sequence with every scramble it accepts.
//!
//! All seeds are fixed, so the tests never flicker. Their thresholds are those of a one-sided 10^-6
//! test: over the some hundred checks here, a correct generator with a fresh seed would fail one of
//! ten thousand runs.

mod examples;

use std::ops::Range;

use evenlight_points::scramble::{self, Randomization};
use evenlight_points::sequences::{self, Options, Spec};
use evenlight_points::{Error, PointSet, Seed};
use examples::{build, pairs};

/// Runs a law on every sequence × randomization; those with fewer dimensions come with all they have.
fn on_all(dims: usize, seed: u64, law: impl Fn(&str, &dyn PointSet)) {
    for (entry, randomization) in pairs() {
        let name = format!("{} / {}", entry.name, randomization.name());
        law(&name, &*build(entry, dims, randomization, Seed::new(seed)));
    }
}

/// The part of a range that a finite set has.
fn part(points: &dyn PointSet, rows: Range<u64>) -> Range<u64> {
    let end = points.len().map_or(rows.end, |len| rows.end.min(len));
    rows.start.min(end)..end
}

fn rows(points: &dyn PointSet, rows: Range<u64>) -> Vec<f64> {
    let rows = part(points, rows);
    let mut out = vec![f64::NAN; (rows.end - rows.start) as usize * points.dims()];
    points.fill(rows, &mut out);
    out
}

#[test]
fn all_coordinates_are_in_the_half_open_unit_interval() {
    on_all(64, 1, |name, points| {
        for start in [0, 1_000_003, 1 << 40, u64::MAX - 100] {
            for x in rows(points, start..start + 100) {
                assert!((0.0..1.0).contains(&x), "{name}: {x}");
            }
        }
    });
}

#[test]
fn order_and_size_of_access_do_not_matter() {
    // Odd starts and lengths cross the blocks that the fast paths work in.
    for dims in [1, 2, 3, 7, 8, 33, 300, 1500] {
        on_all(dims, 2, |name, points| {
            for range in
                [0..1, 0..70, 5..61, 1021..1030, (1 << 33) - 3..(1 << 33) + 4, u64::MAX - 2..u64::MAX]
            {
                let filled = rows(points, range.clone());
                let dims = points.dims();
                for (i, x) in filled.iter().enumerate().rev().step_by(1 + dims / 30) {
                    let expected = points.coord(range.start + (i / dims) as u64, i % dims);
                    assert_eq!(x.to_bits(), expected.to_bits(), "{name}, d = {dims}, {range:?}, place {i}");
                }
            }
        });
    }
}

#[test]
fn long_fills_have_the_bits_of_single_coordinates() {
    on_all(3, 3, |name, points| {
        let filled = rows(points, 1000..6000);
        let dims = points.dims();
        for (i, x) in filled.iter().enumerate() {
            assert_eq!(*x, points.coord(1000 + (i / dims) as u64, i % dims), "{name}, place {i}");
        }
    });
}

#[test]
fn fewer_dimensions_are_the_first_of_more() {
    // The grid of stratified points depends on the dimension, and so do Faure's base, the matrices of Niederreiter and
    // Xing and the numbers of Roberts' sequence.
    let dependent = ["stratified", "faure", "niederreiter_xing", "kronecker"];
    for (entry, randomization) in pairs().filter(|(entry, _)| !dependent.contains(&entry.name)) {
        let [few, many] = [2, 9].map(|dims| build(entry, dims, randomization, Seed::new(4)));
        for index in part(&*few, 0..50) {
            for dim in 0..few.dims() {
                assert_eq!(few.coord(index, dim), many.coord(index, dim), "{}", entry.name);
            }
        }
    }
}

#[test]
fn reseeded_points_are_those_built_with_the_seed() {
    for (entry, randomization) in pairs() {
        let [other, built] = [5, 6].map(|seed| build(entry, 7, randomization, Seed::new(seed)));
        let reseeded = other.reseeded(Seed::new(6));
        assert_eq!(
            (reseeded.dims(), reseeded.len(), reseeded.base()),
            (built.dims(), built.len(), built.base())
        );
        assert_eq!(rows(&*reseeded, 0..99), rows(&*built, 0..99), "{}, {}", entry.name, randomization.name());
    }
}

#[test]
fn single_precision_is_the_truncated_double() {
    on_all(5, 5, |name, points| {
        let range = part(points, 7..1007);
        let mut single = vec![0.0_f32; points.dims() * (range.end - range.start) as usize];
        points.fill_f32(range, &mut single);
        for (short, long) in single.iter().zip(rows(points, 7..1007)) {
            let gap = long - f64::from(*short);
            assert!(*short < 1.0 && (0.0..2f64.powi(-24)).contains(&gap), "{name}: {short} for {long}");
        }
    });
}

/// Pearson's statistic of counts that are expected to be equal.
fn chi_square(cells: usize, samples: impl Iterator<Item = usize>) -> f64 {
    let mut counts = vec![0.0; cells];
    samples.for_each(|cell| counts[cell] += 1.0);
    let expected = counts.iter().sum::<f64>() / cells as f64;
    counts.iter().map(|count| (count - expected).powi(2) / expected).sum()
}

/// Quantiles at 1 − 10^-6 of chi-square with 63 and 255 degrees of freedom (Wilson–Hilferty).
const CHI_SQUARE_63: f64 = 131.7;
const CHI_SQUARE_255: f64 = 377.2;

#[test]
fn marginals_are_uniform() {
    on_all(16, 6, |name, points| {
        for dim in [0, 1, 2, 8, 15].into_iter().filter(|&dim| dim < points.dims()) {
            let bins = part(points, 0..1 << 14).map(|i| (points.coord(i, dim) * 64.0) as usize);
            let statistic = chi_square(64, bins);
            assert!(statistic < CHI_SQUARE_63, "{name}, dimension {dim}: {statistic}");
        }
    });
}

/// Every randomized sequence, as a function of replicate, row and dimension, with its rows and dimensions.
fn on_replicates(law: impl Fn(&str, &dyn Fn(u64, u64, usize) -> f64, u64, usize)) {
    for (entry, randomization) in pairs() {
        let original = build(entry, 3, randomization, Seed::new(7));
        if original.coord(1, 0) == original.reseeded(Seed::new(8)).coord(1, 0) {
            continue; // nothing in it is random
        }
        let sets: Vec<_> = (0..1 << 13).map(|r| original.reseeded(Seed::new(7).replicate(r))).collect();
        let coord = |replicate, index, dim| sets[replicate as usize].coord(index, dim);
        let name = format!("{} / {}", entry.name, randomization.name());
        law(&name, &coord, original.len().unwrap_or(u64::MAX), original.dims());
    }
}

#[test]
fn replicates_are_uniform_and_independent() {
    on_replicates(|name, coord, len, dims| {
        for (index, dim) in [(0, 0), (0, 1), (1, 2), (6, 1), (12345, 2)] {
            let (index, dim) = (index % len, dim % dims);
            let bins = (0..1 << 13).map(|r| (coord(r, index, dim) * 64.0) as usize);
            let statistic = chi_square(64, bins);
            assert!(statistic < CHI_SQUARE_63, "{name}, row {index}, dimension {dim}: {statistic}");

            let cell = |x: f64, y: f64| (x * 16.0) as usize * 16 + (y * 16.0) as usize;
            let neighbors = (0..(1 << 13) - 1).map(|r| cell(coord(r, index, dim), coord(r + 1, index, dim)));
            let statistic = chi_square(256, neighbors);
            assert!(statistic < CHI_SQUARE_255, "{name}, neighboring replicates, row {index}: {statistic}");

            if dims > 1 {
                let next = (dim + 1) % dims;
                let pairs = (0..1 << 13).map(|r| cell(coord(r, index, dim), coord(r, index, next)));
                let statistic = chi_square(256, pairs);
                assert!(statistic < CHI_SQUARE_255, "{name}, two dimensions, row {index}: {statistic}");
            }
        }
    });
}

#[test]
fn names_lead_back_to_their_scrambles() {
    for entry in scramble::ALL {
        assert_eq!(Randomization::named(entry.name), Ok(entry.randomization));
        assert_eq!(entry.randomization.name(), entry.name);
    }
}

#[test]
fn wrong_requests_are_refused_with_what_is_allowed() {
    let message = |name, dims, randomization, options| {
        let spec = Spec { options, ..Spec::new(dims, randomization, Seed::new(0)) };
        match sequences::build(name, &spec) {
            Ok(_) => panic!("{name}, {spec:?} should be refused"),
            Err(error) => error.to_string(),
        }
    };
    let none = Options::default;
    let unknown = message("sobul", 2, Randomization::Owen, none());
    assert!(unknown.starts_with("unknown sequence 'sobul'; known: sobol, "), "{unknown}");
    let unknown = Randomization::named("own").expect_err("unknown").to_string();
    assert!(unknown.starts_with("unknown scramble 'own'; known: none, shift, "), "{unknown}");
    assert_eq!(
        message("independent", 2, Randomization::DigitalShift, none()),
        "sequence 'independent' does not accept scramble 'digital_shift'; accepted: none"
    );
    assert_eq!(
        message("sobol", 2, Randomization::None, Options { order: Some(2), ..none() }),
        "sequence 'sobol' has no option 'order'; it has none"
    );
    assert_eq!(
        message("sobol", 0, Randomization::None, none()),
        "sequence 'sobol' has 1 to 21201 dimensions, not 0"
    );
    assert_eq!(
        message("interlaced_sobol", 2, Randomization::None, Options { order: Some(6), ..none() }),
        "option 'order' of sequence 'interlaced_sobol' must be 2 to 5, not 6"
    );
    let many = message("interlaced_sobol", 7_068, Randomization::None, Options { order: Some(3), ..none() });
    assert_eq!(many, "sequence 'interlaced_sobol' has 1 to 7067 dimensions, not 7068");
    let net = |bits, matrices: &[&[u64]]| {
        let matrices = Some(matrices.iter().map(|columns| columns.to_vec()).collect());
        message("digital_net", 2, Randomization::None, Options { bits, matrices, ..none() })
    };
    assert!(
        net(None, &[&[1], &[1]]).ends_with("must be the number of digits of a column, 1 to 64, not nothing")
    );
    assert!(net(Some(2), &[&[1]]).ends_with("must be one list of columns for each of 2 dimensions, not 1"));
    assert!(net(Some(2), &[&[], &[]]).ends_with("must be lists of 1 to 64 columns, not 0"));
    assert!(net(Some(2), &[&[1, 2], &[1]]).ends_with("must be lists of the same length, here 2, not 1"));
    assert!(net(Some(2), &[&[1, 2], &[3, 4]]).ends_with("must be numbers below 2^2, as 'bits' says, not 4"));
    assert!(message("sobol", 21_202, Randomization::None, none()).ends_with("not 21202"));
    let error = sequences::build("halton", &Spec::new(6_543, Randomization::None, Seed::new(0))).err();
    assert_eq!(error, Some(Error::Dimensions { sequence: "halton", asked: 6_543, most: 6_542 }));
}

#[test]
#[should_panic(expected = "need 10 places, not 9")]
fn a_buffer_of_the_wrong_size_is_refused() {
    let spec = Spec::new(2, Randomization::None, Seed::new(0));
    let points = sequences::build("sobol", &spec).expect("valid");
    points.fill(0..5, &mut [0.0; 9]);
}
