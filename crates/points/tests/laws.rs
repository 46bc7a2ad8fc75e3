//! Laws of the families: every registered sequence with every scramble it accepts.
//!
//! All seeds are fixed, so the tests never flicker. Their thresholds are those of a one-sided 10^-6
//! test: over the some hundred checks here, a correct generator with a fresh seed would fail one of
//! ten thousand runs.

use evenlight_points::{Error, PointSet, Seed, scramble, sequences};

/// Runs a law on every sequence × scramble.
fn on_all(dims: usize, seed: u64, law: impl Fn(&str, &dyn PointSet)) {
    for entry in sequences::ALL {
        for scramble in entry.accepts {
            let points = sequences::build(entry.name, dims, scramble.name(), Seed::new(seed));
            law(
                &format!("{} / {}", entry.name, scramble.name()),
                &*points.expect("the registry accepts its own scrambles"),
            );
        }
    }
}

fn rows(points: &dyn PointSet, rows: std::ops::Range<u64>) -> Vec<f64> {
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
        for (i, x) in filled.iter().enumerate() {
            assert_eq!(*x, points.coord(1000 + (i / 3) as u64, i % 3), "{name}, place {i}");
        }
    });
}

#[test]
fn fewer_dimensions_are_the_first_of_more() {
    for entry in sequences::ALL {
        for scramble in entry.accepts {
            let build =
                |dims| sequences::build(entry.name, dims, scramble.name(), Seed::new(4)).expect("valid");
            let (few, many) = (build(2), build(9));
            assert!(
                (0..50).all(|i| (0..2).all(|dim| few.coord(i, dim) == many.coord(i, dim))),
                "{}",
                entry.name
            );
        }
    }
}

#[test]
fn single_precision_is_the_truncated_double() {
    on_all(5, 5, |name, points| {
        let mut single = vec![0.0_f32; 5 * 1000];
        points.fill_f32(7..1007, &mut single);
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
        for dim in [0, 1, 2, 8, 15] {
            let bins = (0..1 << 14).map(|i| (points.coord(i, dim) * 64.0) as usize);
            let statistic = chi_square(64, bins);
            assert!(statistic < CHI_SQUARE_63, "{name}, dimension {dim}: {statistic}");
        }
    });
}

/// Every randomized sequence, as a function of the replicate.
fn on_replicates(law: impl Fn(&str, &dyn Fn(u64, u64, usize) -> f64)) {
    for entry in sequences::ALL {
        for scramble in entry.accepts.iter().filter(|s| s.name() != "none" || entry.name == "independent") {
            let seed = Seed::new(7);
            let sets: Vec<_> = (0..1 << 13)
                .map(|r| sequences::build(entry.name, 3, scramble.name(), seed.replicate(r)).expect("valid"))
                .collect();
            law(&format!("{} / {}", entry.name, scramble.name()), &|replicate, index, dim| {
                sets[replicate as usize].coord(index, dim)
            });
        }
    }
}

#[test]
fn replicates_are_uniform_and_independent() {
    on_replicates(|name, coord| {
        for (index, dim) in [(0, 0), (0, 1), (1, 2), (6, 1), (12345, 2)] {
            let bins = (0..1 << 13).map(|r| (coord(r, index, dim) * 64.0) as usize);
            let statistic = chi_square(64, bins);
            assert!(statistic < CHI_SQUARE_63, "{name}, row {index}, dimension {dim}: {statistic}");

            let cell = |x: f64, y: f64| (x * 16.0) as usize * 16 + (y * 16.0) as usize;
            let neighbors = (0..(1 << 13) - 1).map(|r| cell(coord(r, index, dim), coord(r + 1, index, dim)));
            let statistic = chi_square(256, neighbors);
            assert!(statistic < CHI_SQUARE_255, "{name}, neighboring replicates, row {index}: {statistic}");

            let dimensions = (0..1 << 13).map(|r| cell(coord(r, index, dim), coord(r, index, (dim + 1) % 3)));
            let statistic = chi_square(256, dimensions);
            assert!(statistic < CHI_SQUARE_255, "{name}, two dimensions, row {index}: {statistic}");
        }
    });
}

#[test]
fn names_lead_back_to_their_scrambles() {
    for entry in scramble::ALL {
        assert_eq!(scramble::Scrambling::named(entry.name), Ok(entry.scramble));
        assert_eq!(entry.scramble.name(), entry.name);
    }
}

#[test]
fn wrong_requests_are_refused_with_what_is_allowed() {
    let message = |name, dims, scramble| match sequences::build(name, dims, scramble, Seed::new(0)) {
        Ok(_) => panic!("{name}, {dims}, {scramble} should be refused"),
        Err(error) => error.to_string(),
    };
    assert_eq!(message("sobul", 2, "owen"), "unknown sequence 'sobul'; known: sobol, halton, independent");
    assert_eq!(message("sobol", 2, "own"), "unknown scramble 'own'; known: none, digital_shift, owen");
    assert_eq!(
        message("halton", 2, "digital_shift"),
        "sequence 'halton' does not accept scramble 'digital_shift'; accepted: owen, none"
    );
    assert_eq!(message("sobol", 0, "none"), "sequence 'sobol' has 1 to 21201 dimensions, not 0");
    assert!(message("sobol", 21_202, "none").ends_with("not 21202"));
    let error = sequences::build("halton", 6_543, "none", Seed::new(0)).err();
    assert_eq!(error, Some(Error::Dimensions { sequence: "halton", asked: 6_543, most: 6_542 }));
}

#[test]
#[should_panic(expected = "need 10 places, not 9")]
fn a_buffer_of_the_wrong_size_is_refused() {
    let points = sequences::build("sobol", 2, "none", Seed::new(0)).expect("valid");
    points.fill(0..5, &mut [0.0; 9]);
}
