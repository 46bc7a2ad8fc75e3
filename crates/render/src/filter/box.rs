//! `box`: an average over a square; no overlap between pixels at the default radius of one half.

use crate::Result;
use crate::filter::{Entry, Filter};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry = Entry { name: "box", build };

fn build(properties: &Properties<'_>) -> Result<Filter> {
    let radius = properties.positive_float("radius", 0.5)?;
    Ok(Filter { radius, ..Filter::pixel_box() })
}
