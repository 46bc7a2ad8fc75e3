//! The square to a rectangle as seen from the origin, all directions alike: rectangular lights by solid angle.
//!
//! The first number goes along one side by solid angle, the second across it. Choose it for lights that are near and large.
//! Computed in double precision. The published closed form loses digits to arc cosines; here Newton's method solves the same equation to the
//! last digit.

use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "spherical_rectangle",
    cite: "C. Urena, M. Fajardo and A. King, An area-preserving parametrization for spherical rectangles, \
           Comput. Graph. Forum 32(4), 59-66 (2013)",
    takes: &["corners"],
    folds: false,
    build: |options| {
        let corners = options.corners.as_deref();
        let corners = corners.ok_or_else(|| options::missing("spherical_rectangle", "corners", ALLOWED))?;
        Ok(Box::new(Fixed::<_, 2, 3>(SphericalRectangle::new(corners)?)))
    },
};

const ALLOWED: &str = "a corner and its two neighbors, at a right angle, in a plane that misses the origin";

type Vector = [f64; 3];

/// A rectangle in the plane z = `distance` of its own axes: x in `x`, y in `y`.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    axes: [Vector; 3],
    distance: f64,
    x: [f64; 2],
    y: [f64; 2],
    /// `strip` at the first side.
    start: f64,
    /// The solid angle.
    area: f64,
}

impl SphericalRectangle {
    /// The rectangle with one corner and its two neighbors at these points.
    ///
    /// # Errors
    /// If they are not three, not at a right angle, or in one plane with the origin.
    pub fn new(corners: &[Vector]) -> Result<Self, Error> {
        let refused = || options::refused("spherical_rectangle", "corners", corners, ALLOWED);
        let &[corner, first, second] = corners else { return Err(refused()) };
        let edges = [first, second].map(|end| std::array::from_fn(|k| end[k] - corner[k]));
        let [width, height] = edges.map(|edge| dot(edge, edge).sqrt());
        let right = dot(edges[0], edges[1]).abs() <= 1e-6 * width * height;
        let [across, up] = [edges[0].map(|x| x / width), edges[1].map(|x| x / height)];
        let normal = cross(across, up);
        let distance = dot(corner, normal);
        if !(width > 0.0 && height > 0.0 && right && distance.abs() > 1e-12 * (width + height)) {
            return Err(refused());
        }
        let sign = distance.signum();
        let (x, y) = (dot(corner, across), dot(corner, up));
        let mut rectangle = Self {
            axes: [across, up, normal.map(|n| sign * n)],
            distance: distance.abs(),
            x: [x, x + width],
            y: [y, y + height],
            start: 0.0,
            area: 0.0,
        };
        rectangle.start = rectangle.strip(x);
        rectangle.area = rectangle.strip(x + width) - rectangle.start;
        Ok(rectangle)
    }

    /// The solid angle.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The solid angle from x = 0 to x, over all y.
    fn strip(&self, x: f64) -> f64 {
        let z = self.distance;
        let corner = |y: f64| (x * y / (z * (x * x + y * y + z * z).sqrt())).atan();
        corner(self.y[1]) - corner(self.y[0])
    }

    /// The sine of the height of y above the plane y = 0, seen at `reach` from it.
    fn height(reach: f64, y: f64) -> f64 {
        y / reach.hypot(y)
    }

    /// The derivative of [`strip`](Self::strip).
    fn slope(&self, x: f64) -> f64 {
        let reach = x.hypot(self.distance);
        let [low, high] = self.y.map(|y| Self::height(reach, y));
        (high - low) * self.distance / (reach * reach)
    }

    /// The x up to which the strip has a part `u` of the solid angle.
    fn across(&self, u: f64) -> f64 {
        let (target, [mut low, mut high]) = (self.start + u * self.area, self.x);
        let mut x = low + u * (high - low);
        // Newton's method within a bracket; the strip is smooth and rises, so that few steps are enough
        for _ in 0..100 {
            let error = self.strip(x) - target;
            if error > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let next = x - error / self.slope(x);
            let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
            if (next - x).abs() <= 1e-16 * (self.distance + x.abs()) {
                return next;
            }
            x = next;
        }
        x
    }
}

impl<T: Real> Warp<T, 2> for SphericalRectangle {
    type Point = [T; 3];

    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let x = self.across(u.wide());
        let reach = x.hypot(self.distance);
        let [low, high] = self.y.map(|y| Self::height(reach, y));
        let sin = low + v.wide() * (high - low);
        let y = (reach * sin / (1.0 - sin * sin).max(1e-300).sqrt()).clamp(self.y[0], self.y[1]);
        let scale = 1.0 / reach.hypot(y);
        let [across, up, ahead] = self.axes;
        std::array::from_fn(|k| T::of(scale * (x * across[k] + y * up[k] + self.distance * ahead[k])))
    }

    fn density(&self, x: &[T; 3]) -> T {
        let [x, y, z] = self.axes.map(|axis| dot(axis, x.map(T::wide)));
        let slack = 16.0 * T::EPSILON.wide() * (x.hypot(y).hypot(z));
        let within = |at: f64, [low, high]: [f64; 2]| {
            at * self.distance >= low * z - slack * (self.distance + low.abs())
                && at * self.distance <= high * z + slack * (self.distance + high.abs())
        };
        let inside = z > 0.0 && within(x, self.x) && within(y, self.y);
        T::of(if inside { 1.0 / self.area } else { 0.0 })
    }

    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let [x, y, z] = self.axes.map(|axis| dot(axis, x.map(T::wide)));
        let (x, y) = (x / z * self.distance, y / z * self.distance);
        let reach = x.hypot(self.distance);
        let [low, high] = self.y.map(|y| Self::height(reach, y));
        let u = (self.strip(x) - self.start) / self.area;
        let v = (Self::height(reach, y) - low) / (high - low);
        [u, v].map(|u| T::of(u.clamp(0.0, 1.0)))
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
