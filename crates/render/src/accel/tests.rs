//! What every ray kernel promises: watertight, equal to trying all triangles, strict about its interval.
//!
//! The environment variable `EVENLIGHT_EMBREE` may name the shared library of Embree 4; then that kernel is held to the
//! promises that do not depend on the last bit.

use std::collections::HashMap;
use std::path::Path;

#[path = "../../tests/random/mod.rs"]
mod random;

use random::Random;

use super::wide::brute_force;
use super::{KernelChoice, RayKernel, TriangleSoup, Wide, build};
use crate::geometry::{Ray, Vec3};

/// More work where the compiler optimizes.
const EFFORT: usize = if cfg!(debug_assertions) { 1 } else { 40 };

#[derive(Default)]
struct Mesh {
    positions: Vec<[f32; 3]>,
    indices: Vec<[u32; 3]>,
}

impl Mesh {
    fn soup(&self) -> TriangleSoup<'_> {
        TriangleSoup { positions: &self.positions, indices: &self.indices }
    }

    fn vertex(&self, index: u32) -> Vec3 {
        Vec3::from_array(self.positions[index as usize])
    }

    /// A sphere of 20 · 4^levels triangles.
    fn icosphere(levels: u32) -> Self {
        let golden = f32::midpoint(1.0, 5.0_f32.sqrt());
        let mut mesh = Self::default();
        for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
            mesh.positions.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]]);
        }
        // The faces are the triples of mutually nearest vertices: edges have length 2.
        let near = |mesh: &Self, a: u32, b: u32| (mesh.vertex(a).distance(mesh.vertex(b)) - 2.0).abs() < 1e-3;
        for a in 0..12 {
            for b in a + 1..12 {
                for c in b + 1..12 {
                    if near(&mesh, a, b) && near(&mesh, b, c) && near(&mesh, a, c) {
                        mesh.indices.push([a, b, c]);
                    }
                }
            }
        }
        for _ in 0..levels {
            let mut middles = HashMap::new();
            let mut indices = Vec::new();
            for [a, b, c] in std::mem::take(&mut mesh.indices) {
                let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(a, b)| {
                    *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                        let middle = (mesh.vertex(a) + mesh.vertex(b)).normalize();
                        mesh.positions.push(middle.to_array());
                        mesh.positions.len() as u32 - 1
                    })
                });
                indices.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
            }
            mesh.indices = indices;
        }
        for position in &mut mesh.positions {
            *position = Vec3::from_array(*position).normalize().to_array();
        }
        mesh
    }

    /// The surface of the cube [-1, 1]³, each face an n × n grid: all edges lie in planes of boxes.
    fn cube_grid(n: u32) -> Self {
        let mut mesh = Self::default();
        let at = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let base = mesh.positions.len() as u32;
                for i in 0..=n {
                    for j in 0..=n {
                        let mut position = [0.0; 3];
                        position[axis] = side;
                        position[(axis + 1) % 3] = at(i);
                        position[(axis + 2) % 3] = at(j);
                        mesh.positions.push(position);
                    }
                }
                for i in 0..n {
                    for j in 0..n {
                        let corner = base + i * (n + 1) + j;
                        let (right, up) = (corner + n + 1, corner + 1);
                        mesh.indices.extend([[corner, right, up], [right, right + 1, up]]);
                    }
                }
            }
        }
        mesh
    }

    fn random_soup(random: &mut Random, triangles: u32, size: f32, scale: f32) -> Self {
        let mut mesh = Self::default();
        for triangle in 0..triangles {
            let center = point(random);
            for _ in 0..3 {
                mesh.positions.push(((center + point(random) * size) * scale).to_array());
            }
            mesh.indices.push([3 * triangle, 3 * triangle + 1, 3 * triangle + 2]);
        }
        mesh
    }

    fn scaled(mut self, scale: f32, shift: f32) -> Self {
        for x in self.positions.iter_mut().flatten() {
            *x = *x * scale + shift;
        }
        self
    }
}

/// In the cube [-1, 1)³.
fn point(random: &mut Random) -> Vec3 {
    random.point() * 2.0 - 1.0
}

fn ray(origin: Vec3, direction: Vec3) -> Ray {
    Ray { origin, direction, t_max: f32::INFINITY }
}

/// The house kernel for every instruction set of this computer, and Embree when it is named.
fn kernels(soup: &TriangleSoup) -> Vec<Box<dyn RayKernel>> {
    let mut kernels = house_kernels(soup);
    if let Some(library) = std::env::var_os("EVENLIGHT_EMBREE") {
        kernels.push(build(KernelChoice::Embree, soup, Some(Path::new(&library))).expect("Embree loads"));
    }
    kernels
}

fn house_kernels(soup: &TriangleSoup) -> Vec<Box<dyn RayKernel>> {
    Wide::build_all(soup).into_iter().map(|kernel| Box::new(kernel) as Box<dyn RayKernel>).collect()
}

/// All vertices and some points on all edges, from inside: every ray must hit.
fn assert_watertight(mesh: &Mesh, origins: &[Vec3]) {
    let soup = mesh.soup();
    let kernels = kernels(&soup);
    for &origin in origins {
        for &[a, b, c] in &mesh.indices {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                for along in [0.0, 0.5, 0.3, 1.0 / 1024.0] {
                    let direction = mesh.vertex(from).lerp(mesh.vertex(to), along) - origin;
                    for (which, kernel) in kernels.iter().enumerate() {
                        let ray = ray(origin, direction);
                        let hit = kernel.closest(&ray);
                        assert!(hit.is_some(), "{} ({which}) leaks: {ray:?}", kernel.name());
                        assert!(kernel.occluded(&ray), "{} ({which}) leaks shadows: {ray:?}", kernel.name());
                    }
                }
            }
        }
    }
}

#[test]
fn spheres_are_watertight() {
    let mut random = Random(1);
    let mut origins = vec![Vec3::ZERO];
    origins.extend((0..EFFORT).map(|_| point(&mut random) * 0.5));
    assert_watertight(&Mesh::icosphere(if EFFORT == 1 { 3 } else { 4 }), &origins);
}

#[test]
fn cubes_are_watertight() {
    let mut random = Random(2);
    // Some origins lie in grid planes, so that many rays run inside faces of boxes.
    let mut origins =
        vec![Vec3::ZERO, Vec3::new(0.25, 0.5, -0.125), Vec3::new(0.0, 0.5, 0.0), Vec3::new(-0.0, 0.1, 0.5)];
    origins.extend((0..EFFORT).map(|_| point(&mut random) * 0.9));
    assert_watertight(&Mesh::cube_grid(if EFFORT == 1 { 8 } else { 16 }), &origins);
}

#[test]
fn scale_and_distance_do_not_leak() {
    for (scale, shift) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1000.0), (1e-3, 10.0), (1e3, 1e5)] {
        let mesh = Mesh::icosphere(2).scaled(scale, shift);
        assert_watertight(
            &mesh,
            &[Vec3::splat(shift), Vec3::splat(shift) + Vec3::new(0.2, -0.1, 0.3) * scale],
        );
    }
}

/// Rays that leave a level surface far larger than the view, grazing ones among them, start above it by less than what the distance
/// to its corners loses to rounding: its flat box must tell.
#[test]
fn huge_level_surfaces_do_not_shadow_themselves() {
    let corners = [[-1e5, -1e5], [1e5, -1e5], [1e5, 1e5], [-1e5, 1e5]];
    let ground =
        Mesh { positions: corners.map(|[x, z]| [x, 0.0, z]).into(), indices: vec![[0, 1, 2], [2, 3, 0]] };
    let mut random = Random(8);
    for kernel in house_kernels(&ground.soup()) {
        for _ in 0..500 * EFFORT {
            let (place, direction) = (point(&mut random) * 10.0, point(&mut random));
            let origin = Vec3::new(place.x, 3e-4, place.z);
            let upward = Vec3::new(direction.x, (direction.y * place.y * 0.1).abs(), direction.z).normalize();
            let ray = ray(origin, upward);
            assert!(!kernel.occluded(&ray) && kernel.closest(&ray).is_none(), "{ray:?}");
        }
    }
}

#[test]
fn axis_parallel_rays_do_not_leak() {
    let mesh = Mesh::cube_grid(8);
    // Not Embree: it loses rays that run along the cube's own edges.
    for kernel in house_kernels(&mesh.soup()) {
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                for zero in [0.0, -0.0, 1e-30, -1e-30] {
                    // Along the cube's own faces only if the ray does not leave them by its tiny tilt.
                    let inset = i32::from(zero != 0.0);
                    let places = inset..17 - inset;
                    for (u, v) in places.clone().flat_map(|u| places.clone().map(move |v| (u, v))) {
                        let at = |i: i32| i as f32 / 8.0 - 1.0;
                        let mut origin = [0.0; 3];
                        origin[(axis + 1) % 3] = at(u);
                        origin[(axis + 2) % 3] = at(v);
                        let mut direction = [zero; 3];
                        direction[axis] = sign;
                        let ray = ray(Vec3::from_array(origin), Vec3::from_array(direction));
                        let hit = kernel
                            .closest(&ray)
                            .unwrap_or_else(|| panic!("{} leaks: {ray:?}", kernel.name()));
                        assert!((hit.t - 1.0).abs() < 1e-6, "{}: {hit:?} of {ray:?}", kernel.name());
                    }
                }
            }
        }
    }
}

#[test]
fn the_house_kernel_agrees_with_trying_all_triangles() {
    let mut random = Random(3);
    for (triangles, size, scale) in
        [(1, 1.0, 1.0), (3, 1.0, 1.0), (200, 0.3, 1.0), (200, 0.3, 1e-6), (200, 0.3, 1e6), (1000, 0.05, 30.0)]
    {
        let mesh = Mesh::random_soup(&mut random, triangles, size, scale);
        let soup = mesh.soup();
        let kernels = house_kernels(&soup);
        for i in 0..1000 * EFFORT.min(10) {
            let mut ray = ray(point(&mut random) * scale, random.direction());
            if i % 3 == 0 {
                ray.t_max = random.next() * scale;
            }
            let expected = brute_force(&soup, &ray);
            for kernel in &kernels {
                assert_eq!(kernel.closest(&ray), expected, "{ray:?}");
                assert_eq!(kernel.occluded(&ray), expected.is_some(), "{ray:?}");
            }
        }
    }
}

#[test]
fn all_kernels_see_the_same_surface() {
    let mut random = Random(4);
    let mesh = Mesh::random_soup(&mut random, 500, 0.2, 1.0);
    let kernels = kernels(&mesh.soup());
    for _ in 0..2000 {
        let ray = ray(point(&mut random), random.direction());
        let expected = kernels[0].closest(&ray);
        for kernel in &kernels[1..] {
            let hit = kernel.closest(&ray);
            assert_eq!(hit.map(|h| h.triangle), expected.map(|h| h.triangle), "{} at {ray:?}", kernel.name());
            if let (Some(hit), Some(expected)) = (hit, expected) {
                assert!((hit.t - expected.t).abs() <= 1e-5 * expected.t.max(0.1), "{hit:?} {expected:?}");
                assert!((hit.u - expected.u).abs() < 1e-3 && (hit.v - expected.v).abs() < 1e-3);
            }
        }
    }
}

#[test]
fn the_interval_is_open_at_both_ends() {
    let mut random = Random(5);
    let mesh = Mesh::random_soup(&mut random, 100, 0.5, 1.0);
    for kernel in kernels(&mesh.soup()) {
        for _ in 0..500 {
            let long = ray(point(&mut random), random.direction());
            let Some(hit) = kernel.closest(&long) else { continue };
            let short = Ray { t_max: hit.t, ..long };
            assert_eq!(kernel.closest(&short), None, "{}", kernel.name());
            assert!(!kernel.occluded(&short), "{}", kernel.name());
            let enough = Ray { t_max: hit.t.next_up(), ..long };
            assert_eq!(kernel.closest(&enough), Some(hit), "{}", kernel.name());
            assert!(kernel.occluded(&enough), "{}", kernel.name());
        }
        // A start exactly on a triangle is not a hit.
        let [a, b, c] = mesh.indices[0].map(|v| mesh.vertex(v));
        let on = ray(a, (b - a).cross(c - a));
        assert!(kernel.closest(&on).is_none_or(|hit| hit.t > 0.0), "{}", kernel.name());
    }
}

#[test]
fn degenerate_input_is_harmless() {
    let down = ray(Vec3::new(0.25, 0.25, 1.0), Vec3::NEG_Z);
    let nothing = Mesh::default();
    let triangle = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let flat = Mesh { positions: vec![[0.25, 0.25, 0.0]; 3], indices: vec![[0, 1, 2]; 20] };
    let line = Mesh { positions: triangle.clone(), indices: vec![[0, 1, 1], [0, 0, 0], [2, 2, 1]] };
    for mesh in [nothing, flat, line] {
        for kernel in kernels(&mesh.soup()) {
            assert_eq!(kernel.closest(&down), None);
            assert!(!kernel.occluded(&down));
        }
    }
    let copies = Mesh { positions: triangle, indices: vec![[0, 1, 2]; 3000] };
    for kernel in house_kernels(&copies.soup()) {
        let hit = kernel.closest(&down).expect("the triangle is there");
        assert_eq!((hit.triangle, hit.t), (0, 1.0), "ties go to the lowest index");
        for direction in [Vec3::ZERO, Vec3::NAN] {
            assert_eq!(kernel.closest(&ray(down.origin, direction)), None);
            assert!(!kernel.occluded(&ray(down.origin, direction)));
        }
    }
}

#[test]
fn rays_together_find_what_each_finds_alone() {
    let mut random = Random(9);
    let mesh = Mesh::random_soup(&mut random, 2000, 0.1, 1.0);
    for kernel in kernels(&mesh.soup()) {
        for count in [0, 1, 7, 8, 9, 100] {
            let rays: Vec<_> = (0..count).map(|_| ray(random.point(), random.direction())).collect();
            let (mut hits, mut occluded) = (vec![None; count], vec![true; count]);
            kernel.closest_each(&rays, &mut hits);
            kernel.occluded_each(&rays, &mut occluded);
            for ((ray, hit), occluded) in rays.iter().zip(hits).zip(occluded) {
                assert_eq!(kernel.closest(ray), hit, "{}", kernel.name());
                assert_eq!(hit.is_some(), occluded, "{}", kernel.name());
            }
        }
    }
}

#[test]
fn names_and_errors_say_what_is_known() {
    for choice in KernelChoice::ALL {
        assert_eq!(choice.name().parse::<KernelChoice>().expect("a known name"), choice);
    }
    let error = "optix".parse::<KernelChoice>().expect_err("an unknown name");
    assert_eq!(error.to_string(), "unknown ray kernel 'optix'; known: auto, embree, wide");
    let mesh = Mesh::icosphere(0);
    let message = |library| {
        build(KernelChoice::Embree, &mesh.soup(), library).err().expect("there is no library").to_string()
    };
    assert!(message(None).contains("needs the path"), "{}", message(None));
    let missing = Path::new("no/such/libembree4.so");
    assert!(message(Some(missing)).contains("cannot load Embree 4 from 'no/such/libembree4.so'"));
    assert_eq!(build(KernelChoice::Auto, &mesh.soup(), None).expect("always possible").name(), "wide");
}
