//! `path`: unidirectional path tracing with next-event estimation.
//!
//! At every surface one light is sampled and one direction is scattered, and the two ways to reach a light are combined by multiple
//! importance sampling (Kajiya 1986, "The Rendering Equation"; Veach & Guibas 1995, "Optimally Combining Sampling Techniques
//! for Monte Carlo Rendering"). Choose it by default; caustics from small lights need another integrator.

use crate::geometry::{Ray, Rgb, Vec3};
use crate::integrator::{Entry, Integrator, Measurement, Transport};
use crate::sampler::{BounceNumbers, PathNumbers};
use crate::scene::{Scene, world::Vertex};

pub(crate) const ENTRY: Entry = Entry {
    name: "path",
    cite: "Kajiya 1986, The Rendering Equation, SIGGRAPH; Veach & Guibas 1995",
    build: |transport| Box::new(Path(transport)),
};

/// A path survives roulette with this many times its throughput as probability.
///
/// The best probability is in proportion to throughput, by a factor that grows with the share of the pixel's error that long paths have
/// (Bolin & Meyer 1997, "An error metric for Monte Carlo ray tracing"; Rath et al. 2022, "EARS: Efficiency-Aware Russian Roulette and
/// Splitting"). Evenly spread points leave little error to short paths: with 2 instead of the usual 1, a Cornell box at 64 samples has
/// 8 % less squared error for 2 % more time; 4 gains less than it costs.
const PERSISTENCE: f32 = 2.0;

/// Roulette never lets all pass: long paths in bright scenes must end.
const MOST_SURVIVORS: f32 = 0.95;

struct Path(Transport);

/// How the ray that is being followed was made.
struct Origin {
    position: Vec3,
    /// Solid-angle density of its direction; infinite for a delta lobe or the camera.
    density: f32,
}

impl Integrator for Path {
    fn measure(&self, scene: &Scene, mut ray: Ray, numbers: &mut PathNumbers) -> Measurement {
        let mut measurement = Measurement::default();
        let mut throughput = Rgb::ONE;
        let mut eta = 1.0_f32;
        let mut origin = Origin { position: ray.origin, density: f32::INFINITY };
        let mut depth = 0;
        if self.0.max_depth == 0 {
            return measurement;
        }
        loop {
            let chosen = numbers.bounce(depth);
            scene.prefetch_light(&chosen);
            let hidden = depth == 0 && self.0.hide_emitters;
            let hit = if hidden { scene.world.first_dark(&mut ray) } else { scene.world.intersect(&ray) };
            if !hidden {
                measurement.radiance += throughput * self.emission(scene, &ray, hit.as_ref(), &origin);
            }
            let Some(hit) = hit else { break };
            let vertex = scene.world.vertex(&ray, &hit);
            if depth == 0 {
                measurement.albedo = vertex.bsdf.albedo(&vertex.surface);
                measurement.normal = vertex.surface.shading.n;
                measurement.depth = hit.t;
            }
            if depth + 1 >= self.0.max_depth {
                break;
            }

            // Next-event estimation.
            if vertex.smooth {
                measurement.radiance += throughput * self.direct(scene, &vertex, &chosen);
            }

            // Scatter.
            let Some(scattered) = vertex.bsdf.sample(&vertex.surface, vertex.wo, chosen.lobe, chosen.bsdf)
            else {
                break;
            };
            throughput *= scattered.weight;
            eta *= scattered.eta;
            let direction = vertex.surface.shading.to_world(scattered.wi);
            ray = vertex.ray(direction, f32::INFINITY);
            let density = if scattered.delta { f32::INFINITY } else { scattered.density };
            origin = Origin { position: vertex.surface.position, density };
            depth += 1;

            // Russian roulette, on what the path can still bring home.
            let largest = throughput.max_element();
            if largest == 0.0 {
                break;
            }
            if depth >= self.0.rr_depth {
                let survival = (PERSISTENCE * largest * eta * eta).min(MOST_SURVIVORS);
                if chosen.roulette >= survival {
                    break;
                }
                throughput /= survival;
            }
        }
        measurement
    }
}

impl Path {
    /// Light that the ray ran into, weighted against next-event estimation.
    #[inline]
    fn emission(
        &self,
        scene: &Scene,
        ray: &Ray,
        hit: Option<&crate::scene::world::Hit>,
        origin: &Origin,
    ) -> Rgb {
        let weight = |density: f32| {
            if origin.density == f32::INFINITY { 1.0 } else { self.0.mis.weight(origin.density, density) }
        };
        let Some(hit) = hit else {
            let mut radiance = Rgb::ZERO;
            for environment in &scene.environments {
                let seen = environment.seen(ray.direction);
                radiance += seen.radiance * weight(seen.density);
            }
            return radiance;
        };
        let Some(seen) = scene.emitter_seen(ray, hit, origin.position) else { return Rgb::ZERO };
        seen.radiance * weight(seen.density)
    }

    /// Light from one sampled light, weighted against scattering.
    #[inline]
    fn direct(&self, scene: &Scene, vertex: &Vertex<'_>, chosen: &BounceNumbers) -> Rgb {
        let position = vertex.surface.position;
        let Some(light) = scene.sample_light(position, chosen.light_choice, chosen.light) else {
            return Rgb::ZERO;
        };
        let wi = vertex.surface.shading.to_local(light.direction);
        let scattered = vertex.bsdf.evaluate(&vertex.surface, vertex.wo, wi);
        if scattered.value == Rgb::ZERO {
            return Rgb::ZERO;
        }
        if scene.world.occluded(&vertex.shadow_ray(light.direction, light.distance)) {
            return Rgb::ZERO;
        }
        let weight = if light.delta { 1.0 } else { self.0.mis.weight(light.density, scattered.density) };
        scattered.value * light.radiance * (weight / light.density)
    }
}
