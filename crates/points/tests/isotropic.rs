//! The isotropic discrepancy against the hulls of all subsets, exact answers, and convex sets that nobody chose.

use std::num::NonZeroUsize;

use evenlight_points::Seed;
use evenlight_points::convert::unit_f64;
use evenlight_points::quality::Rows;
use evenlight_points::quality::isotropic::{Isotropic, isotropic_discrepancy};
use evenlight_points::quality::star::{Settings, star_discrepancy};

type Point = [f64; 2];

fn random(seed: u64, n: u64) -> Vec<Point> {
    let number = |i: u64| unit_f64(Seed::new(seed).dimension(i).bits64());
    (0..n).map(|i| [number(2 * i), number(2 * i + 1)]).collect()
}

fn isotropic(points: &[Point], sectors: usize, workers: usize) -> Isotropic {
    let rows = Rows::new(points.as_flattened(), 2).expect("points");
    isotropic_discrepancy(&rows, sectors, NonZeroUsize::new(workers).expect("threads")).expect("an answer")
}

fn turn(a: Point, b: Point, z: Point) -> f64 {
    (b[0] - a[0]) * (z[1] - a[1]) - (b[1] - a[1]) * (z[0] - a[0])
}

/// The corners of a hull, counterclockwise, by Andrew's chains.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for z in points {
            while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], z) <= 0.0 {
                chain.pop();
            }
            chain.push(z);
        }
        chain.pop();
        chain
    };
    let (lower, upper) = (half(&mut points.iter().copied()), half(&mut points.iter().rev().copied()));
    if points.len() == 1 { points } else { [lower, upper].concat() }
}

fn area(polygon: &[Point]) -> f64 {
    (1..polygon.len()).map(|i| turn(polygon[0], polygon[i - 1], polygon[i])).sum::<f64>() / 2.0
}

/// The most that the hull of a subset has, each subset with all that its hull contains: a point is in it if it does not change it.
fn fullest(points: &[Point]) -> f64 {
    let mut best = 0.0_f64;
    for chosen in 1..1_u32 << points.len() {
        let subset: Vec<_> = (0..points.len()).filter(|i| chosen >> i & 1 == 1).map(|i| points[i]).collect();
        best = best.max(subset.len() as f64 / points.len() as f64 - area(&hull(subset)));
    }
    best
}

#[test]
fn too_many_points_are_those_of_the_best_subset() {
    for case in 0..60_u64 {
        let mut points = random(case, 1 + case % 10);
        if case % 3 == 0 {
            // many on one line, some the same
            points.iter_mut().flatten().for_each(|x| *x = (*x * 5.0).floor() / 4.0);
        }
        let (found, wanted) = (isotropic(&points, 8, 1), fullest(&points));
        assert!(found.worst.value >= wanted - 1e-12, "case {case}: {} {wanted}", found.worst.value);
        if found.worst.closed {
            assert!(
                (found.worst.value - wanted).abs() < 1e-12,
                "case {case}: {} {wanted}",
                found.worst.value
            );
        }
    }
}

/// The area less the part of the points that is in the square to the left of some lines.
fn emptiness(points: &[Point], lines: &[[Point; 2]]) -> f64 {
    let mut polygon = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    for &[a, b] in lines {
        let whole = std::mem::take(&mut polygon);
        for (i, &z) in whole.iter().enumerate() {
            let y = whole[(i + whole.len() - 1) % whole.len()];
            let (before, after) = (turn(a, b, y), turn(a, b, z));
            if before * after < 0.0 {
                let t = before / (before - after);
                polygon.push([y[0] + t * (z[0] - y[0]), y[1] + t * (z[1] - y[1])]);
            }
            if after >= 0.0 {
                polygon.push(z);
            }
        }
    }
    let open = |z: Point| z.iter().all(|&x| 0.0 < x && x < 1.0);
    let inside = |z: &&Point| open(**z) && lines.iter().all(|&[a, b]| turn(a, b, **z) > 1e-12);
    let count = points.iter().filter(inside).count();
    (if polygon.is_empty() { 0.0 } else { area(&polygon) }) - count as f64 / points.len() as f64
}

#[test]
fn no_convex_set_is_beyond_the_upper_bound() {
    for case in 0..24_u64 {
        let mut points = random(case, 1 + case % 12);
        if case % 3 == 0 {
            points.iter_mut().flatten().for_each(|x| *x = (*x * 7.0).floor() / 8.0 + 0.0625);
        }
        let found = isotropic(&points, 32, 1);
        assert!(found.worst.value <= found.upper);
        // all triples of lines through two points, and lines through points in random directions
        let pairs = points.iter().flat_map(|&a| points.iter().map(move |&b| [a, b])).filter(|[a, b]| a != b);
        let turned = random(100 + case, 40).into_iter().zip(points.iter().cycle());
        let turned = turned.map(|(u, &a)| [a, [a[0] + u[0] - 0.5, a[1] + u[1] - 0.5]]);
        let lines: Vec<_> = pairs.chain(turned).collect();
        for trial in 0..20_000_u64 {
            let word = Seed::new(case).dimension(trial).bits64();
            let chosen = |part: u64| lines[(word >> (12 * part)) as usize % lines.len()];
            let some: Vec<_> = (0..=(word >> 60 & 3)).map(chosen).collect();
            let value = emptiness(&points, &some);
            assert!(value <= found.upper + 1e-12, "case {case}: {value} {}", found.upper);
        }
    }
}

#[test]
fn bounds_meet_and_say_which_set_attains_them() {
    // a point has no area; nor has a diagonal
    assert_eq!(isotropic(&[[0.3, 0.6]], 64, 1).worst.value, 1.0);
    let diagonal: Vec<_> = (0..8).map(|i| [f64::from(i) / 8.0; 2]).collect();
    let found = isotropic(&diagonal, 8, 1);
    assert_eq!((found.worst.value, found.upper, found.worst.vertices.len()), (1.0, 1.0, 2));
    // all points in the corners: nothing is inside the square
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let found = isotropic(&corners, 8, 1);
    assert_eq!((found.worst.value, found.upper, found.worst.closed), (1.0, 1.0, false));
    let exact = isotropic(&random(16, 16), 64, 1);
    assert_eq!(exact.worst.value, exact.upper);
}

#[test]
fn more_sectors_tighten_threads_change_nothing_and_boxes_are_convex() {
    for case in 0..6_u64 {
        let points = random(200 + case, 12 + case);
        let (coarse, fine) = (isotropic(&points, 8, 1), isotropic(&points, 32, 1));
        assert!(fine.upper <= coarse.upper && fine.worst.value >= coarse.worst.value);
        assert_eq!(fine, isotropic(&points, 32, 3));
        let rows = Rows::new(points.as_flattened(), 2).expect("points");
        let star =
            star_discrepancy(&rows, &Settings::default(), &mut |_| true).expect("legal").expect("found");
        assert!(star.value <= fine.upper);
    }
}

#[test]
fn what_is_too_much_is_refused() {
    let refused = |numbers: &[f64], dims, sectors| {
        let rows = Rows::new(numbers, dims).expect("points");
        isotropic_discrepancy(&rows, sectors, NonZeroUsize::MIN).expect_err("refused").to_string()
    };
    assert!(refused(&[0.5; 3], 3, 8).contains("for 2 dimensions, not 3"));
    assert!(refused(&vec![0.5; 2050], 2, 8).contains("at most 1024 points, not 1025"));
    assert!(refused(&[0.5; 2], 2, 12).contains("power of 2 from 8 to 4096, not 12"));
    assert!(refused(&vec![0.5; 2000], 2, 512).contains("take fewer sectors"));
}
