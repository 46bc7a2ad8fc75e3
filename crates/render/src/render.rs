//! The render loop that all camera-path integrators share: tiles × replicates, on any number of threads, with the same bits.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use evenlight_points::Seed;

use crate::film::{Film, FilmSettings, PixelMean, Tile};
use crate::geometry::{Rgb, Vec3};
use crate::integrator::{self, CameraPath, Integrator, Measurement, Mis, Transport};
use crate::sampler::{self, PathNumbers};
use crate::scene::Scene;
use crate::scene::world::WAVE;
use crate::sensor::Sensor;
use crate::{Error, Result};

/// Side of a tile in pixels.
const TILE: u32 = 16;

/// How long the caller is not asked again whether to go on.
const PATIENCE: Duration = Duration::from_millis(100);

/// Plain settings of a render.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Name of the integrator.
    pub integrator: String,
    /// Name of the sampler.
    pub sampler: String,
    /// Samples per pixel, over all replicates; a multiple of `replicates`.
    pub spp: u32,
    /// Independent randomizations.
    pub replicates: u32,
    /// The seed of everything.
    pub seed: u64,
    /// Worker threads; 0 for one per core.
    pub threads: usize,
    /// The longest path; `None` as the scene says.
    pub max_depth: Option<u32>,
    /// Name of the pixel filter, with its default parameters; `None` as the scene says.
    pub filter: Option<String>,
    /// Width and height; `None` as the scene says.
    pub size: Option<[u32; 2]>,
    /// How scattering and light sampling are combined.
    pub mis: Mis,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            integrator: "path".into(),
            sampler: "sobol".into(),
            spp: 64,
            replicates: 4,
            seed: 0,
            threads: 0,
            max_depth: None,
            filter: None,
            size: None,
            mis: Mis::default(),
        }
    }
}

/// How far a render has come.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Samples taken.
    pub samples: u64,
    /// Samples there will be.
    pub total: u64,
    /// The film so far.
    pub film: &'a Film,
}

impl std::fmt::Debug for Film {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Film({}x{}, {} replicates)", self.width, self.height, self.replicates)
    }
}

/// Everything that a pixel needs, checked and built.
struct Job<'a> {
    scene: &'a Scene,
    film: FilmSettings,
    sensor: std::sync::Arc<dyn Sensor>,
    integrator: Box<dyn Integrator>,
    sampler: &'static sampler::Entry,
    seed: Seed,
    samples: u32,
}

/// Render a scene. `go_on` is asked about ten times a second, on the caller's thread; when it says no, the film comes back as it is,
/// with some replicates of some pixels incomplete.
pub fn render(
    scene: &Scene,
    settings: &Settings,
    go_on: &mut dyn FnMut(Progress<'_>) -> bool,
) -> Result<Film> {
    let job = Job::new(scene, settings)?;
    let [_, _, width, height] = job.film.crop;
    let mut film = Film::new(width, height, settings.replicates)?;
    let tiles = tiles(width, height, settings.replicates);
    let total = u64::from(width) * u64::from(height) * u64::from(settings.spp);
    let threads = match settings.threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        threads => threads,
    };

    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let samples = AtomicU64::new(0);
    std::thread::scope(|scope| {
        let (sender, finished) = mpsc::channel();
        for _ in 0..threads.min(tiles.len()) {
            let sender = sender.clone();
            scope.spawn(|| {
                let sender = sender;
                while let Some((number, tile)) = take(&tiles, &next, &stop) {
                    if let Some(means) = job.render_tile(tile, &stop) {
                        samples.fetch_add(means.len() as u64 * u64::from(job.samples), Ordering::Relaxed);
                        // the receiver only goes away when nobody wants the tile any more
                        let _ = sender.send((number, means));
                    }
                }
            });
        }
        drop(sender);
        // Tiles are merged in order, so that sums do not depend on who was faster.
        let mut waiting = BTreeMap::new();
        let mut merged = 0;
        let mut asked = Instant::now();
        loop {
            match finished.recv_timeout(PATIENCE.saturating_sub(asked.elapsed())) {
                Ok((number, means)) => drop(waiting.insert(number, means)),
                Err(mpsc::RecvTimeoutError::Timeout) => {}
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
            }
            // also when tiles come in one after the other
            if asked.elapsed() >= PATIENCE {
                let progress = Progress { samples: samples.load(Ordering::Relaxed), total, film: &film };
                if !go_on(progress) {
                    stop.store(true, Ordering::Relaxed);
                }
                asked = Instant::now();
            }
            while let Some(means) = waiting.remove(&merged) {
                film.merge(&tiles[merged], &means);
                merged += 1;
            }
        }
    });
    go_on(Progress { samples: samples.into_inner(), total, film: &film });
    Ok(film)
}

fn take<'a>(tiles: &'a [Tile], next: &AtomicUsize, stop: &AtomicBool) -> Option<(usize, &'a Tile)> {
    if stop.load(Ordering::Relaxed) {
        return None;
    }
    let number = next.fetch_add(1, Ordering::Relaxed);
    tiles.get(number).map(|tile| (number, tile))
}

/// All tiles of all replicates, one replicate after the other: an interrupted render has whole replicates.
fn tiles(width: u32, height: u32, replicates: u32) -> Vec<Tile> {
    let starts = |length: u32| (0..length).step_by(TILE as usize);
    let tile =
        |replicate, x, y| Tile { replicate, x, y, width: TILE.min(width - x), height: TILE.min(height - y) };
    (0..replicates)
        .flat_map(|r| starts(height).flat_map(move |y| starts(width).map(move |x| tile(r, x, y))))
        .collect()
}

impl<'a> Job<'a> {
    fn new(scene: &'a Scene, settings: &Settings) -> Result<Self> {
        let Settings { spp, replicates, .. } = *settings;
        if replicates == 0 || spp == 0 {
            return Err(Error::Settings("spp and replicates must be at least 1".into()));
        }
        if spp % replicates != 0 {
            let message = format!("spp ({spp}) must be a multiple of replicates ({replicates})");
            return Err(Error::Settings(message));
        }
        let mut film = scene.film.clone();
        if let Some(size) = settings.size {
            film = film.resized(size)?;
        }
        if let Some(filter) = &settings.filter {
            film.filter = crate::filter::Filter::by_name(filter)?;
        }
        let transport = Transport {
            max_depth: settings.max_depth.unwrap_or(scene.transport.max_depth),
            mis: settings.mis,
            ..scene.transport
        };
        let (sampler, samples) = (sampler::by_name(&settings.sampler)?, spp / replicates);
        sampler.check(film.size, samples)?;
        Ok(Self {
            scene,
            sensor: scene.sensor(film.aspect())?,
            film,
            integrator: (integrator::by_name(&settings.integrator)?.build)(transport),
            sampler,
            seed: Seed::new(settings.seed),
            samples,
        })
    }

    /// The means of a tile's pixels; `None` when told to stop.
    fn render_tile(&self, tile: &Tile, stop: &AtomicBool) -> Option<Vec<PixelMean>> {
        let mut wave = Wave::new((tile.width * tile.height) as usize);
        let seed = self.seed.replicate(tile.replicate.into());
        for pixel in 0..wave.sums.len() {
            let x = self.film.crop[0] + tile.x + pixel as u32 % tile.width;
            let y = self.film.crop[1] + tile.y + pixel as u32 / tile.width;
            let (key, first) = self.sampler.pixel(seed, [x, y], self.samples);
            for index in 0..self.samples {
                let (path, weight) = self.camera_path([x, y], key, first + index);
                wave.paths.push(path);
                wave.places.push((pixel, weight));
                if wave.paths.len() == WAVE {
                    if stop.load(Ordering::Relaxed) {
                        return None;
                    }
                    wave.measure(self);
                }
            }
        }
        wave.measure(self);
        Some(wave.sums.iter().map(|sum| sum.mean(self.samples)).collect())
    }

    /// The path of one sample of a pixel, and the weight of the sample.
    #[inline]
    fn camera_path(&self, [x, y]: [u32; 2], seed: Seed, index: u32) -> (CameraPath, f32) {
        let mut numbers = PathNumbers::new(self.sampler, seed);
        numbers.start(index);
        let camera = numbers.camera();
        let (dx, weight_x) = self.film.filter.sample(camera.film[0]);
        let (dy, weight_y) = self.film.filter.sample(camera.film[1]);
        let [width, height] = self.film.size.map(|n| n as f32);
        let film = [(x as f32 + 0.5 + dx) / width, (y as f32 + 0.5 + dy) / height];
        let ray = self.sensor.ray(film, camera.lens);
        (CameraPath { ray, numbers, measurement: Measurement::default() }, weight_x * weight_y)
    }
}

/// Samples of a tile that are measured together, whichever pixels they belong to.
struct Wave {
    paths: Vec<CameraPath>,
    /// Pixel and weight of each path.
    places: Vec<(usize, f32)>,
    /// Of all pixels of the tile.
    sums: Vec<PixelSum>,
}

impl Wave {
    fn new(pixels: usize) -> Self {
        Self {
            paths: Vec::with_capacity(WAVE),
            places: Vec::with_capacity(WAVE),
            sums: vec![PixelSum::default(); pixels],
        }
    }

    /// Measure what has come together, and begin anew.
    fn measure(&mut self, job: &Job<'_>) {
        job.integrator.measure(job.scene, &mut self.paths);
        for (path, (pixel, weight)) in self.paths.iter().zip(&self.places) {
            self.sums[*pixel].add(&path.measurement, *weight);
        }
        self.paths.clear();
        self.places.clear();
    }
}

/// What the samples of a pixel add up to, in the order of their indices.
#[derive(Clone, Copy, Default)]
struct PixelSum {
    color: [f64; 3],
    first: Measurement,
    hits: f32,
}

impl PixelSum {
    fn add(&mut self, measured: &Measurement, weight: f32) {
        let radiance = measured.radiance * weight;
        for (sum, value) in self.color.iter_mut().zip(radiance.to_array()) {
            *sum += f64::from(value);
        }
        self.first.albedo += measured.albedo;
        self.first.normal += measured.normal;
        self.first.depth += measured.depth;
        self.hits += f32::from(u8::from(measured.depth > 0.0));
    }

    fn mean(&self, samples: u32) -> PixelMean {
        PixelMean {
            radiance: Rgb::from_array(self.color.map(|sum| (sum / f64::from(samples)) as f32)),
            albedo: self.first.albedo / samples as f32,
            normal: Vec3::normalize_or_zero(self.first.normal),
            depth: self.first.depth / self.hits.max(1.0),
        }
    }
}
