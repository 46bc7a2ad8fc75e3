//! `rectangle`: the square [−1, 1]² in the xy plane, facing +z, as two triangles.
//!
//! As a light it is sampled by solid angle where its sides are perpendicular (Ureña, Fajardo & King 2013, "An Area-Preserving
//! Parametrization for Spherical Rectangles"), which removes the distance and cosine variation of area sampling.

use crate::Result;
use crate::geometry::{Vec2, Vec3};
use crate::scene::build::Builder;
use crate::scene::mesh::Mesh;
use crate::scene::properties::Properties;
use crate::shape::{Entry, Geometry, LightGeometry, LightPoint, area_to_solid_angle, to_world, triangles};

pub(crate) const ENTRY: Entry = Entry { name: "rectangle", build };

fn build(properties: &Properties<'_>, _: &mut Builder) -> Result<Geometry> {
    let flip = properties.boolean("flip_normals", false)?;
    let mut mesh = Mesh {
        positions: vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        uvs: Some(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
        indices: vec![[0, 1, 2], [2, 3, 0]],
        normals: Some(vec![[0.0, 0.0, 1.0]; 4]),
        ..Mesh::default()
    };
    triangles::transform(&mut mesh, &to_world(properties)?);
    if flip {
        mesh.indices.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        mesh.normals.iter_mut().flatten().for_each(|normal| *normal = normal.map(|x| -x));
    }
    Ok(Geometry::Parallelogram(mesh))
}

/// A parallelogram as a light.
pub(crate) struct ParallelogramLight {
    corner: Vec3,
    edges: [Vec3; 2],
    normal: Vec3,
    area: f32,
    perpendicular: bool,
}

impl ParallelogramLight {
    /// The light of a mesh built by this file.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let at = |k: usize| Vec3::from(mesh.positions[k]);
        let edges = [at(1) - at(0), at(3) - at(0)];
        let cross = edges[0].cross(edges[1]);
        let normal =
            mesh.normals.as_ref().map_or(cross.normalize_or_zero(), |normals| Vec3::from(normals[0]));
        let perpendicular = edges[0].dot(edges[1]).abs() < 1e-4 * edges[0].length() * edges[1].length();
        Self { corner: at(0), edges, normal, area: cross.length(), perpendicular }
    }

    /// The rectangle as `from` sees it; `None` where area sampling is more accurate.
    fn spherical(&self, from: Vec3) -> Option<SphericalRectangle> {
        self.perpendicular.then(|| SphericalRectangle::new(self, from)).filter(|s| s.solid_angle > 1e-3)
    }
}

impl LightGeometry for ParallelogramLight {
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<LightPoint> {
        let (uv, density) = match self.spherical(from) {
            Some(spherical) => (spherical.map(u), 1.0 / spherical.solid_angle),
            None => (u, 0.0),
        };
        let position = self.corner + self.edges[0] * uv[0] + self.edges[1] * uv[1];
        let density =
            if density > 0.0 { density } else { area_to_solid_angle(self.area, from, position, self.normal) };
        (density > 0.0).then_some(LightPoint { position, normal: self.normal, uv: Vec2::from(uv), density })
    }

    fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        match self.spherical(from) {
            Some(spherical) => 1.0 / spherical.solid_angle,
            None => area_to_solid_angle(self.area, from, position, normal),
        }
    }

    fn area(&self) -> f32 {
        self.area
    }
}

/// A rectangle projected on the unit sphere around a point, with the notation of Ureña et al. 2013.
struct SphericalRectangle {
    x0: f32,
    x1: f32,
    y0: f32,
    y1: f32,
    z0: f32,
    b0: f32,
    b1: f32,
    k: f32,
    solid_angle: f32,
}

impl SphericalRectangle {
    fn new(light: &ParallelogramLight, from: Vec3) -> Self {
        let lengths = light.edges.map(Vec3::length);
        let (x, y) = (light.edges[0] / lengths[0], light.edges[1] / lengths[1]);
        let to_corner = light.corner - from;
        let z0 = -to_corner.dot(x.cross(y)).abs();
        let (x0, y0) = (to_corner.dot(x), to_corner.dot(y));
        let (x1, y1) = (x0 + lengths[0], y0 + lengths[1]);
        // z components of the normals of the four planes through an edge and the point
        let plane = |a: f32, z0: f32| a / (a * a + z0 * z0).sqrt();
        let (n0, n1, n2, n3) = (-plane(y0, z0), plane(x1, z0), plane(y1, z0), -plane(x0, z0));
        // internal angles of the spherical quadrilateral
        let angle = |a: f32, b: f32| (-a * b).clamp(-1.0, 1.0).acos();
        let (g0, g1, g2, g3) = (angle(n0, n1), angle(n1, n2), angle(n2, n3), angle(n3, n0));
        let k = 2.0 * std::f32::consts::PI - g2 - g3;
        Self { x0, x1, y0, y1, z0, b0: n0, b1: n2, k, solid_angle: g0 + g1 - k }
    }

    /// From the unit square to relative coordinates on the rectangle, uniform in solid angle.
    fn map(&self, u: [f32; 2]) -> [f32; 2] {
        let (sin_au, cos_au) = (u[0] * self.solid_angle + self.k).sin_cos();
        let fu = (cos_au * self.b0 - self.b1) / sin_au;
        let cu = (1.0 / (fu * fu + self.b0 * self.b0).sqrt()).copysign(fu).clamp(-1.0, 1.0);
        let xu = (-(cu * self.z0) / (1.0 - cu * cu).max(1e-12).sqrt()).clamp(self.x0, self.x1);
        let d = (xu * xu + self.z0 * self.z0).sqrt();
        let h0 = self.y0 / (d * d + self.y0 * self.y0).sqrt();
        let h1 = self.y1 / (d * d + self.y1 * self.y1).sqrt();
        let hv = h0 + u[1] * (h1 - h0);
        let hv2 = hv * hv;
        let yv = if hv2 < 1.0 - 1e-6 { (hv * d) / (1.0 - hv2).sqrt() } else { self.y1 };
        let relative = |x: f32, low: f32, high: f32| ((x - low) / (high - low)).clamp(0.0, 1.0);
        [relative(xu, self.x0, self.x1), relative(yv, self.y0, self.y1)]
    }
}
