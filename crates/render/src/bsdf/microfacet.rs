//! Distributions of microfacet normals: Beckmann and GGX, with their shadowing and their sampling.
//!
//! The machinery of all rough surfaces; not a scattering function by itself. Formulas: Walter et al. 2007, "Microfacet
//! Models for Refraction through Rough Surfaces" (D and G1); Heitz 2014, "Understanding the Masking-Shadowing Function"
//! (anisotropy); Heitz & d'Eon 2014 (visible normals); Jakob 2014, "An Improved Visible Normal Sampling Routine for the
//! Beckmann Distribution"; Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".

use std::f32::consts::{FRAC_1_PI, PI};

use crate::Result;
use crate::bsdf::gauss::{erf, erf_inverse};
use crate::geometry::{Vec2, Vec3, sin_cos_turns};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::texture::slot::NumberSlot;

/// The shape of a distribution of normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Gaussian slopes.
    Beckmann,
    /// Trowbridge–Reitz: longer tails.
    Ggx,
}

/// Parameters of a rough surface as scene files give them.
pub(crate) struct Roughness {
    shape: Shape,
    visible: bool,
    alpha_u: NumberSlot,
    alpha_v: Option<NumberSlot>,
}

impl Roughness {
    /// Read `distribution`, `sample_visible` and `alpha` or `alpha_u`, `alpha_v`.
    pub(crate) fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Self> {
        let shape = [Shape::Beckmann, Shape::Ggx][properties.choice("distribution", &["beckmann", "ggx"])?];
        let visible = properties.boolean("sample_visible", true)?;
        let mut slot =
            |name: &str| -> Result<NumberSlot> { NumberSlot::build(properties, builder, name, 0.1) };
        let (u, v) = (properties.has("alpha_u"), properties.has("alpha_v"));
        if u != v || (u && properties.has("alpha")) {
            return Err(properties.error("give either alpha or both alpha_u and alpha_v"));
        }
        let (alpha_u, alpha_v) =
            if u { (slot("alpha_u")?, Some(slot("alpha_v")?)) } else { (slot("alpha")?, None) };
        Ok(Self { shape, visible, alpha_u, alpha_v })
    }

    /// The distribution at `uv`.
    #[inline]
    pub(crate) fn at(&self, uv: Vec2) -> Microfacets {
        let alpha_u = self.alpha_u.evaluate(uv);
        let alpha_v = self.alpha_v.as_ref().map_or(alpha_u, |slot| slot.evaluate(uv));
        Microfacets::new(self.shape, alpha_u, alpha_v, self.visible)
    }

    /// The isotropic distribution that is the same everywhere, if it is.
    pub(crate) fn uniform(&self) -> Option<Microfacets> {
        match (&self.alpha_u, &self.alpha_v) {
            (NumberSlot::Constant(alpha), None) => {
                Some(Microfacets::new(self.shape, *alpha, *alpha, self.visible))
            }
            _ => None,
        }
    }

    /// Whether roughness depends on the direction of the tangent.
    pub(crate) fn is_anisotropic(&self) -> bool {
        self.alpha_v.is_some()
    }
}

/// A distribution of microfacet normals at one point; `z` is the macroscopic normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Microfacets {
    shape: Shape,
    alpha_u: f32,
    alpha_v: f32,
    visible: bool,
}

impl Microfacets {
    /// Roughness below 1e-4 is raised to it (Mitsuba does the same): single precision resolves no smoother surface.
    #[inline]
    pub(crate) fn new(shape: Shape, alpha_u: f32, alpha_v: f32, visible: bool) -> Self {
        Self { shape, alpha_u: alpha_u.max(1e-4), alpha_v: alpha_v.max(1e-4), visible }
    }

    /// The same, but only visible normals are sampled.
    pub(crate) fn of_visible_normals(self) -> Self {
        Self { visible: true, ..self }
    }

    /// The same, rougher, unless only visible normals are sampled: keeps weights at grazing angles bounded
    /// (Walter et al. 2007, section 5.3).
    #[inline]
    pub(crate) fn widened(self, cos_o: f32) -> Self {
        if self.visible {
            return self;
        }
        let factor = 1.2 - 0.2 * cos_o.abs().sqrt();
        Self::new(self.shape, self.alpha_u * factor, self.alpha_v * factor, false)
    }

    /// D: area of the facets with normal `m` (`m.z > 0`).
    #[inline]
    pub(crate) fn area(&self, m: Vec3) -> f32 {
        let (x, y, z2) = (m.x / self.alpha_u, m.y / self.alpha_v, m.z * m.z);
        let tangential = x * x + y * y;
        let scale = FRAC_1_PI / (self.alpha_u * self.alpha_v);
        let area = match self.shape {
            Shape::Beckmann if tangential > 80.0 * z2 => 0.0, // slow and negligible
            Shape::Beckmann => scale * (-tangential / z2).exp() / (z2 * z2),
            Shape::Ggx => scale / ((tangential + z2) * (tangential + z2)),
        };
        if area * m.z > 1e-20 { area } else { 0.0 }
    }

    /// `α² tan²θ` of a direction: its roughness seen from there.
    #[inline]
    fn stretched_tangent_squared(&self, v: Vec3) -> f32 {
        let (x, y) = (v.x * self.alpha_u, v.y * self.alpha_v);
        (x * x + y * y) / (v.z * v.z)
    }

    /// G1: share of the facets with normal `m` visible from `v`; Beckmann by Walter's rational fit (error below 0.35 %).
    #[inline]
    pub(crate) fn visibility(&self, v: Vec3, m: Vec3) -> f32 {
        if v.dot(m) * v.z <= 0.0 {
            return 0.0;
        }
        let t2 = self.stretched_tangent_squared(v);
        match self.shape {
            Shape::Ggx => 2.0 / (1.0 + (1.0 + t2).sqrt()),
            Shape::Beckmann if t2 <= 1.0 / (1.6 * 1.6) => 1.0,
            Shape::Beckmann => {
                let a2 = 1.0 / t2;
                let a = a2.sqrt();
                (3.535 * a + 2.181 * a2) / (1.0 + 2.276 * a + 2.577 * a2)
            }
        }
    }

    /// G1 without approximation: what the density of visible normals needs to integrate to 1.
    #[inline]
    fn exact_visibility(&self, v: Vec3) -> f32 {
        let t2 = self.stretched_tangent_squared(v);
        if self.shape == Shape::Ggx {
            return 2.0 / (1.0 + (1.0 + t2).sqrt());
        }
        if t2 < 0.0625 {
            return 1.0; // Λ < 1e-9
        }
        let a = 1.0 / t2.sqrt();
        let lambda = 0.5 * (erf(a) - 1.0) + (-a * a).exp() / (2.0 * a * PI.sqrt());
        1.0 / (1.0 + lambda)
    }

    /// G: share of the facets with normal `m` visible from both directions.
    #[inline]
    pub(crate) fn shadowing(&self, wi: Vec3, wo: Vec3, m: Vec3) -> f32 {
        self.visibility(wi, m) * self.visibility(wo, m)
    }

    /// Density of [`Self::sample`] at `m`, for `wo` in the upper hemisphere.
    #[inline]
    pub(crate) fn density(&self, wo: Vec3, m: Vec3) -> f32 {
        self.density_of(self.area(m), wo, m)
    }

    /// The same when the area of the facets is known already.
    #[inline]
    pub(crate) fn density_of(&self, area: f32, wo: Vec3, m: Vec3) -> f32 {
        if self.visible { area * self.exact_visibility(wo) * wo.dot(m).abs() / wo.z } else { area * m.z }
    }

    /// Sample a normal, as seen from `wo` in the upper hemisphere.
    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, u: [f32; 2]) -> Vec3 {
        if !self.visible {
            return self.sample_all(u);
        }
        match self.shape {
            Shape::Ggx => self.sample_visible_ggx(wo, u),
            Shape::Beckmann => self.sample_visible_beckmann(wo, u),
        }
    }

    fn normal_of_slope(&self, x: f32, y: f32) -> Vec3 {
        Vec3::new(-self.alpha_u * x, -self.alpha_v * y, 1.0).normalize()
    }

    fn sample_all(&self, u: [f32; 2]) -> Vec3 {
        let radius = match self.shape {
            Shape::Beckmann => (-(-u[1]).ln_1p()).sqrt(),
            Shape::Ggx => (u[1] / (1.0 - u[1])).sqrt(),
        };
        let (sin_phi, cos_phi) = sin_cos_turns(u[0]);
        self.normal_of_slope(radius * cos_phi, radius * sin_phi)
    }

    fn sample_visible_ggx(&self, wo: Vec3, u: [f32; 2]) -> Vec3 {
        let v = Vec3::new(wo.x * self.alpha_u, wo.y * self.alpha_v, wo.z).normalize();
        let (sin_phi, cos_phi) = sin_cos_turns(u[0]);
        let z = (1.0 - u[1]) * (1.0 + v.z) - v.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let h = Vec3::new(radius * cos_phi, radius * sin_phi, z) + v;
        Vec3::new(h.x * self.alpha_u, h.y * self.alpha_v, h.z.max(1e-7)).normalize()
    }

    fn sample_visible_beckmann(&self, wo: Vec3, u: [f32; 2]) -> Vec3 {
        let (x, y) = (wo.x * self.alpha_u, wo.y * self.alpha_v);
        let horizontal = (x * x + y * y).sqrt();
        let (cos_phi, sin_phi) =
            if horizontal > 1e-9 { (x / horizontal, y / horizontal) } else { (1.0, 0.0) };
        let along = beckmann_slope(horizontal / wo.z, u[0]);
        let across = erf_inverse((2.0 * u[1] - 1.0).clamp(-0.999_999, 0.999_999));
        self.normal_of_slope(cos_phi * along - sin_phi * across, sin_phi * along + cos_phi * across)
    }
}

/// Slope along the plane of incidence of a Gaussian surface (α = 1) seen under `tan_theta`: Newton's method on the
/// distribution function in `b = erf(slope)`, which is nearly linear there, from Jakob's first guess, kept inside a
/// shrinking bracket. Two or three steps are the rule.
fn beckmann_slope(tan_theta: f32, u: f32) -> f32 {
    let u = u.clamp(1e-6, 1.0 - 1e-6);
    let scale = tan_theta / PI.sqrt();
    let cot_theta = 1.0 / tan_theta.max(1e-9);
    let whole = erf(cot_theta);
    let highest = whole.min(0.999_999);
    let steep = if cot_theta < 4.0 { scale * (-cot_theta * cot_theta).exp() } else { 0.0 };
    let total = 1.0 + whole + steep;
    let target = u * total;
    // The step after this error squares it; at both ends the function is less linear.
    let enough = 1e-3 * target.min(total - target);
    let (mut low, mut high) = (-1.0_f32, highest);
    let theta = tan_theta.atan();
    let exponent = 1.0 + theta * (-0.876 + theta * (0.4265 - 0.0594 * theta));
    let mut b = (high - (1.0 + high) * (1.0 - u).powf(exponent)).clamp(low, high);
    for _ in 0..12 {
        let slope = erf_inverse(b.max(-0.999_999));
        let excess = 1.0 + b + scale * (-slope * slope).exp() - target;
        if excess > 0.0 {
            high = b;
        } else {
            low = b;
        }
        let next = b - excess / (1.0 - slope * tan_theta);
        b = if (low..=high).contains(&next) { next } else { 0.5 * (low + high) };
        if excess.abs() < enough {
            break;
        }
    }
    erf_inverse(b.max(-0.999_999))
}
