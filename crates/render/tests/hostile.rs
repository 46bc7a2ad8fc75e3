//! Scenes and meshes from nobody's friend: a clear error, soon, and never a panic.

mod fixture;

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use evenlight_render::Result;
use evenlight_render::scene::mesh::{Mesh, obj, ply, serialized};
use fixture::{Folder, SOON, mangle, refused, scene};

#[test]
fn entities_are_refused() {
    let folder = Folder::new();
    let mut xml = "<!DOCTYPE scene [<!ENTITY a0 'ha'>".to_owned();
    for i in 1..30 {
        write!(xml, "<!ENTITY a{i} '&a{};&a{};'>", i - 1, i - 1).expect("text");
    }
    xml += "]><scene version='3.0.0'><string name='s' value='&a29;'/></scene>";
    assert!(folder.load(&xml).expect_err("a bomb").contains("not well-formed XML"));
    let xml = "<!DOCTYPE scene [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><scene version='3.0.0'/>";
    assert!(folder.load(xml).expect_err("an entity").contains("not well-formed XML"));
}

#[test]
fn parameters_cannot_explode() {
    let start = Instant::now();
    let mut body = "<default name='a0' value='hahahahaha'/>".to_owned();
    for i in 1..40 {
        write!(body, "<default name='a{i}' value='$a{}$a{}'/>", i - 1, i - 1).expect("text");
    }
    refused(&body, "grow too large");
    let many = "$x".repeat(2_000_000);
    refused(&format!("<default name='x' value=''/><default name='y' value='{many}'/>"), "too often");
    assert!(start.elapsed() < SOON);
}

#[test]
fn nesting_is_limited() {
    let start = Instant::now();
    let deep = |n: usize| "<bsdf type='twosided'>".repeat(n) + &"</bsdf>".repeat(n);
    scene(&deep(100)).expect("deep, but not too deep");
    refused(&deep(200), "nested deeper than 128");
    refused(&deep(100_000), "nested deeper than 128");
    // The same through references, from either end.
    for descending in [false, true] {
        let mut body = String::new();
        for i in 0..50_000 {
            let i = if descending { 50_000 - i } else { i };
            write!(body, "<bsdf type='t' id='b{i}'><ref id='b{}'/></bsdf>", i + 1).expect("text");
        }
        let last = if descending { 50_001 } else { 50_000 };
        refused(&format!("{body}<bsdf type='t' id='b{last}'/>"), "nested deeper than 128");
    }
    assert!(start.elapsed() < SOON);
}

#[test]
fn includes_cannot_explode() {
    let start = Instant::now();
    let folder = Folder::new();
    for level in 0..10 {
        let line = format!("<include filename='level{}.xml'/>", level + 1).repeat(10);
        folder.write(&format!("level{level}.xml"), format!("<scene version='3.0.0'>{line}</scene>"));
    }
    folder.write("level10.xml", "<scene version='3.0.0'/>");
    let error =
        folder.load("<scene version='3.0.0'><include filename='level0.xml'/></scene>").expect_err("many");
    assert!(error.contains("1000 includes"), "{error}");
    assert!(start.elapsed() < SOON);
}

#[test]
fn many_names_take_no_quadratic_time() {
    let start = Instant::now();
    let mut body = "<shape type='a'>".to_owned();
    for i in 0..200_000 {
        write!(body, "<float name='f{i}' value='1'/>").expect("text");
    }
    scene(&(body + "</shape>")).expect("large, but valid");
    let mut body = "<shape type='a'".to_owned();
    for i in 0..30_000 {
        write!(body, " a{i}=''").expect("text");
    }
    assert!(scene(&(body + "/>")).is_err());
    let mut body = String::new();
    for i in 0..100_000 {
        write!(body, "<bsdf type='a' id='id{i}'/>").expect("text");
    }
    refused(&(body + "<ref id='idx'/>"), "no object has the id 'idx'");
    assert!(start.elapsed() < SOON);
}

#[test]
fn a_scene_survives_cuts_and_flips() {
    let folder = Folder::new();
    let xml = "<scene version='3.0.0'><default name='n' value='2'/><bsdf type='diffuse' id='a'><rgb name='c' \
               value='1 0 .5'/></bsdf><shape type='sphere'><transform name='to_world'><lookat origin='0 0 1' \
               target='0 0 0' up='0 1 0'/><scale value='$n'/></transform><ref id='a'/><spectrum name='k' \
               value='400:1 500:2'/></shape></scene>";
    folder.load(xml).expect("valid");
    mangle(xml.as_bytes(), 3000, |bytes| {
        let path = folder.write("mangled.xml", bytes);
        let _ = evenlight_render::scene::mitsuba::load(&path, &fixture::options(&[]));
    });
}

type Reader = fn(&Path) -> Result<Mesh>;

fn read_first(path: &Path) -> Result<Mesh> {
    serialized::read(path, 0)
}

fn read_second(path: &Path) -> Result<Mesh> {
    serialized::read(path, 1)
}

/// A square of two triangles in every format that can be written.
fn squares() -> Vec<(&'static str, Vec<u8>, Reader)> {
    let ascii = "ply\nformat ascii 1.0\ncomment hi\nelement vertex 4\nproperty float x\nproperty float y\n\
                 property float z\nproperty double u\nproperty float v\nproperty uchar red\nproperty uchar green\n\
                 property uchar blue\nelement face 1\nproperty uchar flags\nproperty list uchar int vertex_index\n\
                 end_header\n0 0 0 0 0 255 0 0\n1 0 0 1 0 255 0 0\n1 1 0 1 1 255 0 0\n0 1 0 0 1 255 0 0\n7 4 0 1 2 3\n";
    let obj = "# a square\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n\
               g square\nf 1/1/1 2/2/1 3/2/1 -1/-2/-1\n";
    vec![
        ("ascii.ply", ascii.into(), ply::read),
        ("little.ply", binary_ply(false), ply::read),
        ("big.ply", binary_ply(true), ply::read),
        ("square.obj", obj.into(), obj::read),
        ("v4.serialized", serialized_file(4, false), read_second),
        ("v3.serialized", serialized_file(3, true), read_second),
        ("first.serialized", serialized_file(4, true), read_first),
    ]
}

fn binary_ply(big: bool) -> Vec<u8> {
    let name = if big { "big" } else { "little" };
    let mut file = format!(
        "ply\nformat binary_{name}_endian 1.0\nelement material 1\nproperty list ushort short numbers\n\
         element face 2\nproperty list uchar uint vertex_indices\nelement vertex 4\nproperty float nz\n\
         property double x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nend_header\n"
    )
    .into_bytes();
    let mut put = |bytes: &[u8]| if big { file.extend(bytes.iter().rev()) } else { file.extend(bytes) };
    for x in [2_u16, 8, 9] {
        put(&x.to_le_bytes());
    }
    for face in [[0_u32, 1, 2], [0, 2, 3]] {
        put(&[3]);
        for i in face {
            put(&i.to_le_bytes());
        }
    }
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0_f32, 1.0]] {
        put(&1.0_f32.to_le_bytes());
        put(&f64::from(x).to_le_bytes());
        for c in [y, 0.0, 0.0, 0.0] {
            put(&c.to_le_bytes());
        }
    }
    file
}

fn serialized_file(version: u16, double: bool) -> Vec<u8> {
    let mut content = Vec::new();
    let flags = 0x1 | 0x2 | 0x8 | if double { 0x2000_u32 } else { 0x1000 };
    content.extend(flags.to_le_bytes());
    if version == 4 {
        content.extend(b"square\0");
    }
    content.extend(4_u64.to_le_bytes());
    content.extend(2_u64.to_le_bytes());
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0_f64, 1.0]];
    let positions = corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]);
    let normals = (0..4).flat_map(|_| [0.0, 0.0, 1.0]);
    let colors = (0..12).map(|_| 0.5);
    for number in positions.chain(normals).chain(corners.into_iter().flatten()).chain(colors) {
        if double {
            content.extend(number.to_le_bytes());
        } else {
            content.extend((number as f32).to_le_bytes());
        }
    }
    for i in [0_u32, 1, 2, 0, 2, 3] {
        content.extend(i.to_le_bytes());
    }
    let mesh = packed(version, &content);
    let mut file = [mesh.clone(), mesh.clone()].concat();
    for offset in [0, mesh.len()] {
        match version {
            3 => file.extend((offset as u32).to_le_bytes()),
            _ => file.extend((offset as u64).to_le_bytes()),
        }
    }
    file.extend(2_u32.to_le_bytes());
    file
}

fn packed(version: u16, content: &[u8]) -> Vec<u8> {
    let mut mesh = [0x041C_u16.to_le_bytes(), version.to_le_bytes()].concat();
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(content).expect("memory");
    mesh.extend(encoder.finish().expect("memory"));
    mesh
}

#[test]
fn squares_are_read() {
    let folder = Folder::new();
    for (name, bytes, read) in squares() {
        let mesh = read(&folder.write(name, &bytes)).expect(name);
        assert_eq!(mesh.indices, [[0, 1, 2], [0, 2, 3]], "{name}");
        assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], "{name}");
        let normals = mesh.normals.as_ref();
        assert!(normals.is_none_or(|all| all.iter().all(|n| *n == [0.0, 0.0, 1.0])), "{name}");
        assert_eq!(normals.is_none(), name == "ascii.ply");
        let uvs = mesh.uvs.is_some();
        assert_eq!(uvs, !matches!(name, "little.ply" | "big.ply"), "{name}");
        let red = mesh.colors.as_ref().map(|colors| colors[3]);
        let wanted = match name {
            "ascii.ply" => Some([1.0, 0.0, 0.0]),
            _ if name.ends_with("serialized") => Some([0.5; 3]),
            _ => None,
        };
        assert_eq!(red, wanted, "{name}");
    }
}

#[test]
fn meshes_survive_cuts_and_flips() {
    let folder = Folder::new();
    let start = Instant::now();
    for (name, bytes, read) in squares() {
        mangle(&bytes, 2000, |mangled| {
            if let Err(error) = read(&folder.write(name, mangled)) {
                assert!(error.to_string().contains(name), "{error} does not name the file");
            }
        });
        // An empty OBJ is an empty mesh; the others know how long they should be.
        if !name.ends_with("obj") {
            let short = &bytes[..bytes.len() / 3];
            assert!(read(&folder.write(name, short)).is_err(), "{name}");
        }
    }
    assert!(start.elapsed() < 3 * SOON);
}

fn mesh_error(name: &str, bytes: impl AsRef<[u8]>, read: Reader, part: &str) {
    let folder = Folder::new();
    let start = Instant::now();
    let error = read(&folder.write(name, bytes)).map(|_| ()).expect_err(part).to_string();
    assert!(error.contains(part) && error.contains(name), "'{error}' does not say '{part}'");
    assert!(start.elapsed() < SOON);
}

#[test]
fn bad_ply_files() {
    let file = |vertices: &str, faces: &str, body: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
             element face {faces}\nproperty list uchar int vertex_index\nend_header\n{body}"
        )
    };
    let three = "0 0 0\n1 0 0\n0 1 0\n";
    for (text, part) in [
        (file("18446744073709551615", "0", ""), "too short"),
        (file("99999999999999999999", "0", ""), "no valid count"),
        (file("-1", "0", ""), "no valid count"),
        (file("3", "4000000000", three), "too short"),
        (file("3", "1", &format!("{three}3 0 1 3")), "refers to vertices [0, 1, 3], but there are 3"),
        (file("3", "1", &format!("{three}3 0 1 -1")), "refers to vertex -1"),
        (file("3", "1", &format!("{three}3 0 1 1.5")), "refers to vertex 1.5"),
        (file("3", "1", &format!("{three}2 0 1")), "has 2 corners"),
        (file("3", "1", &format!("{three}255 0 1 2")), "too short"),
        (file("1", "0", "0 nan 0"), "the position of vertex 0 is not finite"),
        (file("1", "0", "0 1e40 0"), "not finite"),
        (file("1", "0", "0 zero 0"), "'zero' is not a number"),
        ("ply\nelement vertex 1\nend_header\n".into(), "no 'format'"),
        ("ply\nformat ascii 2.0\nend_header\n".into(), "unknown header line"),
        ("ply\nformat ascii 1.0\nproperty float x\nend_header\n".into(), "before any element"),
        ("ply\nformat ascii 1.0\nelement vertex 9999999999\nend_header\n".into(), "no vertices"),
        (
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty int8_t x\nend_header\n".into(),
            "unknown property type",
        ),
        ("plyformat".into(), "ends too early"),
        ("obj\n".into(), "does not start with 'ply'"),
    ] {
        mesh_error("bad.ply", text, ply::read, part);
    }
}

#[test]
fn bad_obj_files() {
    for (text, part) in [
        ("v 0 0\n", "line 1: 2 numbers where 3"),
        ("v 0 0 x\n", "'x' is not a number"),
        ("v 0 0 inf\nv 0 0 0\nf 1 2 2", "not finite"),
        ("v 0 0 0\nf 1 1", "line 2: a face with 2 corners"),
        ("v 0 0 0\nf 1 1 2", "position 2 does not exist; there are 1"),
        ("v 0 0 0\nf 0 1 1", "position 0 does not exist"),
        ("v 0 0 0\nf -2 1 1", "position -2 does not exist"),
        ("v 0 0 0\nf 1/1 1 1", "texture coordinate 1 does not exist"),
        ("v 0 0 0\nf 1//9 1 1", "normal 9 does not exist"),
        ("v 0 0 0\nf 1/2/3/4 1 1", "texture coordinate 2"),
        ("v 0 0 0\nf // 1 1", "without a position"),
        ("v 0 0 0\nf 99999999999999999999 1 1", "not an index"),
        ("v 0 0 0\nf 9223372036854775807 -9223372036854775808 1", "does not exist"),
    ] {
        mesh_error("bad.obj", text, obj::read, part);
    }
    mesh_error("bad.obj", b"v \xff 0 0\n", obj::read, "not text");
}

#[test]
fn bad_serialized_files() {
    let content = |vertices: u64, triangles: u64, rest: usize| {
        let mut content = 0x1000_u32.to_le_bytes().to_vec();
        content.extend(b"x\0");
        content.extend(vertices.to_le_bytes());
        content.extend(triangles.to_le_bytes());
        content.resize(content.len() + rest, 0);
        packed(4, &content)
    };
    for (bytes, part) in [
        (vec![], "ends too early"),
        (b"ply\n1234".to_vec(), "0x041C"),
        ([0x1C, 4, 9, 0].to_vec(), "version 9"),
        (content(u64::MAX, 1, 0), "announced"),
        (content(1 << 40, 1, 0), "announced"),
        (content(3, u64::MAX / 12, 36), "announced"),
        (content(3, 1, 36), "ends too early"),
        // A bomb: 200 MB of zeros in 200 kB, of which the counts need only a part.
        (content(80_000_000, 1, 200_000_000), "announced"),
    ] {
        mesh_error("bad.serialized", bytes, read_first, part);
    }
    mesh_error("bad.serialized", serialized_file(4, false), |path| serialized::read(path, 2), "no mesh 2");
    let mut wild = serialized_file(4, false);
    let at = wild.len() - 12;
    wild[at..at + 8].fill(0xff);
    mesh_error("bad.serialized", wild, read_second, "outside of the file");
}

#[test]
fn devices_and_folders_are_no_meshes() {
    for path in ["/dev/zero", "/tmp", "/"] {
        if Path::new(path).exists() {
            assert!(ply::read(Path::new(path)).expect_err(path).to_string().contains("not a regular file"));
        }
    }
}
