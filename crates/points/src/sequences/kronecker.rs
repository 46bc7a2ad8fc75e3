//! Kronecker sequences {i α}: any number of points, in natural order, at the speed of memory.
//!
//! By default the sequence `R_d` of M. Roberts: number j of α is φ^-j, with φ > 1 and φ^(d+1) = φ + 1, the golden ratio in one
//! dimension. Good in few dimensions, and at any number of points, not only at powers of something; its numbers
//! depend on d. Beyond some ten dimensions take `lattice` or `sobol`. The option `generator` has other α, as integers
//! ⌊2^64 α⌋; irrational numbers that are badly approximable together are good ones.
//!
//! α has 128 digits (64, if given), so that nothing drifts: the last of 2^64 points is as exact as the first.

use super::{Entry, Spec};
use crate::modular::{Generator, ModularPoints};
use crate::scramble::Randomization;
use crate::{Error, PointSet};

pub(super) const ENTRY: Entry = Entry {
    name: "kronecker",
    cite: "L. Kronecker, Naeherungsweise ganzzahlige Aufloesung linearer Gleichungen (1884), with the numbers of M. \
           Roberts, The unreasonable effectiveness of quasirandom sequences (2018)",
    accepts: Randomization::MODULAR,
    takes: &["generator"],
    most_dims: 1 << 16,
    build,
};

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let alphas = match &spec.options.generator {
        None => golden_ratios(spec.dims),
        Some(words) if words.len() == spec.dims => words.iter().map(|&word| u128::from(word) << 64).collect(),
        Some(words) => {
            let (asked, allowed) = (format!("{} numbers", words.len()), format!("{} numbers", spec.dims));
            return Err(Error::Option { sequence: "kronecker", option: "generator", asked, allowed });
        }
    };
    let generator = Generator::Natural(alphas.into());
    Ok(Box::new(ModularPoints::new(generator, None, spec.randomization, spec.seed)))
}

/// φ^-1, φ^-2, …, φ^-d in units of 2^-128, where φ^(d+1) = φ + 1.
pub fn golden_ratios(dims: usize) -> Vec<u128> {
    // The inverse y is the largest number with y^d (1 + y) ≤ 1.
    let small = |y: u128| {
        let power = (1..dims).fold(y, |power, _| product(power, y));
        power.checked_add(product(power, y)).is_some()
    };
    let inverse = (0..u128::BITS).rev().fold(0, |y, bit| {
        let more = y | 1 << bit;
        if small(more) { more } else { y }
    });
    std::iter::successors(Some(inverse), |power| Some(product(*power, inverse))).take(dims).collect()
}

/// The product of two fractions in units of 2^-128, up to a few of them.
fn product(a: u128, b: u128) -> u128 {
    let ([a0, a1], [b0, b1]) = ([a as u64, (a >> 64) as u64], [b as u64, (b >> 64) as u64]);
    let wide = |x: u64, y: u64| u128::from(x) * u128::from(y);
    let middle = (wide(a0, b0) >> 64) + u128::from(wide(a0, b1) as u64) + u128::from(wide(a1, b0) as u64);
    wide(a1, b1) + (wide(a0, b1) >> 64) + (wide(a1, b0) >> 64) + (middle >> 64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(alpha: u128) -> f64 {
        alpha as f64 / 2f64.powi(128)
    }

    #[test]
    fn the_numbers_are_powers_of_the_root_of_their_polynomial() {
        // The golden ratio, the plastic number, and the next one, as M. Roberts lists them.
        for (dims, phi) in
            [(1, 1.618_033_988_749_895), (2, 1.324_717_957_244_746), (3, 1.220_744_084_605_759_6)]
        {
            for (power, alpha) in (1..).zip(golden_ratios(dims)) {
                assert!((unit(alpha) - f64::powi(phi, -power)).abs() < 1e-15, "{dims} {power}");
            }
        }
        for dims in [1, 2, 5, 64, 1000] {
            let alphas = golden_ratios(dims);
            let (last, next) = (alphas[dims - 1], product(alphas[dims - 1], alphas[0]));
            // y^d + y^(d+1) = 1, to 128 digits less those that d products lose.
            let gap = 0_u128.wrapping_sub(last.wrapping_add(next));
            assert!(gap < 1 << 24, "{dims}: {gap}");
        }
    }

    #[test]
    fn the_golden_ratio_has_all_its_digits() {
        let digits = 0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c834_u128; // of its fraction, in base 16
        assert!(golden_ratios(1)[0].abs_diff(digits) <= 4);
    }
}
