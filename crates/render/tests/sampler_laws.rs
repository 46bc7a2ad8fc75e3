//! Laws that every sampler obeys, and the nets that some of them promise.
//!
//! Statistical limits: a chi-square of 15 degrees of freedom exceeds 68.0 once in 10^8 trials, a normal deviate 6 once in
//! 5 · 10^8. Fewer than 2,000 are looked at, all from fixed seeds: a failure is a fault, not bad luck.

use std::collections::HashSet;

use evenlight_points::Seed;
use evenlight_render::sampler::{self, BLOCK, Entry, PathNumbers};

const CHI_SQUARE_LIMIT: f64 = 68.0;
const NORMAL_LIMIT: f64 = 6.0;

/// The numbers of a block.
fn block(sampler: &Entry, key: Seed, index: u32, block: u32) -> [f32; BLOCK] {
    let mut numbers = [0.0; BLOCK];
    (sampler.fill)(key, index, block, &mut numbers);
    numbers
}

/// Keys of many pixels.
fn pixels(count: u32) -> impl Iterator<Item = Seed> {
    (0..count).map(|i| Seed::new(11).replicate(2).pixel(i % 97, i / 97))
}

/// The cell of a number if the unit interval is cut into `count`; exact, as the numbers have 24 bits.
fn cell(number: f32, count: u32) -> u32 {
    (f64::from(number) * f64::from(count)) as u32
}

#[test]
fn numbers_are_at_least_0_and_below_1() {
    for sampler in sampler::ALL {
        for key in pixels(50) {
            for index in (0..70).chain([65_535, 65_536, u32::MAX - 1, u32::MAX]) {
                for number in [0, 1, 63, 64, u32::MAX / 16].map(|b| block(sampler, key, index, b)).concat() {
                    assert!((0.0..1.0).contains(&number), "{}: {number}", sampler.name);
                }
            }
        }
    }
}

#[test]
fn a_path_reads_the_same_numbers_in_any_order() {
    let read = |numbers: &mut PathNumbers, (index, depth): (u32, Option<u32>)| {
        numbers.start(index);
        match depth {
            None => format!("{:?}", numbers.camera()),
            Some(depth) => format!("{:?}", numbers.bounce(depth)),
        }
    };
    for sampler in sampler::ALL {
        let places = (0..5).flat_map(|index| (0..9).map(move |d: u32| (index * 1000, d.checked_sub(1))));
        let mut places: Vec<_> = places.collect();
        let key = Seed::new(5).pixel(3, 4);
        let numbers = &mut PathNumbers::new(sampler, key);
        let forward: Vec<_> = places.iter().map(|&place| read(numbers, place)).collect();
        assert_eq!(forward.iter().collect::<HashSet<_>>().len(), forward.len(), "{}", sampler.name);
        places.reverse();
        let backward: Vec<_> = places.iter().map(|&place| read(numbers, place)).collect();
        assert!(forward.iter().eq(backward.iter().rev()), "{}", sampler.name);
        // and within one sample, without starting anew
        numbers.start(2000);
        let late = format!("{:?}", numbers.bounce(6));
        numbers.camera();
        numbers.bounce(1);
        assert_eq!(format!("{:?}", numbers.bounce(6)), late, "{}", sampler.name);
    }
}

#[test]
fn every_dimension_is_uniform() {
    const CELLS: u32 = 16;
    const PIXELS: u32 = 4096;
    for sampler in sampler::ALL {
        for (index, number) in [(0, 0), (0, 1), (5, 0), (77_777, 3)] {
            let mut counts = [[0_u32; CELLS as usize]; BLOCK];
            for key in pixels(PIXELS) {
                for (counts, x) in counts.iter_mut().zip(block(sampler, key, index, number)) {
                    counts[cell(x, CELLS) as usize] += 1;
                }
            }
            let wanted = f64::from(PIXELS / CELLS);
            for (dimension, counts) in counts.iter().enumerate() {
                let squares = counts.iter().map(|&n| (f64::from(n) - wanted).powi(2) / wanted);
                let chi_square: f64 = squares.sum();
                assert!(chi_square < CHI_SQUARE_LIMIT, "{} {index} {dimension}: {chi_square}", sampler.name);
            }
        }
    }
}

/// Products of centered numbers, summed over pixels, whose keys and places differ.
fn correlation(sampler: &Entry, count: u32, pair: impl Fn(Seed) -> [(Seed, u32, u32, usize); 2]) -> f64 {
    let sum: f64 = pixels(count)
        .map(|pixel| {
            let read = |(key, index, number, dimension): (Seed, u32, u32, usize)| {
                f64::from(block(sampler, key, index, number)[dimension]) - 0.5
            };
            pair(pixel).map(read).iter().product::<f64>() * 12.0
        })
        .sum();
    sum / f64::from(count).sqrt()
}

#[test]
fn pixels_replicates_and_groups_of_dimensions_are_unrelated() {
    for sampler in sampler::ALL {
        for dimension in 0..BLOCK {
            let other = (dimension + 4) % BLOCK; // of another group, and with another prime
            let deviates = [
                correlation(sampler, 4000, |key| {
                    [(key, 3, 0, dimension), (key.pixel(1, 0), 3, 0, dimension)]
                }),
                correlation(sampler, 4000, |key| {
                    [(key, 0, 0, dimension), (key.replicate(1), 0, 0, dimension)]
                }),
                correlation(sampler, 4000, |key| [(key, 6, 0, dimension), (key, 6, 1, dimension)]),
                correlation(sampler, 4000, |key| [(key, 9, 1, dimension), (key, 9, 1, other)]),
                correlation(sampler, 4000, |key| [(key, 2, 0, dimension), (key, 1, 0, other)]),
            ];
            for (law, deviate) in deviates.iter().enumerate() {
                assert!(deviate.abs() < NORMAL_LIMIT, "{} {dimension} {law}: {deviate}", sampler.name);
            }
        }
    }
}

/// Points of a block in the dimensions `from ..`, for a run of indices.
fn run<const D: usize>(
    entry: &Entry,
    key: Seed,
    indices: std::ops::Range<u32>,
    from: usize,
) -> Vec<[f32; D]> {
    let number = |index| block(entry, key, index, (from / BLOCK) as u32);
    indices.map(|index| std::array::from_fn(|dimension| number(index)[from % BLOCK + dimension])).collect()
}

/// Whether each of the boxes with `base^digits[j]` cuts along axis j has one point.
fn fills_boxes<const D: usize>(points: &[[f32; D]], base: u32, digits: [u32; D]) -> bool {
    let boxes = points.iter().map(|point| std::array::from_fn(|j| cell(point[j], base.pow(digits[j]))));
    boxes.collect::<HashSet<[u32; D]>>().len() == points.len()
}

#[test]
fn pairs_of_sobol_are_nets_in_base_two() {
    let sobol = sampler::by_name("sobol").expect("a known name");
    for (key, pair) in pixels(3).zip([0, 5, 17]) {
        for (k, start) in (0..=9_u32).flat_map(|k| [0, 1 << k, 7 << k, 1 << 16].map(|start| (k, start))) {
            let points = run::<2>(sobol, key, start..start + (1 << k), 2 * pair);
            for first in 0..=k {
                assert!(fills_boxes(&points, 2, [first, k - first]), "{pair} {start} 2^{first} of 2^{k}");
            }
        }
    }
}

/// What pixels of a square share: eight rows of eight with two samples each are 128 points of a net, in each pair.
#[test]
fn squares_of_pixels_share_nets_of_zsobol() {
    let zsobol = sampler::by_name("zsobol").expect("a known name");
    let replicate = Seed::new(4).replicate(1);
    for (pair, left, top) in [(0, 0, 0), (1, 8, 16), (5, 1024, 40)] {
        let mut points = Vec::new();
        for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (left + x, top + y))) {
            let (key, first) = zsobol.pixel(replicate, [x, y], 2);
            points.extend(run::<2>(zsobol, key, first..first + 2, 2 * pair));
        }
        for first in 0..=7 {
            assert!(fills_boxes(&points, 2, [first, 7 - first]), "{pair} {left} {top} {first}");
        }
    }
    let (a, b) = (zsobol.pixel(replicate, [65_535, 0], 1).1, zsobol.pixel(replicate, [0, 65_535], 1).1);
    assert_eq!([a, b], [0x5555_5555, 0xaaaa_aaaa]);
    assert!(zsobol.check([65_536, 10], 1).is_ok());
    let message = zsobol.check([65_536, 10], 2).expect_err("too many samples").to_string();
    assert!(message.contains("65536 x 10 pixels with 2 samples"), "{message}");
}

#[test]
fn quadruples_of_sobol_are_nets_in_base_four() {
    let sobol = sampler::by_name("sobol").expect("a known name");
    for (key, quadruple) in pixels(3).zip([0, 3, 6]) {
        for (k, start) in (0..=4_u32).flat_map(|k| [0, 3 << (2 * k), 1 << 16].map(|start| (k, start))) {
            let points = run::<4>(sobol, key, start..start + (1 << (2 * k)), 4 * quadruple);
            for code in 0..(k + 1).pow(3) {
                let [a, b, c] = [code % (k + 1), code / (k + 1) % (k + 1), code / (k + 1).pow(2)];
                let Some(d) = k.checked_sub(a + b + c) else { continue };
                assert!(fills_boxes(&points, 4, [a, b, c, d]), "{quadruple} {start} {a} {b} {c} {d}");
            }
        }
    }
}

#[test]
fn each_dimension_of_halton_is_stratified_by_its_prime() {
    let halton = sampler::by_name("halton").expect("a known name");
    for (dimension, prime) in [2_u32, 3, 5, 7, 11, 13, 17, 19].into_iter().enumerate() {
        for (k, key) in (0_u32..).zip(pixels(20)).take_while(|&(k, _)| prime.pow(k) < 3000) {
            let points = run::<1>(halton, key, 0..prime.pow(k), dimension);
            // numbers have 24 bits, so that one close to the edge of its box may be rounded into the next
            let boxes = points.iter().map(|[x]| cell(*x + 1e-7, prime.pow(k)));
            let found = boxes.collect::<HashSet<_>>().len();
            assert!(found + 1 >= points.len(), "{prime}^{k}: {found}");
        }
    }
}
