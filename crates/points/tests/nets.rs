//! Known numbers of the constructions: elementary intervals, star discrepancies.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Spec};
use evenlight_points::{PointSet, Seed};

fn build(name: &str, dims: usize, scramble: &str, seed: u64) -> Box<dyn PointSet> {
    let randomization = Randomization::named(scramble).expect("known");
    sequences::build(name, &Spec::new(dims, randomization, Seed::new(seed))).expect("valid")
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

/// In base p, each of the p^k cells of a coordinate holds one of any p^k rows from a multiple of p^k on.
#[test]
fn halton_coordinates_are_stratified_in_their_bases() {
    for scramble in ["none", "owen"] {
        let points = build("halton", 7, scramble, 5);
        for (dim, base) in [2_u64, 3, 5, 7, 11, 13, 17].into_iter().enumerate() {
            for k in 1..=3 {
                let cells = base.pow(k);
                for block in [0, 1, 1000] {
                    let mut seen = vec![false; cells as usize];
                    for index in block * cells..(block + 1) * cells {
                        // Unscrambled points lie on cell borders, cut off below them.
                        seen[(points.coord(index, dim) * cells as f64 + 1e-9) as usize] = true;
                    }
                    assert!(seen.iter().all(|&seen| seen), "base {base}, level {k}, {scramble}");
                }
            }
        }
    }
}

/// Radical inverses written down by hand.
#[test]
fn halton_starts_as_on_paper() {
    let points = build("halton", 4, "none", 0);
    let close = |index, dim, x: f64| assert!((points.coord(index, dim) - x).abs() < 1e-15, "{index}, {dim}");
    close(6, 0, 3.0 / 8.0); // 110 -> .011
    close(5, 1, 7.0 / 9.0); // 12 -> .21
    close(7, 2, 11.0 / 25.0); // 12 -> .21
    close(10, 3, 22.0 / 49.0); // 13 -> .31
    close((1 << 40) + 1, 0, 0.5 + 2f64.powi(-41));
    close(3_u64.pow(30) + 1, 1, 1.0 / 3.0 + 3f64.powi(-31));
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

/// Béjian and Faure: n D* of the first n points of the van der Corput sequence from 0 on.
#[test]
fn van_der_corput_has_the_known_discrepancy() {
    let known =
        [(1, 1.0), (2, 1.0), (3, 1.5), (5, 1.75), (13, 2.125), (21, 2.4375), (43, 2.78125), (85, 3.109375)];
    for name in ["sobol", "halton"] {
        let points = build(name, 1, "none", 0);
        for (n, value) in known {
            let found = star_discrepancy(&*points, n) * n as f64;
            assert!((found - value).abs() < 1e-9, "{name}, n = {n}: {found}");
        }
    }
}
