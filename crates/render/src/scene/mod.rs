//! Scenes: from a file to plain data to something a ray can meet.

use std::path::PathBuf;
use std::sync::Arc;

use crate::Result;
use crate::accel::KernelChoice;
use crate::emitter::selection::Selection;
use crate::emitter::{Aim, Emitter, EmitterHit, LightSample};
use crate::film::FilmSettings;
use crate::geometry::{Ray, Rgb, Vec3};
use crate::integrator::Transport;
use crate::sampler::BounceNumbers;
use crate::scene::node::Node;
use crate::scene::world::{Hit, World};
use crate::sensor::Sensor;

mod analytic;
mod assemble;
pub mod build;
pub mod folder;
pub mod materials;
pub mod mesh;
pub mod mitsuba;
pub mod node;
pub mod properties;
pub mod spectrum;
pub mod world;

/// How to read a scene.
#[derive(Clone, Debug, Default)]
pub struct SceneOptions {
    /// Unknown plugins and parameters become warnings.
    pub lenient: bool,
    /// Which ray kernel to build.
    pub kernel: KernelChoice,
    /// The Embree 4 shared library, where there is one.
    pub embree_library: Option<PathBuf>,
}

/// A scene, ready to be rendered.
pub struct Scene {
    /// Its geometry.
    pub world: World,
    /// Its lights.
    pub emitters: Vec<Arc<dyn Emitter>>,
    /// The lights that rays meet when they leave the scene.
    pub(crate) environments: Vec<Environment>,
    pub(crate) selection: Selection,
    /// What its file says of light transport.
    pub transport: Transport,
    /// What its file says of the image.
    pub film: FilmSettings,
    /// What was found wrong and replaced, when loaded leniently.
    pub warnings: Vec<String>,
    sensor: Arc<Node>,
}

/// A light at infinity.
pub(crate) struct Environment {
    emitter: Arc<dyn Emitter>,
    probability: f32,
}

/// A light that was chosen, and where on it.
#[derive(Clone, Copy)]
pub(crate) struct LightAim {
    emitter: usize,
    probability: f32,
    aim: Aim,
}

/// A light met by a ray.
pub(crate) struct Seen {
    pub(crate) radiance: Rgb,
    /// Density with which next-event estimation samples the ray's direction.
    pub(crate) density: f32,
}

impl Environment {
    /// What a ray that leaves the scene sees.
    #[inline]
    pub(crate) fn seen(&self, direction: Vec3) -> Seen {
        let hit = EmitterHit { position: Vec3::ZERO, normal: Vec3::ZERO, uv: glam::Vec2::ZERO, direction };
        let (radiance, density) = self.emitter.evaluate(Vec3::ZERO, &hit);
        Seen { radiance, density: density * self.probability }
    }
}

impl Scene {
    /// The camera, for a film of this width over height.
    pub fn sensor(&self, aspect: f64) -> Result<Arc<dyn Sensor>> {
        assemble::sensor(&self.sensor, aspect)
    }

    /// The number of the light that a hit shape is, and the hit as that light sees it.
    #[inline]
    pub fn emitter_hit(&self, ray: &Ray, hit: &Hit) -> Option<(usize, EmitterHit)> {
        self.world.emitter_hit(ray, hit).map(|(emitter, hit)| (emitter as usize, hit))
    }

    /// The light that a ray ran into, if the shape is one and shines that way; `from` is where the ray was made.
    #[inline]
    pub(crate) fn emitter_seen(&self, ray: &Ray, hit: &Hit, from: Vec3) -> Option<Seen> {
        let (emitter, hit) = self.emitter_hit(ray, hit)?;
        let light = &self.emitters[emitter];
        let radiance = light.radiance(&hit);
        (radiance != Rgb::ZERO).then(|| Seen {
            radiance,
            density: light.density(from, &hit) * self.selection.probability(emitter),
        })
    }

    /// Choose a light, and where on it to sample: all that needs no receiver, up to [`Scene::aim_closer`].
    #[inline]
    pub(crate) fn aim(&self, numbers: &BounceNumbers) -> Option<LightAim> {
        let (emitter, probability) = self.selection.sample(numbers.light_choice)?;
        let u = numbers.light;
        // only environments do anything here
        let aim = if self.environments.is_empty() { Aim::at(u) } else { self.emitters[emitter].aim(u) };
        Some(LightAim { emitter, probability, aim })
    }

    /// The second step of [`Scene::aim`], of a whole wave: other work in between gives the memory time.
    #[inline]
    pub(crate) fn aim_closer(&self, chosen: &mut [Option<LightAim>]) {
        if !self.environments.is_empty() {
            for LightAim { emitter, aim, .. } in chosen.iter_mut().flatten() {
                self.emitters[*emitter].aim_closer(aim);
            }
        }
    }

    /// A direction towards the chosen light.
    #[inline]
    pub(crate) fn sample_light(&self, from: Vec3, chosen: &LightAim) -> Option<LightSample> {
        let LightAim { emitter, probability, aim } = *chosen;
        let light = self.emitters[emitter].sample(from, aim)?;
        Some(if light.delta {
            LightSample { radiance: light.radiance / probability, ..light }
        } else {
            LightSample { density: light.density * probability, ..light }
        })
    }
}
