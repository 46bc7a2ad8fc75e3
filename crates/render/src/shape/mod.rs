//! Shapes: triangle meshes, and smooth surfaces that a ray meets analytically.
//!
//! Plugin names, parameters and defaults are those of Mitsuba 3. Everything is in world space once built.

use std::sync::Arc;

use glam::{DAffine3, DMat4};

use crate::Result;
use crate::bsdf::{Bsdf, diffuse::Diffuse};
use crate::geometry::{Ray, Surface, Vec2, Vec3};
use crate::scene::build::Builder;
use crate::scene::mesh::Mesh;
use crate::scene::node::{Kind, Node};
use crate::scene::properties::Properties;
use crate::texture::Texture;

pub mod cube;
pub mod cylinder;
pub mod disk;
pub mod obj;
pub mod ply;
pub mod rectangle;
pub mod serialized;
pub mod sphere;
pub mod triangles;

/// One shape of the registry.
pub struct Entry {
    /// Name of the Mitsuba 3 plugin.
    pub name: &'static str,
    /// Read the parameters and build, in world space.
    pub build: fn(&Properties<'_>, &mut Builder) -> Result<Geometry>,
}

/// The shapes there are.
pub static ALL: &[Entry] = &[
    cube::ENTRY,
    cylinder::ENTRY,
    disk::ENTRY,
    obj::ENTRY,
    ply::ENTRY,
    rectangle::ENTRY,
    serialized::ENTRY,
    sphere::ENTRY,
];

/// The geometry of a shape, in world space.
pub enum Geometry {
    /// Triangles, which go into the ray kernel.
    Mesh(Mesh),
    /// A flat four-sided mesh whose opposite sides are parallel, as an emitter sampled as a whole.
    Parallelogram(Mesh),
    /// A surface with its own intersection test.
    Analytic(Arc<dyn Analytic>),
}

/// A surface that a ray meets analytically.
pub trait Analytic: LightGeometry {
    /// The smallest and largest corner of its bounding box.
    fn bounds(&self) -> [Vec3; 2];

    /// The first ray parameter in `(0, ray.t_max)`.
    fn intersect(&self, ray: &Ray) -> Option<f32>;

    /// The surface at `position`, which lies on it.
    fn surface(&self, position: Vec3) -> Surface;
}

/// A point on a light, chosen for a receiver.
#[derive(Clone, Copy, Debug)]
pub struct LightPoint {
    /// Where.
    pub position: Vec3,
    /// The unit normal that emission is tied to.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Unit direction from the receiver to the point.
    pub direction: Vec3,
    /// How far it is.
    pub distance: f32,
    /// Density with respect to solid angle at the receiver.
    pub density: f32,
}

impl LightPoint {
    /// A point chosen evenly over a surface of this area; `None` where the receiver does not see its front.
    #[inline]
    pub(crate) fn by_area(area: f32, from: Vec3, position: Vec3, normal: Vec3, uv: Vec2) -> Option<Self> {
        let to_point = position - from;
        let distance_squared = to_point.length_squared();
        let facing = -normal.dot(to_point);
        // the cosine, compared before its root is known: half of all receivers may be behind a light
        if !(facing > 0.0 && facing * facing > GRAZING * GRAZING * distance_squared) {
            return None;
        }
        let distance = distance_squared.sqrt();
        let direction = to_point / distance;
        let density = distance_squared * distance / (facing * area);
        Some(Self { position, normal, uv, direction, distance, density })
    }
}

/// Cosines below this count as not seen: their densities over solid angle would overflow.
const GRAZING: f32 = 1e-6;

/// A surface that light can be sampled from.
pub trait LightGeometry: Send + Sync {
    /// A point on the surface for the receiver `from`; `None` where nothing can be seen.
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<LightPoint>;

    /// Solid-angle density of [`LightGeometry::sample`] at a point that `from` sees.
    fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32;

    /// Surface area.
    fn area(&self) -> f32;
}

/// Convert a density over area to one over solid angle; 0 at grazing angles and zero distance.
#[inline]
pub(crate) fn area_to_solid_angle(area: f32, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
    let to = position - from;
    let distance_squared = to.length_squared();
    let cosine = normal.dot(to).abs() / distance_squared.sqrt();
    if cosine > GRAZING { distance_squared / (cosine * area) } else { 0.0 }
}

/// A shape: geometry, how it scatters and what it emits.
pub struct Shape {
    /// Where it is.
    pub geometry: Geometry,
    /// How it scatters.
    pub bsdf: Arc<dyn Bsdf>,
    /// The radiance that it emits on the side of its normal.
    pub radiance: Option<Arc<dyn Texture>>,
}

impl Shape {
    /// Build a shape from its node; `None` when it was left out, leniently.
    pub(crate) fn build(node: &Node, builder: &mut Builder) -> Result<Option<Self>> {
        let properties = Properties::new(node);
        let Some(entry) = ALL.iter().find(|entry| entry.name == node.plugin) else {
            builder.unknown_plugin(node, ALL.iter().map(|entry| entry.name), "left out")?;
            return Ok(None);
        };
        let geometry = (entry.build)(&properties, builder)?;
        for medium in properties.children(Kind::Medium) {
            let error = crate::Error::Scene {
                location: medium.location.clone(),
                message: "participating media are not rendered yet".into(),
            };
            builder.forgive(error, "ignored")?;
        }
        let radiance = match properties.children(Kind::Emitter)[..] {
            [] => None,
            [child] => Some(crate::emitter::area::radiance(&child.node, builder)?),
            _ => return Err(properties.error("has more than one emitter")),
        };
        let bsdf = match properties.children(Kind::Bsdf)[..] {
            [] => Arc::new(Diffuse::gray(if radiance.is_some() { 0.0 } else { 0.5 })) as Arc<dyn Bsdf>,
            [child] => builder.bsdf(&child.node)?,
            _ => return Err(properties.error("has more than one bsdf")),
        };
        builder.finish(&properties)?;
        Ok(Some(Self { geometry, bsdf, radiance }))
    }
}

/// The `to_world` transform; must be affine and invertible.
pub(crate) fn to_world(properties: &Properties<'_>) -> Result<DAffine3> {
    affine(properties, properties.transform("to_world")?)
}

/// A 4×4 matrix as an invertible affine transform.
pub(crate) fn affine(properties: &Properties<'_>, matrix: DMat4) -> Result<DAffine3> {
    let last_row = matrix.row(3);
    if last_row != glam::DVec4::W {
        return Err(properties.error("to_world must be affine (its last row 0 0 0 1)"));
    }
    let affine = DAffine3::from_mat4(matrix);
    if !matrix.is_finite() || affine.matrix3.determinant() == 0.0 || !affine.inverse().is_finite() {
        return Err(properties.error("to_world must be finite and invertible"));
    }
    Ok(affine)
}

/// The factor of a transform that only rotates, moves and scales evenly; an error for any other.
pub(crate) fn uniform_scale(properties: &Properties<'_>, transform: &DAffine3) -> Result<f64> {
    let m = transform.matrix3;
    let lengths = [m.x_axis.length(), m.y_axis.length(), m.z_axis.length()];
    let skew = [m.x_axis.dot(m.y_axis), m.y_axis.dot(m.z_axis), m.z_axis.dot(m.x_axis)];
    let scale = lengths[0];
    let even = lengths.iter().all(|length| (length - scale).abs() <= 1e-4 * scale);
    if !even || skew.iter().any(|dot| dot.abs() > 1e-4 * scale * scale) {
        return Err(properties.error("to_world may only rotate, move and scale evenly here"));
    }
    Ok(scale)
}
