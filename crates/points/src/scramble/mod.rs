//! Scrambles: random bijections of the digits of a coordinate that keep a net a net.
//!
//! One file, one method. The files hold the base-2 form, on words whose most significant bit is the
//! first digit after the point; a sequence in another base brings its own digits to the same idea.

pub mod digital_shift;
pub mod none;
pub mod owen;

use crate::{Error, Seed};

/// A way to randomize digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scrambling {
    /// Leave the digits alone: [`none`].
    None,
    /// Add the same random digits to all points: [`digital_shift`].
    DigitalShift,
    /// Permute each digit according to all digits before it: [`owen`].
    Owen,
}

/// What a scramble says about itself.
#[derive(Debug)]
pub struct Entry {
    /// The method.
    pub scramble: Scrambling,
    /// Its name everywhere: in Rust, Python, on the command line and in reports.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// The base-2 form: a bijection of 64-bit words whose first k bits depend on the first k bits only.
    pub apply: fn(word: u64, key: Seed) -> u64,
}

/// All scrambles.
pub static ALL: &[&Entry] = &[&none::ENTRY, &digital_shift::ENTRY, &owen::ENTRY];

impl Scrambling {
    /// The scramble of this name.
    ///
    /// # Errors
    /// If there is none; the message lists those there are.
    pub fn named(name: &str) -> Result<Self, Error> {
        let found = ALL.iter().find(|entry| entry.name == name);
        found.map(|entry| entry.scramble).ok_or_else(|| Error::UnknownScramble(name.into()))
    }

    /// Its name, as in the registry.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// Its line in the registry.
    pub fn entry(self) -> &'static Entry {
        match self {
            Self::None => &none::ENTRY,
            Self::DigitalShift => &digital_shift::ENTRY,
            Self::Owen => &owen::ENTRY,
        }
    }
}
