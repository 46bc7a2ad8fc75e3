//! `serialized`: one of the triangle meshes in Mitsuba's compressed binary file.

use crate::Result;
use crate::scene::build::Builder;
use crate::scene::mesh;
use crate::scene::properties::Properties;
use crate::shape::triangles::{MeshOptions, place};
use crate::shape::{Entry, Geometry};

pub(crate) const ENTRY: Entry = Entry { name: "serialized", build };

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let options = MeshOptions::read(properties, false)?;
    let path = properties.required_path("filename")?;
    let index = properties.optional_integer("shape_index")?.unwrap_or(0);
    let index = usize::try_from(index).map_err(|_| properties.error("shape_index must not be negative"))?;
    Ok(Geometry::Mesh(place(mesh::serialized::read(&path, index)?, &options)))
}
