//! `mitchell`: cubic with negative lobes (Mitchell & Netravali 1988); sharp, rings a little.

use crate::Result;
use crate::filter::{Entry, Filter};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry = Entry { name: "mitchell", build };

fn build(properties: &Properties<'_>) -> Result<Filter> {
    let b = f64::from(properties.float("B", 1.0 / 3.0)?);
    let c = f64::from(properties.float("C", 1.0 / 3.0)?);
    Ok(Filter::tabulate(ENTRY.name, 2.0, |x| cubic(b, c, x.abs())))
}

/// Equation (8) of Mitchell & Netravali, "Reconstruction Filters in Computer Graphics".
pub(super) fn cubic(b: f64, c: f64, x: f64) -> f64 {
    let value = if x < 1.0 {
        (12.0 - 9.0 * b - 6.0 * c) * x.powi(3) + (-18.0 + 12.0 * b + 6.0 * c) * x * x + (6.0 - 2.0 * b)
    } else if x < 2.0 {
        (-b - 6.0 * c) * x.powi(3)
            + (6.0 * b + 30.0 * c) * x * x
            + (-12.0 * b - 48.0 * c) * x
            + (8.0 * b + 24.0 * c)
    } else {
        0.0
    };
    value / 6.0
}
