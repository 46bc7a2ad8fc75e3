//! Discrepancies over anchored sets of pairs, by their definition, to judge points by.
#![allow(dead_code, reason = "every test binary uses a part of it")]

/// The largest |count / n − area| over the sets {a < s, b < t} at all three corners, open and closed, for barycentric points.
pub(crate) fn parallelogram_discrepancy(points: &[[f64; 3]]) -> f64 {
    let corner = |first: usize, second: usize| {
        let pairs: Vec<_> = points.iter().map(|point| [point[first], point[second]]).collect();
        anchored_discrepancy(&pairs, covered)
    };
    corner(1, 2).max(corner(2, 0)).max(corner(0, 1))
}

/// What a set {a < s, b < t} covers of the triangle a, b ≥ 0, a + b ≤ 1.
fn covered(s: f64, t: f64) -> f64 {
    2.0 * s * t - (s + t - 1.0).max(0.0).powi(2)
}

/// The largest |count / n − area| over the sets {a < s, b < t}, open and closed.
pub(crate) fn anchored_discrepancy(pairs: &[[f64; 2]], area: fn(f64, f64) -> f64) -> f64 {
    let [rows, columns] = [0, 1].map(|axis| {
        let mut values: Vec<_> = pairs.iter().map(|pair| rounded(pair[axis])).collect();
        values.push(1.0);
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        values
    });
    let mut counts = vec![0_u32; rows.len() * columns.len()];
    for &[a, b] in pairs {
        let place = |values: &[f64], x| values.partition_point(|&value| value < rounded(x));
        counts[place(&rows, a) * columns.len() + place(&columns, b)] += 1;
    }
    // Points with a < s and b < t, and with a ≤ s and b ≤ t.
    let (mut below, mut up_to) = (vec![0; columns.len()], vec![0; columns.len()]);
    let (n, mut most) = (pairs.len() as f64, 0.0_f64);
    for (row, &s) in rows.iter().enumerate() {
        below.copy_from_slice(&up_to);
        let mut sum = 0;
        for (column, up_to) in up_to.iter_mut().enumerate() {
            sum += counts[row * columns.len() + column];
            *up_to += sum;
        }
        for (column, &t) in columns.iter().enumerate() {
            let open = if column == 0 { 0 } else { below[column - 1] };
            let area = area(s, t);
            most = most.max(area - f64::from(open) / n).max(f64::from(up_to[column]) / n - area);
        }
    }
    most
}

/// To 2⁻⁴⁴, so that equal coordinates that were computed differently are equal.
fn rounded(x: f64) -> f64 {
    (x * 2f64.powi(44)).round() / 2f64.powi(44)
}
