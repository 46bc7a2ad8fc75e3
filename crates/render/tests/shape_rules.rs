//! What shapes do with unusual meshes, and with plugins that are nested, referred to or left out.

mod random;
mod stage;

use std::io::Write;

use evenlight_render::geometry::{Ray, Surface, Vec3};
use evenlight_render::render::Settings;
use evenlight_render::scene::{Scene, SceneOptions};
use random::Random;
use stage::fixture::Folder;
use stage::{picture, scene, try_scene};

const CAMERA: &str = "<sensor type='orthographic'><transform name='to_world'><scale x='0.5' y='0.5'/>\
                      <lookat origin='0 0 3' target='0 0 0' up='0 1 0'/></transform><film type='hdrfilm'>\
                      <integer name='width' value='6'/><integer name='height' value='6'/></film></sensor>";

/// A scene with one file next to it.
fn scene_with(name: &str, content: &[u8], body: &str) -> Scene {
    let folder = Folder::new();
    folder.write(name, content);
    let root = folder.load(&format!("<scene version='3.0.0'>{CAMERA}{body}</scene>")).expect(body);
    Scene::build(&root, &SceneOptions::default()).expect(body)
}

fn bits(scene: &Scene) -> Vec<u32> {
    let settings = Settings { spp: 8, replicates: 2, threads: 1, ..Settings::default() };
    let film = picture(scene, &settings);
    film.colors.iter().flatten().chain(film.albedo.iter().flatten()).map(|x| x.to_bits()).collect()
}

/// The surface straight below a point.
fn below(scene: &Scene, x: f32, y: f32) -> Surface {
    let ray = Ray { origin: Vec3::new(x, y, 5.0), direction: Vec3::NEG_Z, t_max: f32::INFINITY };
    let hit = scene.world.intersect(&ray).expect("something below");
    scene.world.vertex(&ray, &hit).surface
}

/// Two triangles that form a roof, in version 4 of Mitsuba's format; `flags` as in the file.
fn serialized(flags: u32) -> Vec<u8> {
    let mut mesh = flags.to_le_bytes().to_vec();
    mesh.extend(b"roof\0");
    mesh.extend([4_u64, 2].iter().flat_map(|n| n.to_le_bytes()));
    let positions = [[-1.0_f32, -1.0, 0.0], [0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [1.0, -1.0, 0.0]];
    mesh.extend(positions.iter().flatten().flat_map(|x| x.to_le_bytes()));
    mesh.extend([0_u32, 1, 2, 1, 3, 2].iter().flat_map(|n| n.to_le_bytes()));
    let mut packed =
        flate2::write::ZlibEncoder::new(vec![0x1c, 0x04, 0x04, 0x00], flate2::Compression::fast());
    packed.write_all(&mesh).expect("memory");
    let mut file = packed.finish().expect("memory");
    file.extend(0_u64.to_le_bytes());
    file.extend(1_u32.to_le_bytes());
    file
}

#[test]
fn a_serialized_mesh_may_ask_for_facets() {
    const SINGLE_PRECISION: u32 = 0x1000;
    const FACE_NORMALS: u32 = 0x0010;
    let body = "<shape type='serialized'><string name='filename' value='roof.serialized'/></shape>";
    let surface = |flags| below(&scene_with("roof.serialized", &serialized(flags), body), -0.1, -0.5);
    let (smooth, faceted) = (surface(SINGLE_PRECISION), surface(SINGLE_PRECISION | FACE_NORMALS));
    let face = Vec3::new(-1.0, 0.0, 1.0).normalize();
    assert!(faceted.shading.n.abs_diff_eq(face, 1e-6), "{}", faceted.shading.n);
    assert!(smooth.shading.n.dot(face) < 0.99 && smooth.geometric_normal.abs_diff_eq(face, 1e-6));
}

#[test]
fn an_empty_or_flat_mesh_is_nothing() {
    let empty = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let flat = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
    for (name, content) in [("empty", empty), ("flat", flat)] {
        for emitter in ["", "<emitter type='area'/>"] {
            let lamp = "<emitter type='constant'/>";
            let mesh = format!("<shape type='obj'><string name='filename' value='m.obj'/>{emitter}</shape>");
            let floor = "<shape type='rectangle'/>";
            let dark = bits(&scene_with("m.obj", content.as_bytes(), &format!("{mesh}{floor}")));
            assert!(dark == bits(&scene(&format!("{CAMERA}{floor}"))), "{name} {emitter}");
            let lit = scene_with("m.obj", content.as_bytes(), &format!("{mesh}{floor}{lamp}"));
            assert!(bits(&lit) == bits(&scene(&format!("{CAMERA}{floor}{lamp}"))), "{name} {emitter}");
        }
    }
}

#[test]
fn nested_and_referred_plugins_are_the_same() {
    let bsdf =
        |id: &str| format!("<bsdf type='diffuse' {id}><rgb name='reflectance' value='0.1 0.2 0.3'/></bsdf>");
    let lamp = "<emitter type='constant'/>";
    let nested = scene(&format!("{CAMERA}<shape type='rectangle'>{}</shape>{lamp}", bsdf("")));
    let referred =
        scene(&format!("{CAMERA}{}<shape type='rectangle'><ref id='a'/></shape>{lamp}", bsdf("id='a'")));
    assert_eq!(bits(&nested), bits(&referred));
    assert!((below_albedo(&nested) - 0.2).abs() < 1e-6);
}

/// The green albedo in the middle.
fn below_albedo(scene: &Scene) -> f32 {
    picture(scene, &Settings { spp: 1, replicates: 1, ..Settings::default() }).albedo[14][1]
}

#[test]
fn a_shape_without_a_bsdf_is_gray_and_a_light_black() {
    assert!((below_albedo(&scene(&format!("{CAMERA}<shape type='rectangle'/>"))) - 0.5).abs() < 1e-6);
    let light = "<shape type='rectangle'><emitter type='area'/></shape>";
    assert_eq!(below_albedo(&scene(&format!("{CAMERA}{light}"))), 0.0);
}

#[test]
fn contradictions_are_refused() {
    for (body, part) in [
        ("<shape type='sphere'><emitter type='point'/></shape>", "must be 'area'"),
        (
            "<shape type='sphere'><emitter type='area'/><emitter type='area'/></shape>",
            "more than one emitter",
        ),
        ("<shape type='sphere'><bsdf type='diffuse'/><bsdf type='diffuse'/></shape>", "more than one bsdf"),
        ("<shape type='sphere'><float name='radius' value='0'/></shape>", "radius must be positive"),
        (
            "<shape type='sphere'><transform name='to_world'><scale x='2'/></transform></shape>",
            "scale evenly",
        ),
        ("<shape type='cylinder'><transform name='to_world'><scale x='2'/></transform></shape>", "round"),
        ("<shape type='cylinder'><float name='radius' value='-1'/></shape>", "must be positive"),
        ("<shape type='cylinder'><point name='p1' x='0' y='0' z='0'/></shape>", "must be positive"),
        ("<shape type='cone'/>", "unknown shape 'cone'; known: cube, cylinder, disk"),
        (
            "<emitter type='spot'><float name='beam_width' value='30'/></emitter>",
            "beam_width <= cutoff_angle",
        ),
        ("<sensor type='thinlens'/>", "aperture_radius"),
        ("<sensor type='perspective'><float name='fov' value='180'/></sensor>", "between 0 and 180"),
        ("<sensor type='perspective'><float name='near_clip' value='9e9'/></sensor>", "near_clip < far_clip"),
    ] {
        let error = try_scene(body).map(|_| ()).expect_err(body);
        assert!(error.contains(part) && error.contains("scene.xml:"), "'{error}' does not say '{part}'");
    }
}

#[test]
fn rays_meet_analytic_shapes_where_their_surface_is() {
    for (plugin, scale) in
        [("sphere", "value='0.7'"), ("disk", "x='1.2' y='0.4'"), ("cylinder", "x='0.5' y='0.5' z='2'")]
    {
        let scene = scene(&format!(
            "<shape type='{plugin}'><transform name='to_world'><scale {scale}/>\
             <rotate x='1' y='2' z='-1' angle='50'/><translate x='0.3' y='-0.2' z='0.5'/></transform></shape>"
        ));
        let (mut random, mut hits) = (Random(4), 0);
        for _ in 0..4000 {
            let mut point = || random.point() * 4.0 - 2.0;
            let (origin, target) = (point(), point());
            let ray = Ray { origin, direction: (target - origin).normalize(), t_max: f32::INFINITY };
            let Some(hit) = scene.world.intersect(&ray) else { continue };
            let surface = scene.world.vertex(&ray, &hit).surface;
            let position = ray.origin + ray.direction * hit.t;
            assert!(
                surface.position.distance(position) < 2e-6 * (4.0 + hit.t),
                "{plugin}: {ray:?} {surface:?}"
            );
            let normal = surface.dp_du.cross(surface.dp_dv).normalize().dot(surface.geometric_normal);
            assert!((normal.abs() - 1.0).abs() < 1e-4, "{plugin}: tangents at {surface:?}");
            assert!(scene.world.occluded(&Ray { t_max: hit.t * 1.01, ..ray }), "{plugin}");
            assert!(!scene.world.occluded(&Ray { t_max: hit.t * 0.99, ..ray }), "{plugin}");
            hits += 1;
        }
        assert!(hits > 100, "{plugin}: only {hits}");
    }
}

/// The first ray parameter at which a line meets a sphere in front of its origin, by the textbook formula in double precision.
fn first_root(ray: &Ray, center: Vec3, radius: f32) -> Option<f64> {
    let direction = ray.direction.as_dvec3();
    let to_center = (center - ray.origin).as_dvec3();
    let along = to_center.dot(direction);
    let half = (f64::from(radius).powi(2) - (to_center - along * direction).length_squared()).sqrt();
    [along - half, along + half].into_iter().find(|t| *t > 0.0)
}

#[test]
fn the_first_of_many_spheres_is_met() {
    let mut random = Random(5);
    let spheres: Vec<(Vec3, f32)> =
        (0..300).map(|_| (random.point() * 4.0 - 2.0, 0.02 + 0.2 * random.next())).collect();
    let shape = |(center, radius): &(Vec3, f32)| {
        let [x, y, z] = center.to_array();
        format!(
            "<shape type='sphere'><point name='center' x='{x}' y='{y}' z='{z}'/><float name='radius' value='{radius}'/></shape>"
        )
    };
    let scene = scene(&spheres.iter().map(shape).collect::<String>());
    let mut hits = 0;
    for _ in 0..4000 {
        let origin = random.point() * 6.0 - 3.0;
        let ray = Ray { origin, direction: random.direction(), t_max: f32::INFINITY };
        let roots = spheres.iter().map(|(center, radius)| first_root(&ray, *center, *radius));
        let first = roots.enumerate().filter_map(|(number, t)| Some((number, t?)));
        let first = first.min_by(|(_, a), (_, b)| a.total_cmp(b));
        let hit = scene.world.intersect(&ray);
        assert_eq!(hit.map(|hit| hit.shape as usize), first.map(|(number, _)| number), "{ray:?}");
        let Some((_, t)) = first else { continue };
        assert!(hit.is_some_and(|hit| (f64::from(hit.t) - t).abs() < 1e-4), "{ray:?}");
        assert!(scene.world.occluded(&Ray { t_max: t as f32 * 1.01, ..ray }));
        assert!(!scene.world.occluded(&Ray { t_max: t as f32 * 0.99, ..ray }));
        hits += 1;
    }
    assert!(hits > 500, "only {hits}");
}
