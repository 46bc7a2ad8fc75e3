//! The convex set that has the most points for its area, exactly.
//!
//! Smaller is better as long as no point is lost, so that it is the convex hull of some points, perhaps of one or two. Sides are put
//! in the order of their directions; a chain of sides that goes through this list once is convex. What a side adds, with all
//! below it, depends on it alone: the points below the upper sides less those below the lower ones. So a pass for each
//! leftmost corner finds the best: O(n^3) in all (D. Eppstein, M. Overmars, G. Rote and G. Woeginger, *Finding minimum area
//! k-gons*, Discrete Comput. Geom. 7, 45–58, 1992).

use std::num::NonZeroUsize;

use super::Convex;
use super::polygon::{Cloud, Point, TIE, area, turn};

/// From a point to a later one, and what it adds as a side.
#[derive(Clone, Copy)]
struct Side {
    ends: [u32; 2],
    /// On the way there, below everything.
    lower: f64,
    /// On the way back, above everything.
    upper: f64,
}

pub(super) fn fullest(cloud: &Cloud, workers: NonZeroUsize) -> Convex {
    let sides = sides(cloud);
    let workers = workers.get().min(cloud.x.len());
    let best = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers)
            .map(|own| (own, sides.clone()))
            .map(|(own, mut sides)| {
                scope.spawn(move || {
                    let starts = (own..cloud.x.len()).step_by(workers);
                    let each = starts.map(|start| {
                        sides.retain(|side| side.ends[0] as usize >= start);
                        (best_from(cloud, &sides, start), start)
                    });
                    each.fold((0.0, 0), larger)
                })
            })
            .collect();
        let found = threads.into_iter().map(|thread| thread.join().expect("counting does not fail"));
        found.fold((0.0, 0), larger)
    });
    let mut sides = sides;
    sides.retain(|side| side.ends[0] as usize >= best.1);
    let vertices = corners(cloud, &sides, best.1);
    Convex { value: cloud.part(&vertices, true) - area(&vertices), vertices, closed: true }
}

/// The larger value, of equal ones that of the earlier start.
fn larger(a: (f64, usize), b: (f64, usize)) -> (f64, usize) {
    if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { b } else { a }
}

/// All sides, by their direction from straight down to straight up.
fn sides(cloud: &Cloud) -> Vec<Side> {
    let x = &cloud.x;
    let mut found = Vec::with_capacity(x.len() * (x.len() - 1) / 2);
    for (i, &a) in x.iter().enumerate() {
        for (j, &b) in x.iter().enumerate().skip(i + 1) {
            let (mut below, mut on) = (0.0, 0.0);
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            for (&z, share) in x[i + 1..j].iter().zip(&cloud.share[i + 1..j]) {
                let left = turn(a, b, z);
                below += if left < -TIE * length { *share } else { 0.0 };
                on += if left.abs() <= TIE * length { *share } else { 0.0 };
            }
            let area = (b[0] - a[0]) * (a[1] + b[1]) * 0.5;
            let side = Side {
                ends: [i as u32, j as u32],
                lower: area - below,
                upper: below + on + cloud.share[j] - area,
            };
            found.push(((b[1] - a[1]).atan2(b[0] - a[0]), side));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, side)| side).collect()
}

/// The most that a hull can have whose first point in order is `start`.
fn best_from(cloud: &Cloud, sides: &[Side], start: usize) -> f64 {
    let mut best = vec![f64::NEG_INFINITY; cloud.x.len()];
    best[start] = cloud.share[start];
    for side in sides {
        let [a, b] = side.ends.map(|end| end as usize);
        best[b] = best[b].max(best[a] + side.lower);
    }
    for side in sides {
        let [a, b] = side.ends.map(|end| end as usize);
        best[a] = best[a].max(best[b] + side.upper);
    }
    best[start]
}

/// The corners of that hull: the same passes, which keep where each chain came from.
fn corners(cloud: &Cloud, sides: &[Side], start: usize) -> Vec<Point> {
    // links of chains: a point, and the link before it
    let mut links = vec![(start, 0)];
    let mut best = vec![(f64::NEG_INFINITY, 0); cloud.x.len()];
    best[start].0 = cloud.share[start];
    let lower = sides.iter().map(|side| (side.ends, side.lower));
    let upper = sides.iter().map(|side| ([side.ends[1], side.ends[0]], side.upper));
    for ([from, to], adds) in lower.chain(upper) {
        let (value, link) = best[from as usize];
        if value + adds > best[to as usize].0 {
            links.push((to as usize, link));
            best[to as usize] = (value + adds, links.len() - 1);
        }
    }
    let mut found = Vec::new();
    let mut link = best[start].1;
    while link != 0 {
        link = links[link].1;
        found.push(cloud.x[links[link].0]);
    }
    found.reverse();
    if found.is_empty() { vec![cloud.x[start]] } else { found }
}
