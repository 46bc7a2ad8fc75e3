//! `gaussian`: a normal density, cut at four standard deviations and lowered to zero there.

use crate::Result;
use crate::filter::{Entry, Filter};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry = Entry { name: "gaussian", build };

fn build(properties: &Properties<'_>) -> Result<Filter> {
    let stddev = properties.positive_float("stddev", 0.5)?;
    let (radius, alpha) = (4.0 * stddev, -0.5 / f64::from(stddev * stddev));
    let edge = (alpha * f64::from(radius * radius)).exp();
    Ok(Filter::tabulate(ENTRY.name, radius, |x| ((alpha * x * x).exp() - edge).max(0.0)))
}
