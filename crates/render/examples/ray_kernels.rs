//! Ray kernels side by side: millions of rays per second and core on the meshes of a folder.
//!
//! ```text
//! cargo run --release -p evenlight-render --example ray_kernels -- FOLDER_OF_PLY [LIBEMBREE4.so]
//! ```
//!
//! All kernels see the same rays in turn, three times over; the best time of each counts, in seconds of this thread's
//! processor time, so that a busy machine disturbs little.
#![allow(clippy::print_stdout)] // a program that prints a table

#[path = "../tests/random/mod.rs"]
mod random;

use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Instant;

use evenlight_render::accel::{Embree, RayKernel, TriangleSoup, Wide};
use evenlight_render::geometry::{Frame, Ray, Vec3};
use evenlight_render::scene::world::WAVE;
use random::Random;

type Outcome<T> = Result<T, Box<dyn Error>>;

const ROUNDS: usize = 3;
const VIEWS: u64 = 16;
const VIEW_SIZE: u32 = 256;
const TILE: u32 = 8;

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("usage: ray_kernels FOLDER_OF_PLY [LIBEMBREE4.so]")?;
    let library = arguments.next();
    let mut mesh = Mesh::default();
    let mut files: Vec<_> =
        fs::read_dir(&folder)?.map(|entry| entry.map(|e| e.path())).collect::<Result<_, _>>()?;
    files.sort();
    for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "ply")) {
        mesh.read_ply(file).map_err(|error| format!("{}: {error}", file.display()))?;
    }
    let soup = TriangleSoup { positions: &mesh.positions, indices: &mesh.indices };
    println!("{folder}: {} triangles", soup.indices.len());

    let mut kernels: Vec<(&str, Box<dyn RayKernel>)> = Vec::new();
    let mut built = |name, build: &mut dyn FnMut() -> Outcome<Box<dyn RayKernel>>| -> Outcome<()> {
        let (wall, start) = (Instant::now(), thread_seconds());
        let kernel = build()?;
        println!(
            "  {name:14} built in {:.2} s ({:.2} s of this thread)",
            wall.elapsed().as_secs_f64(),
            thread_seconds() - start
        );
        kernels.push((name, kernel));
        Ok(())
    };
    built("wide", &mut || Ok(Box::new(Wide::build(&soup))))?;
    if let Some(library) = &library {
        let library = Path::new(library);
        built("embree", &mut || Ok(Box::new(Embree::build(&soup, library)?)))?;
    }
    report(&kernels, &workloads(&soup, kernels[0].1.as_ref()));
    Ok(())
}

/// Rays of one kind, and whether they only ask for occlusion.
struct Workload {
    name: &'static str,
    rays: Vec<Ray>,
    occlusion: bool,
}

impl Workload {
    /// How many of at most [`WAVE`] rays meet anything.
    fn hits(&self, kernel: &dyn RayKernel, rays: &[Ray]) -> usize {
        if self.occlusion {
            let mut occluded = [false; WAVE];
            kernel.occluded_each(rays, &mut occluded[..rays.len()]);
            occluded.iter().filter(|occluded| **occluded).count()
        } else {
            let mut hits = [None; WAVE];
            kernel.closest_each(rays, &mut hits[..rays.len()]);
            hits.iter().flatten().count()
        }
    }
}

fn report(kernels: &[(&str, Box<dyn RayKernel>)], workloads: &[Workload]) {
    println!(
        "  {:10} {:>9}  Mrays/s per kernel; the first kernel relative to each of the others; hits",
        "rays", ""
    );
    for workload in workloads {
        let mut best = vec![f64::INFINITY; kernels.len()];
        let mut hits = vec![0; kernels.len()];
        for _ in 0..ROUNDS {
            for (i, (_, kernel)) in kernels.iter().enumerate() {
                let start = thread_seconds();
                hits[i] = workload.rays.chunks(WAVE).map(|rays| workload.hits(kernel.as_ref(), rays)).sum();
                best[i] = best[i].min(thread_seconds() - start);
            }
        }
        let rates = best.iter().map(|s| format!("{:7.2}", workload.rays.len() as f64 / s * 1e-6));
        let ratios = best[1..].iter().map(|s| format!("{:6.2}×", s / best[0]));
        println!(
            "  {:10} {:>9} {} {} {hits:?}",
            workload.name,
            workload.rays.len(),
            rates.collect::<String>(),
            ratios.collect::<String>()
        );
    }
}

/// The four kinds of rays of a path tracer.
fn workloads(soup: &TriangleSoup, kernel: &dyn RayKernel) -> Vec<Workload> {
    let (mut lower, mut upper) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for &vertex in soup.indices.iter().flatten() {
        let position = Vec3::from_array(soup.positions[vertex as usize]);
        lower = lower.min(position);
        upper = upper.max(position);
    }
    let mut random = Random(1);
    let mut primary = Vec::new();
    for _ in 0..VIEWS {
        // Somewhere in the middle of the scene, looking somewhere.
        let eye = lower + (upper - lower) * (Vec3::splat(0.25) + random.point() * 0.5);
        let frame = Frame::from_normal(random.direction());
        for tile in 0..(VIEW_SIZE / TILE).pow(2) {
            for pixel in 0..TILE * TILE {
                let x = tile % (VIEW_SIZE / TILE) * TILE + pixel % TILE;
                let y = tile / (VIEW_SIZE / TILE) * TILE + pixel / TILE;
                let at = |i: u32| 2.0 * (i as f32 + 0.5) / VIEW_SIZE as f32 - 1.0;
                let direction = frame.to_world(Vec3::new(at(x), at(y), 1.0)).normalize();
                primary.push(Ray { origin: eye, direction, t_max: f32::INFINITY });
            }
        }
    }
    let (mut bounce, mut occlusion, mut scattered) = (Vec::new(), Vec::new(), Vec::new());
    for ray in &primary {
        let anywhere = lower + (upper - lower) * random.point();
        scattered.push(Ray { origin: anywhere, direction: random.direction(), t_max: f32::INFINITY });
        if let Some(hit) = kernel.closest(ray) {
            let [a, b, c] =
                soup.indices[hit.triangle as usize].map(|v| Vec3::from_array(soup.positions[v as usize]));
            let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
            let normal = -normal * normal.dot(ray.direction).signum();
            let origin = ray.origin + ray.direction * hit.t + normal * 1e-4 * (upper - lower).max_element();
            let direction = (normal + random.direction()).normalize_or(normal);
            bounce.push(Ray { origin, direction, t_max: f32::INFINITY });
            occlusion.push(Ray { origin, direction: anywhere - origin, t_max: 1.0 });
        }
    }
    vec![
        Workload { name: "primary", rays: primary, occlusion: false },
        Workload { name: "bounce", rays: bounce, occlusion: false },
        Workload { name: "random", rays: scattered, occlusion: false },
        Workload { name: "occlusion", rays: occlusion, occlusion: true },
    ]
}

/// Processor time of this thread where the system tells (Linux), else wall time.
fn thread_seconds() -> f64 {
    let nanoseconds = fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(wall_seconds, |ns| ns * 1e-9)
}

fn wall_seconds() -> f64 {
    std::time::SystemTime::UNIX_EPOCH.elapsed().map_or(0.0, |t| t.as_secs_f64())
}

/// All meshes in one list.
#[derive(Default)]
struct Mesh {
    positions: Vec<[f32; 3]>,
    indices: Vec<[u32; 3]>,
}

impl Mesh {
    /// Append a binary little-endian PLY file whose vertices are floats (x, y, z first) and whose faces are triangles or
    /// quadrilaterals; that is what the scenes use.
    fn read_ply(&mut self, path: &Path) -> Outcome<()> {
        const END: &[u8] = b"end_header\n";
        let bytes = fs::read(path)?;
        let body = bytes.windows(END.len()).position(|w| w == END).ok_or("no header")? + END.len();
        let header = std::str::from_utf8(&bytes[..body])?;
        if !header.contains("binary_little_endian") {
            return Err("not binary little-endian".into());
        }
        let count = |element: &str| -> Outcome<usize> {
            let line = header.lines().find_map(|line| line.strip_prefix(element)).ok_or("element missing")?;
            Ok(line.trim().parse()?)
        };
        let (vertices, faces) = (count("element vertex ")?, count("element face ")?);
        let stride = 4 * header.lines().filter(|line| line.starts_with("property float")).count();
        let word =
            |at: usize| -> Outcome<[u8; 4]> { Ok(bytes.get(at..at + 4).ok_or("cut short")?.try_into()?) };
        let base = self.positions.len() as u32;
        for vertex in 0..vertices {
            let at = body + vertex * stride;
            let [x, y, z] = [word(at)?, word(at + 4)?, word(at + 8)?].map(f32::from_le_bytes);
            self.positions.push([x, y, z]);
        }
        let mut at = body + vertices * stride;
        for _ in 0..faces {
            let corners = usize::from(*bytes.get(at).ok_or("cut short")?);
            let corner = |i: usize| -> Outcome<u32> { Ok(base + u32::from_le_bytes(word(at + 1 + 4 * i)?)) };
            for i in 2..corners {
                self.indices.push([corner(0)?, corner(i - 1)?, corner(i)?]);
            }
            at += 1 + 4 * corners;
        }
        Ok(())
    }
}
