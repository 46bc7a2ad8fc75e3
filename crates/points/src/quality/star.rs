//! The star discrepancy: the largest local discrepancy over all boxes from the origin.
//!
//! D* is the largest |points inside / n − volume|; by the Koksma–Hlawka inequality it bounds the error of integrating any
//! function of variation 1. To find it exactly is NP-hard in the dimension, so that an answer always says which of the three it
//! is: [`Kind::Exact`], a lower or an upper bound.
//!
//! | method | kind | cost |
//! |---|---|---|
//! | [`super::sweep`] | exact, d ≤ 2 | O(n log n), O(n log² n) |
//! | [`super::dem`] | exact | O(n^{1+d/2}) at most, [`super::dem::estimate`] says what to expect |
//! | [`super::threshold_accepting`] | lower | O(n d) a step |
//! | [`super::bracketing`] | upper (exact if the bounds meet) | O(n d) a bracket |

use std::num::NonZeroUsize;

use super::Rows;
use super::bracketing::{Bounds, Limits, bracketing};
use super::dem::{dem, estimate};
use super::sweep::{Boxes, Extremum, one, two};
use super::threshold_accepting::{Effort, threshold_accepting};
use crate::{Error, Seed};

/// What a number says of the star discrepancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It is the star discrepancy, up to rounding.
    Exact,
    /// The star discrepancy is at least this.
    Lower,
    /// The star discrepancy is at most this.
    Upper,
}

/// The star discrepancy, or a bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Star {
    /// The number that was asked for.
    pub value: f64,
    /// What it says.
    pub kind: Kind,
    /// The worst box that is known; it attains the value unless that is an upper bound.
    pub worst: Extremum,
    /// The algorithm.
    pub method: Method,
}

/// How to find it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// A sweep in one and two dimensions, otherwise exact by [`Method::Dem`] where that takes at most
    /// [`Settings::steps`] steps, otherwise a lower bound.
    Auto,
    /// See [`super::sweep`].
    Sweep,
    /// See [`super::dem`].
    Dem,
    /// See [`super::threshold_accepting`].
    ThresholdAccepting,
    /// See [`super::bracketing`].
    Bracketing,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Auto, Self::Sweep, Self::Dem, Self::ThresholdAccepting, Self::Bracketing];

    /// Its name everywhere.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Sweep => "sweep",
            Self::Dem => "dem",
            Self::ThresholdAccepting => "threshold_accepting",
            Self::Bracketing => "bracketing",
        }
    }

    /// The method of this name.
    pub fn named(name: &str) -> Result<Self, Error> {
        let known = Self::ALL.map(Self::name).join(", ");
        let unknown = || Error::Quality(format!("unknown method '{name}'; known: {known}"));
        Self::ALL.into_iter().find(|method| method.name() == name).ok_or_else(unknown)
    }
}

/// How long to look.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The algorithm.
    pub method: Method,
    /// Walks of [`super::threshold_accepting`], also those that give the others a box to beat.
    pub effort: Effort,
    /// Limits of [`super::bracketing`].
    pub limits: Limits,
    /// The most steps that [`Method::Auto`] takes for an exact answer.
    pub steps: f64,
    /// The seed of the walks.
    pub seed: Seed,
    /// The threads of [`super::dem`].
    pub workers: NonZeroUsize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::Auto,
            effort: Effort::default(),
            limits: Limits::default(),
            steps: 1e10,
            seed: Seed::new(0),
            workers: NonZeroUsize::MIN,
        }
    }
}

/// The star discrepancy of some points, or a bound; None if `progress` stopped it before there was an answer.
///
/// ```
/// use evenlight_points::quality::{Rows, star::{Kind, Settings, star_discrepancy}};
/// let rows = Rows::new(&[0.5; 3], 3)?; // one point in the middle
/// let star = star_discrepancy(&rows, &Settings::default(), &mut |_| true)?.unwrap();
/// assert_eq!((star.value, star.kind), (1.0 - 0.125, Kind::Exact));
/// # Ok::<(), evenlight_points::Error>(())
/// ```
pub fn star_discrepancy(
    rows: &Rows<'_>,
    settings: &Settings,
    progress: &mut dyn FnMut(f64) -> bool,
) -> Result<Option<Star>, Error> {
    let method = chosen(rows, settings)?;
    let known = |steps| threshold_accepting(rows, Effort { steps, ..settings.effort }, settings.seed);
    let exact = |worst: Extremum| Star { value: worst.value, kind: Kind::Exact, worst, method };
    Ok(match method {
        Method::Sweep => Some(exact(sweep(rows))),
        Method::Dem => dem(rows, known(FIRST_LOOK), settings.workers, progress).map(exact),
        Method::Bracketing => {
            let Bounds { upper, lower } =
                bracketing(rows, known(settings.effort.steps), settings.limits, progress);
            let kind = if upper == lower.value { Kind::Exact } else { Kind::Upper };
            Some(Star { value: upper, kind, worst: lower, method })
        }
        Method::ThresholdAccepting | Method::Auto => {
            let worst = known(settings.effort.steps);
            Some(Star { value: worst.value, kind: Kind::Lower, worst, method })
        }
    })
}

/// Steps of the walks that give the exact search a box to beat.
const FIRST_LOOK: u32 = 512;

/// Random descents of an estimate.
const PROBES: u32 = 256;

/// About how many steps the exact star discrepancy would take with [`Method::Dem`], of some nanoseconds each.
pub fn star_discrepancy_cost(rows: &Rows<'_>, seed: Seed) -> f64 {
    let known = threshold_accepting(rows, Effort { steps: FIRST_LOOK, ..Effort::default() }, seed);
    estimate(rows, known.value, PROBES, seed)
}

/// The algorithm itself, where the choice was left open.
fn chosen(rows: &Rows<'_>, settings: &Settings) -> Result<Method, Error> {
    let dims = rows.dims();
    match settings.method {
        Method::Auto if dims <= 2 => Ok(Method::Sweep),
        Method::Auto if dims <= MOST_DIMS && star_discrepancy_cost(rows, settings.seed) <= settings.steps => {
            Ok(Method::Dem)
        }
        Method::Auto => Ok(Method::ThresholdAccepting),
        Method::Sweep if dims > 2 => {
            Err(Error::Quality(format!("method 'sweep' is for 1 or 2 dimensions, not {dims}; use 'dem'")))
        }
        Method::Dem if !(2..=MOST_DIMS).contains(&dims) => {
            Err(Error::Quality(format!("method 'dem' is for 2 to {MOST_DIMS} dimensions, not {dims}")))
        }
        method => Ok(method),
    }
}

/// Coordinates of cells are numbered in a byte; nothing of that many could ever be searched.
const MOST_DIMS: usize = 64;

fn sweep(rows: &Rows<'_>) -> Extremum {
    match rows.dims() {
        1 => one(rows),
        _ => two::<Boxes>(&rows.iter().map(|row| [row[0], row[1]]).collect::<Vec<_>>()),
    }
}
