//! How much of the light that meets a rough interface is reflected or refracted, all directions together. Computed when
//! a scene is built; not a scattering function by itself.

use std::f64::consts::PI;

use crate::bsdf::fresnel;
use crate::bsdf::microfacet::Microfacets;
use crate::geometry::Vec3;

/// Nodes and weights of Gauss–Legendre quadrature on the unit interval.
pub(crate) struct GaussLegendre(Vec<(f32, f32)>);

impl GaussLegendre {
    /// Newton's method on the Legendre polynomial of degree `n` (Press et al., "Numerical Recipes", section 4.6).
    pub(crate) fn new(n: u32) -> Self {
        let rule = (0..n).map(|i| {
            let mut x = (PI * (f64::from(i) + 0.75) / (f64::from(n) + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..20 {
                let (mut previous, mut value) = (1.0, x);
                for k in 2..=n {
                    let k = f64::from(k);
                    (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
                }
                slope = f64::from(n) * (x * value - previous) / (x * x - 1.0);
                x -= value / slope;
            }
            ((0.5 * (x + 1.0)) as f32, (1.0 / ((1.0 - x * x) * slope * slope)) as f32)
        });
        Self(rule.collect())
    }
}

/// Share of the light from a direction of cosine `mu` that a rough interface of relative index `eta` reflects, or
/// transmits, at the first bounce. `facets` must sample visible normals: then Fresnel's term and G1 are all that is left.
pub(crate) fn albedo(
    facets: &Microfacets,
    mu: f32,
    eta: f32,
    transmitted: bool,
    rule: &GaussLegendre,
) -> f32 {
    let wo = Vec3::new((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu);
    let mut sum = 0.0;
    for (u, weight_u) in &rule.0 {
        for (v, weight_v) in &rule.0 {
            let m = facets.sample(wo, [*u, *v]);
            let cos_o = wo.dot(m);
            let interface = fresnel::dielectric(cos_o, eta);
            let (wi, share) = if transmitted {
                (interface.refract(wo, m, cos_o), 1.0 - interface.reflectance)
            } else {
                (2.0 * cos_o * m - wo, interface.reflectance)
            };
            if wi.z != 0.0 && (wi.z < 0.0) == transmitted {
                sum += weight_u * weight_v * share * facets.visibility(wi, m);
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        let GaussLegendre(rule) = GaussLegendre::new(5);
        let integral = |power| rule.iter().map(|(x, weight)| x.powi(power) * weight).sum::<f32>();
        for power in 0..10 {
            assert!((integral(power) - 1.0 / (power + 1) as f32).abs() < 1e-6);
        }
    }
}
