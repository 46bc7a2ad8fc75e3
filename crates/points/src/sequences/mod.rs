//! Sequences: the families of points, one file each, and their registry.
//!
//! To add one, write its file with an `ENTRY`, declare it here and put it in [`ALL`]. The laws, the
//! golden values, the Python names and the error messages follow from the list.

pub mod correlated_multi_jittered;
pub mod dyadic;
pub mod halton;
pub mod independent;
pub mod latin_hypercube;
#[cfg(feature = "generators")]
pub mod mersenne_twister;
pub mod multi_jittered;
pub mod orthogonal_array;
#[cfg(feature = "generators")]
pub mod pcg;
pub mod philox;
pub mod progressive_multi_jittered;
pub mod sobol;
pub mod stratified;
pub mod sz;

use crate::scramble::Scrambling;
use crate::{Error, PointSet, Seed};

/// What a sequence says about itself.
#[derive(Debug)]
pub struct Entry {
    /// Its name everywhere: in Rust, Python, on the command line and in reports.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// The scrambles it takes.
    pub accepts: &'static [Scrambling],
    /// The most dimensions it has.
    pub most_dims: usize,
    /// Builds it, once [`build`] has checked the arguments.
    pub build: fn(dims: usize, scramble: Scrambling, seed: Seed) -> Box<dyn PointSet>,
}

/// All sequences.
pub static ALL: &[&Entry] = &[&sobol::ENTRY, &halton::ENTRY, &independent::ENTRY];

/// Builds a sequence from plain values.
///
/// # Errors
/// If a name is unknown, the scramble does not suit the sequence, or it has no such number of dimensions.
pub fn build(name: &str, dims: usize, scramble: &str, seed: Seed) -> Result<Box<dyn PointSet>, Error> {
    let entry = ALL.iter().find(|entry| entry.name == name);
    let entry = entry.ok_or_else(|| Error::UnknownSequence(name.into()))?;
    let scramble = Scrambling::named(scramble)?;
    if !entry.accepts.contains(&scramble) {
        return Err(Error::NotAccepted { sequence: entry.name, scramble, accepts: entry.accepts });
    }
    if !(1..=entry.most_dims).contains(&dims) {
        return Err(Error::Dimensions { sequence: entry.name, asked: dims, most: entry.most_dims });
    }
    Ok((entry.build)(dims, scramble, seed))
}
