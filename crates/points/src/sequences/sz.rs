//! Nested (0, 2)-, (0, 4)-, (0, 16)- and (0, 256)-sequences: even in consecutive pairs, quadruples, …
//!
//! Dimensions 2i and 2i + 1 are a (0, 2)-sequence in base 2, dimensions 4i to 4i + 3 a (0, 4)-sequence
//! in base 4, and so on: the best that is possible in each of these groups, which Sobol' points have in
//! their first pair only. Choose it where an integrand is a product or nest of functions of few
//! coordinates each, as in rendering. These are the properties of the SZ sequences of A. Ahmed, M. Pharr,
//! V. Ostromoukhov and H. Huang (2025); the matrices come from the following argument, not from their search.
//!
//! Over a field F of 2^q elements, the powers a ∈ F of Pascal's matrix, with entries `C(j, i) a^(j - i)`,
//! generate a (0, 2^q)-sequence in base 2^q (H. Faure 1982, H. Niederreiter 1987). How bits write a
//! digit is open. Let K ⊂ F be the subfield of 2^(q/2), F = K + Kz, and write the digit x + yz as the
//! digits x + s y and y over K. In characteristic 2, Pascal's matrix of twice the size for s is the
//! Kronecker product of the one for s² and that map of two digits: the dimensions s² ∈ K are the Faure
//! sequence of K, and those in another coset of K are it behind a unit triangular matrix, which only
//! reorders blocks of points. Going down the tower to {0, 1} nests all groups.

use super::Entry;
use crate::Seed;
use crate::digital_net::{BITS, DigitalNet};
use crate::scramble::Randomization;
use crate::tower_field::{self, product};

pub(super) const ENTRY: Entry = Entry {
    name: "sz",
    cite: "H. Niederreiter, Monatsh. Math. 104, 273-337 (1987); nested as in A. Ahmed, M. Pharr, V. Ostromoukhov and \
           H. Huang, SZ sequences, ACM Trans. Graph. (2025)",
    accepts: Randomization::BASE_2,
    takes: &[],
    most_dims: 1 << tower_field::BITS,
    build: |spec| Ok(Box::new(sz(spec.dims, spec.randomization, spec.seed))),
};

/// The first `dims` coordinates.
///
/// # Panics
/// If there are more than 65,536 of them, or none.
pub fn sz(dims: usize, randomization: Randomization, seed: Seed) -> DigitalNet {
    let columns: Vec<_> = (0..dims).map(|dim| matrix(dim as u32)).collect();
    DigitalNet::new(&columns, randomization, seed)
}

/// The columns of a generating matrix, first digit in the most significant bit.
fn matrix(dim: u32) -> [u64; BITS] {
    assert!(dim < 1 << tower_field::BITS, "dimension {dim} of 65536");
    // The smallest field that has the dimension: larger ones give the same matrix.
    let bits = (u32::BITS - dim.leading_zeros()).max(1).next_power_of_two();
    let element = element(dim, bits);
    std::array::from_fn(|column| {
        let (j, bit) = (column as u32 / bits, column as u32 % bits);
        let mut word = 0;
        let mut digit = 1 << bit; // times element^(j − i)
        for i in (0..=j).rev() {
            if i & j == i {
                // C(j, i) is odd (Lucas)
                word |= u64::from(written(digit, dim, bits)) << (BITS as u32 - bits * (i + 1));
            }
            digit = product(digit, element, bits);
        }
        word
    })
}

/// The element of the field of 2^`bits` whose power of Pascal's matrix a dimension is: in the coset
/// that the upper half of its number names, the square of the element that it has in the subfield.
fn element(dim: u32, bits: u32) -> u32 {
    if bits == 1 {
        return dim & 1;
    }
    let half = bits / 2;
    let inner = element(dim & ((1 << half) - 1), half);
    dim >> half << half | product(inner, inner, half)
}

/// The bits that write a digit of a dimension, first one in the highest place.
fn written(digit: u32, dim: u32, bits: u32) -> u32 {
    if bits == 1 {
        return digit;
    }
    let half = bits / 2;
    let mask = (1 << half) - 1;
    let inner = dim & mask;
    let (x, y) = (digit & mask, digit >> half);
    let first = x ^ product(element(inner, half), y, half);
    written(first, inner, half) << half | written(y, inner, half)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first `rows` rows of a matrix, as masks over the first `m` columns.
    fn rows(dim: u32, rows: u32, m: u32) -> Vec<u64> {
        let columns = matrix(dim);
        let row = |digit: u32| (0..m).map(|k| (columns[k as usize] >> (63 - digit) & 1) << k).sum();
        (0..rows).map(row).collect()
    }

    fn rank(rows: impl Iterator<Item = u64>) -> u32 {
        let mut basis: Vec<u64> = Vec::new();
        for mut row in rows {
            for &pivot in &basis {
                row = row.min(row ^ pivot);
            }
            if row != 0 {
                basis.push(row);
            }
        }
        basis.len() as u32
    }

    /// The ways to share `sum` digits among `parts` dimensions.
    fn shares(sum: u32, parts: u32) -> Vec<Vec<u32>> {
        if parts == 1 {
            return vec![vec![sum]];
        }
        let rest =
            |first| shares(sum - first, parts - 1).into_iter().map(move |rest| [vec![first], rest].concat());
        (0..=sum).flat_map(rest).collect()
    }

    /// Whether `size` dimensions from `first` on are a (0, m, size)-net in base 2^`bits`.
    fn is_net(first: u32, size: u32, bits: u32, m: u32) -> bool {
        shares(m, size).iter().all(|share| {
            let taken = share.iter().zip(first..).flat_map(|(&count, dim)| rows(dim, count * bits, m * bits));
            rank(taken) == m * bits
        })
    }

    #[test]
    fn consecutive_pairs_are_nets_in_base_two() {
        for first in (0..64).chain(250..260).chain(65_000..65_010).filter(|dim| dim % 2 == 0) {
            assert!((1..=16).chain([33, 64]).all(|m| is_net(first, 2, 1, m)), "dimension {first}");
        }
    }

    #[test]
    fn consecutive_quadruples_are_nets_in_base_four() {
        for first in [0, 4, 8, 12, 16, 60, 252, 256, 65_532] {
            assert!((1..=7).all(|m| is_net(first, 4, 2, m)), "dimension {first}");
        }
    }

    #[test]
    fn groups_of_sixteen_are_nets_in_base_sixteen() {
        for first in [0, 16, 240, 256] {
            assert!((1..=3).all(|m| is_net(first, 16, 4, m)), "dimension {first}");
        }
    }

    /// What the argument above rests on: matrices are unit triangular up to the writing of digits.
    #[test]
    fn every_dimension_alone_is_a_net() {
        for dim in [0, 1, 5, 77, 300, 65_535] {
            assert!((1..=64).all(|m| is_net(dim, 1, 1, m)), "dimension {dim}");
        }
    }
}
