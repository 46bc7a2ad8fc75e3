//! How even are these points? Measured, not assumed: exactly, or between guaranteed bounds.
//!
//! * [`local`]: the error at given boxes;
//! * [`star`]: the largest error over all anchored boxes, exact or bounded, and what it would cost;
//! * the algorithms behind it: [`sweep`] (one and two dimensions), [`dem`] (exact, more dimensions),
//!   [`threshold_accepting`] (lower bounds), [`bracketing`] (upper bounds);
//! * [`l2`]: mean squares instead of the largest error;
//! * [`triangle`]: points in a triangle; [`extreme`] and [`dispersion`]: the worst and the largest empty of all boxes;
//! * [`isotropic`]: the worst of all convex sets, in two dimensions;
//! * [`nets`]: points as nets: elementary intervals and gain coefficients;
//! * [`lattice_criteria`]: worst-case errors of lattices and nets in weighted spaces of functions;
//! * [`t_value`](mod@t_value): the quality parameter of a digital net, from its matrices.
//!
//! All but the last two measure any rows of numbers in [0, 1], whoever made them; points on the upper boundary are legal here.

pub mod bracketing;
mod cuts;
pub mod dem;
mod dem_leaf;
pub mod dispersion;
pub mod extreme;
mod halves;
pub mod isotropic;
mod kinetic;
pub mod l2;
pub mod lattice_criteria;
pub mod local;
pub mod nets;
mod pairs;
mod rows;
mod shapes;
pub mod star;
pub mod sweep;
pub mod t_value;
pub mod threshold_accepting;
pub mod triangle;

pub use rows::Rows;
pub use t_value::{t_value, t_value_in_base};
