//! `envmap`: radiance from far away, given by an image in latitude–longitude form.
//!
//! Directions are sampled in proportion to the image's luminance times sin θ, by inverting a piecewise-constant marginal and
//! conditional density over the cells between texel centers (Pharr, Jakob & Humphreys, "Physically Based Rendering", infinite lights).

use std::f32::consts::PI;
use std::sync::Arc;

use crate::Result;
use crate::emitter::inversion::Inversion;
use crate::emitter::{Emitter, EmitterHit, LightSample, SceneSphere};
use crate::geometry::{Mat3A, Rgb, Vec3, luminance};
use crate::scene::build::{Builder, Entry};
use crate::scene::properties::Properties;
use crate::texture::image::Image;

pub(crate) const ENTRY: Entry<dyn Emitter> = Entry { name: "envmap", build };

struct Envmap {
    image: Arc<Image>,
    scale: f32,
    to_world: Mat3A,
    to_local: Mat3A,
    /// Cell weights of each row, and the weights of the rows.
    rows: Vec<Inversion>,
    marginal: Inversion,
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
    Ok(Arc::new(Envmap::new(image, scale, rotation)))
}

impl Envmap {
    fn new(image: Arc<Image>, scale: f32, to_world: Mat3A) -> Self {
        let light =
            |x: usize, y: usize| luminance(Rgb::from(image.pixels[y * image.width + x % image.width]));
        let mut sines = 0.0;
        let rows: Vec<Inversion> = (0..image.height - 1)
            .map(|y| {
                let sine = (PI * (y as f32 + 0.5) / (image.height - 1) as f32).sin();
                sines += f64::from(sine);
                Inversion::new((0..image.width).map(|x| {
                    0.25 * sine * (light(x, y) + light(x + 1, y) + light(x, y + 1) + light(x + 1, y + 1))
                }))
            })
            .collect();
        let marginal = Inversion::new(rows.iter().map(Inversion::total));
        let mean_luminance = scale * (f64::from(marginal.total()) / (sines * image.width as f64)) as f32;
        Self { scale, to_world, to_local: to_world.transpose(), rows, marginal, mean_luminance, image }
    }

    /// Cell and position within it of a world direction.
    fn cell(&self, direction: Vec3) -> Cell {
        let local = self.to_local * direction;
        let u = local.x.atan2(-local.z) / (2.0 * PI);
        let x = (u - u.floor()) * self.image.width as f32 - 0.5;
        let y = local.y.clamp(-1.0, 1.0).acos() / PI * (self.image.height - 1) as f32;
        let width = self.image.width as i32;
        let column = x.floor();
        let row = (y as usize).min(self.image.height - 2);
        let ring = (local.x * local.x + local.z * local.z).sqrt();
        Cell {
            column: (column as i32).rem_euclid(width) as usize,
            row,
            fraction: [x - column, y - row as f32],
            sine: ring,
        }
    }

    /// The bilinearly interpolated image.
    fn lookup(&self, cell: &Cell) -> Rgb {
        let width = self.image.width;
        let next = if cell.column + 1 == width { 0 } else { cell.column + 1 };
        let at = |x: usize, y: usize| Rgb::from(self.image.pixels[y * width + x]);
        let [fx, fy] = cell.fraction;
        let top = at(cell.column, cell.row) * (1.0 - fx) + at(next, cell.row) * fx;
        let bottom = at(cell.column, cell.row + 1) * (1.0 - fx) + at(next, cell.row + 1) * fx;
        (top * (1.0 - fy) + bottom * fy) * self.scale
    }

    /// Solid-angle density of a cell: its share of the weight over the solid angle that u, v spread over.
    fn cell_density(&self, cell: &Cell) -> f32 {
        let share = self.rows[cell.row].weight(cell.column) / self.marginal.total();
        let cells = (self.image.width * self.rows.len()) as f32;
        if cell.sine > 0.0 { share * cells / (2.0 * PI * PI * cell.sine) } else { 0.0 }
    }
}

/// A cell between four texel centers, and a point in it.
struct Cell {
    column: usize,
    row: usize,
    fraction: [f32; 2],
    /// sin θ at the point.
    sine: f32,
}

impl Emitter for Envmap {
    fn sample(&self, _: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let width = self.image.width;
        let (row, fraction_y) = self.marginal.invert(u[1]);
        let (column, fraction_x) = self.rows[row].invert(u[0]);
        let theta = PI * (row as f32 + fraction_y) / (self.image.height - 1) as f32;
        let phi = 2.0 * PI * (column as f32 + fraction_x + 0.5) / width as f32;
        let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
        let local = Vec3::new(sin_phi * sin_theta, cos_theta, -cos_phi * sin_theta);
        let cell = Cell { column, row, fraction: [fraction_x, fraction_y], sine: sin_theta };
        let density = self.cell_density(&cell);
        (density > 0.0).then(|| LightSample {
            direction: self.to_world * local,
            distance: f32::INFINITY,
            radiance: self.lookup(&cell),
            density,
            delta: false,
        })
    }

    fn radiance(&self, hit: &EmitterHit) -> Rgb {
        self.lookup(&self.cell(hit.direction))
    }

    fn density(&self, _: Vec3, hit: &EmitterHit) -> f32 {
        self.cell_density(&self.cell(hit.direction))
    }

    fn power(&self, scene: &SceneSphere) -> f32 {
        self.mean_luminance * 4.0 * PI * PI * scene.radius * scene.radius
    }

    fn is_environment(&self) -> bool {
        true
    }
}
