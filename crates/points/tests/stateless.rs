//! The functions for renderers give the points of the sequences.

use evenlight_points::PointSet;
use evenlight_points::convert::{unit_f32, unit_f64};
use evenlight_points::scramble::Randomization;
use evenlight_points::stateless::{SOBOL_DIMS, owen_sobol, shuffled, sobol};
use evenlight_points::{Seed, sequences::sobol::sobol as sequence};

const INDICES: [u32; 6] = [0, 1, 2, 1000, 0x8000_0001, u32::MAX];

#[test]
fn words_are_those_of_the_sequences() {
    for (scramble, seed) in
        [(Randomization::None, 0), (Randomization::Owen, 0), (Randomization::Owen, u64::MAX)]
    {
        let points = sequence(SOBOL_DIMS as usize, scramble, Seed::new(seed));
        for index in INDICES {
            let mut row = [f32::NAN; SOBOL_DIMS as usize];
            points.fill_f32(u64::from(index)..u64::from(index) + 1, &mut row);
            for (dim, x) in (0..).zip(row) {
                let word = if scramble == Randomization::None {
                    sobol(index, dim)
                } else {
                    owen_sobol(index, dim, seed)
                };
                assert_eq!(unit_f32(word), x, "{scramble:?}, seed {seed}, index {index}, dimension {dim}");
                // All 32 digits, not only those that single precision shows.
                let double = points.coord(u64::from(index), dim as usize);
                assert_eq!(unit_f64(u64::from(word) << 32), (double * 2f64.powi(32)).floor() / 2f64.powi(32));
            }
        }
    }
}

/// Every aligned block of 2^k indices becomes an aligned block of 2^k indices, and the order is another for another seed.
#[test]
fn shuffling_permutes_aligned_blocks() {
    for seed in [0, 7] {
        for (k, block) in [(0, 5), (3, 0), (3, 9), (10, 3)] {
            let mut images: Vec<_> =
                (block << k..(block + 1) << k).map(|index| shuffled(index, seed)).collect();
            images.sort_unstable();
            let first = images[0] >> k << k;
            assert!(images.iter().zip(first..).all(|(&image, wanted)| image == wanted), "{seed} {k} {block}");
        }
    }
    assert_ne!([0, 1, 2, 3].map(|index| shuffled(index, 0)), [0, 1, 2, 3].map(|index| shuffled(index, 7)));
}

#[test]
#[should_panic(expected = "out of bounds")]
fn dimensions_beyond_the_table_are_refused() {
    sobol(1, SOBOL_DIMS);
}
