//! Scenes whose radiance is known exactly, by every sampler, heuristic and filter, judged in standard errors.
//!
//! The camera sees a spot so small that the answer is one number whatever the filter. The mean of the image over each of 16
//! replicates gives Student's t; one level for all renders together follows from the stated false-alarm rate.

mod judge;
mod stage;

use std::f64::consts::PI;

use evenlight_render::filter;
use evenlight_render::integrator::Mis;
use evenlight_render::render::Settings;
use evenlight_render::sampler;
use glam::DVec3;
use judge::{level, mean_and_error, student_tail};
use stage::{picture, scene};

/// A scene and its radiance.
struct Case {
    name: &'static str,
    body: String,
    exact: f64,
}

const REPLICATES: u32 = 16;
const SAMPLES: u32 = 128;
/// Probability that correct code fails anywhere in this file.
const FALSE_ALARM: f64 = 1e-4;
/// What rounding and the size of the spot may do, relative to the answer.
const ROUNDING: f64 = 3e-5;
/// Standard errors must be below this share of the answer, or the test could not fail.
const LARGEST_ERROR: f64 = 0.015;

const ALBEDO: f64 = 0.5;

/// A camera at `origin` that looks at a spot of a thousandth around `target`.
fn camera(origin: &str, target: &str) -> String {
    format!(
        "<sensor type='orthographic'><transform name='to_world'><scale x='0.001' y='0.001'/>\
         <lookat origin='{origin}' target='{target}' up='0.1 1 0'/></transform>\
         <film type='hdrfilm'><integer name='width' value='4'/><integer name='height' value='4'/></film></sensor>"
    )
}

fn path(max_depth: i32, rr_depth: i32) -> String {
    format!(
        "<integrator type='path'><integer name='max_depth' value='{max_depth}'/>\
         <integer name='rr_depth' value='{rr_depth}'/></integrator>"
    )
}

fn number(name: &str, value: f64) -> String {
    format!("<float name='{name}' value='{value}'/>")
}

fn diffuse(albedo: f64) -> String {
    format!("<bsdf type='diffuse'><rgb name='reflectance' value='{albedo}'/></bsdf>")
}

fn shape(plugin: &str, content: &str, transform: &str) -> String {
    format!("<shape type='{plugin}'>{content}<transform name='to_world'>{transform}</transform></shape>")
}

fn area(radiance: f64) -> String {
    format!("<emitter type='area'><rgb name='radiance' value='{radiance}'/></emitter>")
}

fn sky(radiance: f64) -> String {
    format!("<emitter type='constant'><rgb name='radiance' value='{radiance}'/></emitter>")
}

/// A diffuse floor at z = 0 seen from above at the origin, lit by `lights` that give it an irradiance; direct light only.
fn floor(name: &'static str, lights: &str, irradiance: f64) -> Case {
    let floor = shape("rectangle", &diffuse(ALBEDO), "<scale value='2'/>");
    let body = path(2, 5) + &camera("0 0 0.3", "0 0 0") + &floor + lights;
    Case { name, body, exact: ALBEDO / PI * irradiance }
}

/// Irradiance at the origin per radiance of a polygon above the horizon (Lambert 1760); corners counterclockwise from below.
fn polygon(corners: &[DVec3]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next).map(|(a, b)| {
        let (a, b) = (a.normalize(), b.normalize());
        a.angle_between(b) * a.cross(b).normalize().z
    });
    (0.5 * edges.sum::<f64>()).abs()
}

/// A rectangle light of half sides 0.6 and 0.4, turned by 150° about x and moved to (0.3, 0.2, 1.5): form factor and XML.
fn rectangle_light(radiance: f64) -> (f64, String) {
    let transform = "<scale x='0.6' y='0.4'/><rotate x='1' angle='150'/><translate x='0.3' y='0.2' z='1.5'/>";
    let (sine, cosine) = 150.0_f64.to_radians().sin_cos();
    let place = |x: f64, y: f64| DVec3::new(0.6 * x + 0.3, 0.4 * y * cosine + 0.2, 0.4 * y * sine + 1.5);
    let corners = [place(-1.0, -1.0), place(1.0, -1.0), place(1.0, 1.0), place(-1.0, 1.0)];
    (polygon(&corners), shape("rectangle", &area(radiance), transform))
}

/// The sides of a cube of half side 0.3 at (0.2, −1, 1) that the origin sees: the lower one and that at y = −0.7.
fn cube_light(radiance: f64) -> (f64, String) {
    let below = [[-0.1, -1.3], [0.5, -1.3], [0.5, -0.7], [-0.1, -0.7]].map(|[x, y]| DVec3::new(x, y, 0.7));
    let side = [[-0.1, 0.7], [0.5, 0.7], [0.5, 1.3], [-0.1, 1.3]].map(|[x, z]| DVec3::new(x, -0.7, z));
    let transform = "<scale value='0.3'/><translate x='0.2' y='-1' z='1'/>";
    (polygon(&below) + polygon(&side), shape("cube", &area(radiance), transform))
}

/// A sphere of radius 0.4 at (−0.8, −0.6, 1.2), wholly above the horizon: π (r / d)² cos θ.
fn sphere_light(radiance: f64) -> (f64, String) {
    let center = DVec3::new(-0.8, -0.6, 1.2);
    let factor = PI * 0.16 / center.length_squared() * center.z / center.length();
    (factor, shape("sphere", &area(radiance), "<scale value='0.4'/><translate x='-0.8' y='-0.6' z='1.2'/>"))
}

/// Floors under one light.
fn floors() -> Vec<Case> {
    let (rectangle, rectangle_xml) = rectangle_light(4.0);
    let (cube, cube_xml) = cube_light(4.0);
    let (sphere, sphere_xml) = sphere_light(4.0);
    // a disk of radius 0.7 face to face at height 1.2: π R² / (R² + h²)
    let disk = PI * 0.49 / (0.49 + 1.44);
    let disk_xml =
        shape("disk", &area(4.0), "<scale value='0.7'/><rotate x='1' angle='180'/><translate z='1.2'/>");
    let point = "<emitter type='point'><rgb name='intensity' value='3'/><point name='position' x='0.6' y='0' z='0.8'/></emitter>";
    // 10° off its axis, half way down from a beam of 5° to the cutoff at 15°
    let spot = "<emitter type='spot'><rgb name='intensity' value='9'/><float name='cutoff_angle' value='15'/>\
                <float name='beam_width' value='5'/><transform name='to_world'><rotate y='1' angle='190'/>\
                <translate z='2'/></transform></emitter>";
    let directional = "<emitter type='directional'><rgb name='irradiance' value='5'/><vector name='direction' x='3' y='0' z='-4'/></emitter>";
    // each light hides its part of the sky, and none another
    let together = format!("{}{rectangle_xml}{cube_xml}{sphere_xml}{point}", sky(0.5));
    let hidden = rectangle + cube + sphere;
    vec![
        floor("sky", &sky(2.0), 2.0 * PI),
        floor("point", point, 3.0 * 0.8),
        floor("spot", spot, 9.0 * 0.5 / 4.0),
        floor("directional", directional, 5.0 * 0.8),
        floor("rectangle", &rectangle_xml, 4.0 * rectangle),
        floor("cube", &cube_xml, 4.0 * cube),
        floor("sphere", &sphere_xml, 4.0 * sphere),
        floor("disk", &disk_xml, 4.0 * disk),
        floor("together", &together, 4.0 * hidden + 0.5 * (PI - hidden) + 3.0 * 0.8),
    ]
}

/// A closed diffuse room that glows: E (1 − ρ^D) / (1 − ρ).
fn furnace(name: &'static str, albedo: f64, max_depth: i32, rr_depth: i32) -> Case {
    let room = "<boolean name='flip_normals' value='true'/>";
    let room = shape("cube", &format!("{room}{}{}", diffuse(albedo), area(0.25)), "<scale x='1.3'/>");
    let missing = if max_depth < 0 { 0.0 } else { albedo.powi(max_depth) };
    let body = path(max_depth, rr_depth) + &camera("0.1 0.2 0.3", "0.5 -0.1 -0.7") + &room;
    Case { name, body, exact: 0.25 * (1.0 - missing) / (1.0 - albedo) }
}

/// Glass, mirrors and masks.
fn specular() -> Vec<Case> {
    let glass = |plugin: &str| {
        format!("<bsdf type='{plugin}'>{}{}</bsdf>", number("int_ior", 1.5), number("ext_ior", 1.0))
    };
    let mirror = "<bsdf type='conductor'><string name='material' value='none'/><rgb name='specular_reflectance' value='0.8'/></bsdf>";
    let mirrors =
        |transform: &str| shape("rectangle", &format!("<bsdf type='twosided'>{mirror}</bsdf>"), transform);
    let mask = format!("<bsdf type='mask'>{}{}</bsdf>", number("opacity", 0.3), diffuse(ALBEDO));
    let above = camera("0.3 0.4 2", "0 0 0");
    let lamp = shape("rectangle", &area(3.0), "<scale value='5'/><translate z='-1'/>");
    // 4 % at each side, to and fro between them
    let through = 1.0 - 2.0 * 0.04 / 1.04;
    let case = |name, depth, content: String, exact| Case { name, body: path(depth, 5) + &content, exact };
    let plane = |bsdf: &str| shape("rectangle", bsdf, "<scale value='5'/>");
    let slab = |bsdf: &str| shape("cube", bsdf, "<scale x='5' y='5' z='0.1'/>");
    vec![
        case("glass slab", -1, above.clone() + &slab(&glass("dielectric")) + &sky(1.0), 1.0),
        case("glass ball", -1, above.clone() + &shape("sphere", &glass("dielectric"), "") + &sky(1.0), 1.0),
        case(
            "thin glass under the sky",
            -1,
            above.clone() + &plane(&glass("thindielectric")) + &sky(1.0),
            1.0,
        ),
        case(
            "thin glass",
            -1,
            camera("0 0 2", "0 0 0") + &plane(&glass("thindielectric")) + &lamp,
            3.0 * through,
        ),
        case("mask", -1, above.clone() + &plane(&mask) + &sky(2.0), 2.0 * (0.3 * ALBEDO + 0.7)),
        case("mask over a lamp", -1, above + &plane(&mask) + &lamp, 3.0 * 0.7),
        case(
            "two mirrors",
            3,
            camera("0 0 2", "0 0 0")
                + &mirrors("<rotate y='1' angle='45'/>")
                + &mirrors("<rotate y='1' angle='45'/><translate x='3'/>")
                + &sky(1.0),
            0.64,
        ),
    ]
}

fn cases() -> Vec<Case> {
    let mut cases = floors();
    cases.extend([
        furnace("furnace, 1 edge", 0.7, 1, 5),
        furnace("furnace, 2 edges", 0.7, 2, 5),
        furnace("furnace, 5 edges", 0.7, 5, 5),
        furnace("furnace, 9 edges, early roulette", 0.7, 9, 1),
        furnace("furnace, 9 edges, no roulette", 0.7, 9, 1000),
        furnace("furnace without limit", 0.7, -1, 5),
    ]);
    cases.extend(specular());
    cases
}

/// All renders of a scene but for threads.
fn variants() -> Vec<Settings> {
    let filters = ["box", "tent", "gaussian", "mitchell"];
    let heuristics = Mis::ALL.iter().map(|(_, mis)| *mis);
    let pairs = sampler::ALL.iter().flat_map(|entry| heuristics.clone().map(move |mis| (entry.name, mis)));
    let settings = |(number, (sampler, mis)): (usize, (&str, Mis))| Settings {
        sampler: sampler.into(),
        mis,
        filter: Some(filters[number % filters.len()].into()),
        spp: REPLICATES * SAMPLES,
        replicates: REPLICATES,
        seed: number as u64,
        threads: 1,
        ..Settings::default()
    };
    pairs.enumerate().map(settings).collect()
}

/// The mean of the red image over each replicate.
fn replicate_means(colors: &[[f32; 3]]) -> Vec<f64> {
    let pixels = colors.len() / REPLICATES as usize;
    let mean =
        |image: &[[f32; 3]]| image.iter().map(|color| f64::from(color[0])).sum::<f64>() / pixels as f64;
    colors.chunks_exact(pixels).map(mean).collect()
}

#[test]
fn every_sampler_heuristic_and_filter_finds_the_answer() {
    let (cases, variants) = (cases(), variants());
    let level = level(FALSE_ALARM, cases.len() * variants.len());
    let mut complaints = Vec::new();
    for case in &cases {
        let scene = scene(&case.body);
        for (number, settings) in variants.iter().enumerate() {
            let film = picture(&scene, settings);
            let (mean, error) = mean_and_error(&replicate_means(&film.colors));
            let away = ((mean - case.exact).abs() - ROUNDING * case.exact).max(0.0);
            let likely = away == 0.0 || student_tail(away / error, REPLICATES - 1) > level;
            let how = format!("{} {:?} {:?}", settings.sampler, settings.mis, settings.filter);
            if !likely || error > LARGEST_ERROR * case.exact {
                complaints.push(format!("{}, {how}: {mean} ± {error}, not {}", case.name, case.exact));
            }
            if number == variants.len() - 1 {
                let threads = picture(&scene, &Settings { threads: 3, ..settings.clone() });
                assert_eq!(bits(&film.colors), bits(&threads.colors), "{}, 3 threads", case.name);
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

fn bits(colors: &[[f32; 3]]) -> Vec<u32> {
    colors.iter().flatten().map(|x| x.to_bits()).collect()
}

#[test]
fn all_filters_are_tried() {
    let tried: Vec<_> = variants().into_iter().filter_map(|settings| settings.filter).collect();
    for name in ["box", "tent", "gaussian"] {
        assert!(tried.iter().any(|tried| tried == name) && filter::Filter::by_name(name).is_ok(), "{name}");
    }
}
