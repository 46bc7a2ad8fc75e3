//! `path`: unidirectional path tracing with next-event estimation.
//!
//! At every surface one light is sampled and one direction is scattered, and the two ways to reach a light are combined by multiple
//! importance sampling (Kajiya 1986, "The Rendering Equation"; Veach & Guibas 1995, "Optimally Combining Sampling Techniques
//! for Monte Carlo Rendering"). Choose it by default; caustics from small lights need another integrator.
//!
//! Paths advance in a wave, all by one surface at a time: what one waits for in memory is fetched while the others compute.

use crate::geometry::{Ray, Rgb, Vec3};
use crate::integrator::{CameraPath, Entry, Integrator, Step, Transport};
use crate::sampler::BounceNumbers;
use crate::scene::world::{Hit, Vertex};
use crate::scene::{LightAim, Scene, Seen};

pub(crate) const ENTRY: Entry = Entry {
    name: "path",
    cite: "Kajiya 1986, The Rendering Equation, SIGGRAPH; Veach & Guibas 1995",
    build: |transport| Box::new(Path(transport)),
};

struct Path(Transport);

impl Integrator for Path {
    fn measure_steps(&self, scene: &Scene, paths: &mut [CameraPath], watch: &mut dyn FnMut(Step<'_>)) {
        let mut wave = Wave::new(scene, &self.0, paths);
        while wave.depth < self.0.max_depth && !wave.walks.is_empty() {
            wave.draw_numbers();
            wave.trace();
            let rays = wave.rays.len();
            wave.scatter();
            let shadow_rays = wave.connect();
            watch(Step { paths: &mut *wave.paths, rays, shadow_rays });
            wave.depth += 1;
        }
    }
}

/// A path that has not ended.
#[derive(Clone, Copy)]
struct Walk {
    /// Which of the wave's camera paths it is.
    number: usize,
    throughput: Rgb,
    eta: f32,
    /// Where its ray was made.
    origin: Vec3,
    /// Solid-angle density of the ray's direction; infinite for a delta lobe or the camera.
    density: f32,
}

/// Light that a camera path gets unless something is in its way.
struct Connection {
    number: usize,
    radiance: Rgb,
}

/// Paths that advance together. Vectors of walks, rays, chosen numbers and hits run in parallel.
struct Wave<'a> {
    scene: &'a Scene,
    transport: &'a Transport,
    paths: &'a mut [CameraPath],
    /// Surfaces behind all walks.
    depth: u32,
    walks: Vec<Walk>,
    rays: Vec<Ray>,
    chosen: Vec<BounceNumbers>,
    /// What the next-event estimation of each walk will sample, if there are lights.
    aims: Vec<Option<LightAim>>,
    hits: Vec<Option<Hit>>,
    connections: Vec<Connection>,
    shadow_rays: Vec<Ray>,
    occluded: Vec<bool>,
}

impl<'a> Wave<'a> {
    fn new(scene: &'a Scene, transport: &'a Transport, paths: &'a mut [CameraPath]) -> Self {
        let rays: Vec<Ray> = paths.iter().map(|path| path.ray).collect();
        let walk = |(number, ray): (usize, &Ray)| Walk {
            number,
            throughput: Rgb::ONE,
            eta: 1.0,
            origin: ray.origin,
            density: f32::INFINITY,
        };
        let walks: Vec<Walk> = rays.iter().enumerate().map(walk).collect();
        let count = walks.len();
        Self {
            scene,
            transport,
            paths,
            depth: 0,
            walks,
            rays,
            chosen: Vec::with_capacity(count),
            aims: Vec::with_capacity(count),
            hits: Vec::with_capacity(count),
            connections: Vec::with_capacity(count),
            shadow_rays: Vec::with_capacity(count),
            occluded: Vec::with_capacity(count),
        }
    }

    /// The numbers of the next surface of each walk, and what does not depend on the surface.
    fn draw_numbers(&mut self) {
        self.chosen.clear();
        self.aims.clear();
        for walk in &self.walks {
            let chosen = self.paths[walk.number].numbers.bounce(self.depth);
            self.aims.push(self.scene.aim(&chosen));
            self.chosen.push(chosen);
        }
        self.scene.aim_closer(&mut self.aims);
    }

    /// Whether lights must not be seen now.
    fn lights_hidden(&self) -> bool {
        self.depth == 0 && self.transport.hide_emitters
    }

    /// The next surface of each walk.
    fn trace(&mut self) {
        self.hits.resize(self.rays.len(), None);
        if self.lights_hidden() {
            for (hit, ray) in self.hits.iter_mut().zip(&mut self.rays) {
                *hit = self.scene.world.first_dark(ray);
            }
        } else {
            self.scene.world.intersect_each(&self.rays, &mut self.hits);
        }
    }

    /// Let each walk meet its surface, and close ranks after those that end there.
    fn scatter(&mut self) {
        let mut going_on = 0;
        for i in 0..self.walks.len() {
            going_on += usize::from(self.advance(i, going_on).is_some());
        }
        self.walks.truncate(going_on);
        self.rays.truncate(going_on);
    }

    /// One walk at its surface; `None` when it ends there, else it goes on in another place, not after its own.
    #[inline]
    fn advance(&mut self, i: usize, place: usize) -> Option<()> {
        let (mut walk, ray, hit, chosen) = (self.walks[i], self.rays[i], self.hits[i], self.chosen[i]);
        if !self.lights_hidden() {
            let emission = walk.throughput * self.emission(&walk, &ray, hit.as_ref());
            self.paths[walk.number].measurement.radiance += emission;
        }
        let hit = hit?;
        let vertex = self.scene.world.vertex(&ray, &hit);
        if self.depth == 0 {
            let measurement = &mut self.paths[walk.number].measurement;
            measurement.albedo = vertex.bsdf.albedo(&vertex.surface);
            measurement.normal = vertex.surface.shading.n;
            measurement.depth = hit.t;
        }
        if self.depth + 1 >= self.transport.max_depth {
            return None;
        }

        // Next-event estimation.
        if vertex.smooth {
            self.light_directly(&walk, &vertex, i);
        }

        // Scatter.
        let scattered = vertex.bsdf.sample(&vertex.surface, vertex.wo, chosen.lobe, chosen.bsdf)?;
        walk.throughput *= scattered.weight;
        walk.eta *= scattered.eta;
        walk.origin = vertex.surface.position;
        walk.density = if scattered.delta { f32::INFINITY } else { scattered.density };
        let direction = vertex.surface.shading.to_world(scattered.wi);

        // Russian roulette, on what the path can still bring home.
        let largest = walk.throughput.max_element();
        if largest == 0.0 {
            return None;
        }
        let Transport { roulette, rr_depth, .. } = self.transport;
        let survival = roulette.survival(self.depth + 1, *rr_depth, largest * walk.eta * walk.eta);
        if survival < 1.0 {
            if chosen.roulette >= survival {
                return None;
            }
            walk.throughput /= survival;
        }
        self.walks[place] = walk;
        self.rays[place] = vertex.ray(direction, f32::INFINITY);
        Some(())
    }

    /// Light that the ray ran into, weighted against next-event estimation.
    #[inline]
    fn emission(&self, walk: &Walk, ray: &Ray, hit: Option<&Hit>) -> Rgb {
        let weighted = |Seen { radiance, density }: Seen| {
            if walk.density == f32::INFINITY {
                radiance
            } else {
                radiance * self.transport.mis.weight(walk.density, density)
            }
        };
        match hit {
            Some(hit) => self.scene.emitter_seen(ray, hit, walk.origin).map_or(Rgb::ZERO, weighted),
            None => self.scene.environments.iter().map(|sky| weighted(sky.seen(ray.direction))).sum(),
        }
    }

    /// Light from the light that walk `i` aims at, weighted against scattering, if it is not occluded.
    #[inline]
    fn light_directly(&mut self, walk: &Walk, vertex: &Vertex<'_>, i: usize) {
        let sample = |aim: &LightAim| self.scene.sample_light(vertex.surface.position, aim);
        let Some(light) = self.aims[i].as_ref().and_then(sample) else {
            return;
        };
        let wi = vertex.surface.shading.to_local(light.direction);
        let scattered = vertex.bsdf.evaluate(&vertex.surface, vertex.wo, wi);
        if scattered.value == Rgb::ZERO {
            return;
        }
        let weight =
            if light.delta { 1.0 } else { self.transport.mis.weight(light.density, scattered.density) };
        let radiance = scattered.value * light.radiance * (weight / light.density);
        self.connections.push(Connection { number: walk.number, radiance: walk.throughput * radiance });
        self.shadow_rays.push(vertex.shadow_ray(light.direction, light.distance));
    }

    /// Add the light that is not occluded; how many rays that takes.
    fn connect(&mut self) -> usize {
        self.occluded.resize(self.shadow_rays.len(), false);
        self.scene.world.occluded_each(&self.shadow_rays, &mut self.occluded);
        for (connection, occluded) in self.connections.drain(..).zip(&self.occluded) {
            if !occluded {
                self.paths[connection.number].measurement.radiance += connection.radiance;
            }
        }
        let shadow_rays = self.shadow_rays.len();
        self.shadow_rays.clear();
        shadow_rays
    }
}
