//! `tent`: falls linearly to zero at its radius; rarely rings, blurs a little.

use crate::Result;
use crate::filter::{Entry, Filter};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry = Entry { name: "tent", build };

fn build(properties: &Properties<'_>) -> Result<Filter> {
    let radius = properties.positive_float("radius", 1.0)?;
    let reach = f64::from(radius);
    Ok(Filter::tabulate(ENTRY.name, radius, |x| (1.0 - x.abs() / reach).max(0.0)))
}
