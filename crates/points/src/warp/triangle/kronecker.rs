//! The triangular Kronecker lattice: a square lattice, turned by an angle whose tangent is badly approximable.
//!
//! Choose it when the number of points is known: with such an angle, as 3π/8, its parallelogram discrepancy is O(log n / n), the
//! least known. With π/4 or π/2 it is no better than a grid.
//!
//! K. Basu and A. B. Owen, *Low discrepancy constructions in the triangle*, SIAM J. Numer. Anal. 53(2), 743–761 (2015). Theirs scales
//! the lattice by √(2n) and deletes or adds points to make n. Here the scale is the one with n points inside: it differs from √(2n)
//! by a factor of 1 + O(log n / n), and all points stay in the lattice.

/// One point of the turned lattice in the first quadrant.
type Point = [f64; 2];

/// The barycentric coordinates of `n` points of the lattice Z² + `shift`, turned counterclockwise by `angle`.
///
/// ```
/// use evenlight_points::warp::triangle::kronecker::kronecker;
/// let points = kronecker(100, 3.0 * std::f64::consts::PI / 8.0, [0.0, 0.0]);
/// assert_eq!(points.len(), 100);
/// assert_eq!(points[0], [1.0, 0.0, 0.0]);
/// ```
pub fn kronecker(n: usize, angle: f64, shift: [f64; 2]) -> Vec<[f64; 3]> {
    if n == 0 {
        return Vec::new();
    }
    let (sin, cos) = angle.sin_cos();
    let side = (2.0 * n as f64).sqrt();
    let mut found = Vec::new();
    for margin in [4.0, 16.0, 64.0] {
        found = inside([cos, sin], shift, side + margin);
        if found.len() > n {
            break;
        }
    }
    let size = |[x, y]: Point| x + y;
    let scale = 0.5 * (size(found[n - 1]) + size(found[n]));
    found.truncate(n);
    found.into_iter().map(|[x, y]| [(1.0 - (x + y) / scale).max(0.0), x / scale, y / scale]).collect()
}

/// What rounding may move across the sides.
const SLACK: f64 = 1e-9;

/// The points of the lattice with x ≥ 0, y ≥ 0 and x + y ≤ `size`, by the size of the least triangle that has them.
fn inside([cos, sin]: [f64; 2], shift: [f64; 2], size: f64) -> Vec<Point> {
    let corners = [[0.0, 0.0], [cos * size, -sin * size], [sin * size, cos * size]];
    let bound =
        |pick: fn(f64, f64) -> f64| corners[1..].iter().fold(0.0, |so_far, corner| pick(so_far, corner[0]));
    let (first, last) = ((bound(f64::min) - 1.0).floor() as i64, (bound(f64::max) + 1.0).ceil() as i64);
    let mut found = Vec::new();
    for row in first..=last {
        let i = row as f64 + shift[0];
        // Each side is a half-plane a j ≤ b of the row.
        let sides =
            [(sin, cos * i + SLACK), (-cos, sin * i + SLACK), (cos - sin, size - (cos + sin) * i + SLACK)];
        let (mut low, mut high) = (-2.0 * size - 2.0, 2.0 * size + 2.0);
        for (a, b) in sides {
            match a {
                a if a > 1e-12 => high = f64::min(high, b / a),
                a if a < -1e-12 => low = f64::max(low, b / a),
                _ if b < 0.0 => high = f64::NEG_INFINITY,
                _ => {}
            }
        }
        let (from, to) = ((low - shift[1]).ceil() as i64, (high - shift[1]).floor() as i64);
        for column in from..=to {
            let j = column as f64 + shift[1];
            found.push([(cos * i - sin * j).max(0.0), (sin * i + cos * j).max(0.0)]);
        }
    }
    found.sort_unstable_by(|a, b| (a[0] + a[1], a[1]).partial_cmp(&(b[0] + b[1], b[1])).expect("finite"));
    found
}
