//! Rays through the tree, nearest boxes first.
//!
//! Several rays are in flight at a time and take turns, a box each: the next box of a ray is fetched from memory while the others
//! visit theirs. One after the other, rays through a large scene wait for memory half of their time.
#![allow(unsafe_code)] // an unchecked stack; CPU features are promised by the caller

use std::marker::PhantomData;
use std::mem::MaybeUninit;
use std::ops::ControlFlow::{self, Break, Continue};

use super::collapse::Tree;
use super::lanes::{Lanes, WIDTH};
use super::leaf::Leaf;
use super::node::{Child, GROW, Node, SlabRay};
use super::triangle::Shear;
use crate::accel::TriangleHit;
use crate::geometry::Ray;

/// Rays in flight at a time.
pub(super) const FLIGHT: usize = 8;

/// Boxes still to be visited. One entry packs the entry distance (high half) and the child (low half) of a box: distances
/// are not negative, so entries sort as integers, and each is written and read by one instruction of the same width.
pub(super) struct Stack<'a> {
    entries: &'a mut [MaybeUninit<u64>],
    len: usize,
}

impl Stack<'_> {
    /// # Safety
    /// There must be room.
    #[inline(always)]
    unsafe fn push(&mut self, entry: u64) {
        // SAFETY: the caller promises room.
        unsafe { self.entries.get_unchecked_mut(self.len).write(entry) };
        self.len += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u64> {
        self.len = self.len.checked_sub(1)?;
        // SAFETY: all entries below the old length were written by `push`.
        Some(unsafe { self.entries.get_unchecked(self.len).assume_init_read() })
    }

    /// Sort the top `count` entries, nearest on top.
    #[inline(always)]
    fn sort_top(&mut self, count: usize) {
        let base = self.len - count;
        for i in base + 1..self.len {
            // SAFETY: indices run over entries that `push` wrote.
            unsafe {
                let entry = self.entries.get_unchecked(i).assume_init_read();
                let mut hole = i;
                while hole > base && self.entries.get_unchecked(hole - 1).assume_init_read() < entry {
                    *self.entries.get_unchecked_mut(hole) = *self.entries.get_unchecked(hole - 1);
                    hole -= 1;
                }
                self.entries.get_unchecked_mut(hole).write(entry);
            }
        }
    }
}

/// Stack entries that a tree of this depth may need.
pub(super) fn stack_len(depth: usize) -> usize {
    depth * WIDTH + 1
}

#[inline(always)]
fn pack(distance: f32, child: Child) -> u64 {
    u64::from(distance.to_bits()) << 32 | u64::from(child.0)
}

/// What one ray looks for, and how far it has come.
pub(super) trait Traversal: Sized {
    /// What it will have found.
    type Found;

    /// Begin at the root; `extent` bounds the absolute value of all coordinates of the scene.
    fn start(ray: &Ray, extent: f32) -> Self;

    /// Visit one box: what was found, or the box to visit next.
    ///
    /// # Safety
    /// The CPU must support the lanes. It must be the same tree at every step, and `stack` that of this ray, with [`stack_len`] entries.
    unsafe fn step(&mut self, tree: &Tree, stack: &mut Stack) -> ControlFlow<Self::Found, Child>;
}

/// A traversal under way.
struct Flight<T> {
    traversal: T,
    /// Which ray.
    number: usize,
    /// Entries on its stack.
    stack_len: usize,
}

impl<T: Traversal> Flight<T> {
    /// # Safety
    /// The ray must exist.
    #[inline(always)]
    unsafe fn new(rays: &[Ray], extent: f32, number: usize) -> Self {
        // SAFETY: the caller promises the ray.
        let ray = unsafe { rays.get_unchecked(number) };
        Self { traversal: T::start(ray, extent), number, stack_len: 0 }
    }
}

/// Send all rays through the tree.
///
/// # Safety
/// The CPU must support the lanes; there must be [`stack_len`] entries in `stacks` for each of [`FLIGHT`] rays.
#[inline(always)]
pub(super) unsafe fn each<T: Traversal>(
    (tree, extent): (&Tree, f32),
    rays: &[Ray],
    found: &mut [T::Found],
    stacks: &mut [MaybeUninit<u64>],
) {
    let room = stacks.len() / FLIGHT;
    let mut flights = [const { MaybeUninit::<Flight<T>>::uninit() }; FLIGHT];
    let mut flying = rays.len().min(FLIGHT);
    let mut slots: [usize; FLIGHT] = std::array::from_fn(|slot| slot);
    let mut launched = 0;
    // SAFETY: the caller promises the CPU and the stacks; the first `flying` slots name flights that were written.
    unsafe {
        while launched < flying {
            flights.get_unchecked_mut(launched).write(Flight::new(rays, extent, launched));
            launched += 1;
        }
        while flying > 0 {
            let mut turn = 0;
            while turn < flying {
                let slot = *slots.get_unchecked(turn);
                let flight = flights.get_unchecked_mut(slot);
                let Flight { traversal, number, stack_len } = flight.assume_init_mut();
                let entries = stacks.get_unchecked_mut(slot * room..(slot + 1) * room);
                let mut stack = Stack { entries, len: *stack_len };
                match traversal.step(tree, &mut stack) {
                    Continue(next) => {
                        tree.prefetch(next);
                        *stack_len = stack.len;
                        turn += 1;
                    }
                    Break(answer) => {
                        *found.get_unchecked_mut(*number) = answer;
                        if launched < rays.len() {
                            flight.write(Flight::new(rays, extent, launched));
                            launched += 1;
                        } else {
                            flying -= 1;
                            *slots.get_unchecked_mut(turn) = *slots.get_unchecked(flying);
                        }
                    }
                }
            }
        }
    }
}

/// The first triangle with `0 < t < ray.t_max`; of several at the same distance, the one of lowest index.
pub(super) struct Closest<L> {
    slabs: SlabRay,
    shear: Shear,
    current: Child,
    /// The closest so far; its weights are still to be divided by the determinant, which is 0 while nothing was found.
    best: TriangleHit,
    determinant: f32,
    lanes: PhantomData<L>,
}

impl<L: Lanes> Traversal for Closest<L> {
    type Found = Option<TriangleHit>;

    #[inline(always)]
    fn start(ray: &Ray, extent: f32) -> Self {
        Self {
            slabs: SlabRay::new(ray, extent),
            shear: Shear::new(ray),
            current: Child::node(0),
            best: TriangleHit { t: ray.t_max, u: 0.0, v: 0.0, triangle: 0 },
            determinant: 0.0,
            lanes: PhantomData,
        }
    }

    #[inline(always)]
    unsafe fn step(&mut self, tree: &Tree, stack: &mut Stack) -> ControlFlow<Self::Found, Child> {
        // SAFETY: children index nodes and leaves of the same tree; the caller promises room on the stack.
        unsafe {
            let nearest = if self.current.is_leaf() {
                self.visit_leaf(tree.leaves.get_unchecked(self.current.index()));
                None
            } else {
                self.visit_node(tree.nodes.get_unchecked(self.current.index()), stack)
            };
            match nearest.or_else(|| next(stack, self.best.t)) {
                Some(child) => {
                    self.current = child;
                    Continue(child)
                }
                None => Break(self.found()),
            }
        }
    }
}

impl<L: Lanes> Closest<L> {
    /// The nearest child that is hit; the others go on the stack.
    ///
    /// # Safety
    /// The CPU must support `L`, and there must be room.
    #[inline(always)]
    unsafe fn visit_node(&self, node: &Node, stack: &mut Stack) -> Option<Child> {
        // SAFETY: the caller promises the CPU and room; lanes index arrays of as many.
        unsafe {
            let (mut mask, entry) = self.slabs.test::<L>(node, self.best.t);
            if mask == 0 {
                return None;
            }
            let first = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            if mask == 0 {
                return Some(*node.children.get_unchecked(first));
            }
            let distances = entry.to_array();
            let at = |slot: usize| pack(*distances.get_unchecked(slot), *node.children.get_unchecked(slot));
            let (a, b) = (at(first), at(mask.trailing_zeros() as usize));
            mask &= mask - 1;
            let (near, far) = (a.min(b), a.max(b));
            if mask == 0 {
                stack.push(far);
                return Some(Child(near as u32));
            }
            let c = at(mask.trailing_zeros() as usize);
            mask &= mask - 1;
            if mask == 0 {
                // sorted without branches, which would be mispredicted
                stack.push(far.max(c));
                stack.push(far.min(c).max(near));
                return Some(Child(near.min(c) as u32));
            }
            stack.push(far);
            stack.push(near);
            stack.push(c);
            let mut count = 3;
            while mask != 0 {
                stack.push(at(mask.trailing_zeros() as usize));
                mask &= mask - 1;
                count += 1;
            }
            stack.sort_top(count);
            Some(Child(stack.pop().unwrap_unchecked() as u32))
        }
    }

    /// Test the triangles of a leaf.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    unsafe fn visit_leaf(&mut self, leaf: &Leaf) {
        // SAFETY: the caller promises the CPU; lanes index arrays of as many.
        unsafe {
            let mut hits = self.shear.test::<L>(leaf, self.best.t);
            if hits.mask == 0 {
                return;
            }
            let distances = hits.t.to_array();
            let mut winner = None;
            while hits.mask != 0 {
                let lane = hits.mask.trailing_zeros() as usize;
                hits.mask &= hits.mask - 1;
                let t = *distances.get_unchecked(lane);
                let triangle = *leaf.triangles.get_unchecked(lane);
                // No hit was found while the triangle is 0, so that t_max itself never counts.
                if t < self.best.t || (t == self.best.t && triangle < self.best.triangle) {
                    (self.best.t, self.best.triangle) = (t, triangle);
                    winner = Some(lane);
                }
            }
            if let Some(lane) = winner {
                self.best.u = *hits.v.to_array().get_unchecked(lane);
                self.best.v = *hits.w.to_array().get_unchecked(lane);
                self.determinant = *hits.determinant.to_array().get_unchecked(lane);
            }
        }
    }

    #[inline(always)]
    fn found(&self) -> Option<TriangleHit> {
        let Self { best, determinant, .. } = self;
        (*determinant != 0.0).then(|| TriangleHit {
            u: best.u / determinant,
            v: best.v / determinant,
            ..*best
        })
    }
}

/// The next box not farther than the best hit.
#[inline(always)]
fn next(stack: &mut Stack, best: f32) -> Option<Child> {
    loop {
        let entry = stack.pop()?;
        if f32::from_bits((entry >> 32) as u32) <= best * GROW {
            return Some(Child(entry as u32));
        }
    }
}

/// Whether any triangle lies at `0 < t < ray.t_max`. The order of visits does not matter, so nothing is sorted.
pub(super) struct Occlusion<L> {
    slabs: SlabRay,
    shear: Shear,
    current: Child,
    t_max: f32,
    lanes: PhantomData<L>,
}

impl<L: Lanes> Traversal for Occlusion<L> {
    type Found = bool;

    #[inline(always)]
    fn start(ray: &Ray, extent: f32) -> Self {
        Self {
            slabs: SlabRay::new(ray, extent),
            shear: Shear::new(ray),
            current: Child::node(0),
            t_max: ray.t_max,
            lanes: PhantomData,
        }
    }

    #[inline(always)]
    unsafe fn step(&mut self, tree: &Tree, stack: &mut Stack) -> ControlFlow<bool, Child> {
        // SAFETY: children index nodes and leaves of the same tree; the caller promises the CPU and room on the stack.
        unsafe {
            let mut next = None;
            if self.current.is_leaf() {
                let leaf = tree.leaves.get_unchecked(self.current.index());
                let hits = self.shear.test::<L>(leaf, self.t_max);
                if hits.mask & L::splat(self.t_max).gt(hits.t) != 0 {
                    return Break(true);
                }
            } else {
                let node = tree.nodes.get_unchecked(self.current.index());
                let (mut mask, _) = self.slabs.test::<L>(node, self.t_max);
                if mask != 0 {
                    // Children are sorted by area: the last is the likeliest to be hit.
                    let last = mask.ilog2();
                    mask ^= 1 << last;
                    while mask != 0 {
                        let child = *node.children.get_unchecked(mask.trailing_zeros() as usize);
                        stack.push(u64::from(child.0));
                        mask &= mask - 1;
                    }
                    next = Some(*node.children.get_unchecked(last as usize));
                }
            }
            match next.or_else(|| stack.pop().map(|entry| Child(entry as u32))) {
                Some(child) => {
                    self.current = child;
                    Continue(child)
                }
                None => Break(false),
            }
        }
    }
}
