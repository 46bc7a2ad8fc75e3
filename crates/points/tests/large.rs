//! Large arrays are written past the caches, and by several threads: with the bits of small ones.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Spec};
use evenlight_points::{PointSet, Seed, fill_parallel, fill_parallel_f32};

/// Enough to be written past the caches in either precision, even if four threads share it.
const PLACES: usize = 1 << 23;

/// A start in the middle of everything.
const START: u64 = (1 << 33) - 1003;

fn sobol(dims: usize, scramble: &str) -> Box<dyn PointSet> {
    let randomization = Randomization::named(scramble).expect("known");
    sequences::build("sobol", &Spec::new(dims, randomization, Seed::new(5))).expect("valid")
}

/// Rows that were asked for a few at a time.
fn in_pieces<T: Copy + Default>(
    dims: usize,
    rows: u64,
    fill: impl Fn(std::ops::Range<u64>, &mut [T]),
) -> Vec<T> {
    let mut out = vec![T::default(); rows as usize * dims];
    let piece = 5000 / dims + 1;
    for (start, part) in (START..).step_by(piece).zip(out.chunks_mut(piece * dims)) {
        fill(start..start + (part.len() / dims) as u64, part);
    }
    out
}

#[test]
fn arrays_beyond_the_caches_have_the_bits_of_small_ones() {
    for (dims, scramble) in [
        (1, "owen"),
        (3, "digital_shift"),
        (64, "owen"),
        (1027, "none"),
        (5, "owen_exact"),
        (7, "shift"),
        (9, "linear"),
    ] {
        let points = sobol(dims, scramble);
        let rows = (PLACES / dims) as u64;
        // One place later than the allocation: lines of cache begin elsewhere.
        let mut doubles = vec![f64::NAN; rows as usize * dims + 1];
        points.fill(START..START + rows, &mut doubles[1..]);
        assert!(
            doubles[1..] == in_pieces(dims, rows, |rows, out| points.fill(rows, out)),
            "{dims} {scramble}"
        );
        let mut singles = vec![f32::NAN; rows as usize * dims + 1];
        points.fill_f32(START..START + rows, &mut singles[1..]);
        assert!(
            singles[1..] == in_pieces(dims, rows, |rows, out| points.fill_f32(rows, out)),
            "{dims} {scramble}"
        );
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for (rows, dims) in [(PLACES / 3, 3), (70_001, 7), (100, 5000), (10, 2), (0, 4)] {
        let points = sobol(dims, "owen");
        let range = START..START + rows as u64;
        let mut wanted = vec![f64::NAN; rows * dims];
        points.fill(range.clone(), &mut wanted);
        let mut singles = vec![f32::NAN; rows * dims];
        points.fill_f32(range.clone(), &mut singles);
        for workers in [1, 2, 3, 17] {
            let workers = workers.try_into().expect("not zero");
            let (mut out, mut out_f32) = (vec![f64::NAN; rows * dims], vec![f32::NAN; rows * dims]);
            fill_parallel(&*points, range.clone(), &mut out, workers);
            fill_parallel_f32(&*points, range.clone(), &mut out_f32, workers);
            assert!(out == wanted && out_f32 == singles, "{rows} × {dims}, {workers} threads");
        }
    }
}

#[test]
#[should_panic(expected = "need 20 places, not 19")]
fn an_array_of_the_wrong_length_is_refused_before_any_thread_starts() {
    fill_parallel(&*sobol(2, "owen"), 0..10, &mut [0.0; 19], 4.try_into().expect("not zero"));
}
