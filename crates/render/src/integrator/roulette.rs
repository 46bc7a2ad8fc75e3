//! Russian roulette: paths end by chance, and those that go on count for more, so that the mean stays the same.
//!
//! Survival in proportion to throughput is the default: it spends time where light is. Fixed probabilities make a render the de-biased sum
//! of its bounces (Rhee & Glynn 2015, "Unbiased Estimation with Square Root Convergence for SDE Models"), which
//! [`bounces`](crate::bounces) measures to choose them. No roulette at all is for measuring and for short paths.

use crate::{Error, Result};

/// When paths end by chance.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Roulette {
    /// From the scene's `rr_depth` on, with a survival probability in proportion to throughput.
    #[default]
    Throughput,
    /// Never.
    Never,
    /// A path goes on from its first, second, … surface with these probabilities, of which the last holds for all further surfaces.
    Survival(Survival),
}

/// At least one probability in (0, 1].
#[derive(Clone, Debug, PartialEq)]
pub struct Survival(Vec<f32>);

/// A path survives roulette with this many times its throughput as probability.
///
/// The best probability is in proportion to throughput, by a factor that grows with the share of the pixel's error that long paths have
/// (Bolin & Meyer 1997, "An error metric for Monte Carlo ray tracing"; Rath et al. 2022, "EARS: Efficiency-Aware Russian Roulette and
/// Splitting"). Evenly spread points leave little error to short paths: with 2 instead of the usual 1, a Cornell box at 64 samples has
/// 8 % less squared error for 2 % more time; 4 gains less than it costs.
const PERSISTENCE: f32 = 2.0;

/// Roulette in proportion to throughput never lets all pass: long paths in bright scenes must end.
const MOST_SURVIVORS: f32 = 0.95;

impl Roulette {
    /// The kinds that need no numbers, by name.
    pub const ALL: [(&'static str, Self); 2] = [("throughput", Self::Throughput), ("none", Self::Never)];

    /// A kind by name.
    pub fn by_name(name: &str) -> Result<Self> {
        let found = Self::ALL.into_iter().find(|(known, _)| *known == name);
        found.map(|(_, roulette)| roulette).ok_or_else(|| {
            let message =
                format!("unknown roulette '{name}'; known: throughput, none, or a list of probabilities");
            Error::Settings(message)
        })
    }

    /// Fixed survival probabilities; an error unless there is at least one and all are in (0, 1].
    pub fn with_survival(probabilities: &[f64]) -> Result<Self> {
        if probabilities.is_empty() {
            return Err(Error::Settings("roulette needs at least one survival probability".into()));
        }
        let single: Vec<f32> = probabilities.iter().map(|p| *p as f32).collect();
        match probabilities.iter().zip(&single).find(|(p, single)| !(**single > 0.0 && **p <= 1.0)) {
            Some((p, _)) => {
                Err(Error::Settings(format!("roulette: survival probabilities must be in (0, 1], not {p}")))
            }
            None => Ok(Self::Survival(Survival(single))),
        }
    }

    /// Whether paths may go on for ever where nothing absorbs light.
    pub fn is_endless(&self) -> bool {
        match self {
            Self::Throughput => false,
            Self::Never => true,
            Self::Survival(Survival(probabilities)) => probabilities.last() == Some(&1.0),
        }
    }

    /// The probability with which a path goes on from a surface, the `surfaces`th of the path; `worth` is the largest component of its
    /// throughput, without the compression of radiance by refraction.
    #[inline]
    pub(super) fn survival(&self, surfaces: u32, rr_depth: u32, worth: f32) -> f32 {
        match self {
            Self::Throughput if surfaces >= rr_depth => (PERSISTENCE * worth).min(MOST_SURVIVORS),
            Self::Throughput | Self::Never => 1.0,
            Self::Survival(Survival(probabilities)) => {
                probabilities[(surfaces as usize).min(probabilities.len()) - 1]
            }
        }
    }
}
