//! The house kernel: an eight-wide bounding volume hierarchy in plain Rust, with AVX2 or AVX-512 where the CPU has them.
//! Needs no library, watertight, deterministic, and the fastest here: the default.
//!
//! A binary tree ([`build`]) is collapsed into eight-wide nodes ([`collapse`]); a ray tests eight boxes ([`node`]) or eight
//! triangles ([`leaf`]) at once, and several rays take turns ([`traverse`]).
#![allow(unsafe_code)] // run-time dispatch to CPU features

mod build;
mod collapse;
mod lanes;
mod leaf;
mod node;
mod traverse;
mod triangle;

use std::mem::MaybeUninit;

use traverse::{Closest, FLIGHT, Occlusion};

use super::{RayKernel, TriangleHit, TriangleSoup};
use crate::geometry::Ray;
use crate::memory::use_large_pages;

/// Stack entries of one ray kept on the thread's own stack; enough for 24 levels, more than most scenes have. No power of two, or
/// the stacks of rays in flight would compete for the same few lines of the cache.
const LOCAL_STACK: usize = 200;

/// The eight-wide kernel.
pub struct Wide {
    tree: collapse::Tree,
    /// Greatest absolute coordinate.
    extent: f32,
    instructions: Instructions,
}

/// Which compilation of the traversal runs. All find the same hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Instructions {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Instructions {
    /// All that this CPU can run, the fastest last.
    fn available() -> Vec<Self> {
        #[cfg_attr(not(target_arch = "x86_64"), allow(unused_mut))]
        let mut available = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
        {
            available.push(Self::Avx2);
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
            {
                available.push(Self::Avx512);
            }
        }
        available
    }
}

impl Wide {
    /// Build the tree.
    pub fn build(soup: &TriangleSoup) -> Self {
        let instructions = Instructions::available().pop().unwrap_or(Instructions::Portable);
        Self::build_for(soup, instructions)
    }

    /// One kernel for each instruction set of this CPU.
    #[cfg(test)]
    pub(super) fn build_all(soup: &TriangleSoup) -> Vec<Self> {
        Instructions::available()
            .into_iter()
            .map(|instructions| Self::build_for(soup, instructions))
            .collect()
    }

    fn build_for(soup: &TriangleSoup, instructions: Instructions) -> Self {
        let tree = collapse::collapse(&build::binary_tree(soup), soup);
        use_large_pages(&tree.nodes);
        use_large_pages(&tree.leaves);
        let extent = soup.positions.iter().flatten().fold(0.0, |extent: f32, x| extent.max(x.abs()));
        Self { tree, extent, instructions }
    }

    /// Run `job` with room for the stacks of all rays in flight.
    #[inline(always)]
    fn with_stacks(&self, job: impl FnOnce(&mut [MaybeUninit<u64>])) {
        let needed = traverse::stack_len(self.tree.depth);
        if needed <= LOCAL_STACK {
            job(&mut [MaybeUninit::uninit(); LOCAL_STACK * FLIGHT]);
        } else {
            job(deep_stacks(needed).as_mut());
        }
    }
}

/// Stacks for a tree too deep for the local ones.
#[cold]
#[inline(never)]
fn deep_stacks(len: usize) -> Box<[MaybeUninit<u64>]> {
    Box::new_uninit_slice(len * FLIGHT)
}

impl RayKernel for Wide {
    fn name(&self) -> &'static str {
        "wide"
    }

    fn closest_each(&self, rays: &[Ray], hits: &mut [Option<TriangleHit>]) {
        assert_eq!(rays.len(), hits.len());
        // SAFETY: `instructions` is one of those the CPU has; there is a place for each ray.
        unsafe {
            match self.instructions {
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx512 => closest_avx512(self, rays, hits),
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx2 => closest_avx2(self, rays, hits),
                Instructions::Portable => closest_portable(self, rays, hits),
            }
        }
    }

    fn occluded_each(&self, rays: &[Ray], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len());
        // SAFETY: `instructions` is one of those the CPU has; there is a place for each ray.
        unsafe {
            match self.instructions {
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx512 => occluded_avx512(self, rays, occluded),
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx2 => occluded_avx2(self, rays, occluded),
                Instructions::Portable => occluded_portable(self, rays, occluded),
            }
        }
    }
}

/// The traversals, compiled for one set of CPU features. With AVX-512 the code is that of AVX2, but the compiler has twice
/// the registers, so that the whole ray stays in them (15 % faster on a Zen 4).
macro_rules! compile {
    ($(#[$features:meta])* $lanes:ty: $closest:ident, $occluded:ident) => {
        /// # Safety
        /// The CPU must have the features, and there must be as many places as rays.
        $(#[$features])*
        unsafe fn $closest(kernel: &Wide, rays: &[Ray], hits: &mut [Option<TriangleHit>]) {
            // SAFETY: the caller promises the CPU and the places; the stacks have the right size.
            kernel.with_stacks(|stacks| unsafe {
                traverse::each::<Closest<$lanes>>((&kernel.tree, kernel.extent), rays, hits, stacks);
            });
        }

        /// # Safety
        /// The CPU must have the features, and there must be as many places as rays.
        $(#[$features])*
        unsafe fn $occluded(kernel: &Wide, rays: &[Ray], occluded: &mut [bool]) {
            // SAFETY: the caller promises the CPU and the places; the stacks have the right size.
            kernel.with_stacks(|stacks| unsafe {
                traverse::each::<Occlusion<$lanes>>((&kernel.tree, kernel.extent), rays, occluded, stacks);
            });
        }
    };
}

compile!(lanes::Portable: closest_portable, occluded_portable);

#[cfg(target_arch = "x86_64")]
compile! {
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt")]
    lanes::Avx: closest_avx2, occluded_avx2
}

#[cfg(target_arch = "x86_64")]
compile! {
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,avx512f,avx512vl,avx512dq,avx512bw")]
    lanes::Avx: closest_avx512, occluded_avx512
}

/// The closest hit by trying all triangles: what the tests compare with.
#[cfg(test)]
pub(super) fn brute_force(soup: &TriangleSoup, ray: &Ray) -> Option<TriangleHit> {
    let shear = triangle::Shear::new(ray);
    let mut closest: Option<TriangleHit> = None;
    for index in 0..soup.indices.len() {
        if let Some(triangle::Meeting { t, v, w, determinant }) = shear.meet(soup.vertices(index))
            && t > 0.0
            && t < closest.map_or(ray.t_max, |hit| hit.t)
        {
            closest = Some(TriangleHit { t, u: v / determinant, v: w / determinant, triangle: index as u32 });
        }
    }
    closest
}
