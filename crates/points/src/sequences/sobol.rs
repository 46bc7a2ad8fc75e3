//! Sobol' points with the direction numbers of Joe and Kuo: the default for integration.
//!
//! A (t, s)-sequence in base 2 up to 21,201 dimensions, 64 digits deep. Take powers of 2 of points,
//! from index 0 on: then all elementary intervals are filled evenly. Rows come in natural order, point
//! 0 included (A. B. Owen, *On dropping the first Sobol' point*, 2020), and any row costs the same.

use super::Entry;
use crate::Seed;
use crate::data::{SOBOL_DIMS, sobol_initial};
use crate::digital_net::{BITS, DigitalNet};
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "sobol",
    cite: "I. M. Sobol', USSR Comput. Math. Math. Phys. 7(4), 86-112 (1967), with the direction numbers of S. Joe and \
           F. Y. Kuo, SIAM J. Sci. Comput. 30, 2635-2654 (2008)",
    accepts: Randomization::BASE_2,
    takes: &[],
    most_dims: SOBOL_DIMS,
    build: |spec| Ok(Box::new(sobol(spec.dims, spec.randomization, spec.seed))),
};

/// The first `dims` Sobol' coordinates.
///
/// # Panics
/// If there are more than 21,201 of them, or none.
pub fn sobol(dims: usize, randomization: Randomization, seed: Seed) -> DigitalNet {
    let columns: Vec<_> = (0..dims).map(direction_numbers).collect();
    DigitalNet::new(&columns, randomization, seed)
}

/// The columns of one generating matrix, first digit in the most significant bit: what a renderer needs
/// to build tables of its own. Column k is the word of point 2^k.
///
/// With the polynomial `x^s + a_1 x^(s-1) + … + a_s` and `v_k = m_k / 2^k`, Bratley and Fox (1988,
/// equation 5) give `v_k = a_1 v_(k-1) ⊕ … ⊕ a_s v_(k-s) ⊕ v_(k-s) / 2^s`.
///
/// # Panics
/// If `dim` is not below 21,201.
pub fn direction_numbers(dim: usize) -> [u64; BITS] {
    let (polynomial, initial) = sobol_initial(dim);
    let degree = initial.len();
    if degree == 0 {
        return std::array::from_fn(|k| 1 << (BITS - 1 - k)); // van der Corput
    }
    let mut columns = [0; BITS];
    for (k, m) in initial.iter().enumerate() {
        columns[k] = m << (BITS - 1 - k);
    }
    for k in degree..BITS {
        let taps = (1..=degree).filter(|j| polynomial >> (degree - j) & 1 == 1);
        let start = columns[k - degree] >> degree;
        columns[k] = taps.fold(start, |sum, j| sum ^ columns[k - j]);
    }
    columns
}
