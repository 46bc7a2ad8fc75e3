//! How much light an interface reflects: Fresnel's equations for unpolarized light.
//!
//! Conventions are those of Mitsuba 3: `eta` is the index inside (below the surface) over the index outside, and the
//! sign of a cosine tells the side. Not a scattering function by itself.

use crate::Result;
use crate::geometry::{Rgb, Vec3};
use crate::scene::materials;
use crate::scene::properties::Properties;

/// An interface between two dielectrics, met under some angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interface {
    /// Reflected share of the power.
    pub reflectance: f32,
    /// Cosine of the refracted direction; on the other side, so of opposite sign. Zero under total internal reflection.
    pub cos_t: f32,
    /// Index where the light goes on over the index where it comes from.
    pub eta_it: f32,
    /// Its reciprocal.
    pub eta_ti: f32,
}

impl Interface {
    /// Direction `wo` refracted about a normal `m` of either orientation, given `wo · m`.
    #[inline]
    pub(crate) fn refract(&self, wo: Vec3, m: Vec3, cos_o: f32) -> Vec3 {
        m * (cos_o * self.eta_ti + self.cos_t) - wo * self.eta_ti
    }
}

/// Fresnel reflectance between dielectrics and Snell's law (Born & Wolf, "Principles of Optics", §1.5).
#[inline]
pub(crate) fn dielectric(cos_i: f32, eta: f32) -> Interface {
    let inverse = 1.0 / eta;
    let (eta_it, eta_ti) = if cos_i >= 0.0 { (eta, inverse) } else { (inverse, eta) };
    let cos_t_squared = 1.0 - (1.0 - cos_i * cos_i) * eta_ti * eta_ti;
    if cos_t_squared <= 0.0 {
        return Interface { reflectance: 1.0, cos_t: 0.0, eta_it, eta_ti };
    }
    let (c, t) = (cos_i.abs(), cos_t_squared.sqrt());
    let reflectance = if eta == 1.0 {
        0.0
    } else {
        let perpendicular = (c - eta_it * t) / (c + eta_it * t);
        let parallel = (t - eta_it * c) / (t + eta_it * c);
        0.5 * (perpendicular * perpendicular + parallel * parallel)
    };
    Interface { reflectance, cos_t: -t.copysign(cos_i), eta_it, eta_ti }
}

/// Fresnel reflectance of a conductor of complex index `eta + i·k` (Born & Wolf, §14.2).
#[inline]
pub(crate) fn conductor(cos_i: f32, eta: Rgb, k: Rgb) -> Rgb {
    let cos2 = cos_i * cos_i;
    let sin2 = 1.0 - cos2;
    let difference = eta * eta - k * k - Rgb::splat(sin2);
    let sum = (difference * difference + 4.0 * eta * eta * k * k).map(f32::sqrt);
    let a = (0.5 * (sum + difference)).max(Rgb::ZERO).map(f32::sqrt);
    let (p, q) = (sum + Rgb::splat(cos2), 2.0 * cos_i * a);
    let perpendicular = (p - q) / (p + q);
    let (p, q) = (cos2 * sum + Rgb::splat(sin2 * sin2), sin2 * q);
    let parallel = perpendicular * (p - q) / (p + q);
    0.5 * (perpendicular + parallel)
}

/// Reflectance of a dielectric interface averaged over a cosine-weighted hemisphere of incident light.
///
/// Polynomial fits: `eta < 1` Egan & Hilgeman 1973, `eta > 1` d'Eon & Irving 2011, "A Quantized-Diffusion Model for
/// Rendering Translucent Materials".
pub(crate) fn diffuse_reflectance(eta: f32) -> f32 {
    let inverse = 1.0 / eta;
    if eta < 1.0 {
        return -1.4399 * eta * eta + 0.7099 * eta + 0.6681 + 0.0636 * inverse;
    }
    let coefficients = [-1.36881_f32, 4.98554, -7.80989, 6.75335, -3.4793, 0.919317];
    coefficients.iter().fold(0.0, |sum, coefficient| sum * inverse + coefficient)
}

/// The index inside over the index outside: `int_ior` and `ext_ior`, numbers or names of materials.
pub(crate) fn relative_ior(properties: &Properties<'_>, inside: &str) -> Result<f32> {
    let eta = ior(properties, "int_ior", inside)? / ior(properties, "ext_ior", "air")?;
    if eta.is_finite() && eta > 0.0 {
        return Ok(eta);
    }
    Err(properties.error("the interior and exterior indices of refraction must be positive"))
}

fn ior(properties: &Properties<'_>, parameter: &str, default: &str) -> Result<f32> {
    let name = match properties.optional_string(parameter) {
        Ok(name) => name.unwrap_or(default),
        Err(_) => return properties.float(parameter, 1.0),
    };
    materials::dielectric_ior(name)
        .ok_or_else(|| properties.error(format_args!("{parameter}: unknown dielectric '{name}'")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fits_agree_with_quadrature() {
        for eta in [1.33_f32, 1.5, 1.0 / 1.33, 1.0 / 1.5] {
            let n = 4000;
            let reflected = |i| dielectric(((i as f32 + 0.5) / n as f32).sqrt(), eta).reflectance;
            let mean = (0..n).map(reflected).sum::<f32>() / n as f32;
            assert!((mean - diffuse_reflectance(eta)).abs() < 0.01, "{eta}: {mean}");
        }
    }

    #[test]
    fn normal_incidence_is_the_textbook_formula() {
        assert!((dielectric(1.0, 1.5).reflectance - 0.04).abs() < 1e-6);
        let gray = conductor(1.0, Rgb::splat(1.5), Rgb::ZERO);
        assert!((gray - Rgb::splat(0.04)).abs().max_element() < 1e-6);
        assert_eq!(conductor(0.3, Rgb::ZERO, Rgb::ONE), Rgb::ONE);
    }
}
