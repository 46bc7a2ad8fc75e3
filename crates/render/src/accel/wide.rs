//! The house kernel: an eight-wide bounding volume hierarchy in plain Rust with AVX2 where the CPU has it. Needs no library,
//! watertight, deterministic: the default.
//!
//! A binary tree (PLOC with reinsertion, from `obvhs`) is collapsed into eight-wide nodes ([`collapse`]); a ray tests eight
//! boxes ([`node`]) or a handful of triangles ([`leaf`]) at once ([`traverse`]).
#![allow(unsafe_code)] // run-time dispatch to AVX2

mod collapse;
mod lanes;
mod leaf;
mod node;
mod traverse;
mod triangle;

use std::mem::MaybeUninit;

use glam::Vec3A;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::splits::split_aabbs_preset;
use obvhs::triangle::Triangle;

use super::{RayKernel, TriangleHit, TriangleSoup};
use crate::geometry::Ray;

/// Stack entries kept on the thread's own stack; enough for trees of 63 levels, deeper than any sane scene.
const LOCAL_STACK: usize = 512;

/// The eight-wide kernel.
pub struct Wide {
    tree: collapse::Tree,
    /// Greatest absolute coordinate.
    extent: f32,
    instructions: Instructions,
}

/// Which implementation of the vector operations runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Instructions {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
}

impl Instructions {
    fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            return Self::Avx2;
        }
        Self::Portable
    }
}

impl Wide {
    /// Build the tree.
    pub fn build(soup: &TriangleSoup) -> Self {
        Self::build_with(soup, Instructions::detect())
    }

    fn build_with(soup: &TriangleSoup, instructions: Instructions) -> Self {
        let triangles: Vec<Triangle> = (0..soup.indices.len())
            .map(|i| {
                let [v0, v1, v2] = soup.vertices(i).map(Vec3A::from_array);
                Triangle { v0, v1, v2 }
            })
            .collect();
        let extent = soup.positions.iter().flatten().fold(0.0, |extent: f32, x| extent.max(x.abs()));
        let mut indices: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut boxes: Vec<_> = triangles.iter().map(Triangle::aabb).collect();
        let (total, largest) = boxes.iter().fold((0.0, 0.0_f32), |(total, largest), b| {
            (total + f64::from(b.half_area()), largest.max(b.half_area()))
        });
        if std::env::var("SPLIT").is_ok() {
            split_aabbs_preset(
                &mut boxes,
                &mut indices,
                &triangles,
                (total / triangles.len() as f64) as f32,
                largest,
            );
        }
        let ratio = std::env::var("RATIO").map_or(0.2, |s| s.parse().unwrap());
        let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
            PlocSearchDistance::High,
            &boxes,
            indices,
            SortPrecision::U64,
            2,
        );
        ReinsertionOptimizer::default().run(&mut bvh, ratio, None);
        let tree = collapse::collapse(&bvh, soup);
        eprintln!(
            "nodes {} leaves {} depth {} children/node {:.2} tris/leaf {:.2}",
            tree.nodes.len(),
            tree.leaves.len(),
            tree.depth,
            (tree.nodes.len() + tree.leaves.len()) as f32 / tree.nodes.len() as f32,
            boxes.len() as f32 / tree.leaves.len() as f32
        );
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
        match self.instructions {
            // SAFETY: `detect` found the CPU features.
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => unsafe { closest_avx2(self, ray) },
            Instructions::Portable => {
                self.with_stack(|stack| {
                    // SAFETY: arrays run everywhere; the stack has the right size.
                    unsafe {
                        traverse::closest::<
                            lanes::Array<{ node::NODE_WIDTH }>,
                            lanes::Array<{ leaf::LEAF_WIDTH }>,
                        >(&self.tree, self.extent, ray, stack)
                    }
                })
            }
        }
    }

    fn occluded(&self, ray: &Ray) -> bool {
        match self.instructions {
            // SAFETY: `detect` found the CPU features.
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => unsafe { occluded_avx2(self, ray) },
            Instructions::Portable => {
                self.with_stack(|stack| {
                    // SAFETY: arrays run everywhere; the stack has the right size.
                    unsafe {
                        traverse::occluded::<
                            lanes::Array<{ node::NODE_WIDTH }>,
                            lanes::Array<{ leaf::LEAF_WIDTH }>,
                        >(&self.tree, self.extent, ray, stack)
                    }
                })
            }
        }
    }
}

/// # Safety
/// The CPU must have AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt")]
unsafe fn closest_avx2(kernel: &Wide, ray: &Ray) -> Option<TriangleHit> {
    // SAFETY: the caller promises the CPU; the stack has the right size.
    kernel.with_stack(
        #[inline(always)]
        |stack| unsafe {
            traverse::closest::<lanes::Avx8, lanes::Sse4>(&kernel.tree, kernel.extent, ray, stack)
        },
    )
}

/// # Safety
/// The CPU must have AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt")]
unsafe fn occluded_avx2(kernel: &Wide, ray: &Ray) -> bool {
    // SAFETY: the caller promises the CPU; the stack has the right size.
    kernel.with_stack(
        #[inline(always)]
        |stack| unsafe {
            traverse::occluded::<lanes::Avx8, lanes::Sse4>(&kernel.tree, kernel.extent, ray, stack)
        },
    )
}
