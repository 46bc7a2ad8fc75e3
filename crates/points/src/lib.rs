//! Uniform numbers: where to look.
//!
//! A point set is a pure function of (index, dimension), randomized by a [`Seed`]:
//!
//! ```
//! use evenlight_points::{Seed, scramble::Randomization, sequences};
//! let points = sequences::build("sobol", &sequences::Spec::new(2, Randomization::Owen, Seed::new(7)))?;
//! let mut rows = [0.0; 2 * 8];
//! points.fill(0..8, &mut rows);
//! assert_eq!(rows[2 * 5 + 1], points.coord(5, 1));
//! # Ok::<(), evenlight_points::Error>(())
//! ```
//!
//! * [`sequences`]: the families of points, one file each, and their registry;
//! * [`scramble`]: random bijections of digits that keep nets nets;
//! * [`digital_net`]: the engine that all base-2 sequences share;
//! * [`convert`]: digits to floating point without ever reaching 1.0.

mod cells;
pub mod convert;
mod counts;
mod data;
pub mod digital_net;
mod dyadic_pairs;
mod error;
mod instruction_sets;
pub mod multi_jitter;
mod parallel;
mod point_set;
mod radical_inverse;
pub mod scramble;
mod seed;
pub mod sequences;
mod shuffle;
mod streaming;
mod tower_field;

pub use error::Error;
pub use parallel::{fill_parallel, fill_parallel_f32};
pub use point_set::PointSet;
pub use seed::Seed;
