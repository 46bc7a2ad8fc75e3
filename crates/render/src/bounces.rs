//! What each bounce contributes and costs, measured without roulette: what a choice of survival probabilities needs.
//!
//! A path without roulette is a sum `Y = D_1 + D_2 + …` over its segments: `D_l` is what the path gathers at the end of segment `l`, the
//! light that it ran into there and the light that was sampled from there. With independent roulette that lets a path reach segment `l`
//! with probability `S_l`, the estimate `Σ D_l / S_l` has the second moment `Σ (E T_l² - E T_(l+1)²) / S_l`, where `T_l = D_l + D_(l+1) + …` is
//! the tail (Rhee & Glynn 2015, "Unbiased Estimation with Square Root Convergence for SDE Models", theorem 1), and costs
//! `Σ S_l` times the rays of segment `l`.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::film::Tile;
use crate::geometry::{Rgb, luminance};
use crate::integrator::{Roulette, Step};
use crate::render::{Job, Settings, Wave, tiles};
use crate::scene::Scene;
use crate::workers::{News, in_order};
use crate::{Error, Result};

/// The most segments.
pub const MOST_SEGMENTS: u32 = 1024;

/// The most colors of all images together: 1.5 GiB.
const MOST_COLORS: u64 = 1 << 27;

/// Means over all paths of an image, one number for each segment, in luminance.
#[derive(Clone, Debug, Default)]
pub struct Bounces {
    /// Width and height of the image.
    pub size: [u32; 2],
    /// Of the contribution.
    pub mean: Vec<f64>,
    /// Of the squared contribution.
    pub mean_square: Vec<f64>,
    /// Of the squared sum of this contribution and all further ones.
    pub tail_mean_square: Vec<f64>,
    /// The share of the paths that have such a segment.
    pub alive: Vec<f64>,
    /// Rays per path of the image: those of the segment, and those to the lights that are sampled at its end.
    pub rays: Vec<f64>,
    /// The mean contribution to every pixel: segment after segment, row after row; empty unless asked for.
    pub images: Vec<[f32; 3]>,
}

/// Sums over the paths of a tile.
struct TileSums {
    segments: Vec<Sums>,
    /// Of each segment and pixel; empty unless asked for.
    pixels: Vec<[f64; 3]>,
}

#[derive(Clone, Copy, Default)]
struct Sums {
    contribution: f64,
    square: f64,
    tail_square: f64,
    alive: u64,
    rays: u64,
}

/// Measure the bounces of a scene. Roulette is off, replicates are not used, and `max_depth` must be given. `go_on` is asked about
/// ten times a second, on the caller's thread, and told the share of the work that is done; when it says no, there is no result.
pub fn measure(
    scene: &Scene,
    settings: &Settings,
    images: bool,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Option<Bounces>> {
    let segments = match settings.max_depth {
        Some(depth) if (1..=MOST_SEGMENTS).contains(&depth) => depth as usize,
        _ => {
            return Err(Error::Settings(format!(
                "max_depth must be 1 to {MOST_SEGMENTS} to measure bounces"
            )));
        }
    };
    let settings = Settings { replicates: 1, roulette: Roulette::Never, ..settings.clone() };
    let job = Job::new(scene, &settings)?;
    let [_, _, width, height] = job.film.crop;
    let colors = if images { segments as u64 * u64::from(width) * u64::from(height) } else { 0 };
    if colors > MOST_COLORS {
        let message = format!(
            "{segments} images of {width}x{height} pixels are too large; max_depth × width × height up to {MOST_COLORS} is allowed"
        );
        return Err(Error::Settings(message));
    }
    let tiles = tiles(width, height, 1);
    let mut bounces = Bounces::new([width, height], segments, colors as usize);
    let stop = AtomicBool::new(false);
    let mut done = 0;
    let measure_tile = |number: usize| job.measure_tile(&tiles[number], segments, images, &stop);
    in_order(tiles.len(), settings.threads, &stop, measure_tile, &mut |news| match news {
        News::Done(number, sums) => {
            bounces.add(&tiles[number], &sums, settings.spp);
            done += 1;
        }
        News::Time => stop.store(!go_on(done as f64 / tiles.len() as f64), Ordering::Relaxed),
    });
    let complete = done == tiles.len();
    Ok(complete.then(|| bounces.divided_by(f64::from(width) * f64::from(height) * f64::from(settings.spp))))
}

impl Bounces {
    fn new(size: [u32; 2], segments: usize, colors: usize) -> Self {
        let zeros = || vec![0.0; segments];
        Self {
            size,
            mean: zeros(),
            mean_square: zeros(),
            tail_mean_square: zeros(),
            alive: zeros(),
            rays: zeros(),
            images: vec![[0.0; 3]; colors],
        }
    }

    /// Add the sums of a tile. Tiles come in order, so that rounding does not depend on threads.
    fn add(&mut self, tile: &Tile, sums: &TileSums, spp: u32) {
        for (l, segment) in sums.segments.iter().enumerate() {
            self.mean[l] += segment.contribution;
            self.mean_square[l] += segment.square;
            self.tail_mean_square[l] += segment.tail_square;
            self.alive[l] += segment.alive as f64;
            self.rays[l] += segment.rays as f64;
        }
        let [width, height] = self.size.map(|n| n as usize);
        let rows = sums.pixels.chunks_exact(tile.width as usize);
        for (number, row) in rows.enumerate() {
            let (segment, y) = (number / tile.height as usize, number % tile.height as usize);
            let start = (segment * height + tile.y as usize + y) * width + tile.x as usize;
            for (mean, sum) in self.images[start..].iter_mut().zip(row) {
                *mean = sum.map(|sum| (sum / f64::from(spp)) as f32);
            }
        }
    }

    /// From sums over so many paths to means.
    fn divided_by(mut self, paths: f64) -> Self {
        let means = [
            &mut self.mean,
            &mut self.mean_square,
            &mut self.tail_mean_square,
            &mut self.alive,
            &mut self.rays,
        ];
        means.into_iter().flatten().for_each(|sum| *sum /= paths);
        self
    }
}

impl Job<'_> {
    /// The sums of a tile; `None` when told to stop.
    fn measure_tile(
        &self,
        tile: &Tile,
        segments: usize,
        images: bool,
        stop: &AtomicBool,
    ) -> Option<TileSums> {
        let pixels = (tile.width * tile.height) as usize;
        let mut sums = TileSums {
            segments: vec![Sums::default(); segments],
            pixels: vec![[0.0; 3]; if images { segments * pixels } else { 0 }],
        };
        self.each_wave(tile, stop, |wave| sums.measure(self, wave, pixels))?;
        Some(sums)
    }
}

impl TileSums {
    /// Measure the paths of a wave segment by segment.
    fn measure(&mut self, job: &Job<'_>, wave: &mut Wave, pixels: usize) {
        let mut gathered: Vec<Vec<Rgb>> = Vec::new();
        let places = &wave.places;
        job.integrator.measure_steps(job.scene, &mut wave.paths, &mut |Step { paths, rays, shadow_rays }| {
            let segment = &mut self.segments[gathered.len()];
            segment.alive += rays as u64;
            segment.rays += (rays + shadow_rays) as u64;
            // taken away, so that nothing is lost to the rounding of a sum
            let new =
                |path: &mut crate::integrator::CameraPath| std::mem::take(&mut path.measurement.radiance);
            gathered.push(
                paths.iter_mut().map(new).zip(places).map(|(new, (_, weight))| new * *weight).collect(),
            );
        });
        for (path, (pixel, _)) in places.iter().enumerate() {
            let mut tail = 0.0;
            for (l, contributions) in gathered.iter().enumerate().rev() {
                let contribution = f64::from(luminance(contributions[path]));
                tail += contribution;
                let segment = &mut self.segments[l];
                segment.contribution += contribution;
                segment.square += contribution * contribution;
                segment.tail_square += tail * tail;
                if let Some(sum) = self.pixels.get_mut(l * pixels + pixel) {
                    *sum = std::array::from_fn(|c| sum[c] + f64::from(contributions[path][c]));
                }
            }
        }
    }
}
