//! What a warp can be asked for, in plain values, and what can be wrong with it.

use std::fmt;

/// Settings that only some warps have; `None` leaves the choice to the warp, where it has a default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The coordinates of a point.
    pub dims: Option<usize>,
    /// Half of the opening of a cap, in radians.
    pub angle: Option<f64>,
    /// A radius; of a torus, from its center to the center of its tube.
    pub radius: Option<f64>,
    /// The radius of the tube of a torus.
    pub tube: Option<f64>,
    /// The height of a cylinder.
    pub height: Option<f64>,
    /// Corners as seen from the origin.
    pub corners: Option<Vec<[f64; 3]>>,
    /// Densities or weights, up to a factor.
    pub values: Option<Vec<f64>>,
    /// Where the densities are tabulated.
    pub knots: Option<Vec<f64>>,
    /// The columns of an image.
    pub columns: Option<usize>,
}

impl Options {
    /// The names of the options that are given.
    pub fn given(&self) -> impl Iterator<Item = &'static str> {
        let Self { dims, angle, radius, tube, height, corners, values, knots, columns } = self;
        let all = [
            ("dims", dims.is_some()),
            ("angle", angle.is_some()),
            ("radius", radius.is_some()),
            ("tube", tube.is_some()),
            ("height", height.is_some()),
            ("corners", corners.is_some()),
            ("values", values.is_some()),
            ("knots", knots.is_some()),
            ("columns", columns.is_some()),
        ];
        all.into_iter().filter_map(|(name, given)| given.then_some(name))
    }
}

/// A request for a warp that cannot be met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// No warp has this name.
    Unknown(String),
    /// The option exists, but not for this warp.
    NotTaken {
        /// The name of the warp.
        warp: &'static str,
        /// The option asked for.
        option: &'static str,
        /// The options it takes.
        takes: &'static [&'static str],
    },
    /// An option has a value that the warp cannot have, or is missing.
    Option {
        /// The name of the warp.
        warp: &'static str,
        /// The option.
        option: &'static str,
        /// The value, or "nothing".
        asked: String,
        /// What is allowed, as a phrase that follows "must be".
        allowed: &'static str,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => {
                let known = super::ALL.iter().map(|entry| entry.name).collect::<Vec<_>>();
                write!(f, "unknown warp '{name}'; known: {}", known.join(", "))
            }
            Self::NotTaken { warp, option, takes } => {
                let has = if takes.is_empty() { "none".into() } else { takes.join(", ") };
                write!(f, "warp '{warp}' has no option '{option}'; it has: {has}")
            }
            Self::Option { warp, option, asked, allowed } => {
                write!(f, "option '{option}' of warp '{warp}' must be {allowed}, not {asked}")
            }
        }
    }
}

impl std::error::Error for Error {}

/// The error that says what an option must be.
pub(crate) fn refused(
    warp: &'static str,
    option: &'static str,
    asked: impl fmt::Debug,
    allowed: &'static str,
) -> Error {
    Error::Option { warp, option, asked: format!("{asked:?}"), allowed }
}

/// The dimensions of a curve.
pub(crate) fn curve_dims(warp: &'static str, dims: Option<usize>) -> Result<usize, Error> {
    match dims {
        Some(dims @ 2..=32) => Ok(dims),
        Some(other) => Err(refused(warp, "dims", other, "from 2 to 32")),
        None => Err(missing(warp, "dims", "from 2 to 32")),
    }
}

/// The error that says that an option must be given.
pub(crate) fn missing(warp: &'static str, option: &'static str, allowed: &'static str) -> Error {
    Error::Option { warp, option, asked: "nothing".into(), allowed }
}

/// A number that must be positive and finite.
pub(crate) fn positive(warp: &'static str, option: &'static str, value: f64) -> Result<f64, Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(refused(warp, option, value, "positive and finite"))
}

/// Weights that must be finite and not negative, with a positive sum.
pub(crate) fn weights<'a>(warp: &'static str, values: Option<&'a [f64]>) -> Result<&'a [f64], Error> {
    const ALLOWED: &str = "finite numbers from 0 on with a positive sum";
    let values = values.ok_or_else(|| missing(warp, "values", ALLOWED))?;
    if let Some((place, value)) = values.iter().enumerate().find(|(_, value)| value.is_nan() || **value < 0.0)
    {
        return Err(refused(warp, "values", format_args!("{value} at {place}"), ALLOWED));
    }
    let sum = values.iter().sum::<f64>();
    if sum > 0.0 && sum.is_finite() {
        return Ok(values);
    }
    Err(refused(warp, "values", format_args!("{} with sum {sum}", values.len()), ALLOWED))
}

/// Knots that must ascend.
pub(crate) fn ascending(warp: &'static str, knots: Option<&[f64]>, count: usize) -> Result<Vec<f64>, Error> {
    const ALLOWED: &str = "ascending finite numbers, as many as the values need";
    let Some(knots) = knots else {
        return Ok((0..count).map(|k| k as f64 / (count - 1) as f64).collect());
    };
    let ascends = knots.windows(2).all(|pair| pair[0] < pair[1]) && knots.iter().all(|x| x.is_finite());
    if knots.len() == count && ascends {
        return Ok(knots.to_vec());
    }
    Err(refused(warp, "knots", format_args!("{} for {count}", knots.len()), ALLOWED))
}
