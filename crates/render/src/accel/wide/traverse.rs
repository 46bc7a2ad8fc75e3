//! One ray through the tree, nearest boxes first.
#![allow(unsafe_code)] // an unchecked stack; CPU features are promised by the caller

use std::mem::MaybeUninit;

use super::collapse::Tree;
use super::lanes::{Lanes, WIDTH};
use super::leaf::LeafRay;
use super::node::{Child, GROW, SlabRay};
use super::triangle::Shear;
use crate::accel::TriangleHit;
use crate::geometry::Ray;

/// Boxes still to be visited. One entry packs the entry distance (high half) and the child (low half) of a box: distances
/// are not negative, so entries sort as integers, and each is written and read by one instruction of the same width.
struct Stack<'a> {
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

/// The first triangle with `0 < t < ray.t_max`; of several at the same distance, the one of lowest index.
///
/// # Safety
/// The CPU must support `L`; the stack must hold [`stack_len`] entries.
#[inline(always)]
pub(super) unsafe fn closest<L: Lanes>(
    tree: &Tree,
    extent: f32,
    ray: &Ray,
    stack: &mut [MaybeUninit<u64>],
) -> Option<TriangleHit> {
    // SAFETY: the caller promises the CPU and the stack; children index nodes and leaves of the same tree.
    unsafe {
        let slabs = SlabRay::<L>::new(ray, extent);
        let triangles = LeafRay::<L>::new(Shear::new(ray));
        let mut stack = Stack { entries: stack, len: 0 };
        let mut best = ray.t_max;
        let mut found = TriangleHit { t: best, u: 0.0, v: 0.0, triangle: 0 };
        let mut determinant = 0.0; // nothing found yet
        let mut reach = slabs.reach(L::splat(best));
        let mut current = Child::node(0);
        'visit: loop {
            while !current.is_leaf() {
                let node = tree.nodes.get_unchecked(current.index());
                let (mut mask, entry) = slabs.test(node, reach);
                if mask == 0 {
                    match next(&mut stack, best) {
                        Some(child) => current = child,
                        None => break 'visit,
                    }
                    continue;
                }
                let first = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                if mask == 0 {
                    current = *node.children.get_unchecked(first);
                    continue;
                }
                let distances = entry.to_array();
                let at =
                    |slot: usize| pack(*distances.get_unchecked(slot), *node.children.get_unchecked(slot));
                let a = at(first);
                let b = at(mask.trailing_zeros() as usize);
                mask &= mask - 1;
                if mask == 0 {
                    stack.push(a.max(b));
                    current = Child(a.min(b) as u32);
                    continue;
                }
                stack.push(a);
                stack.push(b);
                let mut count = 2;
                while mask != 0 {
                    stack.push(at(mask.trailing_zeros() as usize));
                    mask &= mask - 1;
                    count += 1;
                }
                stack.sort_top(count);
                current = Child(stack.pop().unwrap_unchecked() as u32);
            }
            let leaf = tree.leaves.get_unchecked(current.index());
            let mut hits = triangles.test(leaf, L::splat(best));
            if hits.mask != 0 {
                let distances = hits.t.to_array();
                let mut winner = None;
                while hits.mask != 0 {
                    let lane = hits.mask.trailing_zeros() as usize;
                    hits.mask &= hits.mask - 1;
                    let t = *distances.get_unchecked(lane);
                    let triangle = *leaf.triangles.get_unchecked(lane);
                    // No hit was found while `found.triangle` is 0, so that t_max itself never counts.
                    if t < best || (t == best && triangle < found.triangle) {
                        best = t;
                        found.triangle = triangle;
                        winner = Some(lane);
                    }
                }
                if let Some(lane) = winner {
                    found.t = best;
                    found.u = *hits.v.to_array().get_unchecked(lane);
                    found.v = *hits.w.to_array().get_unchecked(lane);
                    determinant = *hits.determinant.to_array().get_unchecked(lane);
                }
                reach = slabs.reach(L::splat(best));
            }
            match next(&mut stack, best) {
                Some(child) => current = child,
                None => break,
            }
        }
        (determinant != 0.0).then(|| TriangleHit {
            u: found.u / determinant,
            v: found.v / determinant,
            ..found
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
///
/// # Safety
/// The CPU must support `L`; the stack must hold [`stack_len`] entries.
#[inline(always)]
pub(super) unsafe fn occluded<L: Lanes>(
    tree: &Tree,
    extent: f32,
    ray: &Ray,
    stack: &mut [MaybeUninit<u64>],
) -> bool {
    // SAFETY: the caller promises the CPU and the stack; children index nodes and leaves of the same tree.
    unsafe {
        let slabs = SlabRay::<L>::new(ray, extent);
        let triangles = LeafRay::<L>::new(Shear::new(ray));
        let mut stack = Stack { entries: stack, len: 0 };
        let t_max = L::splat(ray.t_max);
        let reach = slabs.reach(t_max);
        let mut current = Child::node(0);
        loop {
            if current.is_leaf() {
                let hits = triangles.test(tree.leaves.get_unchecked(current.index()), t_max);
                if hits.mask & t_max.gt(hits.t) != 0 {
                    return true;
                }
            } else {
                let node = tree.nodes.get_unchecked(current.index());
                let (mut mask, _) = slabs.test(node, reach);
                if mask != 0 {
                    // Children are sorted by area: the last is the likeliest to be hit.
                    let last = mask.ilog2();
                    mask ^= 1 << last;
                    while mask != 0 {
                        stack.push(u64::from(node.children.get_unchecked(mask.trailing_zeros() as usize).0));
                        mask &= mask - 1;
                    }
                    current = *node.children.get_unchecked(last as usize);
                    continue;
                }
            }
            match stack.pop() {
                Some(entry) => current = Child(entry as u32),
                None => return false,
            }
        }
    }
}
