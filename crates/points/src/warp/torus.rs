//! The square to the surface of a torus around the z axis, all places alike.
//!
//! The outer half of a tube has more area than the inner half: the angle θ around it, from outside, has density 1 + (r/R) cos θ up
//! to a factor, and θ + (r/R) sin θ = 2πv is Kepler's equation, solved by Newton's method within a bracket.

use std::f64::consts::PI;

use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "torus",
    cite: "P. Diaconis, S. Holmes and M. Shahshahani, Sampling from a manifold, IMS Collections 10, 102-125 (2013)",
    takes: &["radius", "tube"],
    folds: false,
    build: |options| {
        let torus = Torus::new(options.radius.unwrap_or(1.0), options.tube.unwrap_or(0.5))?;
        Ok(Box::new(Fixed::<_, 2, 3>(torus)))
    },
};

/// A torus.
#[derive(Clone, Copy, Debug)]
pub struct Torus {
    radius: f64,
    tube: f64,
}

impl Torus {
    /// A torus from the radius of its ring and that of its tube.
    ///
    /// # Errors
    /// If they are not positive and finite, or the tube is wider than the ring.
    pub fn new(radius: f64, tube: f64) -> Result<Self, Error> {
        options::positive("torus", "radius", radius)?;
        options::positive("torus", "tube", tube)?;
        if tube > radius {
            return Err(options::refused("torus", "tube", tube, "at most the radius"));
        }
        Ok(Self { radius, tube })
    }

    /// The angle around the tube below which a part `v` of the area is.
    fn around(&self, v: f64) -> f64 {
        let (ratio, target) = (self.tube / self.radius, 2.0 * PI * v);
        let (mut low, mut high) = (0.0, 2.0 * PI);
        let mut angle = target;
        for _ in 0..60 {
            let error = angle + ratio * angle.sin() - target;
            if error > 0.0 {
                high = angle;
            } else {
                low = angle;
            }
            let step = error / (1.0 + ratio * angle.cos());
            let next = angle - step;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - angle).abs() <= 1e-16 * PI {
                return next;
            }
            angle = next;
        }
        angle
    }
}

impl<T: Real> Warp<T, 2> for Torus {
    type Point = [T; 3];

    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let (sin, cos) = u.wide().sin_cos_turns();
        let (rise, out) = self.around(v.wide()).sin_cos();
        let ring = self.radius + self.tube * out;
        [ring * cos, ring * sin, self.tube * rise].map(T::of)
    }

    fn density(&self, _: &[T; 3]) -> T {
        T::of(0.25 / (PI * PI * self.radius * self.tube))
    }

    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let [x, y, z] = x.map(T::wide);
        let out = x.hypot(y) - self.radius;
        let angle = f64::turns(z, out) * 2.0 * PI;
        let part = (angle + self.tube / self.radius * angle.sin()) / (2.0 * PI);
        [T::of(f64::turns(y, x)), T::of(part.clamp(0.0, 1.0))]
    }
}
