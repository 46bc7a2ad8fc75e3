//! `ply`: a triangle mesh in the Stanford format, ascii or binary.

use crate::Result;
use crate::scene::build::Builder;
use crate::scene::mesh;
use crate::scene::properties::Properties;
use crate::shape::triangles::{MeshOptions, place};
use crate::shape::{Entry, Geometry};

pub(crate) const ENTRY: Entry = Entry { name: "ply", build };

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let options = MeshOptions::read(properties, false)?;
    let path = properties.required_path("filename")?;
    Ok(Geometry::Mesh(place(mesh::ply::read(&path)?, &options)))
}
