//! The square to a triangle on the unit sphere, all directions alike: triangular lights by solid angle.
//!
//! The first number cuts a triangle of that part of the area off along an arc from the second corner, the second number goes along this
//! arc. Computed in double precision.

use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "spherical_triangle",
    cite: "J. Arvo, Stratified sampling of spherical triangles, SIGGRAPH, 437-438 (1995)",
    takes: &["corners"],
    folds: false,
    build: |options| {
        let corners = options.corners.as_deref();
        let corners = corners.ok_or_else(|| options::missing("spherical_triangle", "corners", ALLOWED))?;
        Ok(Box::new(Fixed::<_, 2, 3>(SphericalTriangle::new(corners)?)))
    },
};

const ALLOWED: &str = "three points in directions that are not in one plane with the origin";

type Vector = [f64; 3];

/// A triangle seen from the origin.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    /// Unit directions of the corners.
    corners: [Vector; 3],
    /// Inward unit normals of the sides.
    sides: [Vector; 3],
    /// The inner angle at the first corner.
    angle: f64,
    /// The tangent of half of the side from the first to the second corner.
    half: f64,
    /// From the first corner, the unit direction towards the third.
    tangent: Vector,
    /// The solid angle.
    area: f64,
}

impl SphericalTriangle {
    /// The triangle whose corners are seen in these directions.
    ///
    /// # Errors
    /// If they are not three, or in one plane with the origin.
    pub fn new(corners: &[Vector]) -> Result<Self, Error> {
        let refused = || options::refused("spherical_triangle", "corners", corners, ALLOWED);
        let &[a, b, c] = corners else { return Err(refused()) };
        let [a, b, c] = [a, b, c].map(unit);
        let volume = dot(a, cross(b, c)).abs();
        if volume.is_nan() || volume <= 1e-14 {
            return Err(refused());
        }
        // A. van Oosterom and J. Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30(2), 125-126 (1983)
        let area = 2.0 * volume.atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a));
        let tangent = unit(rejection(c, a));
        let towards_b = unit(rejection(b, a));
        let angle = length(cross(tangent, towards_b)).atan2(dot(tangent, towards_b));
        let turn = dot(a, cross(b, c)).signum();
        let sides = [cross(a, b), cross(b, c), cross(c, a)].map(|side| unit(side.map(|x| turn * x)));
        let half = length(cross(a, b)) / (1.0 + dot(a, b));
        Ok(Self { corners: [a, b, c], sides, angle, half, tangent, area })
    }

    /// The solid angle.
    pub fn area(&self) -> f64 {
        self.area
    }
}

impl<T: Real> Warp<T, 2> for SphericalTriangle {
    type Point = [T; 3];

    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let [first, second, _] = self.corners;
        // Two sides b, c and the angle α between them make tan(E/2) = tan(b/2) tan(c/2) sin α / (1 + tan(b/2) tan(c/2) cos α), E the area;
        // solved for b, that is free of the cancellation in Arvo's formula for cos b.
        let half_area = 0.5 * self.area * u.wide();
        let tan = half_area.sin() / (self.half * (self.angle - half_area).sin());
        let scale = 1.0 / (1.0 + tan * tan);
        let third: Vector =
            std::array::from_fn(|k| scale * ((1.0 - tan * tan) * first[k] + 2.0 * tan * self.tangent[k]));
        // 1 − cos of the distance from the second corner is uniform.
        let depth = v.wide() * 0.5 * square(difference(third, second));
        let along = unit(rejection(third, second));
        let radius = (depth * (2.0 - depth)).max(0.0).sqrt();
        std::array::from_fn(|k| T::of((1.0 - depth) * second[k] + radius * along[k]))
    }

    fn density(&self, x: &[T; 3]) -> T {
        let (x, slack) = (x.map(T::wide), -8.0 * T::EPSILON.wide());
        let inside = self.sides.iter().all(|&side| dot(side, x) >= slack);
        T::of(if inside { 1.0 / self.area } else { 0.0 })
    }

    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let (x, [first, second, third]) = (x.map(T::wide), self.corners);
        // The great circle through the second corner and the point meets the side from the first to the third corner.
        let meeting = unit(cross(cross(second, x), cross(first, third)));
        let front = dot(meeting, first) + dot(meeting, third) >= 0.0;
        let meeting = if front { meeting } else { meeting.map(|x| -x) };
        let tan = length(cross(first, meeting)) / (1.0 + dot(first, meeting)) * self.half;
        let part = 2.0 * (tan * self.angle.sin()).atan2(1.0 + tan * self.angle.cos()) / self.area;
        let along = square(difference(x, second)) / square(difference(meeting, second));
        // at the second corner, every first number will do
        [part, along].map(|u| T::of(if u.is_nan() { 0.0 } else { u.clamp(0.0, 1.0) }))
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn difference(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn square(a: Vector) -> f64 {
    dot(a, a)
}

fn length(a: Vector) -> f64 {
    square(a).sqrt()
}

fn unit(a: Vector) -> Vector {
    let length = length(a);
    a.map(|x| x / length)
}

/// The part of a vector that is perpendicular to a unit vector.
fn rejection(a: Vector, axis: Vector) -> Vector {
    cross(axis, cross(a, axis))
}
