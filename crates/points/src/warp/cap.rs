//! The square to a cap of the unit sphere around +z, all directions alike: lights that are spheres, cones of spots.

use super::round::{depth_and_turns, direction};
use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "cap",
    cite: "Archimedes, On the sphere and cylinder",
    takes: &["angle"],
    folds: false,
    build: |options| {
        let angle = options.angle.ok_or_else(|| options::missing("cap", "angle", ALLOWED))?;
        Ok(Box::new(Fixed::<_, 2, 3>(Cap::new(angle)?)))
    },
};

const ALLOWED: &str = "above 0 and at most π";

/// Directions within an angle of +z.
#[derive(Clone, Copy, Debug)]
pub struct Cap {
    /// 1 − cos of the angle, without cancellation where it is small.
    depth: f64,
}

impl Cap {
    /// A cap that reaches `angle` radians from its center.
    ///
    /// # Errors
    /// If the angle is not in (0, π].
    pub fn new(angle: f64) -> Result<Self, Error> {
        if angle > 0.0 && angle <= std::f64::consts::PI {
            return Ok(Self { depth: 2.0 * (0.5 * angle).sin().powi(2) });
        }
        Err(options::refused("cap", "angle", angle, ALLOWED))
    }
}

impl<T: Real> Warp<T, 2> for Cap {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        direction(u * T::of(self.depth), v)
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        let [depth, _] = depth_and_turns(x);
        let inside = depth <= T::of(self.depth) * (T::of(1.0) + T::of(8.0) * T::EPSILON);
        T::of(if inside { 0.5 / (std::f64::consts::PI * self.depth) } else { 0.0 })
    }

    #[inline]
    fn invert(&self, x: &[T; 3]) -> [T; 2] {
        let [depth, turns] = depth_and_turns(x);
        [(depth / T::of(self.depth)).at_most(T::of(1.0)), turns]
    }
}
