//! `poisson_disk`: darts that are refused near earlier ones, with a distance that shrinks when no place is left.
//!
//! M. `McCool` and E. Fiume, *Hierarchical Poisson disk sampling distributions*, Graphics Interface, 94–105 (1992). Every beginning
//! is a set of Poisson disks, nearly full. A full set of radius r is where classic spectra of blue noise come from; choose it where
//! points should be as random as their distance allows. O(n · darts), in any dimension but with 3^d buckets to look at.

use super::torus::{Buckets, squared_distance};
use super::{Entry, Request, uniform};

pub(super) const ENTRY: Entry = Entry {
    name: "poisson_disk",
    cite: "McCool & Fiume 1992, Hierarchical Poisson disk sampling distributions, Graphics Interface",
    progressive: true,
    effort: ("darts", 16),
    points,
};

/// Distances for one doubling of the number of points.
const STEPS: f64 = 4.0;

fn points(request: &Request) -> Vec<f64> {
    let (n, dims) = (request.n, request.dims);
    let mut x: Vec<f64> = Vec::with_capacity(n * dims);
    // no two points of the torus are farther apart
    let mut radius = 0.5 * (dims as f64).sqrt();
    let mut next = 0;
    while x.len() < n * dims {
        let mut buckets = Buckets::new(dims, 2 * (x.len() / dims + 1), radius);
        x.chunks_exact(dims).for_each(|x| buckets.insert(x));
        let mut darts = u64::from(request.effort) * (x.len() / dims + 1) as u64;
        while darts > 0 && x.len() < n * dims {
            let dart: Vec<f64> = uniform(request.seed, next..next + dims as u64).collect();
            (darts, next) = (darts - 1, next + dims as u64);
            let near = |other: usize| squared_distance(&dart, &x[other * dims..][..dims]) < radius * radius;
            if !buckets.any(&dart, radius, near) {
                buckets.insert(&dart);
                x.extend(dart);
            }
        }
        radius *= 0.5_f64.powf(1.0 / (STEPS * dims as f64));
    }
    x
}
