//! `area`: a shape that emits the same radiance in all directions on the side of its normal.

use std::f32::consts::PI;
use std::sync::Arc;

use crate::emitter::{Aim, Emitter, EmitterHit, LightSample, SceneSphere};
use crate::geometry::{Rgb, Vec3, luminance};
use crate::scene::build::Builder;
use crate::scene::node::Node;
use crate::scene::properties::Properties;
use crate::shape::{LightGeometry, LightPoint};
use crate::texture::Texture;
use crate::{Error, Result};

/// A shape that emits.
pub struct Area {
    geometry: Arc<dyn LightGeometry>,
    radiance: Arc<dyn Texture>,
}

/// Read the radiance of an `area` emitter nested in a shape.
pub(crate) fn radiance(node: &Node, builder: &mut Builder) -> Result<Arc<dyn Texture>> {
    if node.plugin != "area" {
        let message = format!("a shape's emitter must be 'area', not '{}'", node.plugin);
        return Err(Error::Scene { location: node.location.clone(), message });
    }
    let properties = Properties::new(node);
    let radiance = builder.texture(&properties, "radiance", Rgb::ONE)?;
    builder.finish(&properties)?;
    Ok(radiance)
}

impl Area {
    /// A shape's surface with its radiance.
    pub(crate) fn new(geometry: Arc<dyn LightGeometry>, radiance: Arc<dyn Texture>) -> Self {
        Self { geometry, radiance }
    }
}

impl Emitter for Area {
    #[inline]
    fn sample(&self, from: Vec3, aim: Aim) -> Option<LightSample> {
        let LightPoint { direction, distance, density, uv, .. } = self.geometry.sample(from, aim.u)?;
        Some(LightSample { direction, distance, radiance: self.radiance.evaluate(uv), density, delta: false })
    }

    #[inline]
    fn radiance(&self, hit: &EmitterHit) -> Rgb {
        if hit.normal.dot(hit.direction) < 0.0 { self.radiance.evaluate(hit.uv) } else { Rgb::ZERO }
    }

    #[inline]
    fn density(&self, from: Vec3, hit: &EmitterHit) -> f32 {
        self.geometry.density(from, hit.position, hit.normal)
    }

    fn power(&self, _: &SceneSphere) -> f32 {
        luminance(self.radiance.mean()) * self.geometry.area() * PI
    }
}
