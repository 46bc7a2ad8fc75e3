//! Known numbers of the constructions: elementary intervals, star discrepancies.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Options, Spec};
use evenlight_points::{PointSet, Seed};

fn build(name: &str, dims: usize, scramble: &str, seed: u64) -> Box<dyn PointSet> {
    let randomization = Randomization::named(scramble).expect("known");
    sequences::build(name, &Spec::new(dims, randomization, Seed::new(seed))).expect("valid")
}

/// With the number of points of a finite set, and the base of a sequence that has a choice.
fn build_with(name: &str, dims: usize, n: Option<u64>, base: Option<u32>) -> Box<dyn PointSet> {
    let options = Options { n, base, ..Options::default() };
    let spec = Spec { options, ..Spec::new(dims, Randomization::None, Seed::new(0)) };
    sequences::build(name, &spec).expect("valid")
}

/// All ways to write `sum` as an ordered sum of `parts` numbers from 0 on.
fn compositions(sum: u32, parts: usize) -> Vec<Vec<u32>> {
    if parts == 1 {
        return vec![vec![sum]];
    }
    let first = (0..=sum).flat_map(|first| {
        compositions(sum - first, parts - 1).into_iter().map(move |mut rest| {
            rest.push(first);
            rest
        })
    });
    first.collect()
}

/// Counts points in every elementary interval of volume 2^(t − m): 2^t each, scrambled or not, and
/// also in later blocks of 2^m rows.
#[test]
fn elementary_intervals_hold_the_same_number_of_sobol_points() {
    for (dims, m, t) in [(1, 10, 0), (2, 10, 0), (3, 9, 1), (4, 7, 2), (5, 8, 3)] {
        for scramble in
            ["none", "digital_shift", "linear", "linear_striped", "linear_i_binomial", "owen", "owen_exact"]
        {
            for block in [0, 1, 77] {
                let points = build("sobol", dims, scramble, 5);
                // Later blocks are affine images of the first, with the same matrices.
                let rows = block << m..(block + 1) << m;
                for depths in compositions(m - t, dims) {
                    let mut counts = vec![0; 1 << (m - t)];
                    for index in rows.clone() {
                        let cell = depths.iter().enumerate().fold(0, |cell, (dim, &depth)| {
                            (cell << depth) + (points.coord(index, dim) * f64::from(1 << depth)) as usize
                        });
                        counts[cell] += 1;
                    }
                    assert!(
                        counts.iter().all(|&count| count == 1 << t),
                        "s = {dims}, {scramble}, {depths:?}"
                    );
                }
            }
        }
    }
}

/// The exact star discrepancy: all corners of the grid of coordinates, O(n^d).
fn star_discrepancy(points: &dyn PointSet, n: u64) -> f64 {
    let dims = points.dims();
    let mut rows: Vec<(Vec<f64>, bool)> =
        (0..n).map(|i| ((0..dims).map(|dim| points.coord(i, dim)).collect(), true)).collect();
    rows.sort_by(|a, b| a.0[dims - 1].total_cmp(&b.0[dims - 1]));
    let grids: Vec<Vec<f64>> = (0..dims)
        .map(|dim| {
            let mut grid: Vec<_> = rows.iter().map(|row| row.0[dim]).chain([1.0]).collect();
            grid.sort_by(f64::total_cmp);
            grid.dedup();
            grid
        })
        .collect();
    worst_corner(&rows, &grids, 1.0, n as f64)
}

/// The worst corner with the given grids in the last dimensions and `volume` in those before. Rows are
/// those of the closed box so far, sorted by the last coordinate; the mark says "in the open box too".
fn worst_corner(rows: &[(Vec<f64>, bool)], grids: &[Vec<f64>], volume: f64, n: f64) -> f64 {
    let dim = rows.first().map_or(0, |row| row.0.len() - grids.len());
    if grids.len() > 1 {
        let slices = grids[0].iter().map(|&edge| {
            let inside = rows.iter().filter(|row| row.0[dim] <= edge);
            let inside: Vec<_> = inside.map(|(x, open)| (x.clone(), *open && x[dim] < edge)).collect();
            worst_corner(&inside, &grids[1..], volume * edge, n)
        });
        return slices.fold(0.0, f64::max);
    }
    let (mut closed, mut open, mut worst) = (0, 0.0, 0.0_f64);
    let mut open_rows = rows.iter().filter(|row| row.1).peekable();
    for &edge in &grids[0] {
        while open_rows.next_if(|row| row.0[dim] < edge).is_some() {
            open += 1.0;
        }
        while closed < rows.len() && rows[closed].0[dim] <= edge {
            closed += 1;
        }
        worst = worst.max(volume * edge - open / n).max(closed as f64 / n - volume * edge);
    }
    worst
}

/// Values of an independent exact computation for this project, to their last printed digit.
#[test]
fn star_discrepancies_are_the_known_ones() {
    let known = [
        ("sobol", 2, 16, 0.171875),
        ("sobol", 2, 64, 0.053711),
        ("sobol", 2, 256, 0.014587),
        ("sobol", 3, 16, 0.217773),
        ("sobol", 3, 32, 0.129883),
        ("sobol", 3, 64, 0.078690),
        ("sobol", 4, 16, 0.250122),
        ("halton", 2, 16, 0.201389),
        ("halton", 2, 64, 0.052083),
        ("halton", 2, 256, 0.018760),
        ("halton", 3, 16, 0.275),
        ("halton", 3, 32, 0.169583),
        ("halton", 3, 64, 0.097042),
    ];
    for (name, dims, n, value) in known {
        let found = star_discrepancy(&*build(name, dims, "none", 0), n);
        assert!((found - value).abs() < 1e-6, "{name}, d = {dims}, n = {n}: {found}, not {value}");
    }
}

/// Values of the same computation for the first 125 points in base 5.
#[test]
fn star_discrepancies_of_faure_points_are_the_known_ones() {
    for (dims, value) in [(2, 0.033792), (3, 0.0521303)] {
        let found = star_discrepancy(&*build_with("faure", dims, None, Some(5)), 125);
        assert!((found - value).abs() < 1e-6, "d = {dims}: {found}, not {value}");
    }
}

/// J. H. Halton and S. K. Zaremba (1969): n D* = m/3 + 13/9 − (−1)^m 4/(9·2^m) for n = 2^m, and the mean square discrepancy.
#[test]
fn hammersley_points_have_the_known_discrepancy() {
    for m in 2..=9 {
        let (n, sign) = (2_u64.pow(m), if m % 2 == 0 { 1.0 } else { -1.0 });
        let (points, count, m) = (build_with("hammersley", 2, Some(n), None), n as f64, f64::from(m));
        let known = m / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * count);
        let found = star_discrepancy(&*points, n) * count;
        assert!((found - known).abs() < 1e-12, "{n} points: {found}, not {known}");

        let rows: Vec<_> = (0..n).map(|i| [points.coord(i, 0), points.coord(i, 1)]).collect();
        let single = |row: &[f64; 2]| row.iter().map(|x| 1.0 - x * x).product::<f64>();
        let pair =
            |a: &[f64; 2], b: &[f64; 2]| a.iter().zip(b).map(|(x, y)| 1.0 - x.max(*y)).product::<f64>();
        let pairs: f64 = rows.iter().map(|a| rows.iter().map(|b| pair(a, b)).sum::<f64>()).sum();
        let found = count * count / 9.0 - count / 2.0 * rows.iter().map(single).sum::<f64>() + pairs;
        let known = m * m / 64.0 + 29.0 * m / 192.0 + 3.0 / 8.0 - m / (16.0 * count) + 1.0 / (4.0 * count)
            - 1.0 / (72.0 * count * count);
        assert!((found - known).abs() < 1e-9, "{n} points: {found}, not {known}");
    }
}

/// Béjian and Faure: n D* of the first n points of the van der Corput sequence from 0 on.
#[test]
fn van_der_corput_has_the_known_discrepancy() {
    let known =
        [(1, 1.0), (2, 1.0), (3, 1.5), (5, 1.75), (13, 2.125), (21, 2.4375), (43, 2.78125), (85, 3.109375)];
    for name in ["sobol", "halton", "van_der_corput", "faure", "niederreiter"] {
        let points = build(name, 1, "none", 0);
        for (n, value) in known {
            let found = star_discrepancy(&*points, n) * n as f64;
            assert!((found - value).abs() < 1e-9, "{name}, n = {n}: {found}");
        }
    }
}
