//! Inner nodes: eight child boxes tested at once against one ray.
#![allow(unsafe_code)] // loads from raw lanes; CPU features are promised by the caller

use super::lanes::{Lanes, WIDTH, splat3};
use crate::geometry::{Ray, Vec3};

/// What a node's child is: an inner node, or a leaf when [`Child::LEAF`] is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(super) struct Child(pub(super) u32);

impl Child {
    const LEAF: u32 = 1 << 31;

    pub(super) fn leaf(index: usize) -> Self {
        Self(index as u32 | Self::LEAF)
    }

    pub(super) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    #[inline(always)]
    pub(super) fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    #[inline(always)]
    pub(super) fn index(self) -> usize {
        (self.0 & !Self::LEAF) as usize
    }
}

/// Eight boxes and what is inside. Empty slots are inside out and infinite: no ray meets them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Lower x, upper x, lower y, upper y, lower z, upper z of all children.
    planes: [[f32; WIDTH]; 6],
    /// What the boxes hold.
    pub(super) children: [Child; WIDTH],
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [Child(0); WIDTH],
    };

    pub(super) fn set(&mut self, slot: usize, lower: [f32; 3], upper: [f32; 3], child: Child) {
        for axis in 0..3 {
            self.planes[2 * axis][slot] = lower[axis];
            self.planes[2 * axis + 1][slot] = upper[axis];
        }
        self.children[slot] = child;
    }
}

/// A ray prepared for the slab test, conservative against rounding.
///
/// `(plane - origin) / direction` carries at most three roundings, so growing the far distances by `1 + 2⁻²⁰` leaves more
/// room than the `1 + 2γ(3)` of Ize 2013 ("Robust BVH Ray Traversal", JCGT 2(2)), and covers the few roundings of the sheared
/// vertices too. Where a direction component is (almost) zero its inverse is capped, and the slab grows by a margin that
/// outweighs the cap over the whole scene; thus a ray that lies in a plane of a box is inside, and no 0·∞ ever arises.
pub(super) struct SlabRay<L> {
    origin: [L; 3],
    inverse: [L; 3],
    inverse_far: [L; 3],
    margin: [L; 3],
    grow: L,
    zero: L,
    /// Which of `planes` comes first on each axis, as the ray flies.
    near: [usize; 3],
}

/// How much distances grow so that no rounding cuts off a box.
pub(super) const GROW: f32 = 1.0 + 1.0 / (1 << 20) as f32;

impl<L: Lanes> SlabRay<L> {
    /// `extent` bounds the absolute value of all coordinates of the scene.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    pub(super) unsafe fn new(ray: &Ray, extent: f32) -> Self {
        const CAP: f32 = (1_u64 << 40) as f32;
        let steepest = ray.direction.abs().max_element();
        // Within the scene t · steepest stays below 2 · reach, hence the capped ray strays by less than 2 · reach / CAP.
        let reach = extent + ray.origin.abs().max_element();
        let inverse =
            (Vec3::ONE / ray.direction.abs().max(Vec3::splat(steepest / CAP))).copysign(ray.direction);
        let margin = inverse.abs() * (4.0 / CAP * reach);
        // SAFETY: the caller promises the CPU.
        unsafe {
            Self {
                origin: splat3(ray.origin.to_array()),
                inverse: splat3(inverse.to_array()),
                inverse_far: splat3((inverse * GROW).to_array()),
                margin: splat3(margin.to_array()),
                grow: L::splat(GROW),
                zero: L::splat(0.0),
                near: [
                    usize::from(inverse.x < 0.0),
                    2 + usize::from(inverse.y < 0.0),
                    4 + usize::from(inverse.z < 0.0),
                ],
            }
        }
    }

    /// How far the slab test must look so that no box with a hit at `t_max` is missed.
    #[inline(always)]
    pub(super) fn reach(&self, t_max: L) -> L {
        t_max.mul(self.grow)
    }

    /// The children whose boxes the ray meets within `0 <= t <= reach`, and where it enters them.
    #[inline(always)]
    pub(super) fn test(&self, node: &Node, reach: L) -> (u32, L) {
        let (x, y, z) = (self.slab(node, 0), self.slab(node, 1), self.slab(node, 2));
        let entry = x.0.max(y.0).max(z.0.max(self.zero));
        let exit = x.1.min(y.1).min(z.1.min(reach));
        (entry.le(exit), entry)
    }

    /// Where the ray enters and leaves the eight slabs of one axis.
    #[inline(always)]
    fn slab(&self, node: &Node, axis: usize) -> (L, L) {
        let near = self.near[axis];
        // SAFETY: `near` is below 6 and so is its partner; `self` holds values of `L`, which prove the CPU.
        let (near, far) = unsafe {
            let planes = &node.planes;
            (L::load(planes.get_unchecked(near).as_ptr()), L::load(planes.get_unchecked(near ^ 1).as_ptr()))
        };
        (
            near.sub(self.origin[axis]).mul_sub(self.inverse[axis], self.margin[axis]),
            far.sub(self.origin[axis]).mul_add(self.inverse_far[axis], self.margin[axis]),
        )
    }
}
