//! Sources of light: sample a direction towards them, evaluate and density always together.
//!
//! Plugin names, parameters and defaults are those of Mitsuba 3.

use crate::geometry::{Rgb, Vec2, Vec3};
use crate::scene::build::Entry;

pub mod area;
pub mod constant;
pub mod directional;
pub mod envmap;
mod placement;
pub mod point;
pub mod selection;
mod sky;
pub mod spot;

/// The sources of light that stand alone in a scene (`area` belongs to a shape).
pub static ALL: &[Entry<dyn Emitter>] =
    &[constant::ENTRY, directional::ENTRY, envmap::ENTRY, point::ENTRY, spot::ENTRY];

/// Where on a light a sample will be taken.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Which part of the light, and which part of that.
    pub part: [u32; 2],
    /// A point of the unit square that stands for the part.
    pub u: [f32; 2],
}

impl Aim {
    /// At a light that is in one part.
    #[inline]
    pub fn at(u: [f32; 2]) -> Self {
        Self { part: [0; 2], u }
    }
}

/// Light towards a receiver, from one sampled direction.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// Unit direction from the receiver to the light.
    pub direction: Vec3,
    /// How far; infinite for environments.
    pub distance: f32,
    /// Radiance arriving, were there no obstacle; for delta lights with their falloff.
    pub radiance: Rgb,
    /// Solid-angle density of the direction; 1 for delta lights.
    pub density: f32,
    /// Whether the light is a delta function of direction or position.
    pub delta: bool,
}

/// Where a ray met a light.
#[derive(Clone, Copy, Debug)]
pub struct EmitterHit {
    /// The point on the light; meaningless for environments.
    pub position: Vec3,
    /// The unit normal that emission is tied to; meaningless for environments.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Unit direction from the receiver to the light.
    pub direction: Vec3,
}

/// A sphere around the scene.
#[derive(Clone, Copy, Debug)]
pub struct SceneSphere {
    /// Its center.
    pub center: Vec3,
    /// Its radius; positive.
    pub radius: f32,
}

/// A source of light.
pub trait Emitter: Send + Sync {
    /// The part of sampling that needs no receiver: `u` is a point of the unit square. What [`Emitter::aim_closer`] will need is
    /// fetched from memory meanwhile.
    #[inline]
    fn aim(&self, u: [f32; 2]) -> Aim {
        Aim::at(u)
    }

    /// The rest of it; what [`Emitter::sample`] will need is fetched from memory meanwhile.
    #[inline]
    fn aim_closer(&self, _: &mut Aim) {}

    /// Sample a direction from the receiver `from`, as aimed by [`Emitter::aim`] and [`Emitter::aim_closer`].
    fn sample(&self, from: Vec3, aim: Aim) -> Option<LightSample>;

    /// Radiance leaving the hit against `hit.direction`; none from delta lights, which are never hit.
    fn radiance(&self, _hit: &EmitterHit) -> Rgb {
        Rgb::ZERO
    }

    /// Solid-angle density of [`Emitter::sample`] at the hit; 0 for delta lights.
    fn density(&self, _from: Vec3, _hit: &EmitterHit) -> f32 {
        0.0
    }

    /// [`Emitter::radiance`] and [`Emitter::density`] together.
    #[inline]
    fn evaluate(&self, from: Vec3, hit: &EmitterHit) -> (Rgb, f32) {
        (self.radiance(hit), self.density(from, hit))
    }

    /// Emitted power, roughly (luminance): how often the light is chosen.
    fn power(&self, scene: &SceneSphere) -> f32;

    /// Whether rays that leave the scene meet this light.
    fn is_environment(&self) -> bool {
        false
    }
}
