//! Sobol' points with the direction numbers tkrg-a-ap5: up to 50,000 dimensions.
//!
//! Choose it for more dimensions than `sobol` has, or where neighboring coordinates act together, as the steps of a path do:
//! of any five successive dimensions, the first 2^10 points are one in each of the 4^5 cells of side 1/4 (I. M. Sobol's property
//! A′), which fails for 15,075 of the 21,197 such blocks of `sobol`. In pairs of dimensions the two are equally good on average.

use super::Entry;
use crate::Seed;
use crate::data::sobol_tkrg::{TKRG_DIMS, matrices};
use crate::digital_net::DigitalNet;
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "sobol_tkrg",
    cite: "I. M. Sobol', USSR Comput. Math. Math. Phys. 7(4), 86-112 (1967), with the direction numbers of A. Oliva Denis, J. \
           Wheeldon, I. Manyakin and A. Papaioannou, Sobol direction numbers for quasi-Monte Carlo simulation, SSRN 7040539 \
           (2026)",
    accepts: Randomization::BASE_2,
    takes: &[],
    most_dims: TKRG_DIMS,
    build: |spec| Ok(Box::new(sobol_tkrg(spec.dims, spec.randomization, spec.seed))),
};

/// The first `dims` coordinates.
///
/// # Panics
/// If there are more than 50,000 of them, or none.
pub fn sobol_tkrg(dims: usize, randomization: Randomization, seed: Seed) -> DigitalNet {
    assert!(dims <= TKRG_DIMS, "{dims} dimensions of {TKRG_DIMS}");
    let columns: Vec<_> = matrices().take(dims).collect();
    DigitalNet::new(&columns, randomization, seed)
}
