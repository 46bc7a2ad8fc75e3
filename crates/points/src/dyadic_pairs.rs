//! Pairs of coordinates that are (0, 2)-sequences in base 2, as many as asked.
//!
//! Each pair is the (0, 2)-sequence of I. M. Sobol' (1967), van der Corput's matrix and Pascal's, in an
//! order of its own: the digits of the index pass through a random unit triangular matrix (H. Faure and
//! S. Tezuka, *Another random scrambling of digital (t,s)-sequences*, 2002). It permutes the points within
//! every block of 2^m, so that each pair stays what it was; and it sends two indices to any two that
//! part at the same digit equally often, as the nested shuffling of indices does that renderers use
//! (T. Kollig and A. Keller, *Efficient multidimensional sampling*, 2002). The matrices are drawn once and for
//! all; the first is the identity. Randomness is left to the scramble of the coordinates.

use crate::Seed;
use crate::digital_net::BITS;

/// The seed of the orders.
const ORDERS: Seed = Seed::new(0x2002);

/// The columns of the first `dims` generating matrices, first digit in the most significant bit.
pub(crate) fn matrices(dims: usize) -> Vec<[u64; BITS]> {
    (0..dims).map(|dim| matrix(dim as u64 / 2, dim % 2 == 1)).collect()
}

fn matrix(pair: u64, second: bool) -> [u64; BITS] {
    let plain: [u64; BITS] = std::array::from_fn(|j| {
        // Digit i of index 2^j: C(j, i) modulo 2 (Lucas), or only i = j.
        (0..=j).filter(|i| if second { i & j == *i } else { *i == j }).map(|i| 1 << (BITS - 1 - i)).sum()
    });
    std::array::from_fn(|k| {
        let leading = 1_u64 << k;
        let below =
            if pair == 0 { 0 } else { ORDERS.dimension(pair).split(0, k as u64).bits64() & (leading - 1) };
        (0..=k).filter(|j| (leading | below) >> j & 1 == 1).fold(0, |word, j| word ^ plain[j])
    })
}
