//! The binary tree the wide one is made from: parallel locally-ordered clustering (Meister and Bittner 2018), then
//! reinsertion (Meister and Bittner 2018), both from `obvhs`. One triangle per leaf, so that the collapse has all the choice.

use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::accel::TriangleSoup;

/// Share of the nodes tried for reinsertion per round: more rounds gained less than the noise of the measurement.
const REINSERTION: f32 = 0.2;

/// Rounds of clustering that look at direct neighbors only, where that is nearly as good and much faster.
const QUICK_ROUNDS: usize = 2;

/// A binary tree over all triangles.
pub(super) fn binary_tree(soup: &TriangleSoup) -> Bvh2 {
    let boxes: Vec<Aabb> = (0..soup.indices.len())
        .map(|triangle| Aabb::from_points(&soup.vertices(triangle).map(Vec3A::from_array)))
        .collect();
    let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
        PlocSearchDistance::High,
        &boxes,
        (0..boxes.len() as u32).collect(),
        SortPrecision::U64,
        QUICK_ROUNDS,
    );
    ReinsertionOptimizer::default().run(&mut bvh, REINSERTION, None);
    bvh
}
