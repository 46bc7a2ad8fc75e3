//! Polygons without many points, improved side by side: the lower bound for the emptiest convex set.
//!
//! A side is turned about its anchor to where it meets another point, or to where the anchor is in its middle, which is where the
//! area is stationary; or it is left out. The best change is made as long as there is one.

use super::Convex;
use super::polygon::{Cloud, Line, Point, SQUARE, area, cut};

/// The polygon to the left of all lines, and the best that turning or dropping one line after the other makes of it.
pub(super) fn ascend(cloud: &Cloud, mut lines: Vec<Line>) -> Convex {
    let mut value = worth(cloud, &polygon(&lines));
    let mut unchanged = 0;
    while unchanged < lines.len() {
        let line = lines.remove(0);
        let (best, with) = best_turn(cloud, &polygon(&lines), line);
        let without = worth(cloud, &polygon(&lines));
        let gain = best.max(without) - value;
        unchanged = if gain > LEAST { 0 } else { unchanged + 1 };
        value = value.max(best).max(without);
        if without < best || gain <= LEAST {
            lines.push(if gain > LEAST { with } else { line });
        }
    }
    let vertices = polygon(&lines);
    Convex { value: worth(cloud, &vertices), vertices, closed: false }
}

/// A smaller gain is none.
const LEAST: f64 = 1e-13;

fn polygon(lines: &[Line]) -> Vec<Point> {
    let (mut whole, mut part) = (SQUARE.to_vec(), Vec::new());
    for line in lines {
        cut(&whole, line, &mut part);
        std::mem::swap(&mut whole, &mut part);
    }
    whole
}

/// The area less the part of the points inside.
fn worth(cloud: &Cloud, vertices: &[Point]) -> f64 {
    area(vertices) - cloud.part(vertices, false)
}

/// The best of the directions that a side through its anchor should be tried in, and what it makes of a polygon.
fn best_turn(cloud: &Cloud, rest: &[Point], line: Line) -> (f64, Line) {
    let others = cloud.x.iter().filter(|&&x| x != line.at);
    let through = others.flat_map(|&x| [Line::through(line.at, x), Line::through(x, line.at)]);
    let turned = through.map(|through| Line { at: line.at, ..through }).chain(balanced(rest, line.at));
    let mut part = Vec::new();
    let mut best = (f64::NEG_INFINITY, line);
    for line in turned {
        cut(rest, &line, &mut part);
        let most = area(&part);
        if most > best.0 {
            let value = most - cloud.part(&part, false);
            best = if value > best.0 { (value, line) } else { best };
        }
    }
    best
}

/// The lines through a point of a polygon that meet two of its sides at the same distance.
fn balanced(polygon: &[Point], at: Point) -> Vec<Line> {
    let side = |i: usize| (polygon[i], polygon[(i + 1) % polygon.len()]);
    let mut found = Vec::new();
    for i in 0..polygon.len() {
        for j in 0..i {
            // a + s u on one side, mirrored at the point, is b + t v on the other
            let ((a, a_end), (b, b_end)) = (side(i), side(j));
            let (u, v) = ([a_end[0] - a[0], a_end[1] - a[1]], [b_end[0] - b[0], b_end[1] - b[1]]);
            let w = [2.0 * at[0] - a[0] - b[0], 2.0 * at[1] - a[1] - b[1]];
            let determinant = u[0] * v[1] - u[1] * v[0];
            let s = (w[0] * v[1] - w[1] * v[0]) / determinant;
            let meets = [a[0] + s * u[0], a[1] + s * u[1]];
            if (0.0..=1.0).contains(&s) && meets != at {
                found.extend(
                    [Line::through(at, meets), Line::through(meets, at)].map(|line| Line { at, ..line }),
                );
            }
        }
    }
    found
}
