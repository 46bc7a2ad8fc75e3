//! The convex set that has the fewest points for its area, between two bounds.
//!
//! The best open set is a polygon. For each point that is outside some half-plane has it on its edge, and contains the set; the
//! intersection of these and of the square has no further point and at least the area; and where it has the most, each of its sides
//! touches its point. So a polygon is a chain of anchored sides once around, and its value a sum over [`super::pieces`].
//! The directions of the sides are divided into equal sectors; a sweep over them finds the best chain of (anchor, sector), in which
//! each side may be bent within its sector: an upper bound. Its directions, improved one by one, give a real polygon: a lower bound.
//! Only chains that start and end at one anchor in one range of directions are closed; ranges are halved while
//! their bound is above what is known to be attained.

use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroUsize;

use super::Convex;
use super::ascent::ascend;
use super::chains::Start;
use super::polygon::Cloud;
use super::sectors::Sweep;

/// Both bounds.
pub(super) struct Bracket {
    pub(super) lower: Convex,
    pub(super) upper: f64,
}

/// Bounds for the emptiest set; an upper bound below `known` need not be close.
pub(super) fn emptiest(cloud: &Cloud, sectors: usize, known: f64, workers: NonZeroUsize) -> Bracket {
    let anchors = cloud.within();
    let mut lower = ascend(&anchors, Vec::new());
    let quarters = (0..4).map(|quarter| f64::from(quarter - 3) * FRAC_PI_2);
    let ranges: Vec<_> = quarters.map(|low| [low, low + FRAC_PI_2]).collect();
    let each = |anchor: usize| ranges.iter().map(move |&range| Start::Anchor(anchor, range));
    let mut open: Vec<_> = (0..anchors.x.len()).flat_map(each).chain([Start::Left([0.0, 1.0])]).collect();
    let (mut upper, mut count) = (1.0, 8.min(sectors));
    while !open.is_empty() {
        let sweep = Sweep::new(&anchors, count);
        let mut leaves = Vec::new();
        while !open.is_empty() {
            let bounds = sweep.bounds(&open, workers);
            let mut order: Vec<_> = bounds.iter().zip(&open).collect();
            order.sort_by(|a, b| b.0.total_cmp(a.0));
            for (bound, start) in order.iter().take(TRIED) {
                if **bound > known.max(lower.value) {
                    let found = ascend(&anchors, sweep.chain(**start));
                    lower = if found.value > lower.value { found } else { lower };
                }
            }
            let least = known.max(lower.value) + TOLERANCE;
            let left = order.into_iter().filter(|(bound, _)| **bound > least);
            let (whole, halves): (Vec<_>, Vec<_>) = left.partition(|(_, start)| sweep.is_narrow(start));
            leaves.extend(whole.into_iter().map(|(&bound, &start)| (bound, start)));
            open = halves.into_iter().flat_map(|(_, &start)| halved(start)).collect();
        }
        let least = known.max(lower.value) + TOLERANCE;
        leaves.retain(|(bound, _)| *bound > least);
        upper = leaves.iter().map(|(bound, _)| *bound).fold(known.max(lower.value), f64::max);
        open = leaves.into_iter().map(|(_, start)| start).collect();
        count *= 2;
        if count > sectors {
            break;
        }
    }
    Bracket { lower, upper }
}

/// Chains of a round that are improved.
const TRIED: usize = 8;

/// Bounds closer than this are the same up to rounding.
const TOLERANCE: f64 = 1e-12;

fn halved(start: Start) -> [Start; 2] {
    let halves = |[low, high]: [f64; 2]| {
        let middle = 0.5 * (low + high);
        [[low, middle], [middle, high]]
    };
    match start {
        Start::Left(range) => halves(range).map(Start::Left),
        Start::Anchor(anchor, range) => halves(range).map(|range| Start::Anchor(anchor, range)),
    }
}
