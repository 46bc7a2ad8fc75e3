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
//! * [`quality`]: how even points are: discrepancies and their structure;
//! * [`digital_net`]: the engine that all base-2 sequences share;
//! * [`modular`]: the engine that all lattices share;
//! * [`construction`] and [`quality`]: generating vectors of lattices, and how good they are;
//! * [`warp`]: points of triangles, curves, directions and distributions, each with density and inverse;
//! * [`blue_noise`]: points that keep their distance, dither masks, orders of pixels;
//! * [`convert`]: digits to floating point without ever reaching 1.0;
//! * [`stateless`]: one word from (index, dimension, seed), for renderers, and the [`owen_hash`] behind it.
//!
//! Without the default feature `std` there are [`stateless`], [`owen_hash`], [`convert`] and [`Seed`], which need no
//! operating system.

#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "std")]
pub mod blue_noise;
#[cfg(feature = "std")]
mod cells;
#[cfg(feature = "std")]
pub mod construction;
pub mod convert;
#[cfg(feature = "std")]
mod counts;
mod data;
#[cfg(feature = "std")]
pub mod digital_net;
#[cfg(feature = "std")]
mod dyadic_pairs;
#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
mod generating_matrices;
#[cfg(feature = "std")]
mod instruction_sets;
#[cfg(feature = "std")]
pub mod modular;
#[cfg(feature = "std")]
pub mod multi_jitter;
pub mod owen_hash;
#[cfg(feature = "std")]
mod parallel;
#[cfg(feature = "std")]
mod point_set;
#[cfg(feature = "std")]
mod polynomials;
#[cfg(feature = "std")]
mod primes;
#[cfg(feature = "std")]
pub mod quality;
#[cfg(feature = "std")]
mod radix;
pub mod resample;
#[cfg(feature = "std")]
pub mod scramble;
mod seed;
#[cfg(feature = "std")]
pub mod sequences;
#[cfg(feature = "std")]
mod shuffle;
pub mod stateless;
#[cfg(feature = "std")]
mod streaming;
#[cfg(feature = "std")]
mod tiles;
#[cfg(feature = "std")]
mod tower_field;
#[cfg(feature = "std")]
mod unit;
#[cfg(feature = "std")]
pub mod warp;

#[cfg(feature = "std")]
pub use error::Error;
#[cfg(feature = "std")]
pub use parallel::{fill_parallel, fill_parallel_f32};
#[cfg(feature = "std")]
pub use point_set::PointSet;
pub use seed::Seed;

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
