//! Triangle meshes read from files: Stanford PLY, Wavefront OBJ and Mitsuba's `serialized` format.
//!
//! A [`Mesh`] holds what the file says, in object space. The builder of the shape applies what its plugin documents:
//! `to_world`, `face_normals`, `flip_normals`, computed normals where there are none, and `flip_tex_coords`, which replaces
//! v by 1 − v and whose default is *true* for `obj` and *false* for `ply` and `serialized`.
//!
//! Files are not trusted: no count of a header is believed before the bytes are there, polygons become fans, and a mesh that
//! is handed out has finite numbers and valid indices.

pub mod obj;
pub mod ply;
pub mod serialized;

use std::path::Path;

use crate::{Error, Result};

/// The largest mesh file that is read, in bytes.
const FILE_LIMIT: u64 = 2 << 30;

/// An indexed triangle mesh in object space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<[f32; 3]>,
    /// One shading normal per vertex, as given: perhaps not of unit length.
    pub normals: Option<Vec<[f32; 3]>>,
    /// One pair of texture coordinates per vertex, as given: v is not flipped.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// One linear color per vertex.
    pub colors: Option<Vec<[f32; 3]>>,
    /// Triangles, as positions in the lists of vertices.
    pub indices: Vec<[u32; 3]>,
    /// The file itself asks for faceted shading (`serialized` only).
    pub face_normals: bool,
}

impl Mesh {
    /// The promise of this module: finite numbers, valid indices, lists of one length.
    fn checked(self, path: &Path) -> Result<Self> {
        let bad = |what: &str, at: usize| Err(Error::file(path, format_args!("{what} {at} is not finite")));
        if let Some(at) = first_not_finite(&self.positions) {
            return bad("the position of vertex", at);
        }
        if let Some(at) = self.normals.as_deref().and_then(first_not_finite) {
            return bad("the normal of vertex", at);
        }
        if let Some(at) = self.uvs.as_deref().and_then(first_not_finite) {
            return bad("the texture coordinate of vertex", at);
        }
        if let Some(at) = self.colors.as_deref().and_then(first_not_finite) {
            return bad("the color of vertex", at);
        }
        let vertices = self.positions.len();
        if let Some(at) = self.indices.iter().position(|face| face.iter().any(|&i| i as usize >= vertices)) {
            let face = self.indices[at];
            let message = format_args!("triangle {at} refers to vertices {face:?}, but there are {vertices}");
            return Err(Error::file(path, message));
        }
        Ok(self)
    }

    /// Add a polygon as a fan around its first corner.
    fn push_polygon(&mut self, corners: &[u32]) {
        let fan = corners.windows(2).skip(1);
        self.indices.extend(fan.map(|edge| [corners[0], edge[0], edge[1]]));
    }
}

fn first_not_finite<const N: usize>(rows: &[[f32; N]]) -> Option<usize> {
    rows.iter().position(|row| !row.iter().all(|x| x.is_finite()))
}
