//! `obj`: a triangle mesh in the Wavefront format; v runs upwards, unless `flip_tex_coords` is off.

use crate::Result;
use crate::scene::build::Builder;
use crate::scene::mesh;
use crate::scene::properties::Properties;
use crate::shape::triangles::{MeshOptions, place};
use crate::shape::{Entry, Geometry};

pub(crate) const ENTRY: Entry = Entry { name: "obj", build };

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let options = MeshOptions::read(properties, true)?;
    let path = properties.required_path("filename")?;
    Ok(Geometry::Mesh(place(mesh::obj::read(&path)?, &options)))
}
