//! Ray kernels: which triangle does a ray meet first, and does it meet any?
//!
//! All kernels see the scene as one list of triangles in world space. They must be watertight: a ray through a shared edge
//! or vertex of a closed mesh never slips through.

use crate::geometry::Ray;

/// Where a ray met a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Ray parameter.
    pub t: f32,
    /// Barycentric weight of the triangle's second vertex.
    pub u: f32,
    /// Barycentric weight of the triangle's third vertex.
    pub v: f32,
    /// Index into the list of triangles.
    pub triangle: u32,
}

/// Triangles in world space: each triple of `indices` names three `positions`.
#[derive(Clone, Copy, Debug)]
pub struct TriangleSoup<'a> {
    /// Vertex positions; all finite.
    pub positions: &'a [[f32; 3]],
    /// Vertex indices of each triangle; all in range.
    pub indices: &'a [[u32; 3]],
}

/// A ray kernel: built once, then shared by all threads.
pub trait RayKernel: Send + Sync {
    /// The kernel's name in settings and metadata.
    fn name(&self) -> &'static str;

    /// The first triangle with `0 < t < ray.t_max`, if any.
    fn closest(&self, ray: &Ray) -> Option<TriangleHit>;

    /// Whether any triangle lies at `0 < t < ray.t_max`.
    fn occluded(&self, ray: &Ray) -> bool;
}
pub fn build(_: &str, _: TriangleSoup<'_>, _: Option<&std::path::Path>) -> crate::Result<Box<dyn RayKernel>> {
    unimplemented!()
}
