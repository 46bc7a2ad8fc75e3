//! Mitsuba's `serialized` meshes: several compressed meshes in one file, with a dictionary at its end.
//!
//! Format (Mitsuba 3 documentation, "Serialized mesh loader"), little endian: `0x041C`, version 3 or 4, then a zlib
//! stream of flags, name (version 4), counts, positions, normals, texture coordinates, colors, triangles. The file
//! ends with the offset of every mesh (32 bits in version 3, else 64) and their number.

use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;

use super::{FILE_LIMIT, Mesh};
use crate::scene::folder;
use crate::{Error, Result};

/// What goes wrong, without the file's name.
type Parse<T> = std::result::Result<T, String>;

const FORMAT: u16 = 0x041C;
const NORMALS: u32 = 0x0001;
const TEXCOORDS: u32 = 0x0002;
const COLORS: u32 = 0x0008;
const FACE_NORMALS: u32 = 0x0010;
const DOUBLE: u32 = 0x2000;

/// The most a mesh may hold when decompressed, in bytes.
const MESH_LIMIT: u64 = 1 << 30;
/// Deflate cannot do better than this (zlib, "Maximum Expansion Factor").
const MAX_RATIO: u64 = 1032;

/// Read the mesh at a position of the file's dictionary.
pub fn read(path: &Path, shape_index: usize) -> Result<Mesh> {
    let bytes = folder::read(path, FILE_LIMIT)?;
    let mesh = parse(&bytes, shape_index);
    mesh.map_err(|message| Error::file(path, format_args!("serialized mesh: {message}")))?.checked(path)
}

fn parse(bytes: &[u8], shape_index: usize) -> Parse<Mesh> {
    let version = version(bytes)?;
    let start = offset(bytes, version, shape_index)?;
    let stream = bytes.get(start..).ok_or("the dictionary points outside of the file")?;
    self::version(stream).map_err(|message| format!("mesh {shape_index}: {message}"))?;
    let limit = MESH_LIMIT.min(stream.len() as u64 * MAX_RATIO);
    Inflate { decoder: ZlibDecoder::new(&stream[4..]), left: limit }.mesh(version)
}

fn version(bytes: &[u8]) -> Parse<u16> {
    let Some(&[a, b, c, d]) = bytes.first_chunk() else { return Err("the file ends too early".into()) };
    if u16::from_le_bytes([a, b]) != FORMAT {
        return Err("does not start with the format's identifier 0x041C".into());
    }
    match u16::from_le_bytes([c, d]) {
        version @ 3..=4 => Ok(version),
        other => Err(format!("version {other} is not supported; known: 3, 4")),
    }
}

/// Where a mesh starts. The first one is always at the start of the file.
fn offset(bytes: &[u8], version: u16, shape_index: usize) -> Parse<usize> {
    if shape_index == 0 {
        return Ok(0);
    }
    let (rest, count) = bytes.split_last_chunk().ok_or("the dictionary is missing")?;
    let count = u32::from_le_bytes(*count) as usize;
    if shape_index >= count {
        return Err(format!("there is no mesh {shape_index}; the file holds {count}, counted from 0"));
    }
    let width = if version == 3 { 4 } else { 8 };
    let back = (count - shape_index) * width;
    let at = rest.len().checked_sub(back).ok_or("the dictionary is longer than the file")?;
    let mut word = [0; 8];
    word[..width].copy_from_slice(&rest[at..at + width]);
    usize::try_from(u64::from_le_bytes(word)).map_err(|_| "an offset is too large".into())
}

/// A decompressing reader that never gives more than it is allowed.
struct Inflate<'a> {
    decoder: ZlibDecoder<&'a [u8]>,
    left: u64,
}

impl Inflate<'_> {
    fn mesh(&mut self, version: u16) -> Parse<Mesh> {
        let flags = u32::from_le_bytes(self.array()?);
        if version >= 4 {
            while self.array::<1>()? != [0] {}
        }
        let vertices = u64::from_le_bytes(self.array()?);
        let triangles = u64::from_le_bytes(self.array()?);
        let has = |flag: u32| flags & flag != 0;
        self.announce(flags, vertices, triangles)?;
        let (vertices, double) = (vertices as usize, has(DOUBLE));
        let positions = self.rows(vertices, double)?;
        let normals = has(NORMALS).then(|| self.rows(vertices, double)).transpose()?;
        let uvs = has(TEXCOORDS).then(|| self.rows(vertices, double)).transpose()?;
        let colors = has(COLORS).then(|| self.rows(vertices, double)).transpose()?;
        let words = self.bytes(triangles as usize * 12)?;
        let word = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let triangle = |bytes: &[u8]| [word(bytes), word(&bytes[4..]), word(&bytes[8..])];
        let indices = words.chunks_exact(12).map(triangle).collect();
        Ok(Mesh { positions, normals, uvs, colors, indices, face_normals: has(FACE_NORMALS) })
    }

    /// Refuse counts that cannot be true, before anything is allocated.
    fn announce(&self, flags: u32, vertices: u64, triangles: u64) -> Parse<()> {
        let per_flag = [(NORMALS, 3), (TEXCOORDS, 2), (COLORS, 3)];
        let numbers: u64 = per_flag.iter().filter(|(flag, _)| flags & flag != 0).map(|(_, n)| n).sum();
        let each = (3 + numbers) * if flags & DOUBLE == 0 { 4 } else { 8 };
        let size = vertices.checked_mul(each).zip(triangles.checked_mul(12));
        if size.and_then(|(v, t)| v.checked_add(t)).is_none_or(|size| size > self.left) {
            return Err(format!(
                "{vertices} vertices and {triangles} triangles are announced, more than the file or the limit of \
                 {} MiB allows",
                MESH_LIMIT >> 20
            ));
        }
        Ok(())
    }

    fn rows<const N: usize>(&mut self, count: usize, double: bool) -> Parse<Vec<[f32; N]>> {
        let width = if double { 8 } else { 4 };
        let bytes = self.bytes(count * N * width)?;
        let number = |bytes: &[u8]| match *bytes {
            [a, b, c, d] => f32::from_le_bytes([a, b, c, d]),
            [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]) as f32,
            _ => unreachable!("numbers have 4 or 8 bytes"),
        };
        let row = |row: &[u8]| std::array::from_fn(|i| number(&row[i * width..(i + 1) * width]));
        Ok(bytes.chunks_exact(N * width).map(row).collect())
    }

    fn array<const N: usize>(&mut self) -> Parse<[u8; N]> {
        let bytes = self.bytes(N)?;
        bytes.try_into().map_err(|_| "the file ends too early".into())
    }

    /// Exactly this many bytes; memory grows with what really arrives.
    fn bytes(&mut self, count: usize) -> Parse<Vec<u8>> {
        let count = count as u64;
        self.left = self.left.checked_sub(count).ok_or("holds more than its size allows")?;
        let mut bytes = Vec::new();
        let got = (&mut self.decoder).take(count).read_to_end(&mut bytes);
        match got.map_err(|error| format!("cannot be decompressed: {error}"))? as u64 {
            got if got == count => Ok(bytes),
            got => Err(format!("the file ends too early: {got} bytes where {count} are needed")),
        }
    }
}
