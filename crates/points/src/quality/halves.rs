//! The sum over all pairs of points of a product over coordinates, by divide and conquer.
//!
//! Points are halved in the last coordinate. Pairs within a half are the same problem; for pairs across, the factor of that
//! coordinate is a sum of products of one point's number and the other's, and the problem has a coordinate less. In one
//! coordinate a pass over the sorted points is enough. O(n log^{d−1} n) steps, times the number of products to the power d − 1:
//! faster than all pairs for few coordinates and many points.
//!
//! S. Heinrich, *Efficient algorithms for computing the L2-discrepancy*, Math. Comp. 65, 1996.

use super::pairs::Columns;
use super::shapes::Shape;

/// Points with a coefficient each, sorted by the first coordinate.
type Points = Vec<(u32, f64)>;

/// So few pairs are summed one by one.
const FEW: usize = 64 * 64;

/// Σ Π factor over all ordered pairs, those of a point with itself included.
pub(super) fn sum_by_halves<S: Shape>(columns: &Columns<S>) -> f64 {
    let mut points: Points = (0..columns.n as u32).map(|i| (i, 1.0)).collect();
    points.sort_unstable_by(|a, b| key(columns, 0, a.0).total_cmp(&key(columns, 0, b.0)));
    among(columns, &points, columns.g.len() - 1)
}

/// About how many nanoseconds [`sum_by_halves`] takes; measured for up to five coordinates, beyond which it never pays.
pub(super) fn cost<S: Shape>(n: usize, dims: usize) -> f64 {
    if dims > 5 {
        return f64::INFINITY;
    }
    let levels = (n as f64 / 64.0).log2().max(0.0);
    let per_point: f64 = (1..dims).map(|level| S::TERMS as f64 * levels / level as f64).product();
    n as f64 * (200.0 + 40.0 * per_point) * (dims as f64 - 2.0).max(1.0)
}

fn key<S: Shape>(columns: &Columns<S>, dim: usize, i: u32) -> f64 {
    S::key(columns.number(i as usize, dim))
}

/// The pairs among some points, both orders, in the coordinates up to `dim`.
fn among<S: Shape>(columns: &Columns<S>, points: &[(u32, f64)], dim: usize) -> f64 {
    if dim == 0 || points.len() * points.len() <= FEW {
        return between(columns, points, points, dim);
    }
    let middle = median(columns, dim, points, &[]);
    let [low, high] = halves(columns, dim, points, middle);
    let across: f64 = (0..S::TERMS)
        .map(|term| {
            let low = scaled(columns, dim, &low, |terms| terms[term].0);
            let high = scaled(columns, dim, &high, |terms| terms[term].1);
            between(columns, &low, &high, dim - 1)
        })
        .sum();
    among(columns, &low, dim) + among(columns, &high, dim) + 2.0 * across
}

/// The pairs of one point here and one there.
fn between<S: Shape>(columns: &Columns<S>, here: &[(u32, f64)], there: &[(u32, f64)], dim: usize) -> f64 {
    if here.is_empty() || there.is_empty() {
        return 0.0;
    }
    if dim == 0 {
        return sorted(columns, here, there);
    }
    if here.len() * there.len() <= FEW {
        return one_by_one(columns, here, there, dim);
    }
    let middle = median(columns, dim, here, there);
    let [low, high] = halves(columns, dim, here, middle);
    let [low_there, high_there] = halves(columns, dim, there, middle);
    let mut sum = between(columns, &low, &low_there, dim) + between(columns, &high, &high_there, dim);
    for (below, above) in [(&low, &high_there), (&low_there, &high)] {
        for term in 0..S::TERMS {
            let below = scaled(columns, dim, below, |terms| terms[term].0);
            let above = scaled(columns, dim, above, |terms| terms[term].1);
            sum += between(columns, &below, &above, dim - 1);
        }
    }
    sum
}

/// The key, and for equal keys the index, that halves the points of both kinds.
fn median<S: Shape>(
    columns: &Columns<S>,
    dim: usize,
    here: &[(u32, f64)],
    there: &[(u32, f64)],
) -> (f64, u32) {
    let mut keys: Vec<_> = here.iter().chain(there).map(|&(i, _)| (key(columns, dim, i), i)).collect();
    let middle = keys.len() / 2;
    *keys.select_nth_unstable_by(middle, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).1
}

fn halves<S: Shape>(
    columns: &Columns<S>,
    dim: usize,
    points: &[(u32, f64)],
    middle: (f64, u32),
) -> [Points; 2] {
    let (low, high) = points.iter().partition(|&&(i, _)| (key(columns, dim, i), i) < middle);
    [low, high]
}

/// The same points with coefficients times a number of their own.
fn scaled<S: Shape>(
    columns: &Columns<S>,
    dim: usize,
    points: &[(u32, f64)],
    number: impl Fn([(f64, f64); 3]) -> f64,
) -> Points {
    let terms = |i: u32| S::terms(columns.number(i as usize, dim), columns.g[dim]);
    points.iter().map(|&(i, coefficient)| (i, coefficient * number(terms(i)))).collect()
}

fn one_by_one<S: Shape>(columns: &Columns<S>, here: &[(u32, f64)], there: &[(u32, f64)], dim: usize) -> f64 {
    let factor = |i: u32, j: u32, dim: usize| {
        S::factor(columns.number(i as usize, dim), columns.number(j as usize, dim), columns.g[dim])
    };
    let row = |&(i, coefficient): &(u32, f64)| {
        let one = |&(j, other): &(u32, f64)| other * (0..=dim).map(|dim| factor(i, j, dim)).product::<f64>();
        coefficient * there.iter().map(one).sum::<f64>()
    };
    here.iter().map(row).sum()
}

/// One pass over points of both kinds in the order of the first coordinate.
fn sorted<S: Shape>(columns: &Columns<S>, here: &[(u32, f64)], there: &[(u32, f64)]) -> f64 {
    let (mut sum, mut at) = (0.0, 0);
    // Σ coefficient × u of what was passed, of each kind
    let (mut passed_here, mut passed_there) = ([0.0; 3], [0.0; 3]);
    let mut meet = |i: u32, coefficient: f64, own: &mut [f64; 3], other: &[f64; 3]| {
        let terms = S::terms(columns.number(i as usize, 0), columns.g[0]);
        for (term, (u, v)) in terms.into_iter().enumerate() {
            sum += coefficient * v * other[term];
            own[term] += coefficient * u;
        }
    };
    for &(i, coefficient) in here {
        let own = key(columns, 0, i);
        while at < there.len() && key(columns, 0, there[at].0) <= own {
            meet(there[at].0, there[at].1, &mut passed_there, &passed_here);
            at += 1;
        }
        meet(i, coefficient, &mut passed_here, &passed_there);
    }
    for &(i, coefficient) in &there[at..] {
        meet(i, coefficient, &mut passed_there, &passed_here);
    }
    sum
}
