//! Sequences: the families of points, one file each, and their registry.
//!
//! To add one, write its file with an `ENTRY`, declare it here and put it in [`ALL`]. The laws, the
//! golden values, the Python names and the error messages follow from the list.

pub mod correlated_multi_jittered;
pub mod digital_net;
pub mod dyadic;
pub mod faure;
pub mod fibonacci;
pub mod halton;
pub mod hammersley;
pub mod independent;
pub mod interlaced_sobol;
pub mod korobov;
pub mod kronecker;
pub mod latin_hypercube;
pub mod lattice;
#[cfg(feature = "generators")]
pub mod mersenne_twister;
pub mod multi_jittered;
pub mod niederreiter;
pub mod niederreiter_xing;
pub mod orthogonal_array;
#[cfg(feature = "generators")]
pub mod pcg;
pub mod philox;
pub mod polynomial_lattice;
pub mod progressive_multi_jittered;
pub mod sobol;
pub mod sobol_tkrg;
pub mod stratified;
pub mod sz;
pub mod van_der_corput;

use crate::scramble::Randomization;
use crate::{Error, PointSet, Seed};

/// What a sequence says about itself.
#[derive(Debug)]
pub struct Entry {
    /// Its name everywhere: in Rust, Python, on the command line and in reports.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// The randomizations it takes, its default first.
    pub accepts: &'static [Randomization],
    /// The options it takes, by their names in [`Options`].
    pub takes: &'static [&'static str],
    /// The most dimensions it has.
    pub most_dims: usize,
    /// Builds it, once [`build`] has checked what the registry can check.
    pub build: fn(&Spec) -> Result<Box<dyn PointSet>, Error>,
}

/// A request for points, in plain values.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// The number of coordinates of a point.
    pub dims: usize,
    /// How it is randomized.
    pub randomization: Randomization,
    /// The source of all randomness.
    pub seed: Seed,
    /// What only some sequences ask.
    pub options: Options,
}

impl Spec {
    /// A request without options.
    pub fn new(dims: usize, randomization: Randomization, seed: Seed) -> Self {
        Self { dims, randomization, seed, options: Options::default() }
    }
}

/// Settings that only some sequences have; `None` leaves the choice to the sequence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The number of points, for sets that must know it.
    pub n: Option<u64>,
    /// The base of the digits.
    pub base: Option<u32>,
    /// The order of a higher-order net: how many coordinates are interlaced to one.
    pub order: Option<u32>,
    /// The strength of an orthogonal array.
    pub strength: Option<u32>,
    /// The generator of a lattice, one number or one for each dimension.
    pub generator: Option<Vec<u64>>,
    /// The generating matrices of a digital net, one for each dimension: the numbers that write their columns.
    pub matrices: Option<Vec<Vec<u64>>>,
    /// The digits of a column of these matrices; the first is the most significant of so many bits.
    pub bits: Option<u32>,
}

impl Options {
    /// The names of the options that are given.
    pub fn given(&self) -> impl Iterator<Item = &'static str> {
        let Self { n, base, order, strength, generator, matrices, bits } = self;
        let all = [
            ("n", n.is_some()),
            ("base", base.is_some()),
            ("order", order.is_some()),
            ("strength", strength.is_some()),
            ("generator", generator.is_some()),
            ("matrices", matrices.is_some()),
            ("bits", bits.is_some()),
        ];
        all.into_iter().filter_map(|(name, given)| given.then_some(name))
    }
}

/// All sequences.
pub static ALL: &[&Entry] = &[
    &sobol::ENTRY,
    &halton::ENTRY,
    &independent::ENTRY,
    &niederreiter_xing::ENTRY,
    &sobol_tkrg::ENTRY,
    &interlaced_sobol::ENTRY,
    &digital_net::ENTRY,
    &van_der_corput::ENTRY,
    &hammersley::ENTRY,
    &faure::ENTRY,
    &niederreiter::ENTRY,
    &dyadic::ENTRY,
    &sz::ENTRY,
    &progressive_multi_jittered::ENTRY,
    &lattice::ENTRY,
    &polynomial_lattice::ENTRY,
    &kronecker::ENTRY,
    &korobov::ENTRY,
    &fibonacci::ENTRY,
    &latin_hypercube::ENTRY,
    &orthogonal_array::ENTRY,
    &stratified::ENTRY,
    &multi_jittered::ENTRY,
    &correlated_multi_jittered::ENTRY,
    &philox::ENTRY,
    #[cfg(feature = "generators")]
    &pcg::ENTRY,
    #[cfg(feature = "generators")]
    &mersenne_twister::ENTRY,
];

/// The sequence of this name.
///
/// # Errors
/// If there is none; the message lists those there are.
pub fn named(name: &str) -> Result<&'static Entry, Error> {
    let entry = ALL.iter().find(|entry| entry.name == name);
    entry.copied().ok_or_else(|| Error::UnknownSequence(name.into()))
}

/// Builds a sequence from plain values.
///
/// # Errors
/// If the name is unknown, or the sequence does not take the randomization, an option or the number of dimensions.
pub fn build(name: &str, spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let entry = named(name)?;
    let (sequence, &Spec { dims, randomization, .. }) = (entry.name, spec);
    if !entry.accepts.contains(&randomization) {
        return Err(Error::NotAccepted { sequence, randomization, accepts: entry.accepts });
    }
    if let Some(option) = spec.options.given().find(|option| !entry.takes.contains(option)) {
        return Err(Error::NotTaken { sequence, option, takes: entry.takes });
    }
    if !(1..=entry.most_dims).contains(&dims) {
        return Err(Error::Dimensions { sequence, asked: dims, most: entry.most_dims });
    }
    (entry.build)(spec)
}
