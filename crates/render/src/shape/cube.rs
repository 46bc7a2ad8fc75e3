//! `cube`: the cube [−1, 1]³ with outward faces, as twelve triangles.

use crate::Result;
use crate::geometry::Vec3;
use crate::scene::build::Builder;
use crate::scene::mesh::Mesh;
use crate::scene::properties::Properties;
use crate::shape::{Entry, Geometry, to_world, triangles};

pub(crate) const ENTRY: Entry = Entry { name: "cube", build };

/// Outward normal of each face and where its u runs; v runs along their cross product, so that textures are seen from inside.
const FACES: [(Vec3, Vec3); 6] = [
    (Vec3::NEG_Y, Vec3::Z),
    (Vec3::Y, Vec3::NEG_X),
    (Vec3::X, Vec3::Y),
    (Vec3::Z, Vec3::Y),
    (Vec3::NEG_X, Vec3::Y),
    (Vec3::NEG_Z, Vec3::NEG_Y),
];

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let flip = properties.boolean("flip_normals", false)?;
    let mut mesh = Mesh::default();
    for (face, (normal, tangent)) in (0_u32..).zip(FACES) {
        let bitangent = tangent.cross(normal);
        for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            let position = normal + tangent * (2.0 * u - 1.0) + bitangent * (2.0 * v - 1.0);
            mesh.positions.push(position.into());
            mesh.normals.get_or_insert_default().push(normal.into());
            mesh.uvs.get_or_insert_default().push([u, v]);
        }
        let first = 4 * face;
        mesh.indices.extend([[first, first + 2, first + 1], [first + 2, first, first + 3]]);
    }
    triangles::transform(&mut mesh, &to_world(properties)?);
    if flip {
        mesh.indices.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        mesh.normals.iter_mut().flatten().for_each(|normal| *normal = normal.map(|x| -x));
    }
    Ok(Geometry::Mesh(mesh))
}
