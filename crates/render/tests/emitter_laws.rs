//! Laws that every emitter obeys: samples follow their density, and a ray that runs into a light finds what was sampled.

mod judge;
mod random;
mod stage;

use std::collections::BTreeSet;
use std::f32::consts::PI;

use evenlight_render::emitter::{self, Emitter, EmitterHit, LightSample};
use evenlight_render::geometry::{Frame, Mat3A, Ray, Vec2, Vec3};
use evenlight_render::scene::Scene;
use judge::{chi_square, level};
use random::{Random, from_angles};

/// A light seen from a point.
struct Case {
    name: &'static str,
    scene: Scene,
    from: Vec3,
    /// Probability that a sample reaches `from`, where it is known: the share of the area that faces it, for area sampling.
    reaching: Option<f64>,
    /// What is seen at a smaller cosine is left out: area sampling is singular at a silhouette.
    grazing: f32,
}

/// Rotated and moved, so that nothing is aligned; `S` stands for the scale.
const PLACE: &str = "<transform name='to_world'>S<rotate x='0.48' y='0.6' z='-0.64' angle='50'/>\
                     <translate x='0.3' y='-0.2' z='0.5'/></transform>";
const RADIANCE: &str = "<emitter type='area'><texture type='bitmap' name='radiance'>\
                        <string name='filename' value='pattern.png'/></texture></emitter>";
const FLIP: &str = "<boolean name='flip_normals' value='true'/>";
const FACES: &str = "<boolean name='face_normals' value='true'/>";

/// What it is, plugin, scale or other content, receivers with the probability that a sample reaches them;
/// receivers of what is placed are in the coordinates of the place.
type Line = (&'static str, &'static str, &'static str, &'static [([f32; 3], Option<f64>)]);

const FRONT: [f32; 3] = [0.6, -0.4, 1.5];
const SIDE: [f32; 3] = [2.5, 0.6, 0.3];
const BACK: [f32; 3] = [0.6, -0.4, -1.5];

const SHAPES: &[Line] = &[
    (
        "rectangle",
        "rectangle",
        "<scale value='1'/>",
        &[(FRONT, Some(1.0)), (SIDE, Some(1.0)), (BACK, Some(0.0))],
    ),
    ("rectangle near", "rectangle", "<scale value='1'/>", &[([0.3, -0.1, 0.5], Some(1.0))]),
    ("rectangle far", "rectangle", "<scale value='0.2'/>", &[([-20.0, 24.0, 40.0], Some(1.0))]),
    ("rectangle long", "rectangle", "<scale x='2' y='0.3'/>", &[(FRONT, Some(1.0))]),
    ("rectangle mirrored", "rectangle", "<scale x='-1' y='0.5'/>", &[(FRONT, Some(1.0)), (BACK, Some(0.0))]),
    ("rectangle flipped", "rectangle", FLIP, &[([0.2, 0.3, -1.0], Some(1.0)), ([0.2, 0.3, 1.0], Some(0.0))]),
    (
        "rectangle sheared",
        "rectangle",
        "<matrix value='1 0.6 0 0 0 1 0 0 0 0 1 0 0 0 0 1'/>",
        &[(FRONT, Some(1.0)), (BACK, Some(0.0))],
    ),
    ("disk", "disk", "<scale value='1'/>", &[(FRONT, Some(1.0)), (BACK, Some(0.0))]),
    (
        "disk elliptic",
        "disk",
        "<scale x='1.2' y='0.5'/>",
        &[(FRONT, Some(1.0)), ([0.3, -0.1, 0.5], Some(1.0))],
    ),
    ("disk flipped", "disk", FLIP, &[([0.2, 0.3, -1.0], Some(1.0))]),
    ("cube", "cube", "<scale x='0.5' y='0.7' z='0.4'/>", &[(FRONT, None), (SIDE, None), (BACK, None)]),
    ("cube mirrored", "cube", "<scale x='-0.5' y='0.7' z='0.4'/>", &[(FRONT, None), (SIDE, None)]),
    ("cube straight", "cube", "", &[([0.1, 0.2, 2.5], Some(1.0 / 6.0)), ([2.0, 3.0, 0.5], Some(1.0 / 3.0))]),
    ("cube from inside", "cube", FLIP, &[([0.1, 0.2, -0.5], Some(1.0))]),
    ("sphere", "sphere", "<scale value='0.8'/>", &[(FRONT, Some(1.0)), ([10.0, 15.0, -25.0], Some(1.0))]),
    ("sphere near", "sphere", "", &[([0.0, 0.612, 0.8158], Some(1.0)), ([0.0, 0.9, 0.6], Some(1.0))]),
    ("sphere mirrored", "sphere", "<scale x='-1'/>", &[([0.4, 0.3, 0.6], Some(1.0)), (FRONT, Some(0.0))]),
    ("sphere from inside", "sphere", FLIP, &[([0.3, -0.6, 0.2], Some(1.0)), ([0.0, 0.0, 0.0], Some(1.0))]),
    ("cylinder", "cylinder", "<scale x='0.6' y='0.6' z='1.1'/>", &[(FRONT, None), (SIDE, None)]),
    ("cylinder from inside", "cylinder", FLIP, &[([0.3, 0.2, 0.4], Some(1.0)), ([0.1, 0.0, 2.0], Some(1.0))]),
    ("obj", "obj", FACES, &[([0.4, -0.3, 3.0], Some(1.0)), ([2.5, 0.1, 0.9], None)]),
    ("obj smooth", "obj", "", &[([0.4, -0.3, 3.0], Some(1.0)), ([2.5, 0.1, 0.9], None)]),
    ("ply", "ply", FACES, &[([0.4, -0.3, 2.0], Some(1.0)), ([-0.5, -0.4, -1.5], Some(0.0))]),
];

/// Lights that stand alone.
const FREE: &[Line] = &[
    ("constant", "constant", "<rgb name='radiance' value='3 2 1'/>", &[(SIDE, Some(1.0))]),
    ("envmap", "envmap", "<float name='scale' value='2'/>", &[(SIDE, Some(1.0))]),
    ("envmap turned", "envmap", "<scale value='1'/>", &[(SIDE, Some(1.0))]),
    ("point", "point", "<rgb name='intensity' value='3 2 1'/>", &[(FRONT, None)]),
    ("spot", "spot", "<float name='cutoff_angle' value='60'/>", &[([0.5, 0.4, 2.0], None)]),
    ("directional", "directional", "<rgb name='irradiance' value='3 2 1'/>", &[(FRONT, None)]),
];

fn is_placed(content: &str) -> bool {
    content.starts_with("<scale") || content.starts_with("<matrix")
}

/// The receiver of a line in world space.
fn receiver(content: &str, local: [f32; 3]) -> Vec3 {
    let turn = Mat3A::from_axis_angle(glam::Vec3::new(0.48, 0.6, -0.64), 50.0_f32.to_radians());
    let local = Vec3::from(local);
    if is_placed(content) { turn * local + Vec3::new(0.3, -0.2, 0.5) } else { local }
}

fn scene_of((_, plugin, content, _): Line, element: &str) -> Scene {
    let content = if is_placed(content) { PLACE.replace('S', content) } else { content.to_owned() };
    let file = match plugin {
        "obj" | "ply" => format!("<string name='filename' value='roof.{plugin}'/>"),
        "envmap" => "<string name='filename' value='pattern.png'/>".to_owned(),
        _ => String::new(),
    };
    let radiance = if element == "shape" { RADIANCE } else { "" };
    stage::scene(&format!("<{element} type='{plugin}'>{file}{content}{radiance}</{element}>"))
}

fn cases_of(lines: &[Line], element: &'static str) -> Vec<Case> {
    let case = |line: &Line| {
        let line = *line;
        line.3.iter().map(move |&(from, reaching)| Case {
            name: line.0,
            scene: scene_of(line, element),
            from: receiver(line.2, from),
            reaching,
            grazing: if line.1 == "cylinder" { 0.1 } else { 0.0 },
        })
    };
    lines.iter().flat_map(case).collect()
}

/// All but delta lights.
fn cases() -> Vec<Case> {
    let mut cases = cases_of(SHAPES, "shape");
    let free = cases_of(FREE, "emitter").into_iter();
    cases.extend(free.filter(|case| case.scene.emitters[0].is_environment()));
    cases
}

impl Case {
    fn light(&self) -> &dyn Emitter {
        &*self.scene.emitters[0]
    }

    /// What a ray from the receiver runs into, and how far away.
    fn look(&self, direction: Vec3) -> Option<(EmitterHit, f32)> {
        if self.light().is_environment() {
            let hit = EmitterHit { position: Vec3::ZERO, normal: Vec3::ZERO, uv: Vec2::ZERO, direction };
            return Some((hit, f32::INFINITY));
        }
        let ray = Ray { origin: self.from, direction, t_max: f32::INFINITY };
        let hit = self.scene.world.intersect(&ray)?;
        let (_, on_light) = self.scene.emitter_hit(&ray, &hit).expect("all shapes are lights");
        (-on_light.normal.dot(direction) > self.grazing).then_some((on_light, hit.t))
    }

    /// Density of the samples that nothing hides.
    fn density(&self, direction: Vec3) -> f64 {
        self.look(direction).map_or(0.0, |(hit, _)| f64::from(self.light().density(self.from, &hit)))
    }

    /// A sample that nothing hides.
    fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        let sample = sample(self.light(), self.from, u)?;
        let (_, distance) = self.look(sample.direction)?;
        (sample.distance <= 1.001 * distance).then_some(sample)
    }
}

/// A sample of a light, in all its steps.
fn sample(light: &dyn Emitter, from: Vec3, u: [f32; 2]) -> Option<LightSample> {
    let mut aim = light.aim(u);
    light.aim_closer(&mut aim);
    light.sample(from, aim)
}

const BINS: (usize, usize) = (16, 24);
const SAMPLES: usize = 40_000;
/// Probability that correct code fails the chi-square law anywhere.
const FALSE_ALARM: f64 = 1e-4;

/// Bins of a cone that holds the light.
struct Cone {
    frame: Frame,
    lowest: f32,
}

impl Cone {
    fn around(case: &Case, random: &mut Random) -> Self {
        let directions: Vec<Vec3> =
            (0..2000).filter_map(|_| Some(case.sample(random.pair())?.direction)).collect();
        let mean = directions.iter().sum::<Vec3>().normalize_or(Vec3::Z);
        let lowest = directions.iter().fold(1.0_f32, |low, direction| low.min(direction.dot(mean)));
        Self { frame: Frame::from_normal(mean), lowest: (1.0 - 1.2 * (1.0 - lowest)).clamp(-1.0, 0.999_999) }
    }

    /// The direction at a place in the unit square, which maps onto the cone and keeps areas.
    fn direction(&self, z: f32, turn: f32) -> Vec3 {
        self.frame.to_world(from_angles(self.lowest + (1.0 - self.lowest) * z, 2.0 * PI * turn))
    }

    fn bin(&self, direction: Vec3) -> Option<usize> {
        let local = self.frame.to_local(direction);
        let row = (local.z - self.lowest) / (1.0 - self.lowest) * BINS.0 as f32;
        let turn = local.y.atan2(local.x) / (2.0 * PI);
        let column = (((turn - turn.floor()) * BINS.1 as f32) as usize).min(BINS.1 - 1);
        (row >= 0.0).then(|| (row as usize).min(BINS.0 - 1) * BINS.1 + column)
    }

    /// Integral of the density over a bin by the midpoint rule, refined until two steps agree.
    fn probability(&self, case: &Case, bin: usize) -> f64 {
        let solid_angle = 2.0 * std::f64::consts::PI * f64::from(1.0 - self.lowest);
        let midpoints = |n: usize| {
            let place = |bin: usize, i: usize, count: usize| {
                (bin as f32 + (i as f32 + 0.5) / n as f32) / count as f32
            };
            let nodes = (0..n * n).map(|node| {
                let z = place(bin / BINS.1, node / n, BINS.0);
                case.density(self.direction(z, place(bin % BINS.1, node % n, BINS.1)))
            });
            nodes.sum::<f64>() * solid_angle / (BINS.0 * BINS.1 * n * n) as f64
        };
        // odd counts share few nodes: an edge that cuts the bin does not fool two of them alike
        let (mut n, mut coarse, mut fine) = (19, midpoints(9), midpoints(19));
        while n < 79 && f64::abs(fine - coarse) > 2e-6 {
            n = 2 * n + 1;
            (coarse, fine) = (fine, midpoints(n));
        }
        fine
    }
}

#[test]
fn samples_follow_their_density() {
    let cases = cases();
    let level = level(FALSE_ALARM, cases.len());
    for (number, case) in cases.iter().enumerate() {
        let mut random = Random(number as u64);
        let cone = Cone::around(case, &mut random);
        let probabilities = (0..BINS.0 * BINS.1).map(|bin| cone.probability(case, bin));
        let mut expected: Vec<f64> = probabilities.map(|p| p * SAMPLES as f64).collect();
        let reaching = expected.iter().sum::<f64>() / SAMPLES as f64;
        let known = case.reaching.unwrap_or(reaching);
        let name = format!("{} from {}", case.name, case.from);
        assert!((reaching - known).abs() < 2e-3, "{name}: density integrates to {reaching}, not {known}");

        let mut observed = vec![0.0; BINS.0 * BINS.1];
        for _ in 0..SAMPLES {
            let sample = case.sample(random.pair());
            if let Some(bin) = sample.and_then(|sample| cone.bin(sample.direction)) {
                observed[bin] += 1.0;
            }
        }
        expected.push(SAMPLES as f64 * (1.0 - known));
        observed.push(SAMPLES as f64 - observed.iter().sum::<f64>());
        let p = chi_square(&expected, &observed);
        assert!(p > level, "{name}: p = {p}, reaching {reaching}, rest {:?}", observed.last());
    }
}

#[test]
fn a_ray_finds_what_was_sampled() {
    for case in cases().iter().filter(|case| case.reaching != Some(0.0)) {
        let mut random = Random(7);
        let mut compared = 0;
        for _ in 0..3000 {
            let Some(sample) = sample(case.light(), case.from, random.pair()) else { continue };
            assert!((sample.direction.length() - 1.0).abs() < 1e-5 && !sample.delta, "{}", case.name);
            let Some((hit, distance)) = case.look(sample.direction) else { continue };
            let cosine = -hit.normal.dot(sample.direction);
            let environment = case.light().is_environment();
            if !environment && (cosine < 0.02 || sample.distance > 1.01 * distance) {
                continue; // edges, and points behind others
            }
            compared += 1;
            let context = format!("{} from {}: {sample:?} but {hit:?} at {distance}", case.name, case.from);
            let position = case.from + sample.direction * sample.distance;
            let near = environment || (hit.position - position).length() < 1e-4 * (1.0 + distance);
            let density = case.light().density(case.from, &hit);
            // a triangle's edge may be hit on either side; textures are smooth enough for 2 %
            let radiance = (case.light().radiance(&hit) - sample.radiance).abs().max_element() < 0.02;
            assert!(
                near && radiance && (density / sample.density - 1.0).abs() < 2e-3,
                "{context}: {density}"
            );
        }
        assert!(compared > 200, "{}: only {compared}", case.name);
    }
}

#[test]
fn the_dark_side_is_dark() {
    for case in cases().iter().filter(|case| case.reaching == Some(0.0)) {
        let mut random = Random(3);
        assert!((0..1000).all(|_| sample(case.light(), case.from, random.pair()).is_none()), "{}", case.name);
    }
}

#[test]
fn extremes_give_finite_numbers() {
    let edges = [0.0, f32::EPSILON / 2.0, 0.5, 1.0 - f32::EPSILON / 2.0];
    let mut all = cases();
    all.extend(cases_of(FREE, "emitter"));
    for case in &all {
        // also from points on the light, in its plane and at its center
        for from in [case.from, Vec3::ZERO, Vec3::new(0.3, -0.2, 0.5), Vec3::X, Vec3::new(1e6, 1e6, 0.0)] {
            for u in edges.iter().flat_map(|&a| edges.map(|b| [a, b])) {
                let Some(sample) = sample(case.light(), from, u) else { continue };
                let finite = sample.direction.is_finite() && sample.radiance.is_finite();
                let density = sample.density > 0.0 && sample.density.is_finite();
                assert!(finite && density, "{} from {from}: {sample:?}", case.name);
            }
        }
    }
}

#[test]
fn spot_light_falls_off_linearly_with_the_angle() {
    let scene = stage::scene(
        "<emitter type='spot'><rgb name='intensity' value='6 3 1'/><float name='cutoff_angle' value='40'/>\
         <float name='beam_width' value='30'/></emitter>",
    );
    for (degrees, falloff) in
        [(0.0_f32, 1.0), (29.9, 1.0), (32.5, 0.75), (35.0, 0.5), (39.0, 0.1), (40.1, 0.0)]
    {
        let from = from_angles(degrees.to_radians().cos(), 1.0) * 2.0;
        let light = sample(&*scene.emitters[0], from, [0.5; 2]);
        let ours = light.map_or(0.0, |light| light.radiance.x);
        assert!((ours - 6.0 * falloff / 4.0).abs() < 2e-4, "{degrees}: {ours}");
    }
}

#[test]
fn distant_spheres_keep_their_solid_angle() {
    let scene = stage::scene(&format!("<shape type='sphere'>{RADIANCE}</shape>"));
    for distance in [2.0_f32, 30.0, 1e3, 1e5] {
        let sample = sample(&*scene.emitters[0], Vec3::X * distance, [0.5; 2]).expect("it is seen");
        let sine_squared = f64::from(distance).powi(-2);
        let solid_angle = 2.0 * std::f64::consts::PI * sine_squared / (1.0 + (1.0 - sine_squared).sqrt());
        assert!((f64::from(sample.density) * solid_angle - 1.0).abs() < 1e-5, "{distance}: {sample:?}");
    }
}

#[test]
fn every_emitter_and_shape_is_tried() {
    let names = |lines: &[Line]| lines.iter().map(|line| line.1).collect::<BTreeSet<_>>();
    assert_eq!(names(FREE), emitter::ALL.iter().map(|entry| entry.name).collect());
    let mut shapes: BTreeSet<_> = evenlight_render::shape::ALL.iter().map(|entry| entry.name).collect();
    shapes.remove("serialized"); // a mesh like any other
    assert_eq!(names(SHAPES), shapes);
}
