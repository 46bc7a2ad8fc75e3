//! Geometry that rays can meet: all shapes of a scene behind one ray kernel.

use std::sync::Arc;

use crate::accel::{RayKernel, TriangleHit};
use crate::bsdf::Bsdf;
use crate::emitter::EmitterHit;
use crate::geometry::{Frame, Ray, Surface, Vec2, Vec3};
use crate::memory::prefetch;
use crate::scene::analytic::AnalyticShapes;
use crate::scene::mesh::Mesh;
use crate::shape::Analytic;

/// How far, relative to the scene's coordinates, new rays start off the surface they leave.
const OFFSET: f32 = 1.0 / 32_768.0;

/// The share of its length by which a shadow ray stops before the light.
const SHADOW_MARGIN: f32 = 5e-4;

/// The most rays that are followed together: enough to keep busy while memory is slow, few enough to stay in the cache.
pub const WAVE: usize = 32;

/// What a ray met.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Ray parameter.
    pub t: f32,
    /// Which shape.
    pub shape: u32,
    /// The triangle of the ray kernel and its barycentric coordinates; all 0 for analytic shapes.
    triangle: u32,
    barycentric: [f32; 2],
}

/// All that shading asks of a triangle, in one place: hits are scattered over memory, and each should wait for it once.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct ShadingTriangle {
    shape: u32,
    /// Whether all normals are the geometric one.
    flat: bool,
    geometric_normal: [f32; 3],
    /// The first corner, and from it to the others.
    position: [f32; 3],
    edges: [[f32; 3]; 2],
    /// At the corners; the geometric normal where the mesh has none.
    normals: [[f32; 3]; 3],
    /// At the corners; barycentric coordinates where the mesh has none.
    uvs: [[f32; 2]; 3],
}

impl ShadingTriangle {
    /// The `triangle`th triangle of a mesh.
    pub(crate) fn new(shape: u32, mesh: &Mesh, triangle: usize) -> Self {
        let indices = mesh.indices[triangle].map(|index| index as usize);
        let [a, b, c] = indices.map(|index| Vec3::from(mesh.positions[index]));
        let (ab, ac) = (b - a, c - a);
        let geometric_normal: [f32; 3] = ab.cross(ac).normalize_or(Vec3::Z).into();
        let normals =
            mesh.normals.as_ref().map_or([geometric_normal; 3], |normals| indices.map(|i| normals[i]));
        let nearly = |normal: [f32; 3]| Vec3::from(normal).abs_diff_eq(Vec3::from(geometric_normal), 1e-6);
        Self {
            shape,
            flat: normals.into_iter().all(nearly),
            geometric_normal,
            position: a.into(),
            edges: [ab.into(), ac.into()],
            normals,
            uvs: mesh
                .uvs
                .as_ref()
                .map_or([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], |uvs| indices.map(|index| uvs[index])),
        }
    }

    /// Interpolate at a hit.
    #[inline(always)]
    fn surface(&self, [v, w]: [f32; 2], tangents: bool) -> Surface {
        let (ab, ac) = (Vec3::from(self.edges[0]), Vec3::from(self.edges[1]));
        let geometric_normal = Vec3::from(self.geometric_normal);
        let normal = if self.flat {
            geometric_normal
        } else {
            let [na, nb, nc] = self.normals.map(Vec3::from);
            (na * (1.0 - v - w) + nb * v + nc * w).normalize_or(geometric_normal)
        };
        let [ta, tb, tc] = self.uvs.map(Vec2::from);
        let mut surface = Surface {
            position: Vec3::from(self.position) + ab * v + ac * w,
            geometric_normal: geometric_normal * 1.0_f32.copysign(geometric_normal.dot(normal)),
            shading: Frame::from_normal(normal),
            uv: ta + (tb - ta) * v + (tc - ta) * w,
            dp_du: Vec3::ZERO,
            dp_dv: Vec3::ZERO,
        };
        if tangents {
            let (s, t) = (surface.shading.s, surface.shading.t);
            (surface.dp_du, surface.dp_dv) = tangents_of(ab, ac, [tb - ta, tc - ta]).unwrap_or((s, t));
            surface.shading = Frame::from_normal_and_tangent(normal, surface.dp_du);
        }
        surface
    }
}

/// A shape in the world.
pub(crate) struct PlacedShape {
    /// The surface, unless it is triangles in the ray kernel.
    pub(crate) analytic: Option<Arc<dyn Analytic>>,
    pub(crate) bsdf: Arc<dyn Bsdf>,
    /// Number of the light that it is.
    pub(crate) emitter: Option<u32>,
    pub(crate) smooth: bool,
    pub(crate) needs_tangents: bool,
}

/// All shapes of a scene.
pub struct World {
    pub(crate) kernel: Box<dyn RayKernel>,
    /// The triangles of the kernel, as shading sees them.
    pub(crate) triangles: Vec<ShadingTriangle>,
    pub(crate) shapes: Vec<PlacedShape>,
    /// The shapes that are not in the kernel.
    pub(crate) analytic: AnalyticShapes,
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
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.hit(ray, self.kernel.closest(ray))
    }

    /// The first surface that each of at most [`WAVE`] rays meets.
    pub fn intersect_each(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        let mut triangles = [None; WAVE];
        let triangles = &mut triangles[..rays.len()];
        self.kernel.closest_each(rays, triangles);
        for hit in triangles.iter().flatten() {
            prefetch(&self.triangles[hit.triangle as usize]);
        }
        for ((hit, ray), triangle) in hits.iter_mut().zip(rays).zip(triangles) {
            *hit = self.hit(ray, *triangle);
        }
    }

    /// What a ray meets first, given the first triangle that it meets.
    #[inline]
    fn hit(&self, ray: &Ray, triangle: Option<TriangleHit>) -> Option<Hit> {
        let mut hit = triangle.map(|TriangleHit { t, u, v, triangle }| {
            let shape = self.triangles[triangle as usize].shape;
            Hit { t, shape, triangle, barycentric: [u, v] }
        });
        if !self.analytic.is_empty() {
            let ray = Ray { t_max: hit.map_or(ray.t_max, |hit| hit.t), ..*ray };
            if let Some((shape, t)) = self.analytic.closest(ray) {
                hit = Some(Hit { t, shape, triangle: 0, barycentric: [0.0; 2] });
            }
        }
        hit
    }

    /// The first surface that is no light; the ray is moved on to start behind the lights it passed.
    pub fn first_dark(&self, ray: &mut Ray) -> Option<Hit> {
        loop {
            let hit = self.intersect(ray)?;
            if self.shapes[hit.shape as usize].emitter.is_none() {
                return Some(hit);
            }
            let beyond = self.vertex(ray, &hit).ray(ray.direction, ray.t_max - hit.t);
            *ray = beyond;
        }
    }

    /// Whether anything lies on the ray.
    pub fn occluded(&self, ray: &Ray) -> bool {
        let mut occluded = [false];
        self.occluded_each(std::slice::from_ref(ray), &mut occluded);
        occluded[0]
    }

    /// Whether anything lies on each of the rays.
    pub fn occluded_each(&self, rays: &[Ray], occluded: &mut [bool]) {
        self.kernel.occluded_each(rays, occluded);
        if !self.analytic.is_empty() {
            for (occluded, ray) in occluded.iter_mut().zip(rays) {
                *occluded = *occluded || self.analytic.occluded(*ray);
            }
        }
    }

    #[inline(always)]
    fn surface(&self, shape: &PlacedShape, ray: &Ray, hit: &Hit, tangents: bool) -> Surface {
        match &shape.analytic {
            None => self.triangles[hit.triangle as usize].surface(hit.barycentric, tangents),
            Some(analytic) => analytic.surface(ray.origin + ray.direction * hit.t),
        }
    }

    /// Everything about a hit that scattering needs.
    #[inline]
    pub fn vertex(&self, ray: &Ray, hit: &Hit) -> Vertex<'_> {
        let shape = &self.shapes[hit.shape as usize];
        let surface = self.surface(shape, ray, hit, shape.needs_tangents);
        let wo = surface.shading.to_local(-ray.direction);
        Vertex { surface, wo, bsdf: &*shape.bsdf, smooth: shape.smooth }
    }

    /// The light that a hit shape is, and the hit as that light sees it.
    #[inline]
    pub(crate) fn emitter_hit(&self, ray: &Ray, hit: &Hit) -> Option<(u32, EmitterHit)> {
        let shape = &self.shapes[hit.shape as usize];
        let emitter = shape.emitter?;
        let surface = self.surface(shape, ray, hit, false);
        let hit = EmitterHit {
            position: surface.position,
            normal: surface.geometric_normal,
            uv: surface.uv,
            direction: ray.direction,
        };
        Some((emitter, hit))
    }

    /// How many shapes there are.
    pub fn shape_count(&self) -> usize {
        self.shapes.len()
    }

    /// How many triangles the ray kernel holds.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
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

/// Derivatives of the position by the texture coordinates; `None` where their changes along the edges (`u`, `v`) are degenerate.
fn tangents_of(ab: Vec3, ac: Vec3, [u, v]: [Vec2; 2]) -> Option<(Vec3, Vec3)> {
    let determinant = u.perp_dot(v);
    let inverse = 1.0 / determinant;
    (determinant != 0.0 && inverse.is_finite())
        .then(|| ((ab * v.y - ac * u.y) * inverse, (ac * u.x - ab * v.x) * inverse))
}
