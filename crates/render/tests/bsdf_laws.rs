//! Laws that every BSDF obeys, whatever its parameters.

mod judge;
mod plugins;
mod random;

use std::collections::BTreeSet;
use std::f32::consts::PI;
use std::sync::Arc;

use evenlight_render::bsdf::{self, Bsdf, BsdfSample};
use evenlight_render::geometry::{Surface, Vec2, Vec3};
use judge::{chi_square, level};
use plugins::surface;
use random::{Random, from_angles};

/// One BSDF with parameters.
struct Case {
    xml: String,
    bsdf: Arc<dyn Bsdf>,
    /// Index of refraction below the surface over that above.
    below: f32,
    /// Shading about a normal other than the surface's is not reciprocal.
    reciprocal: bool,
}

/// The parameter sets, in a short form of XML: `plugin name=number … (nested) …`.
const CASES: &[&str] = &[
    "diffuse reflectance=0.7",
    "twosided (diffuse)",
    "twosided (diffuse) (roughconductor alpha=0.3)",
    "conductor material=Au",
    "roughconductor",
    "roughconductor alpha=0.5 material=Cu",
    "roughconductor distribution=ggx alpha=0.3",
    "roughconductor distribution=ggx alpha=1.0",
    "roughconductor distribution=ggx alpha_u=0.15 alpha_v=0.5",
    "roughconductor alpha_u=0.6 alpha_v=0.2",
    "roughconductor alpha=0.4 sample_visible=false",
    "roughconductor distribution=ggx alpha=0.3 sample_visible=false",
    "dielectric int_ior=1.5 ext_ior=1.0",
    "roughdielectric int_ior=1.5 ext_ior=1.0 alpha=0.3",
    "roughdielectric int_ior=1.5 ext_ior=1.0 distribution=ggx alpha_u=0.3 alpha_v=0.6",
    "roughdielectric int_ior=1.0 ext_ior=1.5 distribution=ggx alpha=0.5",
    "roughdielectric int_ior=1.5 ext_ior=1.0 alpha=0.4 sample_visible=false",
    "thindielectric",
    "plastic",
    "plastic nonlinear=true diffuse_reflectance=0.9",
    "roughplastic",
    "roughplastic distribution=ggx alpha=0.4 diffuse_reflectance=0.9",
    "roughplastic alpha=0.5 sample_visible=false",
    "mask opacity=0.3 (diffuse)",
    "mask opacity=0.7 (roughconductor alpha=0.4)",
    "blendbsdf weight=0.3 (diffuse) (roughconductor alpha=0.3)",
    "blendbsdf weight=0.6 (plastic) (dielectric)",
    "normalmap normalmap=0.8,0.6,0.8 (roughconductor distribution=ggx alpha=0.4)",
    "normalmap normalmap=0.3,0.5,0.9 (plastic)",
    "normalmap normalmap=0.7,0.4,0.9 (roughdielectric alpha=0.4)",
    "bumpmap scale=0.2 [checkerboard] (diffuse)",
    "null",
];

/// Turn the short form into XML.
fn to_xml(short: &str) -> String {
    let (head, nested) = short.split_once(" (").map_or((short, ""), |(head, rest)| (head, rest));
    let mut words = head.split_whitespace();
    let mut xml = format!("<bsdf type=\"{}\">", words.next().unwrap_or_default());
    for word in words {
        let parameter = match word.split_once('=') {
            None => format!("<texture type=\"{}\"/>", word.trim_matches(['[', ']'])),
            Some((name, value)) => {
                let element = match value {
                    "true" | "false" => "boolean",
                    _ if value.contains(',') => "rgb",
                    _ if value.parse::<f32>().is_ok() => "float",
                    _ => "string",
                };
                format!("<{element} name=\"{name}\" value=\"{}\"/>", value.replace(',', " "))
            }
        };
        xml.push_str(&parameter);
    }
    let nested = nested.split(" (").filter(|plugin| !plugin.is_empty());
    nested.for_each(|plugin| xml += &to_xml(plugin.trim_end_matches(')')));
    xml + "</bsdf>"
}

fn cases() -> Vec<Case> {
    let build = |short: &&str| {
        let bsdf = plugins::bsdf(&to_xml(short)).unwrap_or_else(|error| panic!("{short}: {error}"));
        let below = match () {
            () if short.contains("int_ior=1.5") => 1.5,
            () if short.contains("ext_ior=1.5") => 1.0 / 1.5,
            () => 1.0,
        };
        let reciprocal = !short.contains("map");
        Case { xml: (*short).to_owned(), bsdf, below, reciprocal }
    };
    CASES.iter().map(build).collect()
}

fn here() -> Surface {
    surface(Vec2::new(0.3, 0.6))
}

/// Directions to look from: steep, oblique, grazing, from below.
fn viewers() -> [Vec3; 4] {
    [from_angles(0.95, 0.4), from_angles(0.5, 2.0), from_angles(0.1, -2.5), from_angles(-0.6, 1.0)]
}

/// Bins of the sphere, in the cosine and the azimuth.
const BINS: (usize, usize) = (24, 24);
const SAMPLES: usize = 100_000;
/// Probability that correct code fails the chi-square law anywhere.
const FALSE_ALARM: f64 = 1e-4;

/// Integral of the density over a bin by the midpoint rule, refined until two steps agree.
fn probability(case: &Case, wo: Vec3, (row, column): (usize, usize)) -> f64 {
    let surface = here();
    let midpoints = |n: usize| {
        let place =
            |bin: usize, i: usize, count: usize| (bin as f32 + (i as f32 + 0.5) / n as f32) / count as f32;
        let nodes = (0..n * n).map(|node| {
            let wi = from_angles(
                2.0 * place(row, node / n, BINS.0) - 1.0,
                2.0 * PI * place(column, node % n, BINS.1),
            );
            f64::from(case.bsdf.evaluate(&surface, wo, wi).density)
        });
        nodes.sum::<f64>() * 4.0 * std::f64::consts::PI / (BINS.0 * BINS.1 * n * n) as f64
    };
    // Odd counts share few nodes: an edge that cuts the bin does not fool two of them alike.
    let (mut n, mut coarse, mut fine) = (15, midpoints(7), midpoints(15));
    while n < 255 && f64::abs(fine - coarse) > 1e-6 {
        n = 2 * n + 1;
        (coarse, fine) = (fine, midpoints(n));
    }
    fine
}

fn expected_counts(case: &Case, wo: Vec3) -> Vec<f64> {
    let bin = |index: usize| probability(case, wo, (index / BINS.1, index % BINS.1)) * SAMPLES as f64;
    (0..BINS.0 * BINS.1).map(bin).collect()
}

/// Counts per bin; what was absorbed or left by a delta lobe is not counted.
fn observed_counts(case: &Case, wo: Vec3, seed: u64) -> Vec<f64> {
    let (rows, columns) = BINS;
    let (surface, mut random) = (here(), Random(seed));
    let mut counts = vec![0.0; rows * columns];
    for _ in 0..SAMPLES {
        let sample = case.bsdf.sample(&surface, wo, random.next(), random.pair());
        if let Some(BsdfSample { wi, delta: false, .. }) = sample {
            let row = (((wi.z + 1.0) * 0.5 * rows as f32) as usize).min(rows - 1);
            let turn = wi.y.atan2(wi.x) / (2.0 * PI);
            let column = (((turn - turn.floor()) * columns as f32) as usize).min(columns - 1);
            counts[row * columns + column] += 1.0;
        }
    }
    counts
}

#[test]
fn samples_follow_their_density() {
    let cases = cases();
    let tests = cases.len() * viewers().len();
    let level = level(FALSE_ALARM, tests);
    for (number, case) in cases.iter().enumerate() {
        for (viewer, wo) in viewers().into_iter().enumerate() {
            let mut expected = expected_counts(case, wo);
            let total: f64 = expected.iter().sum();
            assert!(total <= SAMPLES as f64 * 1.0005, "{}: density {}", case.xml, total / SAMPLES as f64);
            let mut observed = observed_counts(case, wo, (number * 10 + viewer) as u64);
            expected.push((SAMPLES as f64 - total).max(0.0));
            observed.push(SAMPLES as f64 - observed.iter().sum::<f64>());

            let p = chi_square(&expected, &observed);
            assert!(p > level, "{} from {wo}: p = {p}", case.xml);
        }
    }
}

#[test]
fn weight_is_value_over_density() {
    for case in cases() {
        let (surface, mut random) = (here(), Random(1));
        for _ in 0..4000 {
            let wo = random.direction();
            let Some(sample) = case.bsdf.sample(&surface, wo, random.next(), random.pair()) else { continue };
            if sample.delta || sample.wi.z.abs() < 1e-3 || wo.z.abs() < 1e-3 {
                continue;
            }
            let again = case.bsdf.evaluate(&surface, wo, sample.wi);
            let weight = again.value / again.density;
            let near =
                (weight - sample.weight).abs().max_element() <= 0.01 * sample.weight.max_element() + 1e-5;
            let dense = (again.density / sample.density - 1.0).abs() < 0.02;
            assert!(near && dense, "{} from {wo}: {sample:?} but {again:?}", case.xml);
        }
    }
}

#[test]
fn scattering_is_reciprocal() {
    for case in cases().into_iter().filter(|case| case.reciprocal) {
        let (surface, mut random) = (here(), Random(2));
        for _ in 0..4000 {
            let (a, b) = (random.direction(), random.direction());
            // Radiance over the squared index is what two-way paths conserve (Veach 1997, section 5.2).
            let index = |v: Vec3| if v.z > 0.0 { 1.0 } else { case.below };
            let f = |wo: Vec3, wi: Vec3| {
                case.bsdf.evaluate(&surface, wo, wi).value / (wi.z.abs() * index(wo) * index(wo))
            };
            let (forth, back) = (f(a, b), f(b, a));
            let close = (forth - back).abs().max_element() <= 2e-3 * forth.max_element() + 1e-5;
            assert!(close, "{}: {a} {b}: {forth} but {back}", case.xml);
        }
    }
}

#[test]
fn no_energy_is_gained() {
    for case in cases() {
        for wo in viewers() {
            let (surface, mut random, n) = (here(), Random(3), 24);
            let mut sum = Vec3::ZERO;
            for cell in 0..n * n * n {
                let [i, j, k] = [cell / (n * n), cell / n % n, cell % n];
                let mut place = |i: usize| (i as f32 + random.next()) / n as f32;
                let (lobe, u) = (place(i), [place(j), place(k)]);
                if let Some(sample) =
                    case.bsdf.sample(&surface, wo, lobe.min(0.999_999), u.map(|x| x.min(0.999_999)))
                {
                    sum += sample.weight * (sample.eta * sample.eta);
                }
            }
            let albedo = sum / (n * n * n) as f32;
            assert!(albedo.max_element() <= 1.006, "{} from {wo}: albedo {albedo}", case.xml);
        }
    }
}

#[test]
fn extremes_give_finite_numbers() {
    let edge = 1.0 - 2.0_f32.powi(-24);
    let cosines = [1.0, 0.3, 1e-3, 1e-6, 1e-20, 0.0, -1e-20, -1e-6, -0.3, -1.0];
    let numbers = [0.0, 2.0_f32.powi(-24), 0.25, 0.5, 0.999, edge];
    for case in cases() {
        let surface = here();
        for wo in cosines.map(|z| from_angles(z, 0.7)) {
            for index in 0..numbers.len().pow(3) {
                let pick = |digit: usize| numbers[index / numbers.len().pow(digit as u32) % numbers.len()];
                let Some(sample) = case.bsdf.sample(&surface, wo, pick(0), [pick(1), pick(2)]) else {
                    continue;
                };
                let unit = (sample.wi.length() - 1.0).abs() < 1e-3;
                let weight = sample.weight.is_finite() && sample.weight.min_element() >= 0.0;
                let density = sample.density > 0.0 && sample.density.is_finite();
                assert!(unit && weight && density, "{} from {wo}: {sample:?}", case.xml);
            }
            for wi in cosines.iter().flat_map(|z| [from_angles(*z, 0.7), from_angles(*z, 0.7 - PI)]) {
                let result = case.bsdf.evaluate(&surface, wo, wi);
                let value = result.value.is_finite() && result.value.min_element() >= 0.0;
                let density = result.density >= 0.0 && result.density.is_finite();
                assert!(value && density, "{}: {wo} {wi}: {result:?}", case.xml);
            }
        }
    }
}

#[test]
fn every_registered_bsdf_is_tried() {
    let registered: BTreeSet<_> = bsdf::ALL.iter().map(|entry| entry.name).collect();
    let tried = CASES.iter().filter_map(|case| case.split_whitespace().next()).collect();
    assert_eq!(registered, tried);
}
