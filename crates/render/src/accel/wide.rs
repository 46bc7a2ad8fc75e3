//! The house kernel: an eight-wide bounding volume hierarchy in plain Rust, with AVX2 or AVX-512 where the CPU has them.
//! Needs no library, watertight, deterministic, and the fastest here: the default.
//!
//! A binary tree ([`build`]) is collapsed into eight-wide nodes ([`collapse`]); a ray tests eight boxes ([`node`]) or eight
//! triangles ([`leaf`]) at once ([`traverse`]).
#![allow(unsafe_code)] // run-time dispatch to CPU features

mod build;
mod collapse;
mod lanes;
mod leaf;
mod node;
mod traverse;
mod triangle;

use std::mem::MaybeUninit;

use super::{RayKernel, TriangleHit, TriangleSoup};
use crate::geometry::Ray;

/// Stack entries kept on the thread's own stack; enough for 63 levels, far more than any sane scene has.
const LOCAL_STACK: usize = 512;

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
        let extent = soup.positions.iter().flatten().fold(0.0, |extent: f32, x| extent.max(x.abs()));
        Self { tree, extent, instructions }
    }

    /// Run `job` with room for a traversal's stack.
    #[inline(always)]
    fn with_stack<R>(&self, job: impl FnOnce(&mut [MaybeUninit<u64>]) -> R) -> R {
        let needed = traverse::stack_len(self.tree.depth);
        if needed <= LOCAL_STACK {
            job(&mut [MaybeUninit::uninit(); LOCAL_STACK])
        } else {
            job(deep_stack(needed).as_mut())
        }
    }
}

/// A stack for a tree too deep for the local one.
#[cold]
#[inline(never)]
fn deep_stack(len: usize) -> Box<[MaybeUninit<u64>]> {
    Box::new_uninit_slice(len)
}

impl RayKernel for Wide {
    fn name(&self) -> &'static str {
        "wide"
    }

    fn closest(&self, ray: &Ray) -> Option<TriangleHit> {
        // SAFETY: `instructions` is one of those the CPU has.
        unsafe {
            match self.instructions {
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx512 => closest_avx512(self, ray),
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx2 => closest_avx2(self, ray),
                Instructions::Portable => closest_portable(self, ray),
            }
        }
    }

    fn occluded(&self, ray: &Ray) -> bool {
        // SAFETY: `instructions` is one of those the CPU has.
        unsafe {
            match self.instructions {
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx512 => occluded_avx512(self, ray),
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx2 => occluded_avx2(self, ray),
                Instructions::Portable => occluded_portable(self, ray),
            }
        }
    }
}

/// The traversals, compiled for one set of CPU features. With AVX-512 the code is that of AVX2, but the compiler has twice
/// the registers, so that the whole ray stays in them (15 % faster on a Zen 4).
macro_rules! compile {
    ($(#[$features:meta])* $lanes:ty: $closest:ident, $occluded:ident) => {
        /// # Safety
        /// The CPU must have the features.
        $(#[$features])*
        unsafe fn $closest(kernel: &Wide, ray: &Ray) -> Option<TriangleHit> {
            // SAFETY: the caller promises the CPU; the stack has the right size.
            kernel.with_stack(|stack| unsafe {
                traverse::closest::<$lanes>(&kernel.tree, kernel.extent, ray, stack)
            })
        }

        /// # Safety
        /// The CPU must have the features.
        $(#[$features])*
        unsafe fn $occluded(kernel: &Wide, ray: &Ray) -> bool {
            // SAFETY: the caller promises the CPU; the stack has the right size.
            kernel.with_stack(|stack| unsafe {
                traverse::occluded::<$lanes>(&kernel.tree, kernel.extent, ray, stack)
            })
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
