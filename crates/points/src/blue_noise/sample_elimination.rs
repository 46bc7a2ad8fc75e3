//! `sample_elimination`: from several times as many random points the most crowded is taken away, again and again.
//!
//! C. Yuksel, *Sample elimination for generating Poisson disk sample sets*, Comput. Graph. Forum 34(2), 25–32 (2015). How crowded a
//! point is, is a sum over its neighbors that falls with their distance, in units of that in the densest packing. The points
//! that are left are put in order the same way: half of them is taken away, then half of these, with the distances of the smaller
//! sets, and the last to go come first. Choose it for progressive samples in any few dimensions: closer to a full set of Poisson
//! disks than darts come, without the crystals of always taking the farthest point. O(M log M) for M random points, with a constant
//! that grows like 3^d.

use std::collections::BinaryHeap;

use super::torus::{Buckets, squared_distance};
use super::{Entry, MOST_DIMS, Request};

pub(super) const ENTRY: Entry = Entry {
    name: "sample_elimination",
    cite: "Yuksel 2015, Sample elimination for generating Poisson disk sample sets, Comput. Graph. Forum 34(2)",
    progressive: true,
    effort: ("candidates", 8),
    points,
};

fn points(request: &Request) -> Vec<f64> {
    let (n, dims) = (request.n, request.dims);
    let count = n * request.effort as usize;
    let pool = super::cloud(request, count);
    let cloud = Cloud { x: &pool, dims };
    let (mut kept, _) = cloud.eliminate((0..count as u32).collect(), n);
    let mut order = Vec::with_capacity(n);
    while kept.len() > 1 {
        let half = kept.len() / 2;
        let (left, taken) = cloud.eliminate(kept, half);
        order.extend(taken);
        kept = left;
    }
    order.extend(kept);
    order.iter().rev().flat_map(|&number| cloud.point(number)).copied().collect()
}

struct Cloud<'a> {
    x: &'a [f64],
    dims: usize,
}

impl Cloud<'_> {
    fn point(&self, number: u32) -> &[f64] {
        &self.x[number as usize * self.dims..][..self.dims]
    }

    /// Those of some points that are left when as many as wanted are, and the others, first to go first.
    fn eliminate(&self, numbers: Vec<u32>, wanted: usize) -> (Vec<u32>, Vec<u32>) {
        let crowding = Crowding::new(self.dims, wanted, numbers.len());
        let mut buckets = Buckets::new(self.dims, numbers.len(), f64::MIN_POSITIVE);
        for &number in &numbers {
            buckets.insert(self.point(number));
        }
        let neighbors = |place: usize| {
            let own = self.point(numbers[place]);
            let mut found = Vec::new();
            buckets.any(own, crowding.reach, |other| {
                let weight = crowding.weight(squared_distance(own, self.point(numbers[other])));
                found.extend((weight > 0.0 && other != place).then_some((other, weight)));
                false
            });
            found
        };
        let sum = |place: usize| neighbors(place).iter().map(|(_, weight)| weight).sum();
        let mut crowd: Vec<f64> = (0..numbers.len()).map(sum).collect();
        // bits of numbers that are not negative are in the order of the numbers
        let mut most: BinaryHeap<_> =
            (0..).zip(&crowd).map(|(place, crowd)| (crowd.to_bits(), place)).collect();
        let mut gone = vec![false; numbers.len()];
        let mut taken = Vec::with_capacity(numbers.len() - wanted);
        while taken.len() < numbers.len() - wanted {
            let (bits, place) = most.pop().expect("more points are left than wanted");
            if bits == crowd[place].to_bits() {
                gone[place] = true;
                taken.push(numbers[place]);
                for (other, weight) in neighbors(place) {
                    crowd[other] -= weight.min(crowd[other]);
                }
            } else {
                most.push((crowd[place].to_bits(), place));
            }
        }
        let left = numbers.into_iter().zip(gone).filter(|(_, gone)| !gone);
        (left.map(|(number, _)| number).collect(), taken)
    }
}

/// How a neighbor counts: w(d) = (1 − d / reach)^8, with distances below the least as that.
struct Crowding {
    reach: f64,
    least: f64,
}

impl Crowding {
    /// For some points that are to be left of so many.
    fn new(dims: usize, wanted: usize, of: usize) -> Self {
        let reach = 2.0 * (PACKING[dims - 1] / wanted as f64).powf(1.0 / dims as f64);
        let share = wanted as f64 / of as f64;
        Self { reach, least: reach * 0.65 * (1.0 - share * share.sqrt()) }
    }

    fn weight(&self, squared_distance: f64) -> f64 {
        let near = 1.0 - squared_distance.sqrt().max(self.least) / self.reach;
        let squared = near.max(0.0) * near;
        squared * squared * squared * squared
    }
}

/// For 1 to 8 dimensions the n-th part of a volume that has the side of the radius, in the densest lattices: J. H. Conway and N. J. A.
/// Sloane, *Sphere Packings, Lattices and Groups*, table 1.2.
const PACKING: [f64; MOST_DIMS] = [0.5, 0.28868, 0.17678, 0.125, 0.08839, 0.07217, 0.0625, 0.0625];
