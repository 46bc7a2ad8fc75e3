//! The triangular van der Corput sequence: the digits of the index in base 4, least significant first, choose nested triangles.
//!
//! Choose it where points must go on without end, or begin anywhere. The first 4^k points have parallelogram discrepancy
//! 2/(3√n) − 1/(9n), and any 4^k aligned ones one in each small triangle, whatever the scramble. Scrambled, each point is
//! uniform and the error of smooth means falls as 1/n.
//!
//! K. Basu and A. B. Owen, *Low discrepancy constructions in the triangle*, SIAM J. Numer. Anal. 53(2), 743–761 (2015); scrambled:
//! *Scrambled geometric net integration over general product spaces*, Found. Comput. Math. 17, 467–496 (2017).

use super::scramble::Scramble;
use super::{digits, place};
use crate::scramble::Randomization;
use crate::{Error, Seed};

/// The sequence in one triangle.
#[derive(Clone, Copy, Debug)]
pub struct VanDerCorput {
    scramble: Scramble,
}

impl VanDerCorput {
    /// The sequence with one of the randomizations that [`scramble`](super::scramble::ACCEPTS) names.
    ///
    /// # Errors
    /// If it is another one.
    pub fn new(randomization: Randomization, seed: Seed) -> Result<Self, Error> {
        Ok(Self { scramble: Scramble::new("triangle_van_der_corput", randomization, seed)? })
    }

    /// The barycentric coordinates of a point.
    ///
    /// ```
    /// use evenlight_points::scramble::Randomization;
    /// use evenlight_points::warp::triangle::van_der_corput::VanDerCorput;
    /// let points = VanDerCorput::new(Randomization::None, evenlight_points::Seed::new(0))?;
    /// assert_eq!(points.barycentric(4), [2.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0]);
    /// # Ok::<(), evenlight_points::Error>(())
    /// ```
    #[inline]
    pub fn barycentric(&self, index: u64) -> [f64; 3] {
        digits::barycentric(self.scramble.apply(reversed(index), index))
    }

    /// Writes points from index `start` on, in the triangle whose corners are given one after the other.
    ///
    /// # Panics
    /// If `corners` are not three points, or `out` does not have places for whole points.
    pub fn fill(&self, start: u64, corners: &[f64], out: &mut [f64]) {
        let k = corners.len() / 3;
        assert!(k > 0 && corners.len() == 3 * k && out.len().is_multiple_of(k), "whole points of a triangle");
        for (index, x) in (start..).zip(out.chunks_exact_mut(k)) {
            place(self.barycentric(index), corners, x);
        }
    }
}

/// The digits in base 4 in reverse order.
#[inline]
fn reversed(index: u64) -> u64 {
    const LOW: u64 = u64::MAX / 3;
    let bits = index.reverse_bits();
    (bits & LOW) << 1 | bits >> 1 & LOW
}
