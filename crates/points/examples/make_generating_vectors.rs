//! Constructs the generating vectors that ship with the crate, and writes them or compares them with those there are.
//!
//! `cargo run --release -p evenlight-points --example make_generating_vectors -- write` takes some minutes; `check` instead
//! of `write` changes nothing and fails if there is a difference. A number after it bounds the dimensions that are looked at.

use std::path::Path;
use std::process::ExitCode;

use evenlight_points::construction;
use evenlight_points::quality::lattice_criteria::Space;

/// Bytes of a number, little-endian.
const RECORD: usize = 3;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let write = match arguments.next().as_deref() {
        Some("write") => true,
        Some("check") => false,
        _ => return ExitCode::FAILURE,
    };
    let most = arguments.next().and_then(|number| number.parse().ok()).unwrap_or(usize::MAX);
    let weights = |dims: usize| (1..=dims.min(most)).map(|j| 1.0 / (j * j) as f64).collect::<Vec<_>>();
    let lattice = construction::lattice(1 << 20, Some(1 << 10), &weights(3600), Space::Sobolev);
    let polynomials = construction::polynomial_lattice(1 << 18, Some(1 << 8), &weights(2048));
    let mut same = true;
    for (name, numbers) in [("lattice.bin", lattice), ("polynomial_lattice.bin", polynomials)] {
        let numbers = numbers.expect("the request is legal");
        let records: Vec<_> =
            numbers.iter().flat_map(|number| number.to_le_bytes()[..RECORD].to_vec()).collect();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/data").join(name);
        if write {
            std::fs::write(&path, &records).expect("the folder is writable");
        }
        same &= std::fs::read(&path).is_ok_and(|bytes| bytes.starts_with(&records));
    }
    if same { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
