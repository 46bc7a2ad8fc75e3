//! The square to the unit disk, concentric squares to concentric circles.
//!
//! Choose it before polar coordinates: it is continuous, one to one, and cells keep their shape but for a factor.

use super::round::disk_density;
use super::{Entry, Fixed, Real, Warp};

pub(super) const ENTRY: Entry = Entry {
    name: "disk_concentric",
    cite: "P. Shirley and K. Chiu, A low distortion map between disk and square, J. Graph. Tools 2(3), 45-52 (1997)",
    takes: &[],
    folds: false,
    build: |_| Ok(Box::new(Fixed::<_, 2, 2>(DiskConcentric))),
};

/// The concentric map.
#[derive(Clone, Copy, Debug)]
pub struct DiskConcentric;

impl<T: Real> Warp<T, 2> for DiskConcentric {
    type Point = [T; 2];

    /// The radius is the larger of two coordinates of the square [−1, 1]²; the angle is linear along each of its sides.
    #[inline]
    fn map(&self, u: [T; 2]) -> [T; 2] {
        let [a, b] = u.map(|u| u + u - T::of(1.0));
        if a == T::of(0.0) && b == T::of(0.0) {
            return [a, b];
        }
        let (flat, steep) = (T::of(0.125), T::of(0.25));
        let (radius, turns) =
            if a.absolute() > b.absolute() { (a, flat * (b / a)) } else { (b, steep - flat * (a / b)) };
        // an eighth of a turn to either side: negative turns are those of the whole circle
        let (sin, cos) = if turns < T::of(0.0) {
            let (sin, cos) = (-turns).sin_cos_turns();
            (-sin, cos)
        } else {
            turns.sin_cos_turns()
        };
        [radius * cos, radius * sin]
    }

    #[inline]
    fn density(&self, x: &[T; 2]) -> T {
        disk_density(x)
    }

    #[inline]
    fn invert(&self, &[x, y]: &[T; 2]) -> [T; 2] {
        let radius = (x * x + y * y).sqrt();
        if radius == T::of(0.0) {
            return [T::of(0.5); 2];
        }
        let (half, eight) = (T::of(0.5), T::of(8.0));
        let [a, b] = if x.absolute() > y.absolute() {
            let radius = if x < T::of(0.0) { -radius } else { radius };
            [radius, radius * eight * signed_turns(y, x)]
        } else {
            let radius = if y < T::of(0.0) { -radius } else { radius };
            [radius * eight * signed_turns(x, y), radius]
        };
        [a, b].map(|a| (a * half + half).at_least(T::of(0.0)).at_most(T::of(1.0)))
    }
}

/// The angle whose tangent is y/x, in turns: at most an eighth to either side.
#[inline]
fn signed_turns<T: Real>(y: T, x: T) -> T {
    let (y, x) = if x < T::of(0.0) { (-y, -x) } else { (y, x) };
    if y < T::of(0.0) { -T::turns(-y, x) } else { T::turns(y, x) }
}
