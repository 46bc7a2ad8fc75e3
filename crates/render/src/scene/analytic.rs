//! The analytic shapes of a scene in a tree of boxes, so that hundreds of spheres cost little more than a few.
//!
//! The nodes lie in depth-first order, and each knows where to go on when a ray misses its box: no stack is needed (Smits 1998,
//! "Efficiency Issues for Ray Tracing", JGT 3(2)).

use std::sync::Arc;

use crate::geometry::{Ray, Vec3};
use crate::shape::Analytic;

/// An analytic shape and its number in the scene.
pub(crate) type Numbered = (u32, Arc<dyn Analytic>);

/// A box, what is in it, and the node after all that is in it.
struct Node {
    low: Vec3,
    high: Vec3,
    next: u32,
    shape: Option<Numbered>,
}

/// All analytic shapes of a scene.
#[derive(Default)]
pub(crate) struct AnalyticShapes {
    nodes: Vec<Node>,
}

impl AnalyticShapes {
    /// Put the shapes into a tree.
    pub(crate) fn new(shapes: Vec<Numbered>) -> Self {
        let mut tree = Self::default();
        if !shapes.is_empty() {
            tree.push(shapes.into_iter().map(|shape| (shape.1.bounds(), shape)).collect());
        }
        tree
    }

    /// Whether there are none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Append the tree of one or more shapes, halved at the median of their centers along the axis in which these lie furthest apart.
    fn push(&mut self, mut shapes: Vec<([Vec3; 2], Numbered)>) {
        let empty = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        let around = |[low, high]: [Vec3; 2], [a, b]: [Vec3; 2]| [low.min(a), high.max(b)];
        let [low, high] = shapes.iter().map(|(bounds, _)| *bounds).fold(empty, around);
        let number = self.nodes.len();
        self.nodes.push(Node { low, high, next: 0, shape: None });
        if shapes.len() == 1 {
            self.nodes[number].shape = shapes.pop().map(|(_, shape)| shape);
        } else {
            let center = |[low, high]: &[Vec3; 2]| low.midpoint(*high);
            let centers = shapes.iter().map(|(bounds, _)| [center(bounds); 2]).fold(empty, around);
            let axis = (centers[1] - centers[0]).max_position();
            shapes.sort_by(|(a, _), (b, _)| center(a)[axis].total_cmp(&center(b)[axis]));
            let upper = shapes.split_off(shapes.len() / 2);
            self.push(shapes);
            self.push(upper);
        }
        self.nodes[number].next = self.nodes.len() as u32;
    }

    /// The first shape on a ray, and where.
    pub(crate) fn closest(&self, mut ray: Ray) -> Option<(u32, f32)> {
        let mut first = None;
        self.visit(&mut ray, |ray, shape, t| {
            ray.t_max = t;
            first = Some((shape, t));
            true
        });
        first
    }

    /// Whether any shape lies on a ray.
    pub(crate) fn occluded(&self, mut ray: Ray) -> bool {
        let mut any = false;
        self.visit(&mut ray, |_, _, _| {
            any = true;
            false
        });
        any
    }

    /// Show every shape that is met in `(0, ray.t_max)` to `see`, which may shorten the ray and says whether to go on.
    #[inline]
    fn visit(&self, ray: &mut Ray, mut see: impl FnMut(&mut Ray, u32, f32) -> bool) {
        let inverse = ray.direction.recip();
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            at += 1;
            if node.missed(ray, inverse) {
                at = node.next as usize;
            } else if let Some((number, shape)) = &node.shape {
                let met = shape.intersect(ray).filter(|t| *t < ray.t_max);
                if met.is_some_and(|t| !see(ray, *number, t)) {
                    return;
                }
            }
        }
    }
}

impl Node {
    /// NaN (a ray in a face of the box) is no miss: the comparisons are written to keep it.
    #[inline]
    fn missed(&self, ray: &Ray, inverse: Vec3) -> bool {
        let (a, b) = ((self.low - ray.origin) * inverse, (self.high - ray.origin) * inverse);
        let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
        enter > leave * 1.0001 || leave < 0.0 || enter > ray.t_max
    }
}
