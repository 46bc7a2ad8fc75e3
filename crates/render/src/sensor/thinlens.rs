//! `thinlens`: a perspective camera with a round lens: what is not at `focus_distance` is blurred.

use std::sync::Arc;

use crate::Result;
use crate::geometry::{Ray, Vec3, sin_cos_turns};
use crate::scene::build::Builder;
use crate::scene::properties::Properties;
use crate::sensor::perspective::Projection;
use crate::sensor::{Entry, Sensor};

pub(crate) const ENTRY: Entry = Entry { name: "thinlens", build };

struct ThinLens {
    projection: Projection,
    aperture_radius: f32,
    focus_distance: f32,
}

fn build(properties: &Properties<'_>, _: &mut Builder, aspect: f64) -> Result<Arc<dyn Sensor>> {
    let projection = Projection::read(properties, aspect)?;
    let aperture_radius = properties
        .optional_float("aperture_radius")?
        .filter(|radius| *radius > 0.0)
        .ok_or_else(|| properties.error("needs an aperture_radius above 0"))?;
    let focus_distance = properties.positive_float("focus_distance", projection.far)?;
    Ok(Arc::new(ThinLens { projection, aperture_radius, focus_distance }))
}

impl Sensor for ThinLens {
    fn ray(&self, film: [f32; 2], lens: [f32; 2]) -> Ray {
        let focus = self.projection.local(film) * self.focus_distance;
        let (sin_phi, cos_phi) = sin_cos_turns(lens[1]);
        let radius = self.aperture_radius * lens[0].sqrt();
        let origin = Vec3::new(radius * cos_phi, radius * sin_phi, 0.0);
        self.projection.ray(origin, focus - origin)
    }
}
