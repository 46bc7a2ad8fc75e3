//! Million coordinates per second and core of every sequence with every scramble it takes:
//! `cargo run --release -p evenlight-points --example throughput`.
#![allow(clippy::print_stdout, reason = "a command-line report")]

use std::time::Instant;

use evenlight_points::sequences::sobol::direction_numbers;
use evenlight_points::sequences::{self, Options, Spec};
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
            for dims in [2, 8, 64, 1024].map(|dims: usize| dims.min(entry.most_dims)) {
                let n = count(entry.name, dims);
                let options = Options { n, matrices: matrices(entry.name, dims), ..Options::default() };
                let spec = Spec { options, ..Spec::new(dims, *scramble, Seed::new(1)) };
                let points = sequences::build(entry.name, &spec)?;
                if points.len().is_some_and(|len| len < (COORDINATES / dims) as u64) {
                    print!("{:>8}", "-");
                    continue;
                }
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

/// Sobol' matrices for the nets that must be given theirs.
fn matrices(sequence: &str, dims: usize) -> Option<Vec<Vec<u64>>> {
    (sequence == "digital_net").then(|| (0..dims).map(|dim| direction_numbers(dim).to_vec()).collect())
}

/// The number of points of the finite sets: about as many as there are coordinates.
fn count(sequence: &str, dims: usize) -> Option<u64> {
    match (sequence, dims) {
        (
            "latin_hypercube" | "multi_jittered" | "correlated_multi_jittered" | "hammersley" | "korobov",
            _,
        )
        | ("stratified", 2) => Some(1 << 20),
        ("stratified", 8) => Some(6_u64.pow(8)),
        ("stratified", _) => Some(1), // there is no grid
        ("orthogonal_array", _) => Some(1031 * 1031),
        ("fibonacci", _) => Some(1_346_269),
        _ => None,
    }
}
