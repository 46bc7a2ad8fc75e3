//! Million coordinates per second and core of every sequence with every scramble it takes:
//! `cargo run --release -p evenlight-points --example throughput`.
#![allow(clippy::print_stdout, reason = "a command-line report")]

use std::time::Instant;

use evenlight_points::sequences::{self, Spec};
use evenlight_points::{Error, Seed};

/// Coordinates in each run, which is 8 MiB of doubles; the best of some runs counts.
const COORDINATES: usize = 1 << 20;
const RUNS: usize = 15;

fn main() -> Result<(), Error> {
    println!("{:<28}{:>8}{:>8}{:>8}{:>8}   Mcoord/s into a used buffer", "", "d=2", "d=8", "d=64", "d=1024");
    let mut out = vec![0.0; COORDINATES];
    for entry in sequences::ALL {
        for scramble in entry.accepts {
            print!("{:<28}", format!("{} / {}", entry.name, scramble.name()));
            for dims in [2, 8, 64, 1024] {
                let points = sequences::build(entry.name, &Spec::new(dims, *scramble, Seed::new(1)))?;
                let seconds = (0..RUNS).map(|_| {
                    let start = Instant::now();
                    points.fill(0..(COORDINATES / dims) as u64, &mut out);
                    start.elapsed().as_secs_f64()
                });
                print!("{:>8.0}", COORDINATES as f64 / 1e6 / seconds.fold(f64::INFINITY, f64::min));
            }
            println!();
        }
    }
    Ok(())
}
