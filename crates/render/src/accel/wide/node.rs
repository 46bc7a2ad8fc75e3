//! Inner nodes: eight child boxes tested at once against one ray.
#![allow(unsafe_code)] // loads from raw lanes; CPU features are promised by the caller

use super::lanes::{Lanes, WIDTH};
use crate::geometry::{Ray, Vec3};

/// What a node's child is: an inner node, or a leaf when [`Child::LEAF`] is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(super) struct Child(pub(super) u32);

impl Child {
    const LEAF: u32 = 1 << 31;

    /// The first leaf, which is empty.
    const EMPTY: Self = Self(Self::LEAF);

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

/// Eight boxes and what is inside. Empty slots are inside out and infinite, so that no ray meets them; a ray that is not a
/// number may, but finds an empty leaf there.
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
        children: [Child::EMPTY; WIDTH],
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
///
/// The origin is subtracted first, although `plane · inverse - shift` would save an instruction: a ray that leaves a huge level
/// surface must miss its flat box by the ray's own offset, which is nothing compared with the coordinates.
pub(super) struct SlabRay {
    origin: [f32; 3],
    inverse: [f32; 3],
    inverse_far: [f32; 3],
    margin: [f32; 3],
    /// Which of `planes` comes first on each axis, as the ray flies.
    near: [u32; 3],
}

/// How much distances grow so that no rounding cuts off a box.
pub(super) const GROW: f32 = 1.0 + 1.0 / (1 << 20) as f32;

impl SlabRay {
    /// `extent` bounds the absolute value of all coordinates of the scene.
    #[inline(always)]
    pub(super) fn new(ray: &Ray, extent: f32) -> Self {
        const CAP: f32 = (1_u64 << 40) as f32;
        let steepest = ray.direction.abs().max_element();
        // Within the scene t · steepest stays below 2 · reach, hence the capped ray strays by less than 2 · reach / CAP.
        let reach = extent + ray.origin.abs().max_element();
        let inverse =
            (Vec3::ONE / ray.direction.abs().max(Vec3::splat(steepest / CAP))).copysign(ray.direction);
        Self {
            origin: ray.origin.to_array(),
            inverse: inverse.to_array(),
            inverse_far: (inverse * GROW).to_array(),
            margin: (inverse.abs() * (4.0 / CAP * reach)).to_array(),
            near: [
                u32::from(inverse.x < 0.0),
                2 + u32::from(inverse.y < 0.0),
                4 + u32::from(inverse.z < 0.0),
            ],
        }
    }

    /// The children whose boxes the ray meets within `0 <= t <= t_max`, or a little beyond, and where it enters them.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    pub(super) unsafe fn test<L: Lanes>(&self, node: &Node, t_max: f32) -> (u32, L) {
        // SAFETY: the caller promises the CPU.
        unsafe {
            let (x, y, z) = (self.slab::<L>(node, 0), self.slab::<L>(node, 1), self.slab::<L>(node, 2));
            let entry = x.0.max(y.0).max(z.0.max(L::splat(0.0)));
            let exit = x.1.min(y.1).min(z.1.min(L::splat(t_max * GROW)));
            (entry.le(exit), entry)
        }
    }

    /// Where the ray enters and leaves the eight slabs of one axis.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    unsafe fn slab<L: Lanes>(&self, node: &Node, axis: usize) -> (L, L) {
        let near = self.near[axis] as usize;
        // SAFETY: `near` is below 6 and so is its partner; the caller promises the CPU.
        unsafe {
            let planes = &node.planes;
            let origin = L::splat(self.origin[axis]);
            let from_origin = |plane: usize| L::load(planes.get_unchecked(plane).as_ptr()).sub(origin);
            let margin = L::splat(self.margin[axis]);
            (
                from_origin(near).mul_sub(L::splat(self.inverse[axis]), margin),
                from_origin(near ^ 1).mul_add(L::splat(self.inverse_far[axis]), margin),
            )
        }
    }
}
