//! Geometry that rays can meet: all shapes of a scene behind one ray kernel.

use std::sync::Arc;

use crate::accel::{RayKernel, TriangleHit};
use crate::bsdf::Bsdf;
use crate::emitter::{EmitterHit, SceneSphere};
use crate::geometry::{Frame, Ray, Surface, Vec2, Vec3};
use crate::scene::mesh::Mesh;
use crate::shape::Analytic;

/// How far, relative to the scene's coordinates, new rays start off the surface they leave.
const OFFSET: f32 = 1.0 / 32_768.0;

/// The share of its length by which a shadow ray stops before the light.
const SHADOW_MARGIN: f32 = 5e-4;

/// What a ray met.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Ray parameter.
    pub t: f32,
    /// Which shape.
    pub shape: u32,
    /// The triangle in the shape's mesh and its barycentric coordinates; all 0 for analytic shapes.
    triangle: u32,
    barycentric: [f32; 2],
}

/// The geometry of a placed shape.
pub(crate) enum Placed {
    /// Triangles in the ray kernel, from this one on.
    Mesh {
        /// The mesh.
        mesh: Mesh,
        /// Number of its first triangle in the kernel.
        first_triangle: u32,
    },
    /// A surface with its own intersection test.
    Analytic(Arc<dyn Analytic>),
}

/// A shape in the world.
pub(crate) struct PlacedShape {
    pub(crate) placed: Placed,
    pub(crate) bsdf: Arc<dyn Bsdf>,
    /// Number of the light that it is.
    pub(crate) emitter: Option<u32>,
    pub(crate) smooth: bool,
    pub(crate) needs_tangents: bool,
}

/// All shapes of a scene.
pub struct World {
    pub(crate) kernel: Box<dyn RayKernel>,
    /// The shape of each triangle of the kernel.
    pub(crate) triangle_shape: Vec<u32>,
    pub(crate) shapes: Vec<PlacedShape>,
    /// The analytic shapes, with their bounding boxes; few enough to try one after the other.
    pub(crate) analytic: Vec<(u32, [Vec3; 2])>,
    pub(crate) bounds: SceneSphere,
}

/// A surface point where a path scatters.
pub struct Vertex<'a> {
    /// Where.
    pub surface: Surface,
    /// Local direction to where the path came from.
    pub wo: Vec3,
    /// How it scatters.
    pub bsdf: &'a dyn Bsdf,
    /// Whether next-event estimation can succeed.
    pub smooth: bool,
}

impl World {
    /// The first surface that a ray meets.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        let mut hit = self.kernel.closest(ray).map(|TriangleHit { t, u, v, triangle }| {
            let shape = self.triangle_shape[triangle as usize];
            let first = match &self.shapes[shape as usize].placed {
                Placed::Mesh { first_triangle, .. } => *first_triangle,
                Placed::Analytic(_) => 0,
            };
            Hit { t, shape, triangle: triangle - first, barycentric: [u, v] }
        });
        if !self.analytic.is_empty() {
            let mut ray = Ray { t_max: hit.map_or(ray.t_max, |hit| hit.t), ..*ray };
            for (shape, t) in self.analytic_hits(ray) {
                if t < ray.t_max {
                    ray.t_max = t;
                    hit = Some(Hit { t, shape, triangle: 0, barycentric: [0.0; 2] });
                }
            }
        }
        hit
    }

    /// Whether anything lies on the ray.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.kernel.occluded(ray) || (!self.analytic.is_empty() && self.analytic_hits(*ray).next().is_some())
    }

    fn analytic_hits(&self, ray: Ray) -> impl Iterator<Item = (u32, f32)> {
        let inverse = ray.direction.recip();
        let near = self.analytic.iter().filter(move |(_, [low, high])| {
            let (a, b) = ((*low - ray.origin) * inverse, (*high - ray.origin) * inverse);
            // NaN (a ray in a face of the box) must not reject: comparisons are written to keep it
            let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
            !(enter > leave * 1.0001 || leave < 0.0 || enter > ray.t_max)
        });
        near.filter_map(move |&(shape, _)| match &self.shapes[shape as usize].placed {
            Placed::Analytic(analytic) => analytic.intersect(&ray).map(|t| (shape, t)),
            Placed::Mesh { .. } => None,
        })
    }

    /// Everything about a hit that scattering needs.
    #[inline]
    pub fn vertex(&self, ray: &Ray, hit: &Hit) -> Vertex<'_> {
        let shape = &self.shapes[hit.shape as usize];
        let surface = match &shape.placed {
            Placed::Mesh { mesh, .. } => mesh_surface(mesh, hit, shape.needs_tangents),
            Placed::Analytic(analytic) => analytic.surface(ray.origin + ray.direction * hit.t),
        };
        let wo = surface.shading.to_local(-ray.direction);
        Vertex { surface, wo, bsdf: &*shape.bsdf, smooth: shape.smooth }
    }

    /// The light that a hit shape is, and the hit as that light sees it.
    #[inline]
    pub(crate) fn emitter_hit(&self, ray: &Ray, hit: &Hit) -> Option<(u32, EmitterHit)> {
        let shape = &self.shapes[hit.shape as usize];
        let emitter = shape.emitter?;
        let surface = match &shape.placed {
            Placed::Mesh { mesh, .. } => mesh_surface(mesh, hit, false),
            Placed::Analytic(analytic) => analytic.surface(ray.origin + ray.direction * hit.t),
        };
        let hit = EmitterHit {
            position: surface.position,
            normal: surface.geometric_normal,
            uv: surface.uv,
            direction: ray.direction,
        };
        Some((emitter, hit))
    }

    /// A sphere around everything.
    pub fn bounds(&self) -> SceneSphere {
        self.bounds
    }

    /// How many shapes there are.
    pub fn shape_count(&self) -> usize {
        self.shapes.len()
    }

    /// How many triangles the ray kernel holds.
    pub fn triangle_count(&self) -> usize {
        self.triangle_shape.len()
    }

    /// The name of the ray kernel.
    pub fn kernel_name(&self) -> &'static str {
        self.kernel.name()
    }
}

impl Vertex<'_> {
    /// A ray that leaves the surface.
    #[inline]
    pub fn ray(&self, direction: Vec3, t_max: f32) -> Ray {
        let Surface { position, geometric_normal: normal, .. } = self.surface;
        let offset = (1.0 + position.abs().max_element()) * OFFSET;
        let origin = position + normal * offset.copysign(normal.dot(direction));
        Ray { origin, direction, t_max }
    }

    /// A ray towards a light at `distance` that stops just before it.
    #[inline]
    pub fn shadow_ray(&self, direction: Vec3, distance: f32) -> Ray {
        self.ray(direction, distance * (1.0 - SHADOW_MARGIN))
    }
}

/// Interpolate a mesh at a hit.
#[inline]
fn mesh_surface(mesh: &Mesh, hit: &Hit, tangents: bool) -> Surface {
    let [a, b, c] = mesh.indices[hit.triangle as usize];
    let (ia, ib, ic) = (a as usize, b as usize, c as usize);
    let (v, w) = (hit.barycentric[0], hit.barycentric[1]);
    let a = Vec3::from(mesh.positions[ia]);
    let (ab, ac) = (Vec3::from(mesh.positions[ib]) - a, Vec3::from(mesh.positions[ic]) - a);
    let geometric_normal = ab.cross(ac).normalize_or(Vec3::Z);
    let normal = match &mesh.normals {
        None => geometric_normal,
        Some(normals) => {
            let weighted = Vec3::from(normals[ia]) * (1.0 - v - w)
                + Vec3::from(normals[ib]) * v
                + Vec3::from(normals[ic]) * w;
            weighted.normalize_or(geometric_normal)
        }
    };
    let corners =
        mesh.uvs.as_ref().map(|uvs| [Vec2::from(uvs[ia]), Vec2::from(uvs[ib]), Vec2::from(uvs[ic])]);
    let uv = corners.map_or(Vec2::new(v, w), |[ta, tb, tc]| ta + (tb - ta) * v + (tc - ta) * w);
    let mut surface = Surface {
        position: a + ab * v + ac * w,
        geometric_normal: geometric_normal * 1.0_f32.copysign(geometric_normal.dot(normal)),
        shading: Frame::from_normal(normal),
        uv,
        dp_du: Vec3::ZERO,
        dp_dv: Vec3::ZERO,
    };
    if tangents {
        (surface.dp_du, surface.dp_dv) = corners
            .and_then(|corners| tangents_of(ab, ac, corners))
            .unwrap_or((surface.shading.s, surface.shading.t));
        surface.shading = Frame::from_normal_and_tangent(normal, surface.dp_du);
    }
    surface
}

/// Derivatives of the position by the texture coordinates; `None` where these are degenerate.
fn tangents_of(ab: Vec3, ac: Vec3, [ta, tb, tc]: [Vec2; 3]) -> Option<(Vec3, Vec3)> {
    let (u, v) = (tb - ta, tc - ta);
    let determinant = u.perp_dot(v);
    let inverse = 1.0 / determinant;
    (determinant != 0.0 && inverse.is_finite())
        .then(|| ((ab * v.y - ac * u.y) * inverse, (ac * u.x - ab * v.x) * inverse))
}
