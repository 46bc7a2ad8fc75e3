//! The square to the upper unit hemisphere with density cos θ / π: how diffuse surfaces scatter.
//!
//! A uniform point of the unit disk is lifted to the sphere (Malley). The renderer's diffuse lobes are sampled by this code.

use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "hemisphere_cosine",
    cite: "T. Malley, A shading method for computer generated images, master's thesis, University of Utah (1988)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 3>(HemisphereCosine))),
};

/// Malley's method: u is the angle in turns, v the squared radius.
#[derive(Clone, Copy, Debug)]
pub struct HemisphereCosine;

impl<T: Real> Warp<T, 2> for HemisphereCosine {
    type Point = [T; 3];

    #[inline]
    fn map(&self, [u, v]: [T; 2]) -> [T; 3] {
        let (sin, cos) = u.sin_cos_turns();
        let radius = v.sqrt();
        [radius * cos, radius * sin, (T::of(1.0) - v).sqrt()]
    }

    #[inline]
    fn density(&self, x: &[T; 3]) -> T {
        x[2].at_least(T::of(0.0)) * T::of(1.0 / std::f64::consts::PI)
    }

    #[inline]
    fn invert(&self, &[x, y, _]: &[T; 3]) -> [T; 2] {
        [T::turns(y, x), (x * x + y * y).at_most(T::of(1.0))]
    }
}
