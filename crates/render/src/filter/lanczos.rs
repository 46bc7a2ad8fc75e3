//! `lanczos`: a sinc windowed by a wider sinc; the sharpest here, rings the most.

use std::f64::consts::PI;

use crate::Result;
use crate::filter::{Entry, Filter};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry = Entry { name: "lanczos", build };

fn build(properties: &Properties<'_>) -> Result<Filter> {
    let lobes = properties.optional_integer("lobes")?.unwrap_or(3);
    if !(1..=16).contains(&lobes) {
        return Err(properties.error("lobes must be between 1 and 16"));
    }
    let sinc = |x: f64| if x.abs() < 1e-9 { 1.0 } else { (PI * x).sin() / (PI * x) };
    Ok(Filter::tabulate(ENTRY.name, lobes as f32, |x| sinc(x) * sinc(x / lobes as f64)))
}
