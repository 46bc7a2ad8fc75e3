//! The functions of [`evenlight_points::stateless`] for C, which `include/evenlight_points.h` declares.
//!
//! Plain numbers in, a plain number out: nothing to allocate, to free or to initialize, callable from any thread.

#![allow(unsafe_code, reason = "names that C finds are not mangled")]

use evenlight_points::{convert, stateless};

/// A coordinate of a Sobol' point, not randomized; 0 if `dimension` is not below `EVENLIGHT_SOBOL_DIMS`.
#[unsafe(no_mangle)]
pub extern "C" fn evenlight_sobol(index: u32, dimension: u32) -> u32 {
    if dimension < stateless::SOBOL_DIMS { stateless::sobol(index, dimension) } else { 0 }
}

/// A coordinate of an Owen-scrambled Sobol' point; 0 if `dimension` is not below `EVENLIGHT_SOBOL_DIMS`.
#[unsafe(no_mangle)]
pub extern "C" fn evenlight_owen_sobol(index: u32, dimension: u32, seed: u64) -> u32 {
    if dimension < stateless::SOBOL_DIMS { stateless::owen_sobol(index, dimension, seed) } else { 0 }
}

/// The index in a random order that keeps nets nets.
#[unsafe(no_mangle)]
pub extern "C" fn evenlight_shuffled(index: u32, seed: u64) -> u32 {
    stateless::shuffled(index, seed)
}

/// The upper 24 bits of a word as a number in [0, 1).
#[unsafe(no_mangle)]
pub extern "C" fn evenlight_unit_f32(word: u32) -> f32 {
    convert::unit_f32(word)
}
