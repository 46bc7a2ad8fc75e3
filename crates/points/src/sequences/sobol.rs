//! Sobol' points with the direction numbers of Joe and Kuo: the default for integration.
//!
//! A (t, s)-sequence in base 2 up to 21,201 dimensions, 64 digits deep. Take powers of 2 of points,
//! from index 0 on: then all elementary intervals are filled evenly. Rows come in natural order, point
//! 0 included (A. B. Owen, *On dropping the first Sobol' point*, 2020), and any row costs the same.

use super::Entry;
use crate::Seed;
use crate::data::direction_numbers::SOBOL_DIMS;
pub use crate::data::direction_numbers::direction_numbers;
use crate::digital_net::DigitalNet;
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
