//! Randomizations of point sets, most of them random bijections of digits that keep a net a net.
//!
//! One file, one method. The files hold the base-2 form, on words whose most significant bit is the
//! first digit after the point; a sequence in another base brings its own digits to the same idea.
//!
//! | | keeps nets | replicate variance of a smooth mean | cost |
//! |---|---|---|---|
//! | `owen_exact` | yes | n⁻³, the yardstick | ten times `owen` |
//! | `owen` | yes | the same, by hashing | small |
//! | `linear` | yes | the same, but with heavier tails | none, but set-up |
//! | `linear_i_binomial` | yes | the same, with fewer random bits | none, but set-up |
//! | `linear_striped` | yes | n⁻⁴ in one dimension | none, but set-up |
//! | `digit_permutation` | yes | n⁻²; in base 2 the same as `digital_shift` | small |
//! | `digital_shift` | yes | n⁻² | none |
//! | `shift` | lattices, not nets | n⁻² | none |
//! | `shift_tent` | no | n⁻⁴ for lattices | none |

pub mod digit_permutation;
pub mod digital_shift;
pub mod linear;
pub mod linear_i_binomial;
pub mod linear_striped;
mod matrix;
pub mod none;
pub mod owen;
pub mod owen_exact;
pub mod shift;
pub mod shift_tent;

use crate::{Error, Seed};

/// A way to randomize points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Randomization {
    /// Leave the points alone: [`none`].
    None,
    /// Add the same random numbers to all points, modulo 1: [`shift`].
    Shift,
    /// The same, then fold every coordinate: [`shift_tent`].
    ShiftTent,
    /// Add the same random digits to all points: [`digital_shift`].
    DigitalShift,
    /// Permute the digits of every place, the same way for all points: [`digit_permutation`].
    DigitPermutation,
    /// Multiply the digits by a random lower triangular matrix, then shift them: [`linear`].
    Linear,
    /// The same, with one random digit for each column: [`linear_striped`].
    LinearStriped,
    /// The same, with one random digit for each diagonal: [`linear_i_binomial`].
    LinearIBinomial,
    /// Permute each digit according to all digits before it, by hashing: [`owen`].
    Owen,
    /// The same, with a random permutation of its own at every node: [`owen_exact`].
    OwenExact,
}

/// What a randomization says about itself.
#[derive(Debug)]
pub struct Entry {
    /// The method.
    pub randomization: Randomization,
    /// Its name everywhere: in Rust, Python, on the command line and in reports.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// The base-2 form: a map of 64-bit words that keeps their distribution, a bijection unless it folds.
    pub apply: fn(word: u64, key: Seed) -> u64,
    /// Whether the base-2 form is affine over {0, 1}: then it can be built into generating matrices.
    pub affine: bool,
    /// Whether the first k digits after depend on the first k digits before only, so that nets stay nets.
    pub nested: bool,
}

/// All randomizations.
pub static ALL: &[&Entry] = &[
    &none::ENTRY,
    &shift::ENTRY,
    &shift_tent::ENTRY,
    &digital_shift::ENTRY,
    &digit_permutation::ENTRY,
    &linear::ENTRY,
    &linear_striped::ENTRY,
    &linear_i_binomial::ENTRY,
    &owen::ENTRY,
    &owen_exact::ENTRY,
];

impl Randomization {
    /// What a sequence in base 2 takes, its default first.
    pub const BASE_2: &'static [Self] = &[
        Self::Owen,
        Self::OwenExact,
        Self::Linear,
        Self::LinearStriped,
        Self::LinearIBinomial,
        Self::DigitalShift,
        Self::Shift,
        Self::None,
    ];

    /// What a sequence in any other prime base takes, its default first.
    pub const ANY_BASE: &'static [Self] = &[
        Self::Owen,
        Self::OwenExact,
        Self::Linear,
        Self::LinearStriped,
        Self::LinearIBinomial,
        Self::DigitPermutation,
        Self::DigitalShift,
        Self::Shift,
        Self::None,
    ];
    /// What a lattice takes, its default first.
    pub const MODULAR: &'static [Self] = &[Self::Shift, Self::ShiftTent, Self::None];

    /// The randomization of this name.
    ///
    /// # Errors
    /// If there is none; the message lists those there are.
    pub fn named(name: &str) -> Result<Self, Error> {
        let found = ALL.iter().find(|entry| entry.name == name);
        found.map(|entry| entry.randomization).ok_or_else(|| Error::UnknownRandomization(name.into()))
    }

    /// Its name, as in the registry.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// Its line in the registry.
    pub fn entry(self) -> &'static Entry {
        match self {
            Self::None => &none::ENTRY,
            Self::Shift => &shift::ENTRY,
            Self::ShiftTent => &shift_tent::ENTRY,
            Self::DigitalShift => &digital_shift::ENTRY,
            Self::DigitPermutation => &digit_permutation::ENTRY,
            Self::Linear => &linear::ENTRY,
            Self::LinearStriped => &linear_striped::ENTRY,
            Self::LinearIBinomial => &linear_i_binomial::ENTRY,
            Self::Owen => &owen::ENTRY,
            Self::OwenExact => &owen_exact::ENTRY,
        }
    }
}
