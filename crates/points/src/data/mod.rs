//! Published tables that ship with the crate. `data/README.md` names sources, formats and licenses.

pub(crate) mod direction_numbers;
#[cfg(feature = "std")]
pub(crate) mod generating_vectors;
#[cfg(feature = "std")]
pub(crate) mod niederreiter_xing;
#[cfg(feature = "std")]
pub(crate) mod sobol_tkrg;
