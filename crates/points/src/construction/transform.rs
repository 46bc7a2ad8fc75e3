//! Fourier transforms of finite commutative groups whose order is a power of 2, by one radix-2 loop.
//!
//! Elements are numbers of some bits. To add two elements is to add bits where a carry goes from bit p to a later
//! bit of the group's choosing, or nowhere: to p + 1 in the cyclic group. The loop is that of J. W. Cooley and
//! J. W. Tukey; the group decides on the twiddle factors alone. It is our own because no library has the groups of
//! polynomials, and because elementary operations in a fixed order give the same vectors on every machine.

use std::f64::consts::TAU;

use crate::instruction_sets::for_this_machine;

/// Complex numbers: real parts and imaginary parts.
pub(super) type Complex = [Vec<f64>; 2];

/// From which bit a carry into a bit comes.
pub(super) type Carry = fn(bit: u32) -> Option<u32>;

/// The transforms of all groups of a chain, each the group of the first bits.
#[derive(Debug)]
pub(super) struct Transform {
    /// For each bit p, factors for all numbers of the bits below.
    twiddles: Vec<Complex>,
}

impl Transform {
    pub(super) fn new(bits: u32, carry: Carry) -> Self {
        let table = |bit: u32| {
            let angles = (0..1_u64 << bit).map(|low| -TAU * turn(bit, low, carry));
            let (re, im) = angles.map(|angle| (angle.cos(), angle.sin())).unzip();
            [re, im]
        };
        Self { twiddles: (0..bits).map(table).collect() }
    }

    /// All characters' sums, in an order that only [`Self::inverse`] needs to know.
    pub(super) fn forward(&self, re: &mut [f64], im: &mut [f64]) {
        if re.len() <= SMALL {
            return decimate_all(re, im, &self.twiddles);
        }
        let half = re.len() / 2;
        let ([re, later_re], [im, later_im]) = (halves(re, half), halves(im, half));
        decimate([re, im], [later_re, later_im], &self.twiddles[half.ilog2() as usize]);
        self.forward(re, im);
        self.forward(later_re, later_im);
    }

    /// Undoes [`Self::forward`], but for a factor: the order of the group.
    pub(super) fn inverse(&self, re: &mut [f64], im: &mut [f64]) {
        if re.len() <= SMALL {
            return combine_all(re, im, &self.twiddles);
        }
        let half = re.len() / 2;
        let ([re, later_re], [im, later_im]) = (halves(re, half), halves(im, half));
        self.inverse(re, im);
        self.inverse(later_re, later_im);
        combine([re, im], [later_re, later_im], &self.twiddles[half.ilog2() as usize]);
    }
}

/// The elements whose numbers stay in a first-level cache until they are done.
const SMALL: usize = 1 << 10;

fn halves(numbers: &mut [f64], half: usize) -> [&mut [f64]; 2] {
    numbers.split_at_mut(half).into()
}

/// The part of a turn by which a number of lower bits twiddles a bit: the bits that carry into it are binary digits.
fn turn(bit: u32, low: u64, carry: Carry) -> f64 {
    let (mut turn, mut place, mut from) = (0.0, 0.25, carry(bit));
    while let Some(below) = from {
        turn += place * (low >> below & 1) as f64;
        (place, from) = (place / 2.0, carry(below));
    }
    turn
}

for_this_machine! {
    /// Sums to the first half; differences, twiddled, to the second.
    decimate = decimate_body(first: [&mut [f64]; 2], second: [&mut [f64]; 2], twiddles: &Complex)
}

for_this_machine! {
    /// Undoes [`decimate`], but for a factor of 2.
    combine = combine_body(first: [&mut [f64]; 2], second: [&mut [f64]; 2], twiddles: &Complex)
}

for_this_machine! {
    /// [`decimate`], and the same with both halves, down to single numbers.
    decimate_all = decimate_all_body(re: &mut [f64], im: &mut [f64], twiddles: &[Complex])
}

for_this_machine! {
    /// Undoes [`decimate_all`], but for a factor.
    combine_all = combine_all_body(re: &mut [f64], im: &mut [f64], twiddles: &[Complex])
}

#[inline(always)]
fn decimate_body([re, im]: [&mut [f64]; 2], [later_re, later_im]: [&mut [f64]; 2], [cos, sin]: &Complex) {
    let seconds = later_re.iter_mut().zip(later_im);
    for (((a, b), (c, d)), (cos, sin)) in re.iter_mut().zip(im).zip(seconds).zip(cos.iter().zip(sin)) {
        let (x, y) = (*a - *c, *b - *d);
        (*a, *b) = (*a + *c, *b + *d);
        (*c, *d) = (x * cos - y * sin, x * sin + y * cos);
    }
}

#[inline(always)]
fn combine_body([re, im]: [&mut [f64]; 2], [later_re, later_im]: [&mut [f64]; 2], [cos, sin]: &Complex) {
    let seconds = later_re.iter_mut().zip(later_im);
    for (((a, b), (c, d)), (cos, sin)) in re.iter_mut().zip(im).zip(seconds).zip(cos.iter().zip(sin)) {
        let (x, y) = (*c * cos + *d * sin, *d * cos - *c * sin);
        (*c, *d) = (*a - x, *b - y);
        (*a, *b) = (*a + x, *b + y);
    }
}

#[inline(always)]
fn decimate_all_body(re: &mut [f64], im: &mut [f64], twiddles: &[Complex]) {
    for (bit, twiddles) in twiddles.iter().enumerate().take(re.len().ilog2() as usize).rev() {
        in_blocks(bit, re, im, |first, second| decimate_body(first, second, twiddles));
    }
}

#[inline(always)]
fn combine_all_body(re: &mut [f64], im: &mut [f64], twiddles: &[Complex]) {
    for (bit, twiddles) in twiddles.iter().enumerate().take(re.len().ilog2() as usize) {
        in_blocks(bit, re, im, |first, second| combine_body(first, second, twiddles));
    }
}

/// Calls `work` for the halves of every block of 2^(bit + 1) elements; the compiler unrolls the loops of small blocks.
#[inline(always)]
fn in_blocks(bit: usize, re: &mut [f64], im: &mut [f64], work: impl Fn([&mut [f64]; 2], [&mut [f64]; 2])) {
    match bit {
        0 => in_blocks_of(1, re, im, work),
        1 => in_blocks_of(2, re, im, work),
        2 => in_blocks_of(4, re, im, work),
        3 => in_blocks_of(8, re, im, work),
        _ => in_blocks_of(1 << bit, re, im, work),
    }
}

#[inline(always)]
fn in_blocks_of(
    half: usize,
    re: &mut [f64],
    im: &mut [f64],
    work: impl Fn([&mut [f64]; 2], [&mut [f64]; 2]),
) {
    for (re, im) in re.chunks_exact_mut(2 * half).zip(im.chunks_exact_mut(2 * half)) {
        let ([re, later_re], [im, later_im]) = (halves(re, half), halves(im, half));
        work([re, im], [later_re, later_im]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Elements of the group with these carries, added.
    fn sum(mut a: u64, mut b: u64, bits: u32, carry: Carry) -> u64 {
        while b != 0 {
            let both = a & b;
            a ^= b;
            b = (0..bits)
                .filter(|&bit| carry(bit).is_some_and(|from| both >> from & 1 == 1))
                .map(|bit| 1 << bit)
                .sum();
        }
        a
    }

    /// The correlation by transforms against the sum over all pairs.
    #[test]
    fn transforms_turn_correlations_into_products() {
        let groups: [Carry; 3] =
            [|bit| bit.checked_sub(1), |bit| (bit % 2 == 1).then_some(bit / 2), |_| None];
        for carry in groups {
            let (bits, size) = (6, 64);
            let transform = Transform::new(bits, carry);
            let x: Vec<f64> = (0..size).map(|i| f64::from(i * i % 17)).collect();
            let y: Vec<f64> = (0..size).map(|i| f64::from(i * 7 % 13)).collect();
            let (mut fx, mut fy) = ([x.clone(), vec![0.0; 64]], [y.clone(), vec![0.0; 64]]);
            for [re, im] in [&mut fx, &mut fy] {
                transform.forward(re, im);
            }
            let mut product = [vec![0.0; 64], vec![0.0; 64]];
            for i in 0..64 {
                product[0][i] = fx[0][i] * fy[0][i] + fx[1][i] * fy[1][i];
                product[1][i] = fx[0][i] * fy[1][i] - fx[1][i] * fy[0][i];
            }
            let [re, im] = &mut product;
            transform.inverse(re, im);
            for b in 0..64_u64 {
                let expected: f64 =
                    (0..64_u64).map(|a| x[a as usize] * y[sum(a, b, bits, carry) as usize]).sum();
                assert!((re[b as usize] / 64.0 - expected).abs() < 1e-9 && im[b as usize].abs() < 1e-9);
            }
        }
    }
}
