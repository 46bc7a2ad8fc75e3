//! `envmap`: radiance from far away, given by an image in latitude–longitude form.
//!
//! Directions are sampled in proportion to the image's luminance times sin θ (Pharr, Jakob & Humphreys, "Physically Based
//! Rendering", infinite lights).

use std::f32::consts::PI;
use std::sync::Arc;

use crate::Result;
use crate::emitter::sky::{Sky, SkyPoint};
use crate::emitter::{Aim, Emitter, EmitterHit, LightSample, SceneSphere};
use crate::geometry::{Mat3A, Rgb, Vec3, sin_cos_turns};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::image::Image;

pub(crate) const ENTRY: Entry<dyn Emitter> = Entry { name: "envmap", build };

struct Envmap {
    sky: Sky,
    scale: f32,
    to_world: Mat3A,
    to_local: Mat3A,
    mean_luminance: f32,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Emitter>> {
    let path = properties.required_path("filename")?;
    let scale = properties.float("scale", 1.0)?;
    let to_world = crate::shape::to_world(properties)?;
    crate::shape::uniform_scale(properties, &to_world)?;
    let image = builder.image(path, false)?;
    if image.width < 2 || image.height < 3 {
        return Err(properties.error("the image must have at least 2×3 pixels"));
    }
    let rotation = Mat3A::from((to_world.matrix3 * (1.0 / to_world.matrix3.x_axis.length())).as_mat3());
    Ok(Arc::new(Envmap::new(&image, scale, rotation)))
}

impl Envmap {
    fn new(image: &Image, scale: f32, to_world: Mat3A) -> Self {
        let rows = image.height - 1;
        let sine = |row: usize| (PI * (row as f32 + 0.5) / rows as f32).sin();
        let sky = Sky::new(image, sine);
        let mean = sky.total_weight() / ((0..rows).map(sine).sum::<f32>() * image.width as f32);
        Self { sky, scale, to_world, to_local: to_world.transpose(), mean_luminance: scale * mean }
    }

    /// Where a world direction meets the image, and sin θ there.
    #[inline]
    fn locate(&self, direction: Vec3) -> (SkyPoint, f32) {
        let [width, rows] = self.sky.cells();
        let local = self.to_local * direction;
        let turns = local.x.atan2(-local.z) / (2.0 * PI);
        // columns from the center of the first texel, shifted by a turn so that truncation rounds down
        let x = (turns + 1.0) * width as f32 - 0.5;
        let y = local.y.clamp(-1.0, 1.0).acos() / PI * rows as f32;
        let (column, row) = (x as usize, (y as usize).min(rows - 1));
        let fraction = [x - column as f32, (y - row as f32).min(1.0)];
        let sine = (local.x * local.x + local.z * local.z).sqrt();
        (SkyPoint { cell: [column % width, row], fraction }, sine)
    }

    /// Solid-angle density at a point of the image: its two coordinates cover 2π² sin θ.
    #[inline]
    fn solid_angle_density(&self, point: &SkyPoint, sine: f32) -> f32 {
        if sine > 0.0 { self.sky.density(point) / (2.0 * PI * PI * sine) } else { 0.0 }
    }
}

impl Emitter for Envmap {
    fn aim(&self, u: [f32; 2]) -> Aim {
        let (tile, u) = self.sky.choose_tile(u);
        Aim { part: [tile as u32, 0], u }
    }

    fn aim_closer(&self, aim: &mut Aim) {
        let (cell, u) = self.sky.choose_cell(aim.part[0] as usize, aim.u);
        *aim = Aim { part: [aim.part[0], cell as u32], u };
    }

    fn sample(&self, _: Vec3, aim: Aim) -> Option<LightSample> {
        let [width, rows] = self.sky.cells();
        let [tile, cell] = aim.part.map(|part| part as usize);
        let point = self.sky.point(tile, cell, aim.u);
        let (sin_theta, cos_theta) =
            sin_cos_turns(0.5 * (point.cell[1] as f32 + point.fraction[1]) / rows as f32);
        let (sin_phi, cos_phi) =
            sin_cos_turns((point.cell[0] as f32 + point.fraction[0] + 0.5) / width as f32);
        let local = Vec3::new(sin_phi * sin_theta, cos_theta, -cos_phi * sin_theta);
        let density = self.solid_angle_density(&point, sin_theta);
        (density > 0.0).then(|| LightSample {
            direction: self.to_world * local,
            distance: f32::INFINITY,
            radiance: self.sky.color(&point) * self.scale,
            density,
            delta: false,
        })
    }

    fn radiance(&self, hit: &EmitterHit) -> Rgb {
        self.sky.color(&self.locate(hit.direction).0) * self.scale
    }

    fn density(&self, _: Vec3, hit: &EmitterHit) -> f32 {
        let (point, sine) = self.locate(hit.direction);
        self.solid_angle_density(&point, sine)
    }

    fn evaluate(&self, _: Vec3, hit: &EmitterHit) -> (Rgb, f32) {
        let (point, sine) = self.locate(hit.direction);
        (self.sky.color(&point) * self.scale, self.solid_angle_density(&point, sine))
    }

    fn power(&self, scene: &SceneSphere) -> f32 {
        self.mean_luminance * 4.0 * PI * PI * scene.radius * scene.radius
    }

    fn is_environment(&self) -> bool {
        true
    }
}
