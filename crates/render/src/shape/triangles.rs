//! What all triangle meshes share: placing in the world, vertex normals, and sampling as a light.

use glam::{DAffine3, DVec3};

use crate::Result;
use crate::geometry::{Vec2, Vec3};
use crate::scene::mesh::Mesh;
use crate::scene::properties::Properties;
use crate::shape::{LightGeometry, LightPoint, area_to_solid_angle, to_world};

/// The parameters that all meshes share.
pub(crate) struct MeshOptions {
    to_world: DAffine3,
    face_normals: bool,
    flip_normals: bool,
    flip_tex_coords: bool,
}

impl MeshOptions {
    /// Read them; `flips_tex_coords` is the format's default.
    pub(crate) fn read(properties: &Properties<'_>, flips_tex_coords: bool) -> Result<Self> {
        Ok(Self {
            to_world: to_world(properties)?,
            face_normals: properties.boolean("face_normals", false)?,
            flip_normals: properties.boolean("flip_normals", false)?,
            flip_tex_coords: properties.boolean("flip_tex_coords", flips_tex_coords)?,
        })
    }
}

/// Bring a mesh to world space, with the normals it should have.
pub(crate) fn place(mut mesh: Mesh, options: &MeshOptions) -> Mesh {
    transform(&mut mesh, &options.to_world);
    if options.face_normals || mesh.face_normals {
        mesh.normals = None;
    } else if mesh.normals.is_none() {
        mesh.normals = Some(vertex_normals(&mesh));
    }
    if options.flip_tex_coords {
        mesh.uvs.iter_mut().flatten().for_each(|uv| uv[1] = 1.0 - uv[1]);
    }
    if options.flip_normals {
        mesh.indices.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        mesh.normals.iter_mut().flatten().for_each(|normal| *normal = normal.map(|x| -x));
    }
    mesh
}

/// Apply a transform to positions and normals; normals become unit vectors.
pub(crate) fn transform(mesh: &mut Mesh, to_world: &DAffine3) {
    for position in &mut mesh.positions {
        *position = to_world.transform_point3(DVec3::from(position.map(f64::from))).as_vec3().into();
    }
    let normal_matrix = to_world.matrix3.inverse().transpose();
    for normal in mesh.normals.iter_mut().flatten() {
        *normal = (normal_matrix * DVec3::from(normal.map(f64::from))).normalize_or_zero().as_vec3().into();
    }
}

fn corner(mesh: &Mesh, triangle: usize, corner: usize) -> Vec3 {
    Vec3::from(mesh.positions[mesh.indices[triangle][corner] as usize])
}

/// Smooth normals: face normals weighted by the angle at the vertex
/// (Thürmer & Wüthrich 1998, "Computing vertex normals from polygonal facets").
fn vertex_normals(mesh: &Mesh) -> Vec<[f32; 3]> {
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    for (triangle, indices) in mesh.indices.iter().enumerate() {
        let corners = [0, 1, 2].map(|k| corner(mesh, triangle, k));
        let face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        for k in 0..3 {
            let to_next = (corners[(k + 1) % 3] - corners[k]).normalize_or_zero();
            let to_last = (corners[(k + 2) % 3] - corners[k]).normalize_or_zero();
            let angle = to_next.dot(to_last).clamp(-1.0, 1.0).acos();
            normals[indices[k] as usize] += face * angle;
        }
    }
    normals.into_iter().map(|normal| normal.normalize_or(Vec3::X).into()).collect()
}

/// The corners of a triangle, counterclockwise as seen from the side of its vertex normals: mirrored meshes are not.
fn facing_outwards(mesh: &Mesh, [a, b, c]: [u32; 3]) -> [u32; 3] {
    let Some(normals) = &mesh.normals else { return [a, b, c] };
    let outward: Vec3 = [a, b, c].iter().map(|&index| Vec3::from(normals[index as usize])).sum();
    let [pa, pb, pc] = [a, b, c].map(|index| Vec3::from(mesh.positions[index as usize]));
    if (pb - pa).cross(pc - pa).dot(outward) < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// A mesh as a light: a triangle is chosen by area, then a point on it uniformly.
pub(crate) struct TriangleLight {
    corners: Vec<[Vec3; 3]>,
    uvs: Vec<[Vec2; 3]>,
    /// Area of all triangles up to and including each.
    cumulative_area: Vec<f32>,
}

impl TriangleLight {
    /// The light of a mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let indices: Vec<_> = mesh.indices.iter().map(|&triangle| facing_outwards(mesh, triangle)).collect();
        let position = |index: u32| Vec3::from(mesh.positions[index as usize]);
        let uv = |index: u32| mesh.uvs.as_ref().map_or(Vec2::ZERO, |uvs| uvs[index as usize].into());
        let corners: Vec<_> = indices.iter().map(|triangle| triangle.map(position)).collect();
        let mut total = 0.0_f64;
        let cumulative_area = corners.iter().map(|[a, b, c]| {
            total += f64::from(0.5 * (*b - *a).cross(*c - *a).length());
            total as f32
        });
        Self {
            cumulative_area: cumulative_area.collect(),
            uvs: indices.iter().map(|triangle| triangle.map(uv)).collect(),
            corners,
        }
    }
}

impl LightGeometry for TriangleLight {
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<LightPoint> {
        let last = self.corners.len().checked_sub(1)?;
        let target = u[0] * self.area();
        let chosen = self.cumulative_area.partition_point(|&sum| sum <= target).min(last);
        let below = if chosen == 0 { 0.0 } else { self.cumulative_area[chosen - 1] };
        let width = self.cumulative_area[chosen] - below;
        let within = if width > 0.0 { ((target - below) / width).clamp(0.0, 1.0) } else { 0.5 };
        let root = within.sqrt();
        let (v, w) = (root * (1.0 - u[1]), root * u[1]);
        let [a, b, c] = self.corners[chosen];
        let position = a + (b - a) * v + (c - a) * w;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let [uv_a, uv_b, uv_c] = self.uvs[chosen];
        let uv = uv_a + (uv_b - uv_a) * v + (uv_c - uv_a) * w;
        LightPoint::by_area(self.area(), from, position, normal, uv)
    }

    fn density(&self, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        area_to_solid_angle(self.area(), from, position, normal)
    }

    fn area(&self) -> f32 {
        self.cumulative_area.last().copied().unwrap_or(0.0)
    }
}
