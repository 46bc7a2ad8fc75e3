//! Construction of lattices: generating vectors that are good for given weights, component by component.
//!
//! Every coordinate in turn takes the number that gives the least squared worst-case error
//! ([`crate::quality::lattice_criteria`]) with those chosen before (I. H. Sloan and A. V. Reztsov, Math. Comp. 71, 263-273,
//! 2002). Over all candidates the errors are a correlation over a group, that of the units modulo n, so that fast
//! transforms give all of them in time n log n for a coordinate and memory for n numbers, instead of n² (D. Nuyens and
//! R. Cools, *Fast algorithms for component-by-component construction of rank-1 lattice rules in shift-invariant
//! reproducing kernel Hilbert spaces*, Math. Comp. 75, 903-920, 2006).
//!
//! * [`component_by_component`]: the algorithm, for one n or embedded in many;
//! * `levels`: the groups of n = 2^m, of n prime, and of polynomials;
//! * `transform`: the characters of those groups;
//! * [`korobov`]: the search for a Korobov lattice.

pub mod component_by_component;
pub mod korobov;
mod levels;
mod transform;

pub use component_by_component::{lattice, polynomial_lattice};
