//! From a binary tree to an eight-wide one, by dynamic programming over the surface area heuristic.
//!
//! Ylitie, Karras and Laine 2017 ("Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 4.2):
//! `cost(n, i)` is the least cost of representing the subtree of node `n` as a forest of at most `i` wide trees.

use obvhs::bvh2::Bvh2;

use super::lanes::WIDTH;
use super::leaf::Leaf;
use super::node::{Child, Node};
use crate::accel::TriangleSoup;
use crate::memory::prefetch;

/// Cost of testing one inner node, in units of one leaf. Both wait for memory more than they compute; anything from 0.5 to 2
/// performs about alike.
const NODE_COST: f32 = 0.5;

/// The wide tree in traversal order.
pub(super) struct Tree {
    /// The root comes first.
    pub(super) nodes: Vec<Node>,
    /// The first is empty: the child in empty slots.
    pub(super) leaves: Vec<Leaf>,
    /// Levels of inner nodes.
    pub(super) depth: usize,
}

impl Tree {
    /// Have a node or leaf fetched from memory.
    ///
    /// # Safety
    /// It must be a child of this tree.
    #[inline(always)]
    #[allow(unsafe_code)] // as unchecked as the traversal that asks for it
    pub(super) unsafe fn prefetch(&self, child: Child) {
        // SAFETY: children index nodes and leaves of their tree.
        unsafe {
            if child.is_leaf() {
                prefetch(self.leaves.get_unchecked(child.index()));
            } else {
                prefetch(self.nodes.get_unchecked(child.index()));
            }
        }
    }
}

/// How one binary node is best represented.
#[derive(Clone, Copy, Default)]
struct Plan {
    /// `cost[i]`: as a forest of at most `i + 1` wide trees, up to 7.
    cost: [f32; WIDTH - 1],
    /// `left[i]`: how many of those trees the left child gets; 0 when one tree fewer is as good. The last one says how an
    /// inner node's eight slots are handed out.
    left: [u8; WIDTH],
    /// Triangles below.
    triangles: u32,
    /// Whether a single tree is a leaf.
    leaf: bool,
}

/// Plan all nodes bottom-up, then emit the best wide tree top-down.
pub(super) fn collapse(bvh: &Bvh2, soup: &TriangleSoup) -> Tree {
    let mut tree = Tree { nodes: vec![Node::EMPTY], leaves: vec![Leaf::new(std::iter::empty())], depth: 1 };
    if bvh.nodes.is_empty() {
        return tree;
    }
    let plans = plan(bvh);
    let mut pending = vec![(0_usize, 0_u32, 1_usize)];
    let mut children = Vec::with_capacity(WIDTH);
    while let Some((slot, root, depth)) = pending.pop() {
        tree.depth = tree.depth.max(depth);
        children.clear();
        if bvh.nodes[root as usize].is_leaf() {
            children.push(root); // a scene of one triangle
        } else {
            let first = bvh.nodes[root as usize].first_index;
            let left = usize::from(plans[root as usize].left[WIDTH - 1]);
            gather(bvh, &plans, first, left, &mut children);
            gather(bvh, &plans, first + 1, WIDTH - left, &mut children);
        }
        // The occlusion test visits the last child first: the largest is the likeliest to be hit.
        let area = |n: &u32| bvh.nodes[*n as usize].aabb().half_area();
        children.sort_by(|a, b| area(a).total_cmp(&area(b)));
        for (i, &n) in children.iter().enumerate() {
            let child = if plans[n as usize].leaf {
                tree.leaves.push(leaf(bvh, soup, n));
                Child::leaf(tree.leaves.len() - 1)
            } else {
                tree.nodes.push(Node::EMPTY);
                pending.push((tree.nodes.len() - 1, n, depth + 1));
                Child::node(tree.nodes.len() - 1)
            };
            let aabb = bvh.nodes[n as usize].aabb();
            tree.nodes[slot].set(i, aabb.min.to_array(), aabb.max.to_array(), child);
        }
    }
    tree
}

/// The plans of all nodes, children before parents.
fn plan(bvh: &Bvh2) -> Vec<Plan> {
    let mut order = vec![0_u32];
    let mut next = 0;
    while next < order.len() {
        let node = &bvh.nodes[order[next] as usize];
        if !node.is_leaf() {
            order.extend([node.first_index, node.first_index + 1]);
        }
        next += 1;
    }
    let mut plans = vec![Plan::default(); bvh.nodes.len()];
    for &n in order.iter().rev() {
        let node = &bvh.nodes[n as usize];
        let area = node.aabb().half_area();
        plans[n as usize] = if node.is_leaf() {
            Plan { cost: [area; WIDTH - 1], left: [0; WIDTH], triangles: node.prim_count, leaf: true }
        } else {
            let first = node.first_index as usize;
            plan_inner(area, &plans[first], &plans[first + 1])
        };
    }
    plans
}

fn plan_inner(area: f32, left: &Plan, right: &Plan) -> Plan {
    // The best way to hand out trees to the two children: cost, and how many go left.
    let distribute = |trees: usize| {
        (1..trees).fold((f32::INFINITY, 1), |best, k| {
            let cost = left.cost[k - 1] + right.cost[trees - k - 1];
            if cost < best.0 { (cost, k as u8) } else { best }
        })
    };
    let mut plan = Plan { triangles: left.triangles + right.triangles, ..Plan::default() };
    let (children, split) = distribute(WIDTH);
    let opened = children + area * NODE_COST;
    plan.left[WIDTH - 1] = split;
    plan.leaf = plan.triangles as usize <= WIDTH && area <= opened;
    plan.cost[0] = if plan.leaf { area } else { opened };
    for trees in 2..WIDTH {
        let (cost, split) = distribute(trees);
        let fewer = plan.cost[trees - 2];
        plan.cost[trees - 1] = cost.min(fewer);
        plan.left[trees - 1] = if cost < fewer { split } else { 0 };
    }
    plan
}

/// The roots of the best forest of at most `trees` below `n`.
fn gather(bvh: &Bvh2, plans: &[Plan], n: u32, mut trees: usize, children: &mut Vec<u32>) {
    let plan = &plans[n as usize];
    while trees > 1 && plan.left[trees - 1] == 0 {
        trees -= 1;
    }
    if trees == 1 {
        children.push(n);
    } else {
        let first = bvh.nodes[n as usize].first_index;
        let left = usize::from(plan.left[trees - 1]);
        gather(bvh, plans, first, left, children);
        gather(bvh, plans, first + 1, trees - left, children);
    }
}

/// The leaf that holds all triangles below `n`.
fn leaf(bvh: &Bvh2, soup: &TriangleSoup, n: u32) -> Leaf {
    let mut triangles = Vec::with_capacity(WIDTH);
    let mut pending = vec![n];
    while let Some(n) = pending.pop() {
        let node = &bvh.nodes[n as usize];
        let first = node.first_index;
        if node.is_leaf() {
            let range = first as usize..(first + node.prim_count) as usize;
            triangles.extend(&bvh.primitive_indices[range]);
        } else {
            pending.extend([first, first + 1]);
        }
    }
    Leaf::new(triangles.into_iter().map(|index| (index, soup.vertices(index as usize))))
}
