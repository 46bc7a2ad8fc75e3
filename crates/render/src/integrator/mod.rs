//! Light transport: from a camera ray to radiance.

use crate::geometry::{Ray, Rgb, Vec3};
use crate::sampler::PathNumbers;
use crate::scene::Scene;
use crate::{Error, Result};

pub mod path;
mod roulette;

pub use roulette::{Roulette, Survival};

/// One integrator of the registry.
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// Make it ready.
    pub build: fn(Transport) -> Box<dyn Integrator>,
}

/// The integrators there are.
pub static ALL: &[Entry] = &[path::ENTRY];

/// An integrator by name.
pub fn by_name(name: &str) -> Result<&'static Entry> {
    ALL.iter().find(|entry| entry.name == name).ok_or_else(|| {
        let known = ALL.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ");
        Error::Settings(format!("unknown integrator '{name}'; known: {known}"))
    })
}

/// How the samples of several techniques are weighted (Veach & Guibas 1995).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mis {
    /// In proportion to density.
    Balance,
    /// In proportion to squared density.
    #[default]
    Power,
}

impl Mis {
    /// All heuristics with their names.
    pub const ALL: [(&'static str, Self); 2] = [("balance", Self::Balance), ("power", Self::Power)];

    /// A heuristic by name.
    pub fn by_name(name: &str) -> Result<Self> {
        Self::ALL
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, mis)| *mis)
            .ok_or_else(|| Error::Settings(format!("unknown MIS heuristic '{name}'; known: balance, power")))
    }

    /// The weight of a sample drawn with density `drawn`, when another technique draws it with density `other`.
    #[inline]
    pub fn weight(self, drawn: f32, other: f32) -> f32 {
        match self {
            Self::Balance => drawn / (drawn + other),
            Self::Power => {
                let ratio = other / drawn;
                1.0 / (1.0 + ratio * ratio)
            }
        }
    }
}

/// The settings that all light transport shares; defaults are Mitsuba's.
#[derive(Clone, Debug)]
pub struct Transport {
    /// The longest path, in edges: 1 is light seen directly, 2 is direct illumination.
    pub max_depth: u32,
    /// Roulette in proportion to throughput begins at this depth.
    pub rr_depth: u32,
    /// When paths end by chance.
    pub roulette: Roulette,
    /// Lights are not seen by the camera.
    pub hide_emitters: bool,
    /// How techniques are combined.
    pub mis: Mis,
}

/// What a camera ray brings home.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measurement {
    /// Radiance.
    pub radiance: Rgb,
    /// Albedo of the first surface.
    pub albedo: Rgb,
    /// Shading normal of the first surface.
    pub normal: Vec3,
    /// Distance to the first surface; 0 where there is none.
    pub depth: f32,
}

/// A light path from the camera: where it begins, the numbers that drive it, and what it brings home.
pub struct CameraPath {
    /// The camera ray.
    pub ray: Ray,
    /// What every choice along the path is made with.
    pub numbers: PathNumbers,
    /// The result.
    pub measurement: Measurement,
}

/// What an integrator shows after each segment of the paths of a wave.
pub struct Step<'a> {
    /// All paths of the wave, with what they have measured so far. The radiance may be taken away.
    pub paths: &'a mut [CameraPath],
    /// Rays that found the ends of the segments: as many as there are paths that got so far.
    pub rays: usize,
    /// Rays from there to lights that were sampled.
    pub shadow_rays: usize,
}

/// A way to solve the light transport equation from the camera.
pub trait Integrator: Send + Sync {
    /// Estimate what each of at most [`WAVE`](crate::scene::world::WAVE) camera rays measures: independent of each other, but
    /// together they wait for memory less.
    fn measure(&self, scene: &Scene, paths: &mut [CameraPath]) {
        self.measure_steps(scene, paths, &mut |_| {});
    }

    /// The same, shown to `watch` after each segment.
    fn measure_steps(&self, scene: &Scene, paths: &mut [CameraPath], watch: &mut dyn FnMut(Step<'_>));
}
