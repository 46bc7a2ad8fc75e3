//! The square to the side of a cylinder around the z axis, from z = 0 upwards.

use super::{Entry, Error, Fixed, Real, Warp, options};

pub(super) const ENTRY: Entry = Entry {
    name: "cylinder",
    cite: "its area is that of the rectangle it unrolls to",
    takes: &["radius", "height"],
    folds: false,
    build: |options| {
        let cylinder = Cylinder::new(options.radius.unwrap_or(1.0), options.height.unwrap_or(1.0))?;
        Ok(Box::new(Fixed::<_, 2, 3>(cylinder)))
    },
};

/// The side of a cylinder.
#[derive(Clone, Copy, Debug)]
pub struct Cylinder {
    radius: f64,
    height: f64,
}

impl Cylinder {
    /// A cylinder with this radius and height.
    ///
    /// # Errors
    /// If one of them is not positive and finite.
    pub fn new(radius: f64, height: f64) -> Result<Self, Error> {
        Ok(Self {
            radius: options::positive("cylinder", "radius", radius)?,
            height: options::positive("cylinder", "height", height)?,
        })
    }
}

impl<T: Real> Warp<T, 2> for Cylinder {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let (sin, cos) = u.sin_cos_turns();
        [T::of(self.radius) * cos, T::of(self.radius) * sin, T::of(self.height) * v]
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        let inside = x[2] >= T::of(0.0) && x[2] <= T::of(self.height);
        T::of(if inside { 0.5 / (std::f64::consts::PI * self.radius * self.height) } else { 0.0 })
    }

    #[inline]
    fn invert(&self, &[x, y, z]: &[T; 3]) -> [T; 2] {
        [T::turns(y, x), (z / T::of(self.height)).at_least(T::of(0.0)).at_most(T::of(1.0))]
    }
}
