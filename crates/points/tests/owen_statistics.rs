//! The statistical proof that hashed Owen scrambling behaves like the exact one:
//! `cargo test --release -p evenlight-points --features statistics --test owen_statistics -- --nocapture`.
//!
//! Two experiments. Root mean squared errors of five integrands for n = 2^4 … 2^14, against those of `owen_exact` and, for the
//! linear one, against theory; and the gain coefficients of all products of digits up to the eighth in three dimensions, against the
//! formula of A. B. Owen, *Monte Carlo variance of scrambled net quadrature*, SIAM J. Numer. Anal. 34 (1997). The hash of S. Laine
//! and T. Karras with the constants of B. Burley (2020), which is nested but not uniform, must fail both: they can tell.
//!
//! Deviations are in standard errors, which come from the replicates; seeds are fixed. Five of them are exceeded once in
//! 1.7 million times, and there are at most a few thousand comparisons.
#![cfg(feature = "statistics")]
#![expect(clippy::print_stdout, reason = "the measured errors are worth reading")]

mod replicates;

use evenlight_points::convert::unit_f64;
use evenlight_points::digital_net::DigitalNet;
use evenlight_points::scramble::Randomization;
use evenlight_points::scramble::owen::nested_uniform_scramble_32;
use evenlight_points::sequences::sobol::sobol;
use evenlight_points::{PointSet, Seed};
use replicates::{DIMS, Mean, SquaredErrors, deviation};

/// What scrambles the points of a net.
#[derive(Clone, Copy)]
enum Scramble {
    Ours(Randomization),
    /// A hash of 32 bits; the rest puts points in the middle of their cells.
    Hash32(fn(word: u32, seed: u32) -> u32),
}

const EXACT: Scramble = Scramble::Ours(Randomization::OwenExact);
const OWEN: Scramble = Scramble::Ours(Randomization::Owen);
const OWEN_32: Scramble = Scramble::Hash32(nested_uniform_scramble_32);
const WEAK: Scramble = Scramble::Hash32(laine_karras);

/// The hash that is not uniform.
fn laine_karras(word: u32, seed: u32) -> u32 {
    let x = word.reverse_bits().wrapping_add(seed);
    let factors = [0x6c50_b47c, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6_u32];
    factors.into_iter().fold(x, |x, factor| x ^ x.wrapping_mul(factor)).reverse_bits()
}

/// The first rows of Sobol' points, and how to scramble them.
struct Net {
    plain: DigitalNet,
    scrambled: Box<dyn PointSet>,
    scramble: Scramble,
}

impl Net {
    fn new(scramble: Scramble) -> Self {
        let build = |randomization| sobol(DIMS, randomization, Seed::new(0));
        let scrambled = match scramble {
            Scramble::Ours(randomization) => build(randomization),
            Scramble::Hash32(_) => build(Randomization::None),
        };
        Self { plain: build(Randomization::None), scrambled: Box::new(scrambled), scramble }
    }

    /// Calls `look` with `n` rows of each of some replicates.
    fn replicates(&self, n: usize, seeds: impl Iterator<Item = Seed>, mut look: impl FnMut(&[f64])) {
        let words: Vec<_> = (0..n * DIMS).map(|i| self.plain.word((i / DIMS) as u64, i % DIMS)).collect();
        let mut rows = vec![0.0; n * DIMS];
        for seed in seeds {
            match self.scramble {
                Scramble::Ours(_) => self.scrambled.reseeded(seed).fill(0..n as u64, &mut rows),
                Scramble::Hash32(hash) => {
                    let keys: [_; DIMS] = std::array::from_fn(|dim| seed.dimension(dim as u64).bits32());
                    for (i, (x, word)) in rows.iter_mut().zip(&words).enumerate() {
                        *x = unit_f64(u64::from(hash((word >> 32) as u32, keys[i % DIMS])) << 32 | 1 << 31);
                    }
                }
            }
            look(&rows);
        }
    }
}

/// The mean squared errors of the integrands over at least 512 replicates.
fn squared_errors(scramble: Scramble, m: u32, stream: u64) -> SquaredErrors {
    let n = 1_usize << m;
    let replicates = ((1 << 23) / n as u64).min(8192);
    let seeds = (0..replicates).map(|r| Seed::new(stream).split(20, m.into()).replicate(r));
    let mut errors = SquaredErrors::default();
    Net::new(scramble).replicates(n, seeds, |rows| errors.add(rows));
    errors
}

/// The largest deviations of the mean squared errors: from those of the exact scramble, and from theory.
fn errors_deviate(scramble: Scramble) -> (f64, f64) {
    let (mut from_exact, mut from_theory) = (0.0_f64, 0.0_f64);
    for m in 4..=14 {
        let (ours, exact) = (squared_errors(scramble, m, 1), squared_errors(EXACT, m, 2));
        from_exact = from_exact.max(ours.deviation(&exact, &format!("n = 2^{m}")));
        let of_theory = [ours, exact].map(|errors| errors.deviation_of_sum(1 << m));
        from_theory = of_theory.into_iter().fold(from_theory, f64::max);
    }
    (from_exact, from_theory)
}

#[test]
fn errors_of_the_hash_are_those_of_the_exact_scramble() {
    let (from_exact, from_theory) = errors_deviate(OWEN);
    assert!(from_exact < 5.0 && from_theory < 5.0, "{from_exact}, {from_theory}");
}

#[test]
fn errors_of_the_short_hash_are_those_of_the_exact_scramble() {
    let (from_exact, from_theory) = errors_deviate(OWEN_32);
    assert!(from_exact < 5.0 && from_theory < 5.0, "{from_exact}, {from_theory}");
}

#[test]
fn errors_of_a_weak_hash_are_others() {
    let (from_exact, from_theory) = errors_deviate(WEAK);
    assert!(from_exact > 10.0 && from_theory > 10.0, "{from_exact}, {from_theory}");
}

/// Points of a net whose gain coefficients are looked at: as many as a word has bits.
const POINTS: usize = 64;

/// Levels of digits, two more than the net resolves, in as many dimensions.
const LEVELS: usize = 8;
const AXES: usize = 3;

/// A product of digits: for each axis none, or the level of one.
type Product = [Option<usize>; AXES];

/// All products but the empty one.
fn products() -> impl Iterator<Item = Product> {
    let digit = |code: usize, axis: u32| (code / (LEVELS + 1).pow(axis) % (LEVELS + 1)).checked_sub(1);
    (1..(LEVELS + 1).pow(AXES as u32)).map(move |code| [0, 1, 2].map(|axis| digit(code, axis)))
}

/// The gain coefficient of a product by its formula, from all pairs of points.
fn gain(net: &DigitalNet, product: Product) -> f64 {
    let same = |a: u64, b: u64, digits: usize| i64::from((a ^ b).leading_zeros() as usize >= digits);
    let factor = |i, k, axis, level| {
        let (a, b) = (net.word(i, axis), net.word(k, axis));
        2 * same(a, b, level + 1) - same(a, b, level)
    };
    let pair = |i, k| (0..AXES).filter_map(|axis| Some(factor(i, k, axis, product[axis]?))).product::<i64>();
    let n = POINTS as u64;
    let sum: i64 = (0..n).flat_map(|i| (0..n).map(move |k| (i, k))).map(|(i, k)| pair(i, k)).sum();
    sum as f64 / n as f64
}

/// Bit i of word [axis][level]: that digit of point i, alone or added to all digits before it.
fn digits(rows: &[f64], cumulated: bool) -> [[u64; LEVELS]; AXES] {
    let mut words = [[0; LEVELS]; AXES];
    for (i, row) in rows.chunks_exact(DIMS).enumerate() {
        for (words, x) in words.iter_mut().zip(row) {
            let leading = (x * 2f64.powi(LEVELS as i32)) as u64;
            for (level, word) in words.iter_mut().enumerate() {
                let digits = leading >> (LEVELS - 1 - level);
                *word |= u64::from(if cumulated { digits.count_ones() & 1 } else { digits as u32 & 1 }) << i;
            }
        }
    }
    words
}

/// The largest deviation of estimated gain coefficients from the formula. The estimate is n times the mean square of the mean of
/// the product of digits ±1: with one digit of each axis, or with the sum of all digits to that level, which has the same gain.
fn gains_deviate(scramble: Scramble, stream: u64) -> f64 {
    let net = Net::new(scramble);
    let all: Vec<_> = products().collect();
    let mut estimates = vec![[Mean::default(); 2]; all.len()];
    net.replicates(POINTS, (0..20_000).map(|r| Seed::new(stream).replicate(r)), |rows| {
        for (kind, words) in [false, true].map(|cumulated| digits(rows, cumulated)).iter().enumerate() {
            for (estimate, product) in estimates.iter_mut().zip(&all) {
                let chosen = words.iter().zip(product).filter_map(|(words, level)| Some(words[(*level)?]));
                let odd = chosen.fold(0, |sum, word| sum ^ word).count_ones();
                let sum = POINTS as f64 - 2.0 * f64::from(odd);
                estimate[kind].add(sum * sum / POINTS as f64);
            }
        }
    });
    let z = all.iter().zip(estimates).flat_map(|(&product, estimates)| {
        let gain = gain(&net.plain, product);
        estimates.map(|estimate| deviation(estimate.value() - gain, estimate.variance()))
    });
    let worst = z.fold(0.0, f64::max);
    println!("{} products: {worst:.1} standard errors at most", 2 * all.len());
    worst
}

/// Z. Pan and A. B. Owen (2023): the gains of a digital net in base 2 are 0 or powers of 2, at most 2^(t + s − 1), here with t = 1.
#[test]
fn gains_are_powers_of_two() {
    let net = Net::new(EXACT).plain;
    let mut gains: Vec<_> = products().map(|product| gain(&net, product)).collect();
    gains.sort_by(f64::total_cmp);
    gains.dedup();
    assert!(gains.iter().all(|&gain| [0.0, 1.0, 2.0, 4.0, 8.0].contains(&gain)), "{gains:?}");
    assert!(gains.len() > 2, "{gains:?}");
}

/// Among 1,456 estimates of an exact scramble, the largest deviation exceeds 5.5 once in ten thousand seeds.
#[test]
fn gains_are_those_of_theory() {
    let linear = Scramble::Ours(Randomization::Linear);
    for (stream, scramble) in (1..).zip([EXACT, OWEN, OWEN_32, linear]) {
        let worst = gains_deviate(scramble, stream);
        assert!(worst < 5.5, "scramble {stream}: {worst}");
    }
}

#[test]
fn gains_of_a_weak_hash_are_others() {
    let worst = gains_deviate(WEAK, 5);
    assert!(worst > 50.0, "{worst}");
}

#[test]
fn the_weak_hash_is_the_published_one() {
    assert_eq!(laine_karras(0, 0xdead_beef), 0xd543_8bf7);
    assert_eq!(laine_karras(0x8000_0000, 0xdead_beef), 0x0d5e_1e4c);
    assert_eq!(laine_karras(0x1234_5678, 0x9e37_79b9), 0xa61c_7925);
}
