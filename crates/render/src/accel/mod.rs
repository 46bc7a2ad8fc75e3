//! Ray kernels: which triangle does a ray meet first, and does it meet any?
//!
//! All kernels see the scene as one list of triangles in world space. They must be watertight: a ray through a shared edge
//! or vertex of a closed mesh never slips through.

mod embree;
#[cfg(test)]
mod tests;
mod wide;

use std::path::Path;
use std::str::FromStr;

pub use embree::Embree;
pub use wide::Wide;

use crate::geometry::Ray;
use crate::{Error, Result};

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

impl TriangleSoup<'_> {
    /// The vertices of one triangle.
    pub(crate) fn vertices(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.indices[triangle].map(|vertex| self.positions[vertex as usize])
    }
}

/// A ray kernel: built once, then shared by all threads.
pub trait RayKernel: Send + Sync {
    /// The kernel's name in settings and metadata.
    fn name(&self) -> &'static str;

    /// For each ray the first triangle with `0 < t < ray.t_max`, if any; `hits` has as many places as there are rays.
    fn closest_each(&self, rays: &[Ray], hits: &mut [Option<TriangleHit>]);

    /// For each ray whether any triangle lies at `0 < t < ray.t_max`; `occluded` has as many places as there are rays.
    fn occluded_each(&self, rays: &[Ray], occluded: &mut [bool]);

    /// [`RayKernel::closest_each`] for one ray. Many together are faster.
    fn closest(&self, ray: &Ray) -> Option<TriangleHit> {
        let mut hit = [None];
        self.closest_each(std::slice::from_ref(ray), &mut hit);
        hit[0]
    }

    /// [`RayKernel::occluded_each`] for one ray. Many together are faster.
    fn occluded(&self, ray: &Ray) -> bool {
        let mut occluded = [false];
        self.occluded_each(std::slice::from_ref(ray), &mut occluded);
        occluded[0]
    }
}

/// The kernels by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum KernelChoice {
    /// The faster of the watertight kernels: [`Wide`] (1.2 to 1.8 times Embree's robust mode in `examples/ray_kernels.rs`).
    #[default]
    Auto,
    /// Intel Embree 4, robust mode, from a shared library.
    Embree,
    /// The house kernel.
    Wide,
}

impl KernelChoice {
    /// All choices, in the order of error messages.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Embree, Self::Wide];

    /// The name in settings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Embree => "embree",
            Self::Wide => "wide",
        }
    }
}

impl FromStr for KernelChoice {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        Self::ALL.into_iter().find(|choice| choice.name() == name).ok_or_else(|| {
            let known = Self::ALL.map(Self::name).join(", ");
            Error::Settings(format!("unknown ray kernel '{name}'; known: {known}"))
        })
    }
}

/// Build the kernel of choice; `embree_library` is the path to the shared library of Embree 4.
///
/// # Errors
/// When Embree is asked for and its library is not given, cannot be loaded or has another version.
pub fn build(
    choice: KernelChoice,
    soup: &TriangleSoup,
    embree_library: Option<&Path>,
) -> Result<Box<dyn RayKernel>> {
    match choice {
        KernelChoice::Auto | KernelChoice::Wide => Ok(Box::new(Wide::build(soup))),
        KernelChoice::Embree => {
            let library = embree_library.ok_or_else(|| {
                Error::Settings(
                    "the ray kernel 'embree' needs the path of the shared library of Embree 4".into(),
                )
            })?;
            Ok(Box::new(Embree::build(soup, library)?))
        }
    }
}
