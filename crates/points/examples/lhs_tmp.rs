#![allow(clippy::all, clippy::pedantic)]
use evenlight_points::{PointSet, Seed, sequences::latin_hypercube::LatinHypercube};
use std::time::Instant;
fn main() {
    for (d, n) in [(2usize, 1u64 << 20), (8, 1 << 20), (64, 1 << 20), (64, 1_000_003), (1024, 1 << 16)] {
        let p = LatinHypercube::new(d, n, Seed::new(1));
        let mut out = vec![0.5; d * n as usize];
        let mut best = f64::INFINITY;
        for _ in 0..3 {
            let s = Instant::now();
            p.fill(0..n, &mut out);
            best = best.min(s.elapsed().as_secs_f64());
        }
        println!("d={d} n={n}: {:.0} Mcoord/s", out.len() as f64 / best / 1e6);
    }
}
