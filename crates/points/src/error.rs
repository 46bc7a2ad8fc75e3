//! What can be wrong with a request for points. All of it is found while building.

use std::fmt;

use crate::scramble::Scrambling;

/// A request that cannot be met; the message says what was asked and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// No sequence has this name.
    UnknownSequence(String),
    /// No scramble has this name.
    UnknownScramble(String),
    /// The scramble exists, but does not apply to this sequence.
    NotAccepted {
        /// The name of the sequence.
        sequence: &'static str,
        /// The scramble asked for.
        scramble: Scrambling,
        /// The scrambles it takes.
        accepts: &'static [Scrambling],
    },
    /// The sequence has no such number of dimensions.
    Dimensions {
        /// The name of the sequence.
        sequence: &'static str,
        /// The dimensions asked for.
        asked: usize,
        /// The most it has.
        most: usize,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownSequence(name) => {
                let known = crate::sequences::ALL.iter().map(|entry| entry.name);
                write!(f, "unknown sequence '{name}'; known: {}", list(known))
            }
            Self::UnknownScramble(name) => {
                let known = crate::scramble::ALL.iter().map(|entry| entry.name);
                write!(f, "unknown scramble '{name}'; known: {}", list(known))
            }
            Self::NotAccepted { sequence, scramble, accepts } => write!(
                f,
                "sequence '{sequence}' does not accept scramble '{}'; accepted: {}",
                scramble.name(),
                list(accepts.iter().map(|scramble| scramble.name()))
            ),
            Self::Dimensions { sequence, asked, most } => {
                write!(f, "sequence '{sequence}' has 1 to {most} dimensions, not {asked}")
            }
        }
    }
}

impl std::error::Error for Error {}

fn list(names: impl Iterator<Item = &'static str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}
