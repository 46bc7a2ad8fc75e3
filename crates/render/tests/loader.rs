//! The rules of the scene format, one by one, and the scenes of others.

mod fixture;

use std::path::PathBuf;
use std::sync::Arc;

use evenlight_render::scene::mitsuba::{LoadOptions, load};
use evenlight_render::scene::node::{Kind, Node, Value};
use evenlight_render::scene::properties::Properties;
use fixture::{Folder, options, parameter, refused, scene, value};
use glam::{DMat4, DVec3};

fn shape(inner: &str) -> String {
    format!("<shape type=\"sphere\">{inner}</shape>")
}

#[test]
fn plain_values() {
    let all = shape(
        "<boolean name='b' value='True'/><integer name='i' value=' -7 '/><float name='f' value='1e-3'/>\
         <string name='s' value='a &amp; b'/><point name='p' x='1' y='2' z='3'/><vector name='v' value='4, 5 6'/>\
         <vector name='one' value='7'/>",
    );
    assert!(matches!(value(&all, "b"), Value::Boolean(true)));
    assert!(matches!(value(&all, "i"), Value::Integer(-7)));
    assert!(matches!(value(&all, "f"), Value::Float(x) if x == 1e-3));
    assert!(matches!(value(&all, "s"), Value::String(s) if s == "a & b"));
    assert!(matches!(value(&all, "p"), Value::Vector([1.0, 2.0, 3.0])));
    assert!(matches!(value(&all, "v"), Value::Vector([4.0, 5.0, 6.0])));
    assert!(matches!(value(&all, "one"), Value::Vector([7.0, 7.0, 7.0])));
}

#[test]
fn bad_values_are_refused_with_their_line() {
    for (inner, part) in [
        ("<boolean name='b' value='1'/>", "neither true nor false"),
        ("<integer name='i' value='1.5'/>", "not a whole number"),
        ("<float name='f' value='1e1f'/>", "not a number"),
        ("<float name='f' value='nan'/>", "not finite"),
        ("<float name='f' value='1e39'/>", "not finite"),
        ("<point name='p' x='1' y='2'/>", "'z' is missing"),
        ("<point name='p' value='1 2'/>", "one or three"),
        ("<point name='p' value='1' x='1'/>", "both"),
        ("<float name='f'/>", "'value' is missing"),
        ("<float value='1'/>", "'name' is missing"),
        ("<float name='f' value='1' unit='m'/>", "unknown attribute 'unit'; known: name, value"),
        ("<float name='f' value='1'/><integer name='f' value='1'/>", "'f' is given twice"),
        ("<bsdf type='diffuse' name='f'/><float name='f' value='1'/>", "'f' is given twice"),
        ("<float name='f' value='1'><float name='g' value='1'/></float>", "takes no nested"),
        ("<color name='c' value='1'/>", "unknown element; known here: alias, boolean, bsdf, default"),
        ("<rotate x='1' angle='3'/>", "inside of <transform>"),
        ("<scene/>", "root of a file"),
        ("<rgb name='c' value='1 2'/>", "one or three"),
        ("<rgb name='c' value='#12345'/>", "#rrggbb"),
        ("<bsdf/>", "'type' is missing"),
        ("<bsdf type=''/>", "'type' is empty"),
    ] {
        refused(&shape(inner), part);
    }
    let error = refused("\n\n<shape type='sphere'>\n<float name='f' value='x'/></shape>", "not a number");
    assert!(error.contains("scene.xml:5: <float>"), "{error}");
}

#[test]
fn versions() {
    let folder = Folder::new();
    for version in ["3.0.0", "3.9.1", "3.0", "3"] {
        folder.load(&format!("<scene version='{version}'/>")).expect(version);
    }
    for version in ["2.1.0", "0.6.0", "4.0.0", "three", "3.x", ""] {
        let error = folder.load(&format!("<scene version='{version}'/>")).expect_err(version);
        assert!(error.contains("Mitsuba 3 are supported") && error.contains("scene.xml:1"), "{error}");
    }
    assert!(folder.load("<scene/>").expect_err("none").contains("'version' is missing"));
    assert!(folder.load("<bsdf version='3.0.0'/>").expect_err("none").contains("must start with <scene>"));
    assert!(folder.load("<scene version='3.0.0'>").expect_err("open").contains("not well-formed"));
}

#[test]
fn parameters_and_defaults() {
    let folder = Folder::new();
    let xml = "<scene version='3.0.0'><default name='r' value='2'/><default name='rr' value='3'/>\
               <default name='r' value='9'/><shape type='$kind'><float name='a' value='$r'/>\
               <float name='b' value='$rr'/><string name='c' value='\\$r $r.5'/></shape></scene>";
    let root = folder.load_with(xml, &options(&[("kind", "cube"), ("rr", "4")])).expect(xml);
    let cube = &root.children[0].node;
    assert_eq!(cube.plugin, "cube");
    assert!(matches!(parameter(cube, "a"), Value::Float(2.0)));
    assert!(matches!(parameter(cube, "b"), Value::Float(4.0)));
    assert!(matches!(parameter(cube, "c"), Value::String(s) if s == "$r 2.5"));
    let error = folder.load(xml).expect_err("no kind");
    assert!(error.contains("undefined parameter '$kind'; known: r, rr"), "{error}");
    let error = folder.load_with(xml, &options(&[("kind", "cube"), ("spp", "4")])).expect_err("no spp");
    assert!(error.contains("unknown parameter 'spp'; known: kind, r, rr"), "{error}");
}

#[test]
fn names_ids_and_references() {
    let root = scene(
        "<ref id='later'/><bsdf type='diffuse' id='later'/><alias id='later' as='again'/>\
         <shape type='sphere'><ref name='_arg_0' id='again'/><ref name='bsdf' id='later'/></shape>",
    )
    .expect("valid");
    let bsdf = &root.children[1].node;
    let sphere = &root.children[2].node;
    assert!(Arc::ptr_eq(&root.children[0].node, bsdf));
    assert!(sphere.children.iter().all(|child| Arc::ptr_eq(&child.node, bsdf)));
    assert_eq!(sphere.children[0].name, None);
    assert_eq!(sphere.children[1].name.as_deref(), Some("bsdf"));

    refused("<bsdf type='diffuse' id='Wall'/><ref id='wal'/>", "no object has the id 'wal'; similar: Wall");
    refused("<bsdf type='a' id='x'/><bsdf type='b' id='x'/>", "the id 'x' is already taken at");
    refused("<alias id='x' as='y'/><bsdf type='a' id='x'/>", "no object before this has the id 'x'");
    refused("<bsdf type='twosided' id='a'><ref id='a'/></bsdf>", "circle: scene → a");
    refused("<bsdf type='t' id='a'><ref id='b'/></bsdf><bsdf type='t' id='b'><ref id='a'/></bsdf>", "a → b");
}

#[test]
fn includes_and_paths() {
    let folder = Folder::new();
    folder.write("parts/material.xml", "<bsdf version='3.0.0' type='diffuse' id='gray'/>");
    folder.write(
        "parts/all.xml",
        "<scene version='3.0.0'><default name='n' value='5'/><include filename='material.xml' name='front'/>\
         <shape type='ply'><string name='filename' value='mesh.ply'/></shape></scene>",
    );
    let mesh = folder.write("parts/mesh.ply", "");
    folder.write("images/sky.exr", "");
    let root = folder
        .load(
            "<scene version='3.0.0'><path value='images'/><include filename='parts/all.xml'/>\
             <shape type='sphere'><ref id='gray'/><float name='radius' value='$n'/></shape>\
             <emitter type='envmap'><string name='filename' value='sky.exr'/></emitter></scene>",
        )
        .expect("valid");
    let kinds: Vec<Kind> = root.children.iter().map(|child| child.node.kind).collect();
    assert_eq!(kinds, [Kind::Bsdf, Kind::Shape, Kind::Shape, Kind::Emitter]);
    assert_eq!(root.children[0].name.as_deref(), Some("front"));
    assert!(root.children[0].node.location.to_string().ends_with("parts/material.xml:1"));
    assert_eq!(Properties::new(&root.children[1].node).path("filename").expect("inside"), Some(mesh));
    let sky = Properties::new(&root.children[3].node).path("filename").expect("inside");
    assert_eq!(sky, Some(folder.path().join("images/sky.exr")));

    folder.write("loop.xml", "<scene version='3.0.0'><include filename='loop.xml'/></scene>");
    let error =
        folder.load("<scene version='3.0.0'><include filename='loop.xml'/></scene>").expect_err("loop");
    assert!(error.contains("loop.xml:1: <include>: 'loop.xml' includes itself"), "{error}");
    for deep in 0..20 {
        let inner = format!("<scene version='3.0.0'><include filename='deep{}.xml'/></scene>", deep + 1);
        folder.write(&format!("deep{deep}.xml"), inner);
    }
    let error =
        folder.load("<scene version='3.0.0'><include filename='deep0.xml'/></scene>").expect_err("deep");
    assert!(error.contains("more than 15 nested"), "{error}");
    refused("<include filename='absent.xml'/>", "cannot be read");
    refused("<path value='absent'/>", "does not exist");
    refused("<shape type='a'><path value='.'/></shape>", "only allowed directly below <scene>");
}

fn to_world(operations: &str) -> DMat4 {
    let body = shape(&format!("<transform name='to_world'>{operations}</transform>"));
    match value(&body, "to_world") {
        Value::Transform(matrix) => matrix,
        other => panic!("{other:?}"),
    }
}

#[test]
fn transforms() {
    let m = to_world("<translate x='1'/><scale value='2'/>");
    assert_eq!(m.transform_point3(DVec3::ZERO), DVec3::new(2.0, 0.0, 0.0));
    let m = to_world("<scale y='3'/><rotate z='2' angle='90'/>");
    assert!((m.transform_point3(DVec3::Y) - DVec3::new(-3.0, 0.0, 0.0)).length() < 1e-12);
    let m = to_world("<matrix value='1 2 3 4 5 6 7 8 9 1 2 3 0 0 0 1'/>");
    assert_eq!(m.transform_point3(DVec3::ZERO), DVec3::new(4.0, 8.0, 3.0));
    let m = to_world("<matrix value='1,2,3 4,5,6 7,8,10'/>");
    assert_eq!(m.transform_vector3(DVec3::X), DVec3::new(1.0, 4.0, 7.0));
    // Figures of Mitsuba 3.9.1.
    let m = to_world("<lookat origin='0,1,2' target='1,1,3' up='0 1 0'/>");
    let h = 0.5_f64.sqrt();
    let wanted = [[h, 0.0, -h, 0.0], [0.0, 1.0, 0.0, 0.0], [h, 0.0, h, 0.0], [0.0, 1.0, 2.0, 1.0]];
    assert!(m.abs_diff_eq(DMat4::from_cols_array_2d(&wanted), 1e-12), "{m}");
    let m = to_world("<lookat origin='0,1,2' target='1,1,-3'/>");
    assert!((m.x_axis.truncate() - DVec3::Y).length() < 1e-12);
    assert!((m.y_axis.truncate() - DVec3::new(0.980581, 0.0, 0.196116)).length() < 1e-6);
}

#[test]
fn bad_transforms() {
    for (operations, part) in [
        ("<scale x='0'/>", "singular"),
        ("<matrix value='1 2 3 4 5 6 7 8 9'/>", "singular"),
        ("<translate x='nan'/>", "not finite"),
        ("<scale value='1e30'/><scale value='1e30'/>", "not finite"),
        ("<matrix value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1'/>", "last row"),
        ("<matrix value='1 0 0'/>", "9 or 16 numbers"),
        ("<rotate angle='3'/>", "no direction"),
        ("<rotate x='1'/>", "'angle' is missing"),
        ("<lookat origin='0 0 0' target='0 0 0'/>", "the same"),
        ("<lookat origin='0 0 0' target='0 0 1' up='0 0 2'/>", "parallel"),
        ("<lookat origin='0 0' target='0 0 1'/>", "three numbers"),
        ("<shear x='1'/>", "known in a <transform>: lookat"),
        ("<scale value='2'><scale value='2'/></scale>", "no nested"),
    ] {
        refused(&shape(&format!("<transform name='to_world'>{operations}</transform>")), part);
    }
}

fn color(body: &str, name: &str) -> [f64; 3] {
    match value(body, name) {
        Value::Rgb(color) => color,
        other => panic!("{other:?}"),
    }
}

#[test]
fn colors_and_spectra() {
    let bsdf = |inner: &str| color(&format!("<bsdf type='conductor'>{inner}</bsdf>"), "c");
    let emitter = |inner: &str| color(&format!("<emitter type='point'>{inner}</emitter>"), "c");
    assert_eq!(bsdf("<rgb name='c' value='.5'/>"), [0.5; 3]);
    assert_eq!(bsdf("<rgb name='c' value='1, 2, 3'/>"), [1.0, 2.0, 3.0]);
    assert_eq!(bsdf("<rgb name='c' value='#ff0033'/>"), [1.0, 0.0, 0.2]);
    assert_eq!(bsdf("<spectrum name='c' value='0.5'/>"), [0.5; 3]);
    assert_eq!(bsdf("<spectrum name='c' type='d65'><float name='scale' value='5'/></spectrum>"), [5.0; 3]);
    assert_eq!(
        emitter("<spectrum name='c' type='uniform'><float name='value' value='5'/></spectrum>"),
        [5.0; 3]
    );
    // Figures of Mitsuba 3.9.1.
    let pairs = "400:0.1, 500:0.6, 600:0.9, 700:1";
    let near = |ours: [f64; 3], theirs: [f64; 3]| {
        assert!(ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1e-5), "{ours:?} {theirs:?}");
    };
    near(bsdf(&format!("<spectrum name='c' value='{pairs}'/>")), [0.974706, 0.739609, 0.318301]);
    near(emitter(&format!("<spectrum name='c' value='{pairs}'/>")), [1.15019, 0.705721, 0.276247]);
    near(emitter("<spectrum name='c' value='.5'/>"), [0.602397, 0.474146, 0.454458]);
    near(
        color("<bsdf type='conductor'><spectrum name='k' value='500:5 600:9'/></bsdf>", "k"),
        [2.62775, 6.89586, 0.0],
    );

    let folder = Folder::new();
    folder.write("a.spd", "# measured\n400 0.1\n500 0.6 # here\n\n600 0.9\n700 1\n");
    let root = folder.load(
        "<scene version='3.0.0'><bsdf type='diffuse'><spectrum name='c' filename='a.spd'/></bsdf></scene>",
    );
    match parameter(&root.expect("valid").children[0].node, "c") {
        Value::Rgb(c) => near(c, [0.974706, 0.739609, 0.318301]),
        other => panic!("{other:?}"),
    }
    for (inner, part) in [
        ("<spectrum name='c' value='1 2 3'/>", "not a number"),
        ("<spectrum name='c' value='400:1 2'/>", "wavelength:value"),
        ("<spectrum name='c' value='500:1 400:2'/>", "must increase"),
        ("<spectrum name='c' value='500:1'/>", "at least two"),
        ("<spectrum name='c' value='1' filename='x'/>", "either"),
        ("<spectrum name='c' filename='../x'/>", "outside of the scene's folder"),
        ("<spectrum name='c' type='blackbody'/>", "known: d65, srgb, uniform"),
        ("<spectrum name='c' type='d65'><float name='x' value='1'/></spectrum>", "unknown parameter 'x'"),
        ("<spectrum name='c' type='d65'><bsdf type='x'/></spectrum>", "no nested plugins"),
        ("<spectrum name='c' type='srgb'/>", "'color' is missing"),
    ] {
        refused(&format!("<bsdf type='diffuse'>{inner}</bsdf>"), part);
    }
}

#[test]
fn files_outside_of_the_folder_are_refused() {
    let folder = Folder::new();
    let secret = folder.write("secret.txt", "secret");
    let inside = |value: &str, allow_outside: bool| {
        let xml = format!(
            "<scene version='3.0.0'>\n<shape type='ply'>\n<string name='filename' value='{value}'/></shape></scene>"
        );
        let path = folder.write("scene/scene.xml", xml);
        let options = LoadOptions { allow_outside, ..LoadOptions::default() };
        let root = load(&path, &options).expect("the name alone is harmless");
        let found = Properties::new(&root.children[0].node).path("filename");
        found.map_err(|error| error.to_string())
    };
    folder.write("scene/meshes/a.ply", "");
    assert!(inside("meshes/a.ply", false).is_ok());
    assert!(inside("meshes/../meshes/a.ply", false).is_ok());
    assert!(inside("absent.ply", false).is_ok());
    let absolute = secret.to_str().expect("text").to_owned();
    for outside in ["../secret.txt", "../../../../etc/passwd", "/etc/passwd", "meshes/../../x", "", &absolute]
    {
        let error = inside(outside, false).expect_err(outside);
        assert!(error.contains("scene.xml:3"), "{error}");
    }
    assert_eq!(inside("../secret.txt", true).expect("allowed").map(|path| path.exists()), Some(true));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&secret, folder.path().join("scene/link.ply")).expect("a link");
        assert!(inside("link.ply", false).expect_err("a link").contains("outside"));
    }
    // Included files may use the root's folder, but not leave it.
    folder.write("scene/parts/part.xml", "<scene version='3.0.0'><include filename='../other.xml'/></scene>");
    folder.write("scene/other.xml", "<scene version='3.0.0'/>");
    let xml = "<scene version='3.0.0'><include filename='parts/part.xml'/></scene>";
    load(&folder.write("scene/scene.xml", xml), &LoadOptions::default()).expect("inside");
    let xml = "<scene version='3.0.0'><include filename='../secret.txt'/></scene>";
    let error = load(&folder.write("scene/scene.xml", xml), &LoadOptions::default()).expect_err("outside");
    assert!(error.to_string().contains("outside of the scene's folder"), "{error}");
}

fn count(node: &Node) -> usize {
    1 + node.children.iter().map(|child| count(&child.node)).sum::<usize>()
}

/// The scenes others made, where they are at hand.
fn shared_scenes() -> Option<PathBuf> {
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes");
    let folder = std::env::var_os("EVENLIGHT_SCENES").map_or(beside, PathBuf::from);
    if !folder.is_dir() {
        eprintln!("note: no scenes at {}; set EVENLIGHT_SCENES to check them", folder.display());
        return None;
    }
    Some(folder)
}

#[test]
fn scenes_of_others_load_with_all_their_files() {
    use evenlight_render::scene::mesh::ply;
    use evenlight_render::texture::image::Image;
    let Some(folder) = shared_scenes() else { return };
    let mut found = 0;
    let entries = std::fs::read_dir(folder).expect("readable");
    for scene in entries.map(|entry| entry.expect("readable").path().join("scene.xml")).filter(|p| p.exists())
    {
        let root = load(&scene, &options(&[("spp", "1")])).expect("the scene is valid");
        assert!(count(&root) > 10, "{}", scene.display());
        let (mut meshes, mut images) = (0, 0);
        visit(&root, &mut |node| {
            let properties = Properties::new(node);
            match (&node.plugin[..], properties.path("filename").expect("inside")) {
                ("ply", Some(path)) => {
                    meshes += ply::read(&path).expect("a valid mesh").indices.len();
                }
                ("bitmap" | "envmap", Some(path)) => {
                    images += Image::read(&path, false).expect("a valid image").pixels.len();
                }
                _ => {}
            }
        });
        eprintln!("{}: {meshes} triangles, {images} pixels", scene.display());
        found += 1;
    }
    assert!(found > 0, "no scenes in the folder");
}

fn visit(node: &Node, see: &mut impl FnMut(&Node)) {
    see(node);
    node.children.iter().for_each(|child| visit(&child.node, see));
}
