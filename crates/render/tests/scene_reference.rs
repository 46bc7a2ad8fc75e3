//! Shapes, emitters and sensors mean what they mean in Mitsuba 3.
//!
//! The numbers come from `data/make_scene_reference.py`.

mod stage;

use evenlight_render::emitter::{Aim, EmitterHit};
use evenlight_render::geometry::{Ray, Vec2, Vec3};

const REFERENCE: &str = include_str!("data/scene_reference.csv");

/// One plugin of the file and its rows of numbers.
struct Case {
    name: &'static str,
    xml: &'static str,
    rows: Vec<Vec<f32>>,
}

fn cases(family: &str) -> Vec<Case> {
    let mut cases: Vec<(bool, Case)> = Vec::new();
    for line in REFERENCE.lines().filter(|line| !line.starts_with('#')) {
        if line.starts_with(|first: char| first.is_ascii_alphabetic()) {
            let mut fields = line.splitn(3, ',');
            let mut next = || fields.next().expect("a family, a name and XML");
            let wanted = next() == family;
            cases.push((wanted, Case { name: next(), xml: next(), rows: Vec::new() }));
        } else {
            let row = line.split(',').map(|x| x.parse().expect("a number")).collect();
            cases.last_mut().expect("a plugin before its rows").1.rows.push(row);
        }
    }
    let cases: Vec<_> = cases.into_iter().filter_map(|(wanted, case)| wanted.then_some(case)).collect();
    assert!(!cases.is_empty());
    cases
}

fn vector(row: &[f32], at: usize) -> Vec3 {
    Vec3::new(row[at], row[at + 1], row[at + 2])
}

/// The relative error that numbers may have: rounding in single precision.
const SINGLE: f32 = 1e-4;

/// Skies keep their texels in half precision: half a unit in the eleventh bit.
const HALF: f32 = 1.0 / 2048.0;

/// The complaint about a row, unless all numbers agree.
fn complaint(name: &str, row: &[f32], [ours, theirs]: [&[f32]; 2], tolerance: f32) -> Option<String> {
    assert_eq!(ours.len(), theirs.len(), "{name}: columns");
    let same = ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() <= tolerance * b.abs() + 2e-5);
    (!same).then(|| format!("{name}: {row:?}\n  ours   {ours:?}\n  theirs {theirs:?}"))
}

/// Complaints about all rows of a family; `evaluate` gives our numbers and their counterparts.
fn judge(family: &str, tolerance: f32, evaluate: impl Fn(&Case) -> Vec<[Vec<f32>; 2]>) {
    let complaints: Vec<String> = cases(family)
        .iter()
        .flat_map(|case| {
            let rows = case.rows.iter().zip(evaluate(case));
            rows.filter_map(|(row, [ours, theirs])| complaint(case.name, row, [&ours, &theirs], tolerance))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(complaints.is_empty(), "{} rows differ\n{}", complaints.len(), complaints.join("\n"));
}

fn flat(vectors: &[Vec3]) -> Vec<f32> {
    vectors.iter().flat_map(Vec3::to_array).collect()
}

#[test]
fn shapes_agree_with_mitsuba() {
    judge("shape", SINGLE, |case| {
        let scene = stage::scene(case.xml);
        let row = |row: &Vec<f32>| {
            let direction = vector(row, 3).normalize();
            let ray = Ray { origin: vector(row, 0), direction, t_max: f32::INFINITY };
            let Some(hit) = scene.world.intersect(&ray) else { return [vec![0.0; 18], row[6..].to_vec()] };
            let surface = scene.world.vertex(&ray, &hit).surface;
            let mut ours = vec![hit.t];
            ours.extend(flat(&[surface.position, surface.geometric_normal, surface.shading.n]));
            ours.extend([surface.uv.x, surface.uv.y]);
            ours.extend(flat(&[surface.dp_du, surface.dp_dv]));
            let mut theirs = row[6..].to_vec();
            // our geometric normal is on the side of the shading normal
            let side = 1.0_f32.copysign(vector(&theirs, 4).dot(vector(&theirs, 7)));
            theirs[4..7].iter_mut().for_each(|x| *x *= side);
            [ours, theirs]
        };
        case.rows.iter().map(row).collect()
    });
}

#[test]
fn delta_lights_agree_with_mitsuba() {
    judge("light", SINGLE, |case| {
        let scene = stage::scene(case.xml);
        let row = |row: &Vec<f32>| {
            let Some(light) = scene.emitters[0].sample(vector(row, 0), Aim::at([0.3, 0.6])) else {
                return [vec![0.0; 3], row[7..].to_vec()];
            };
            assert!(light.delta && light.density == 1.0);
            let mut ours = flat(&[light.direction]);
            ours.push(if light.distance.is_finite() { light.distance } else { 0.0 });
            ours.extend(light.radiance.to_array());
            [ours, row[3..].to_vec()]
        };
        case.rows.iter().map(row).collect()
    });
}

#[test]
fn skies_agree_with_mitsuba() {
    judge("sky", HALF, |case| {
        let scene = stage::scene(case.xml);
        let row = |row: &Vec<f32>| {
            let direction = vector(row, 0).normalize();
            let hit = EmitterHit { position: Vec3::ZERO, normal: Vec3::ZERO, uv: Vec2::ZERO, direction };
            [scene.emitters[0].radiance(&hit).to_array().to_vec(), row[3..].to_vec()]
        };
        case.rows.iter().map(row).collect()
    });
}

#[test]
fn sensors_agree_with_mitsuba() {
    judge("sensor", SINGLE, |case| {
        let scene = stage::scene(case.xml);
        let sensor = scene.sensor(scene.film.aspect()).expect(case.name);
        let row = |row: &Vec<f32>| {
            let ray = sensor.ray([row[0], row[1]], [row[2], row[3]]);
            let mut ours = flat(&[ray.origin, ray.direction]);
            ours.push(ray.t_max);
            [ours, row[4..].to_vec()]
        };
        case.rows.iter().map(row).collect()
    });
}
