//! The statistical proof that `owen` behaves like `owen_exact` in other bases than 2 as well:
//! `cargo test --release -p evenlight-points --features statistics --test radix_owen_statistics -- --nocapture`.
//!
//! The two experiments of `owen_statistics.rs`. Root mean squared errors of five integrands against those of `owen_exact`, for
//! Faure's points in base 5, Niederreiter's in base 3 and Halton's; and the gain coefficients of products of functions of single
//! digits in three dimensions, against the formula of A. B. Owen, *Monte Carlo variance of scrambled net quadrature*, SIAM J. Numer.
//! Anal. 34 (1997). Two weaker scrambles must fail both: a hash by multiplication and addition of the reversed digits as a number,
//! which is what the hash of S. Laine and T. Karras is in base 2; and well hashed shifts of digits where permutations are needed.
//!
//! Deviations are in standard errors, which come from the replicates; seeds are fixed. Five of them are exceeded once in
//! 1.7 million times, and there are at most a few thousand comparisons.
#![cfg(feature = "statistics")]
#![expect(clippy::print_stdout, reason = "the measured errors are worth reading")]

mod replicates;

use std::f64::consts::{SQRT_2, TAU};

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Options, Spec};
use evenlight_points::{PointSet, Seed};
use replicates::{DIMS, Mean, SquaredErrors, deviation};

/// What scrambles the points of a net.
#[derive(Clone, Copy)]
enum Scramble {
    Ours(Randomization),
    /// Replaces the digits of one coordinate, the first of them first.
    Weak(fn(digits: &mut [u64], base: u64, key: Seed)),
}

const EXACT: Scramble = Scramble::Ours(Randomization::OwenExact);
const OWEN: Scramble = Scramble::Ours(Randomization::Owen);
const CONGRUENTIAL: Scramble = Scramble::Weak(congruential);
const SHIFTING: Scramble = Scramble::Weak(shifting);

/// Digits that a weak scramble looks at.
const DIGITS: usize = 12;

/// x ↦ a (x + c) of the number whose least significant digit is the first: information only travels upwards. With a random a this
/// would be exact in pairs of points; a hash has it fixed.
fn congruential(digits: &mut [u64], base: u64, key: Seed) {
    let number = digits.iter().rev().fold(0, |number, digit| number * base + digit);
    let mut image = u128::from(number + (key.bits64() >> 32)) * 0x5851_f42d;
    for digit in digits {
        *digit = (image % u128::from(base)) as u64;
        image /= u128::from(base);
    }
}

/// Adds a random digit to every digit, one of its own at every node of the tree of digits.
fn shifting(digits: &mut [u64], base: u64, mut node: Seed) {
    for digit in digits {
        let below = node.split(20, *digit);
        *digit = (*digit + node.bits64() % base) % base;
        node = below;
    }
}

/// Four coordinates of a sequence, by its name and base; Halton's have their own.
#[derive(Clone, Copy)]
struct Sequence(&'static str, Option<u32>);

const FAURE: Sequence = Sequence("faure", Some(5));

impl Sequence {
    fn build(self, randomization: Randomization) -> Box<dyn PointSet> {
        let Self(name, base) = self;
        let options = Options { base, ..Options::default() };
        sequences::build(name, &Spec { options, ..Spec::new(DIMS, randomization, Seed::new(0)) })
            .expect("valid")
    }

    /// Calls `look` with `n` rows of each of some replicates.
    fn replicates(
        self,
        scramble: Scramble,
        n: usize,
        seeds: impl Iterator<Item = Seed>,
        mut look: impl FnMut(&[f64]),
    ) {
        let points = self.build(if let Scramble::Ours(ours) = scramble { ours } else { Randomization::None });
        let mut rows = vec![0.0; n * DIMS];
        points.fill(0..n as u64, &mut rows);
        let plain = rows.clone();
        for seed in seeds {
            match scramble {
                Scramble::Ours(_) => points.reseeded(seed).fill(0..n as u64, &mut rows),
                Scramble::Weak(apply) => {
                    for (i, (x, &plain)) in rows.iter_mut().zip(&plain).enumerate() {
                        let base = self.1.map_or([2, 3, 5, 7][i % DIMS], u64::from);
                        let mut digits: Vec<_> = digits(plain, base).take(DIGITS).collect();
                        apply(&mut digits, base, seed.dimension((i % DIMS) as u64));
                        // the middle of the cell
                        *x = digits.iter().rev().fold(0.5, |x, &digit| (digit as f64 + x) / base as f64);
                    }
                }
            }
            look(&rows);
        }
    }
}

/// The digits of a coordinate, of whose rounding down nothing remains.
fn digits(x: f64, base: u64) -> impl Iterator<Item = u64> {
    let mut rest = x + 1e-13;
    std::iter::from_fn(move || {
        let scaled = rest * base as f64;
        rest = scaled.fract();
        Some(scaled as u64)
    })
}

/// The mean squared errors of the integrands over at least 512 replicates.
fn squared_errors(sequence: Sequence, scramble: Scramble, n: usize, stream: u64) -> SquaredErrors {
    let replicates = ((1 << 20) / n as u64).clamp(512, 4096);
    let seeds = (0..replicates).map(|r| Seed::new(stream).split(20, n as u64).replicate(r));
    let mut errors = SquaredErrors::default();
    sequence.replicates(scramble, n, seeds, |rows| errors.add(rows));
    errors
}

/// The largest deviation of the mean squared errors from those of the exact scramble, and for Faure's points from theory.
fn errors_deviate(sequence: Sequence, scramble: Scramble, counts: &[usize]) -> f64 {
    let mut worst = 0.0_f64;
    for &n in counts {
        let (ours, exact) = (squared_errors(sequence, scramble, n, 1), squared_errors(sequence, EXACT, n, 2));
        worst = worst.max(ours.deviation(&exact, &format!("{}, n = {n}", sequence.0)));
        if sequence.0 == "faure" {
            worst = worst.max(ours.deviation_of_sum(n as u64)).max(exact.deviation_of_sum(n as u64));
        }
    }
    worst
}

#[test]
fn errors_of_the_hash_are_those_of_the_exact_scramble() {
    let cases: [(_, &[_]); 3] = [
        (FAURE, &[25, 125, 625, 3125]),
        (Sequence("niederreiter", Some(3)), &[27, 81, 243, 729, 2187, 6561]),
        (Sequence("halton", None), &[30, 210, 1000, 6300]),
    ];
    for (sequence, counts) in cases {
        let worst = errors_deviate(sequence, OWEN, counts);
        assert!(worst < 5.0, "{}: {worst}", sequence.0);
    }
}

#[test]
fn errors_of_weaker_scrambles_are_others() {
    for scramble in [CONGRUENTIAL, SHIFTING] {
        let worst = errors_deviate(FAURE, scramble, &[25, 125, 625]);
        assert!(worst > 10.0, "{worst}");
    }
}

/// Levels of digits whose gain coefficients are looked at, in as many dimensions.
const LEVELS: usize = 5;
const AXES: usize = 3;

/// A product of functions of one digit: for each axis none, or the level of the digit.
type Product = [Option<usize>; AXES];

/// All products but the empty one.
fn products() -> impl Iterator<Item = Product> {
    let digit = |code: usize, axis: u32| (code / (LEVELS + 1).pow(axis) % (LEVELS + 1)).checked_sub(1);
    (1..(LEVELS + 1).pow(AXES as u32)).map(move |code| [0, 1, 2].map(|axis| digit(code, axis)))
}

/// The gain coefficient of a product by its formula, from all pairs of points.
fn gain(plain: &[f64], base: u64, product: Product) -> f64 {
    let digits: Vec<Vec<u64>> = plain.iter().map(|&x| digits(x, base).take(LEVELS + 1).collect()).collect();
    let same = |a: &[u64], b: &[u64], count| f64::from(u8::from(a[..count] == b[..count]));
    let factor = |i: usize, k: usize, axis: usize, level: usize| {
        let (a, b) = (&digits[i * DIMS + axis], &digits[k * DIMS + axis]);
        (base as f64 * same(a, b, level + 1) - same(a, b, level)) / (base - 1) as f64
    };
    let pair = |i, k| (0..AXES).filter_map(|axis| Some(factor(i, k, axis, product[axis]?))).product::<f64>();
    let n = plain.len() / DIMS;
    let sum: f64 = (0..n).flat_map(|i| (0..n).map(move |k| (i, k))).map(|(i, k)| pair(i, k)).sum();
    sum / n as f64
}

/// Functions of mean 0 and variance 1 of one digit of a coordinate, given the digits before: of the digit alone, and of its sum
/// with those before it at twice the frequency. Entry [kind][axis][level][point].
fn functions(rows: &[f64], base: u64) -> [[[Vec<f64>; LEVELS]; AXES]; 2] {
    let mut values: [[[Vec<f64>; LEVELS]; AXES]; 2] = Default::default();
    for row in rows.chunks_exact(DIMS) {
        for axis in 0..AXES {
            let mut sum = 0;
            for (level, digit) in digits(row[axis], base).take(LEVELS).enumerate() {
                sum += digit;
                for (kind, phase) in [digit, 2 * sum].into_iter().enumerate() {
                    let angle = TAU * (phase % base) as f64 / base as f64;
                    values[kind][axis][level].push(SQRT_2 * angle.cos());
                }
            }
        }
    }
    values
}

/// The largest deviation of estimated gain coefficients from the formula: n times the mean square of the mean of the product.
fn gains_deviate(base: u32, n: usize, scramble: Scramble, stream: u64) -> f64 {
    let sequence = Sequence("niederreiter", Some(base));
    let mut plain = vec![0.0; n * DIMS];
    sequence.build(Randomization::None).fill(0..n as u64, &mut plain);
    let all: Vec<_> = products().collect();
    let mut estimates = vec![[Mean::default(); 2]; all.len()];
    let seeds = (0..4000).map(|r| Seed::new(stream).replicate(r));
    sequence.replicates(scramble, n, seeds, |rows| {
        for (kind, values) in functions(rows, base.into()).iter().enumerate() {
            for (estimate, product) in estimates.iter_mut().zip(&all) {
                let mut products = vec![1.0; n];
                for (values, level) in values.iter().zip(product) {
                    let Some(level) = *level else { continue };
                    products.iter_mut().zip(&values[level]).for_each(|(product, value)| *product *= value);
                }
                estimate[kind].add(products.iter().sum::<f64>().powi(2) / n as f64);
            }
        }
    });
    let z = all.iter().zip(estimates).flat_map(|(&product, estimates)| {
        let gain = gain(&plain, base.into(), product);
        // A gain of 0 comes out as the square of some roundings.
        estimates.map(|estimate| deviation(estimate.value() - gain, estimate.variance() + 1e-20))
    });
    let worst = z.fold(0.0, f64::max);
    println!("base {base}, {} products: {worst:.1} standard errors at most", 2 * all.len());
    worst
}

/// Among 430 estimates of an exact scramble, the largest deviation exceeds 5.5 once in fifty thousand seeds.
#[test]
fn gains_are_those_of_theory() {
    let linear = Scramble::Ours(Randomization::Linear);
    for (base, n) in [(3, 81), (5, 125)] {
        for (stream, scramble) in (1..).zip([EXACT, OWEN, linear]) {
            let worst = gains_deviate(base, n, scramble, stream);
            assert!(worst < 5.5, "base {base}, scramble {stream}: {worst}");
        }
    }
}

#[test]
fn gains_of_weaker_scrambles_are_others() {
    for scramble in [CONGRUENTIAL, SHIFTING] {
        let worst = gains_deviate(5, 125, scramble, 4);
        assert!(worst > 20.0, "{worst}");
    }
}
