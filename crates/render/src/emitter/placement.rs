//! Where a light of no extent is or shines to: a vector of its own or `to_world`, never both.

use glam::{DAffine3, DVec3};

use crate::Result;
use crate::scene::properties::Properties;

/// The vector `name`, or what `from_transform` takes from `to_world`; an error where a scene gives both.
pub(super) fn vector_or_transform(
    properties: &Properties<'_>,
    name: &str,
    from_transform: fn(&DAffine3) -> DVec3,
) -> Result<DVec3> {
    let to_world = crate::shape::to_world(properties)?;
    match properties.optional_vector(name)? {
        Some(_) if properties.has("to_world") => {
            Err(properties.error(format_args!("{name} and to_world exclude each other")))
        }
        Some(vector) => Ok(DVec3::from(vector)),
        None => Ok(from_transform(&to_world)),
    }
}
