//! The points of a lattice by their denominators, and the group that moves them about.
//!
//! The points k/n of a lattice with n = 2^m are 0 and, for each denominator 2^t up to n, all odd k over it. A generator
//! z, odd, takes k to k z modulo 2^t: it acts as an element of the group of odd numbers modulo 2^t, which are ± the powers
//! of 5. All our ω are even, so that the powers of 5 are enough: a cyclic group of 2^(t - 2) elements, and the group of a
//! level is that of the next one reduced. For n prime there are 0 and the powers of a primitive root. For polynomials
//! modulo x^t the group of those with a constant term has 2^(t - 1) elements, products of 1 + x^i to the power of the
//! i-th digit; because (1 + x^i)² = 1 + x^2i, digits carry from place i to place 2i.

use super::transform::{Complex, Transform};
use crate::quality::lattice_criteria::Space;

/// All levels of a lattice, from the point 0 on.
#[derive(Debug)]
pub(super) struct Levels {
    group: Group,
    all: Vec<Level>,
    /// Elements of the group of the last level.
    units: Vec<u32>,
    transform: Transform,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Group {
    PowersOfTwo,
    Prime(u64),
    Polynomials,
}

/// The points of one denominator.
#[derive(Debug)]
struct Level {
    /// The number of points of the lattice of this level and all before.
    n: u64,
    /// How many points there are for each element of the group: 2 if only one of k and −k is there.
    multiplicity: f64,
    /// ω of each element of the group.
    omega: Vec<f64>,
    /// Its transform, over the order of the group; empty for the trivial group.
    spectrum: Complex,
}

impl Levels {
    /// n = 2^m, m at most 30.
    pub(super) fn powers_of_two(m: u32, space: Space) -> Self {
        let mut powers = std::iter::successors(Some(1_u32), |k| Some(k.wrapping_mul(5)));
        let mask = (1_u64 << m) - 1;
        let units = powers.by_ref().take(1 << m.saturating_sub(2)).map(|k| k & mask as u32).collect();
        let transform = Transform::new(m.saturating_sub(2), |bit| bit.checked_sub(1));
        let sizes = (0..=m).map(|t| (1 << t, 1 << t.saturating_sub(2), if t < 2 { 1.0 } else { 2.0 }));
        Self::new(Group::PowersOfTwo, units, transform, (space, sizes.collect()))
    }

    /// n an odd prime below 2^31.
    pub(super) fn prime(n: u64, space: Space) -> Self {
        let (root, half) = (primitive_root(n), (n - 1) / 2);
        let powers = std::iter::successors(Some(1), |k| Some(k * root % n));
        let units = powers.take(half as usize).map(|k| k as u32).collect();
        // Padded with zeros, sums over the whole group are sums over a larger one whose order is a power of 2.
        let transform = Transform::new((2 * half).next_power_of_two().ilog2(), |bit| bit.checked_sub(1));
        let sizes = vec![(1, 1, 1.0), (n, half as usize, 2.0)];
        Self::new(Group::Prime(n), units, transform, (space, sizes))
    }

    /// Polynomials over {0, 1} modulo x^m, m at most 24.
    pub(super) fn polynomials(m: u32) -> Self {
        let mask = (1_u64 << m) - 1;
        let mut units = vec![1];
        for i in 1..m {
            let factor = |unit: &u32| (u64::from(*unit) ^ (u64::from(*unit) << i)) & mask;
            units.extend(units.clone().iter().map(|unit| factor(unit) as u32));
        }
        let transform = Transform::new(m.saturating_sub(1), |bit| (bit % 2 == 1).then_some(bit / 2));
        let sizes = (0..=m).map(|t| (1 << t, 1 << t.saturating_sub(1), 1.0)).collect();
        Self::new(Group::Polynomials, units, transform, (Space::Walsh, sizes))
    }

    fn new(
        group: Group,
        units: Vec<u32>,
        transform: Transform,
        (space, sizes): (Space, Vec<(u64, usize, f64)>),
    ) -> Self {
        let mut levels = Self { group, all: vec![], units, transform };
        for (n, size, multiplicity) in sizes {
            let place = |unit: &u32| if n == 1 { 0.0 } else { (u64::from(*unit) % n) as f64 / n as f64 };
            let omega: Vec<_> = levels.units[..size].iter().map(|unit| space.omega(place(unit))).collect();
            let spectrum = levels.spectrum(&omega);
            levels.all.push(Level { n, multiplicity, omega, spectrum });
        }
        levels
    }

    fn spectrum(&self, omega: &[f64]) -> Complex {
        if omega.len() == 1 {
            return [vec![], vec![]];
        }
        let order = self.order(omega.len());
        let mut re: Vec<_> = omega.iter().cycle().take(order).copied().collect();
        let mut im = vec![0.0; order];
        self.transform.forward(&mut re, &mut im);
        re.iter_mut().chain(&mut im).for_each(|part| *part /= order as f64);
        [re, im]
    }

    /// The order of the group in which a level of this size is transformed.
    fn order(&self, size: usize) -> usize {
        if let Group::Prime(_) = self.group { (2 * size).next_power_of_two() } else { size }
    }

    /// The last level.
    pub(super) fn top(&self) -> usize {
        self.all.len() - 1
    }

    /// The number of points of the lattice that ends with this level.
    pub(super) fn points(&self, level: usize) -> u64 {
        self.all[level].n
    }

    /// The number of candidates that this level tells apart.
    pub(super) fn size(&self, level: usize) -> usize {
        self.all[level].omega.len()
    }

    /// The generator of a candidate; the smaller of two that differ in sign.
    pub(super) fn generator(&self, candidate: usize) -> u64 {
        let (unit, n) = (u64::from(self.units[candidate]), self.points(self.top()));
        if self.group == Group::Polynomials { unit } else { unit.min(n - unit).max(1) }
    }

    /// For two functions on the points of a level: the sums of function times ω, moved by every candidate.
    pub(super) fn correlate(&self, level: usize, functions: [&[f64]; 2]) -> [Vec<f64>; 2] {
        let Level { multiplicity, omega, spectrum, .. } = &self.all[level];
        if omega.len() == 1 {
            return functions.map(|function| vec![multiplicity * function[0] * omega[0]]);
        }
        let order = spectrum[0].len();
        let padded = |function: &[f64], sign| {
            function.iter().map(|x| sign * x).chain(std::iter::repeat(0.0)).take(order).collect::<Vec<_>>()
        };
        let (mut re, mut im) = (padded(functions[0], *multiplicity), padded(functions[1], -multiplicity));
        self.transform.forward(&mut re, &mut im);
        let parts = re.iter_mut().zip(&mut im).zip(spectrum[0].iter().zip(&spectrum[1]));
        for ((re, im), (a, b)) in parts {
            (*re, *im) = (*re * a + *im * b, *re * b - *im * a);
        }
        self.transform.inverse(&mut re, &mut im);
        re.truncate(omega.len());
        im.truncate(omega.len());
        [re, im]
    }

    /// Multiplies a function on the points of a level by 1 + γ ω, moved by a candidate.
    pub(super) fn multiply(&self, level: usize, candidate: usize, weight: f64, function: &mut [f64]) {
        let omega = &self.all[level].omega;
        let candidate = candidate % omega.len();
        if self.group != Group::Polynomials {
            let (before, after) = omega.split_at(candidate);
            let moved = after.iter().chain(before);
            function.iter_mut().zip(moved).for_each(|(x, omega)| *x *= 1.0 + weight * omega);
            return;
        }
        let (products, mask) = (products_with(self.units[candidate]), self.points(level) as u32 - 1);
        for (x, unit) in function.iter_mut().zip(&self.units) {
            let [low, middle, high, _] = (unit & mask).to_le_bytes().map(usize::from);
            let product = (products[0][low] ^ products[1][middle] ^ products[2][high]) & mask;
            let place = f64::from(product) / self.points(level) as f64;
            *x *= 1.0 + weight * Space::Walsh.omega(place);
        }
    }
}

/// The products without carry of a number with every value of each of three bytes.
fn products_with(unit: u32) -> [[u32; 256]; 3] {
    std::array::from_fn(|byte| {
        std::array::from_fn(|value| {
            (0..8).filter(|bit| value >> bit & 1 == 1).fold(0, |sum, bit| sum ^ (unit << (8 * byte + bit)))
        })
    })
}

/// The least primitive root of a prime.
fn primitive_root(n: u64) -> u64 {
    let mut factors = vec![];
    let mut rest = n - 1;
    for divisor in (2..).take_while(|divisor| divisor * divisor < n) {
        if rest.is_multiple_of(divisor) {
            factors.push(divisor);
            while rest.is_multiple_of(divisor) {
                rest /= divisor;
            }
        }
    }
    factors.extend((rest > 1).then_some(rest));
    let primitive = |g: &u64| factors.iter().all(|factor| power(*g, (n - 1) / factor, n) != 1);
    (2..n).find(primitive).unwrap_or(1)
}

fn power(mut base: u64, mut exponent: u64, n: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * base % n;
        }
        (base, exponent) = (base * base % n, exponent >> 1);
    }
    result
}
