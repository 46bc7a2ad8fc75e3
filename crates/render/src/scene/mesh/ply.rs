//! Stanford PLY: ASCII and binary, any order and type of properties.
//!
//! Vertices: `x y z`, optional `nx ny nz`, `u v` or `s t`, and `r g b` or `red green blue` (integers are taken as
//! sRGB). Faces: a list `vertex_index` or `vertex_indices` of three or more corners, where Mitsuba 3.9.1 takes triangles
//! only. All else is skipped.
//! Format: Turk, "The PLY Polygon File Format", 1994.

use std::path::Path;

use super::{FILE_LIMIT, Mesh};
use crate::scene::folder;
use crate::texture::image::srgb_to_linear;
use crate::{Error, Result};

/// What goes wrong, without the file's name.
type Parse<T> = std::result::Result<T, String>;

const MAX_ELEMENTS: usize = 64;
const MAX_PROPERTIES: usize = 256;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &str) -> Parse<Self> {
        Ok(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(format!("unknown property type '{}'", name.escape_debug())),
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value that stands for 1 in a color.
    fn color_range(self) -> Option<f64> {
        match self {
            Self::U8 => Some(255.0),
            Self::U16 => Some(65535.0),
            _ => None,
        }
    }
}

struct Property<'a> {
    name: &'a str,
    scalar: Scalar,
    /// Type of the length, for lists.
    length: Option<Scalar>,
}

struct Element<'a> {
    name: &'a str,
    count: usize,
    properties: Vec<Property<'a>>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

struct Header<'a> {
    encoding: Encoding,
    elements: Vec<Element<'a>>,
}

/// Read a PLY file.
pub fn read(path: &Path) -> Result<Mesh> {
    let bytes = folder::read(path, FILE_LIMIT)?;
    parse(&bytes).map_err(|message| Error::file(path, format_args!("PLY: {message}")))?.checked(path)
}

fn parse(bytes: &[u8]) -> Parse<Mesh> {
    let (header, body) = header(bytes)?;
    match header.encoding {
        Encoding::Ascii => read_body(&header, &mut Ascii { rest: body }),
        Encoding::LittleEndian => read_body(&header, &mut Binary::<false> { rest: body }),
        Encoding::BigEndian => read_body(&header, &mut Binary::<true> { rest: body }),
    }
}

/// The header and the bytes after it.
fn header(bytes: &[u8]) -> Parse<(Header<'_>, &[u8])> {
    let mut rest = bytes;
    if next_line(&mut rest)? != "ply" {
        return Err("does not start with 'ply'".into());
    }
    let mut encoding = None;
    let mut elements: Vec<Element<'_>> = Vec::new();
    loop {
        let line = next_line(&mut rest)?;
        let words: Vec<&str> = line.split_ascii_whitespace().take(6).collect();
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, "1.0"] => encoding = Some(encoding_named(name)?),
            ["element", name, count] => {
                let count = count.parse().map_err(|_| format!("'{line}' has no valid count"))?;
                elements.push(Element { name, count, properties: Vec::new() });
            }
            ["property", ref words @ ..] => {
                let element = elements.last_mut().ok_or("a property before any element")?;
                element.properties.push(property(words, line)?);
            }
            ["end_header"] => break,
            _ => return Err(format!("unknown header line '{}'", line.escape_debug())),
        }
        if elements.len() > MAX_ELEMENTS
            || elements.last().is_some_and(|element| element.properties.len() > MAX_PROPERTIES)
        {
            return Err(format!("more than {MAX_ELEMENTS} elements or {MAX_PROPERTIES} properties"));
        }
    }
    let encoding = encoding.ok_or("the header has no 'format' line")?;
    Ok((Header { encoding, elements }, rest))
}

fn next_line<'a>(rest: &mut &'a [u8]) -> Parse<&'a str> {
    let end = rest.iter().position(|&byte| byte == b'\n').ok_or("the header ends too early")?;
    let line = std::str::from_utf8(&rest[..end]).map_err(|_| "the header is not text")?;
    *rest = &rest[end + 1..];
    Ok(line.trim())
}

fn encoding_named(name: &str) -> Parse<Encoding> {
    match name {
        "ascii" => Ok(Encoding::Ascii),
        "binary_little_endian" => Ok(Encoding::LittleEndian),
        "binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(format!("unknown format '{}'", name.escape_debug())),
    }
}

fn property<'a>(words: &[&'a str], line: &str) -> Parse<Property<'a>> {
    match *words {
        ["list", length, scalar, name] => {
            let length = Scalar::named(length)?;
            if matches!(length, Scalar::F32 | Scalar::F64) {
                return Err(format!("list '{name}' has a length that is not a whole number"));
            }
            Ok(Property { name, scalar: Scalar::named(scalar)?, length: Some(length) })
        }
        [scalar, name] if scalar != "list" => {
            Ok(Property { name, scalar: Scalar::named(scalar)?, length: None })
        }
        _ => Err(format!("cannot read '{}'", line.escape_debug())),
    }
}

/// Where the numbers of the body come from.
trait Numbers {
    /// The next number.
    fn next(&mut self, scalar: Scalar) -> Parse<f64>;
    /// An upper bound of how many numbers with this total binary size may still come.
    fn room_for(&self, count: usize, numbers: usize, size: usize) -> bool;
}

struct Binary<'a, const BIG: bool> {
    rest: &'a [u8],
}

impl<const BIG: bool> Numbers for Binary<'_, BIG> {
    #[inline]
    fn next(&mut self, scalar: Scalar) -> Parse<f64> {
        macro_rules! take {
            ($number:ty) => {{
                let Some((bytes, rest)) = self.rest.split_first_chunk() else {
                    return Err("the file ends too early".into());
                };
                self.rest = rest;
                let number =
                    if BIG { <$number>::from_be_bytes(*bytes) } else { <$number>::from_le_bytes(*bytes) };
                f64::from(number)
            }};
        }
        Ok(match scalar {
            Scalar::I8 => take!(i8),
            Scalar::U8 => take!(u8),
            Scalar::I16 => take!(i16),
            Scalar::U16 => take!(u16),
            Scalar::I32 => take!(i32),
            Scalar::U32 => take!(u32),
            Scalar::F32 => take!(f32),
            Scalar::F64 => take!(f64),
        })
    }

    fn room_for(&self, count: usize, _: usize, size: usize) -> bool {
        count.checked_mul(size).is_some_and(|bytes| bytes <= self.rest.len())
    }
}

struct Ascii<'a> {
    rest: &'a [u8],
}

impl Numbers for Ascii<'_> {
    fn next(&mut self, _: Scalar) -> Parse<f64> {
        let start = self.rest.iter().position(|byte| !byte.is_ascii_whitespace());
        let word = &self.rest[start.ok_or("the file ends too early")?..];
        let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.rest = &word[end..];
        let number = std::str::from_utf8(&word[..end]).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| format!("'{}' is not a number", word[..end.min(40)].escape_ascii()))
    }

    fn room_for(&self, count: usize, numbers: usize, _: usize) -> bool {
        // A digit and a separator each; the last separator may be missing.
        count.checked_mul(numbers * 2).is_some_and(|bytes| bytes <= self.rest.len() + 1)
    }
}

fn read_body(header: &Header<'_>, numbers: &mut impl Numbers) -> Parse<Mesh> {
    let mut mesh = Mesh::default();
    let mut known = [false; 2];
    for element in &header.elements {
        // Without properties there is nothing to read, however large the count is.
        if element.properties.is_empty() {
            continue;
        }
        let each = element.properties.len();
        let size = element.properties.iter().map(|p| p.length.unwrap_or(p.scalar).size()).sum();
        if !numbers.room_for(element.count, each, size) {
            return Err(format!(
                "{} elements '{}' are announced, but the file is too short for them",
                element.count, element.name
            ));
        }
        let place = ["vertex", "face"].iter().position(|name| *name == element.name);
        if place.is_some_and(|place| std::mem::replace(&mut known[place], true)) {
            return Err(format!("two elements '{}'", element.name));
        }
        match place {
            Some(0) => read_vertices(element, numbers, &mut mesh)?,
            Some(_) => read_faces(element, numbers, &mut mesh)?,
            None => skip(element, numbers)?,
        }
    }
    match known {
        [true, true] => Ok(mesh),
        [false, _] => Err("no vertices: the element 'vertex' is missing or empty of properties".into()),
        _ => Err("no triangles: the element 'face' is missing or empty of properties".into()),
    }
}

/// Where the properties of a vertex go: position, normal, texture coordinate, color.
const SLOTS: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texture_s"],
    &["v", "t", "texture_v", "texture_t"],
    &["r", "red"],
    &["g", "green"],
    &["b", "blue"],
];

fn read_vertices(element: &Element<'_>, numbers: &mut impl Numbers, mesh: &mut Mesh) -> Parse<()> {
    let slot =
        |p: &Property<'_>| SLOTS.iter().position(|names| names.contains(&p.name) && p.length.is_none());
    let slots: Vec<Option<usize>> = element.properties.iter().map(slot).collect();
    let given = |slot: usize| slots.iter().filter(|s| **s == Some(slot)).count();
    if let Some(twice) = (0..SLOTS.len()).find(|slot| given(*slot) > 1) {
        return Err(format!("the property '{}' of vertices is given twice", SLOTS[twice][0]));
    }
    let all = |range: std::ops::Range<usize>| range.into_iter().all(|slot| given(slot) == 1);
    if !all(0..3) {
        return Err("vertices have no x, y and z".into());
    }
    let color_property = element.properties.iter().find(|p| SLOTS[8].contains(&p.name));
    let range = color_property.and_then(|p| p.scalar.color_range());
    let count = element.count;
    mesh.positions.reserve_exact(count);
    mesh.normals = all(3..6).then(|| Vec::with_capacity(count));
    mesh.uvs = all(6..8).then(|| Vec::with_capacity(count));
    mesh.colors = all(8..11).then(|| Vec::with_capacity(count));
    let mut row = [0.0_f32; SLOTS.len()];
    for _ in 0..count {
        for (property, slot) in element.properties.iter().zip(&slots) {
            match slot {
                Some(slot) => row[*slot] = numbers.next(property.scalar)? as f32,
                None => skip_property(property, numbers)?,
            }
        }
        mesh.positions.push([row[0], row[1], row[2]]);
        if let Some(normals) = &mut mesh.normals {
            normals.push([row[3], row[4], row[5]]);
        }
        if let Some(uvs) = &mut mesh.uvs {
            uvs.push([row[6], row[7]]);
        }
        if let Some(colors) = &mut mesh.colors {
            let color = [row[8], row[9], row[10]];
            colors.push(range.map_or(color, |range| color.map(|c| srgb_to_linear(c / range as f32))));
        }
    }
    Ok(())
}

fn read_faces(element: &Element<'_>, numbers: &mut impl Numbers, mesh: &mut Mesh) -> Parse<()> {
    let is_corners = |p: &Property<'_>| matches!(p.name, "vertex_index" | "vertex_indices");
    if element.properties.iter().filter(|p| is_corners(p) && p.length.is_some()).count() != 1 {
        return Err("faces need one list 'vertex_index' or 'vertex_indices'".into());
    }
    mesh.indices.reserve_exact(element.count);
    let mut corners = Vec::new();
    for face in 0..element.count {
        for property in &element.properties {
            let Some(length) = property.length.filter(|_| is_corners(property)) else {
                skip_property(property, numbers)?;
                continue;
            };
            let length = list_length(numbers, length, property.scalar)?;
            if length < 3 {
                return Err(format!("face {face} has {length} corners"));
            }
            corners.clear();
            for _ in 0..length {
                let index = numbers.next(property.scalar)?;
                if !(0.0..=f64::from(u32::MAX)).contains(&index) || index.fract() != 0.0 {
                    return Err(format!("face {face} refers to vertex {index}"));
                }
                corners.push(index as u32);
            }
            mesh.push_polygon(&corners);
        }
    }
    Ok(())
}

fn list_length(numbers: &mut impl Numbers, length: Scalar, scalar: Scalar) -> Parse<usize> {
    let length = numbers.next(length)?;
    if length < 0.0 || length.fract() != 0.0 || !numbers.room_for(length as usize, 1, scalar.size()) {
        return Err(format!("a list of length {length}, for which the file is too short"));
    }
    Ok(length as usize)
}

fn skip(element: &Element<'_>, numbers: &mut impl Numbers) -> Parse<()> {
    for _ in 0..element.count {
        element.properties.iter().try_for_each(|property| skip_property(property, numbers))?;
    }
    Ok(())
}

fn skip_property(property: &Property<'_>, numbers: &mut impl Numbers) -> Parse<()> {
    let length = match property.length {
        None => 1,
        Some(length) => list_length(numbers, length, property.scalar)?,
    };
    (0..length).try_for_each(|_| numbers.next(property.scalar).map(|_| ()))
}
