//! Scattering at surfaces: sample, evaluate and density always together.
//!
//! Directions are unit vectors in the local shading frame (`z` is the shading normal) and point away from the surface:
//! `wo` towards the viewer (where the path came from), `wi` towards the light (where it goes on). Plugin names,
//! parameters and defaults are those of Mitsuba 3.

use crate::geometry::{Rgb, Surface, Vec3};

/// What a BSDF scatters towards one direction.
#[derive(Clone, Copy, Debug)]
pub struct BsdfValue {
    /// `f(wo, wi) · |cos θ_i|`, without any delta lobe.
    pub value: Rgb,
    /// Density of [`Bsdf::sample`] at `wi` with respect to solid angle, without any delta lobe.
    pub density: f32,
}

impl BsdfValue {
    /// Nothing is scattered.
    pub const ZERO: Self = Self { value: Rgb::ZERO, density: 0.0 };
}

/// A sampled direction.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample {
    /// The direction in the local shading frame.
    pub wi: Vec3,
    /// `f · |cos θ_i| / density`, or the weight of the delta lobe.
    pub weight: Rgb,
    /// Solid-angle density of `wi` (all non-delta lobes together); for a delta lobe the probability of its choice.
    pub density: f32,
    /// Whether a delta lobe was chosen (next-event estimation cannot make this direction).
    pub delta: bool,
    /// Relative index of refraction along the path: `η_transmitted / η_incident` when the path crosses a refracting
    /// interface, else 1. Russian roulette undoes the squared factor (radiance compression) with it.
    pub eta: f32,
}

impl BsdfSample {
    /// A delta lobe that reflects about the normal, chosen with `probability`.
    #[inline]
    fn mirror(wo: Vec3, weight: Rgb, probability: f32) -> Self {
        let wi = Vec3::new(-wo.x, -wo.y, wo.z);
        Self { wi, weight, density: probability, delta: true, eta: 1.0 }
    }

    /// A delta lobe that goes straight on, chosen with `probability`.
    #[inline]
    fn pass_through(wo: Vec3, weight: Rgb, probability: f32) -> Self {
        Self { wi: -wo, weight, density: probability, delta: true, eta: 1.0 }
    }

    /// A sample of a smooth reflection lobe, unless it cannot be reached.
    #[inline]
    fn smooth(wi: Vec3, BsdfValue { value, density }: BsdfValue) -> Option<Self> {
        (density > 0.0).then(|| Self { wi, weight: value / density, density, delta: false, eta: 1.0 })
    }
}

/// A scattering function.
pub trait Bsdf: Send + Sync {
    /// Sample `wi`: `lobe` chooses among lobes, `u` is a point of the unit square. `None`: absorbed.
    fn sample(&self, surface: &Surface, wo: Vec3, lobe: f32, u: [f32; 2]) -> Option<BsdfSample>;

    /// Value and density of the non-delta lobes at `wi`; nothing where there are none.
    fn evaluate(&self, _surface: &Surface, _wo: Vec3, _wi: Vec3) -> BsdfValue {
        BsdfValue::ZERO
    }

    /// Whether there is any non-delta lobe (else next-event estimation is pointless).
    fn has_smooth_lobe(&self) -> bool {
        true
    }

    /// Whether the frame's `s` must follow `dp_du`, and `dp_du`, `dp_dv` must be right (anisotropy, bump maps).
    fn needs_tangents(&self) -> bool {
        false
    }

    /// Whether light may pass to the other side.
    fn transmits(&self) -> bool {
        false
    }

    /// Directional albedo, roughly: what the albedo layer of the film shows.
    fn albedo(&self, surface: &Surface) -> Rgb;
}

pub mod blendbsdf;
pub mod bumpmap;
pub mod conductor;
pub mod dielectric;
pub mod diffuse;
pub mod mask;
pub mod normalmap;
pub mod null;
pub mod plastic;
pub mod roughconductor;
pub mod roughdielectric;
pub mod roughplastic;
pub mod thindielectric;
pub mod twosided;

mod coat;
mod fresnel;
mod gauss;
mod glass;
mod interface;
mod metal;
mod microfacet;
mod perturbed;
mod warp;

/// The scattering functions there are.
pub static ALL: &[crate::scene::build::Entry<dyn Bsdf>] = &[
    blendbsdf::ENTRY,
    bumpmap::ENTRY,
    conductor::ENTRY,
    dielectric::ENTRY,
    diffuse::ENTRY,
    mask::ENTRY,
    normalmap::ENTRY,
    null::ENTRY,
    plastic::ENTRY,
    roughconductor::ENTRY,
    roughdielectric::ENTRY,
    roughplastic::ENTRY,
    thindielectric::ENTRY,
    twosided::ENTRY,
];
