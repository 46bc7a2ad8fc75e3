//! How even point sets are: figures of merit, one file each.

pub mod t_value;

pub use t_value::{t_value, t_value_in_base};
