//! What all kernels of the L2 family come down to: five shapes of a factor, for pairs and for sorted halves.
//!
//! A discrepancy of the L2 family sums, over all pairs of points, a product over coordinates. With two numbers a and b of
//! each coordinate of each point, computed once, the factor has one of five shapes. Every shape is also a short sum of
//! products for points in ascending order, which is what divide and conquer lives on.

/// A factor of two points; each has its own a and b, and g belongs to the coordinate.
pub(super) trait Shape: Send + Sync {
    /// How many products [`Shape::terms`] has.
    const TERMS: usize;
    /// The factor; the same for both orders.
    fn factor(own: [f64; 2], other: [f64; 2], g: f64) -> f64;
    /// By what points are put in order.
    fn key(own: [f64; 2]) -> f64;
    /// Numbers u and v of a point: the factor of a point and one that is not below it is Σ u v.
    fn terms(own: [f64; 2], g: f64) -> [(f64, f64); 3];
}

/// a + a′ − |b − b′|.
pub(super) struct Tent;

impl Shape for Tent {
    const TERMS: usize = 2;
    #[inline(always)]
    fn factor(own: [f64; 2], other: [f64; 2], _: f64) -> f64 {
        (own[0] + other[0]) - (own[1] - other[1]).abs()
    }
    fn key(own: [f64; 2]) -> f64 {
        own[1]
    }
    fn terms([a, b]: [f64; 2], _: f64) -> [(f64, f64); 3] {
        [(a + b, 1.0), (1.0, a - b), (0.0, 0.0)]
    }
}

/// min(a, a′), where a falls.
pub(super) struct Least;

impl Shape for Least {
    const TERMS: usize = 1;
    #[inline(always)]
    fn factor(own: [f64; 2], other: [f64; 2], _: f64) -> f64 {
        if own[0] < other[0] { own[0] } else { other[0] }
    }
    fn key(own: [f64; 2]) -> f64 {
        -own[0]
    }
    fn terms([a, _]: [f64; 2], _: f64) -> [(f64, f64); 3] {
        [(1.0, a), (0.0, 0.0), (0.0, 0.0)]
    }
}

/// min(a, a′) − a a′.
pub(super) struct Bridge;

impl Shape for Bridge {
    const TERMS: usize = 1;
    #[inline(always)]
    fn factor(own: [f64; 2], other: [f64; 2], _: f64) -> f64 {
        (if own[0] < other[0] { own[0] } else { other[0] }) - own[0] * other[0]
    }
    fn key(own: [f64; 2]) -> f64 {
        own[0]
    }
    fn terms([a, _]: [f64; 2], _: f64) -> [(f64, f64); 3] {
        [(a, 1.0 - a), (0.0, 0.0), (0.0, 0.0)]
    }
}

/// a + a′ + (|b − b′| − g)².
pub(super) struct Bowl;

impl Shape for Bowl {
    const TERMS: usize = 3;
    #[inline(always)]
    fn factor(own: [f64; 2], other: [f64; 2], g: f64) -> f64 {
        let t = (own[1] - other[1]).abs() - g;
        (own[0] + other[0]) + t * t
    }
    fn key(own: [f64; 2]) -> f64 {
        own[1]
    }
    fn terms([a, b]: [f64; 2], g: f64) -> [(f64, f64); 3] {
        [(a + (b + g) * (b + g), 1.0), (1.0, a + b * (b - 2.0 * g)), (b, -2.0 * b)]
    }
}

/// a + (|b − b′| − g)², where all points have the same a.
pub(super) struct Wrap;

impl Shape for Wrap {
    const TERMS: usize = 3;
    #[inline(always)]
    fn factor(own: [f64; 2], other: [f64; 2], g: f64) -> f64 {
        let t = (own[1] - other[1]).abs() - g;
        own[0] + t * t
    }
    fn key(own: [f64; 2]) -> f64 {
        own[1]
    }
    fn terms([a, b]: [f64; 2], g: f64) -> [(f64, f64); 3] {
        [(a + (b + g) * (b + g), 1.0), (1.0, b * (b - 2.0 * g)), (b, -2.0 * b)]
    }
}
