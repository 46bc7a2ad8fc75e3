//! What can be wrong with a request for points. All of it is found while building.

use std::fmt;

use crate::scramble::Randomization;

/// A request that cannot be met; the message says what was asked and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// No sequence has this name.
    UnknownSequence(String),
    /// No randomization has this name.
    UnknownRandomization(String),
    /// The randomization exists, but does not apply to this sequence.
    NotAccepted {
        /// The name of the sequence.
        sequence: &'static str,
        /// The randomization asked for.
        randomization: Randomization,
        /// The randomizations it takes.
        accepts: &'static [Randomization],
    },
    /// The option exists, but not for this sequence.
    NotTaken {
        /// The name of the sequence.
        sequence: &'static str,
        /// The option asked for.
        option: &'static str,
        /// The options it takes.
        takes: &'static [&'static str],
    },
    /// An option has a value that the sequence cannot have, or is missing.
    Option {
        /// The name of the sequence.
        sequence: &'static str,
        /// The option.
        option: &'static str,
        /// The value, or "nothing".
        asked: String,
        /// What is allowed, as a phrase that follows "must be".
        allowed: String,
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
    /// Points or a setting that a measure of quality cannot use; the message says what is wrong and what is allowed.
    Quality(String),
    /// Blue noise that cannot be made; the message says what is wrong and what is allowed.
    BlueNoise(String),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownSequence(name) => {
                let known = crate::sequences::ALL.iter().map(|entry| entry.name);
                write!(f, "unknown sequence '{name}'; known: {}", list(known))
            }
            Self::UnknownRandomization(name) => {
                let known = crate::scramble::ALL.iter().map(|entry| entry.name);
                write!(f, "unknown scramble '{name}'; known: {}", list(known))
            }
            Self::NotAccepted { sequence, randomization, accepts } => write!(
                f,
                "sequence '{sequence}' does not accept scramble '{}'; accepted: {}",
                randomization.name(),
                list(accepts.iter().map(|randomization| randomization.name()))
            ),
            Self::NotTaken { sequence, option, takes: [] } => {
                write!(f, "sequence '{sequence}' has no option '{option}'; it has none")
            }
            Self::NotTaken { sequence, option, takes } => write!(
                f,
                "sequence '{sequence}' has no option '{option}'; it has: {}",
                list(takes.iter().copied())
            ),
            Self::Option { sequence, option, asked, allowed } => {
                write!(f, "option '{option}' of sequence '{sequence}' must be {allowed}, not {asked}")
            }
            Self::Dimensions { sequence, asked, most } => {
                write!(f, "sequence '{sequence}' has 1 to {most} dimensions, not {asked}")
            }
            Self::Quality(message) | Self::BlueNoise(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for Error {}

fn list(names: impl Iterator<Item = &'static str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}
