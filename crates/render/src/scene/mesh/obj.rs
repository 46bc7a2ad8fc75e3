//! Wavefront OBJ: `v`, `vt`, `vn` and `f`; polygons become fans, indices may be negative, groups and materials are
//! ignored.
//!
//! Every distinct combination of position, texture coordinate and normal becomes one vertex. Texture coordinates are as
//! in the file; flipping v (Mitsuba's default for this format) is up to the builder of the shape.

use std::collections::HashMap;
use std::path::Path;

use super::{FILE_LIMIT, Mesh};
use crate::scene::folder;
use crate::{Error, Result};

/// What goes wrong, without the file's name.
type Parse<T> = std::result::Result<T, String>;

/// Position, texture coordinate and normal of a corner, as places in the lists of the file.
type Corner = (u32, Option<u32>, Option<u32>);

#[derive(Default)]
struct Reader {
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    vertices: HashMap<Corner, u32>,
    corners: Vec<Corner>,
    mesh: Mesh,
}

/// Read an OBJ file.
pub fn read(path: &Path) -> Result<Mesh> {
    let bytes = folder::read(path, FILE_LIMIT)?;
    let mut reader = Reader::default();
    for (number, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        let blame = |message| Error::file(path, format_args!("OBJ, line {}: {message}", number + 1));
        // Names of groups and comments may be in any encoding; only lines with numbers must be text.
        if matches!(line.trim_ascii_start(), [b'v' | b'f', ..]) {
            let line = std::str::from_utf8(line).map_err(|_| blame("not text".to_owned()))?;
            reader.line(line).map_err(blame)?;
        }
    }
    reader.finish().checked(path)
}

impl Reader {
    fn line(&mut self, line: &str) -> Parse<()> {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.positions.push(numbers(words, 3)?),
            Some("vn") => self.normals.push(numbers(words, 3)?),
            Some("vt") => self.uvs.push(numbers(words, 1)?),
            Some("f") => self.face(words)?,
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Parse<()> {
        let mut polygon = Vec::with_capacity(4);
        for word in words.take_while(|word| !word.starts_with('#')) {
            let corner = self.corner(word)?;
            let next = self.corners.len() as u32;
            let vertex = *self.vertices.entry(corner).or_insert(next);
            if vertex == next {
                self.corners.push(corner);
            }
            polygon.push(vertex);
        }
        if polygon.len() < 3 {
            return Err(format!("a face with {} corners", polygon.len()));
        }
        self.mesh.push_polygon(&polygon);
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &str) -> Parse<Corner> {
        let mut parts = word.split('/');
        let mut part = |count: usize, what: &str| match parts.next() {
            None | Some("") => Ok(None),
            Some(index) => place(index, count, what).map(Some),
        };
        let position = part(self.positions.len(), "position")?.ok_or("a corner without a position")?;
        let uv = part(self.uvs.len(), "texture coordinate")?;
        let normal = part(self.normals.len(), "normal")?;
        if parts.next().is_some() {
            return Err(format!("cannot read the corner '{}'", word.escape_debug()));
        }
        Ok((position, uv, normal))
    }

    fn finish(mut self) -> Mesh {
        let position = |corner: &Corner| self.positions[corner.0 as usize];
        self.mesh.positions = self.corners.iter().map(position).collect();
        // Where only some corners have texture coordinates, the others get (0, 0); a normal has no such default.
        if self.corners.iter().any(|corner| corner.1.is_some()) {
            let uv = |corner: &Corner| corner.1.map_or([0.0; 2], |i| self.uvs[i as usize]);
            self.mesh.uvs = Some(self.corners.iter().map(uv).collect());
        }
        let normal = |corner: &Corner| corner.2.map(|i| self.normals[i as usize]);
        self.mesh.normals = self.corners.iter().map(normal).collect();
        self.mesh.normals = self.mesh.normals.filter(|normals| !normals.is_empty());
        self.mesh
    }
}

/// At least `needed` and at most `N` numbers; further words are ignored.
fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>, needed: usize) -> Parse<[f32; N]> {
    let mut row = [0.0; N];
    for (i, number) in row.iter_mut().enumerate() {
        match words.next() {
            Some(word) => {
                *number = word.parse().map_err(|_| format!("'{}' is not a number", word.escape_debug()))?;
            }
            None if i >= needed => break,
            None => return Err(format!("{i} numbers where {needed} are needed")),
        }
    }
    Ok(row)
}

/// The place an index means: counted from 1, or from the end when negative.
fn place(index: &str, count: usize, what: &str) -> Parse<u32> {
    let number: i64 = index.parse().map_err(|_| format!("'{}' is not an index", index.escape_debug()))?;
    let place = if number < 0 { count as i64 + number } else { number - 1 };
    let valid = u32::try_from(place).ok().filter(|&place| (place as usize) < count);
    valid.ok_or_else(|| format!("{what} {number} does not exist; there are {count} up to here"))
}
