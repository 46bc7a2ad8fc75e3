//! Points of products of triangles, Δ × … × Δ: one coordinate of a net for each triangle.
//!
//! Choose it for light paths between k triangles, or any integral over them. A Sobol' point read two bits at a time is a point
//! of a net in base 4; its digits choose nested triangles. Nested scrambling makes each point uniform and keeps the net:
//! smooth means then err as n⁻¹ (log n)^((k − 1)/2).
//!
//! K. Basu and A. B. Owen, *Scrambled geometric net integration over general product spaces*, Found. Comput. Math. 17, 467–496 (2017).

use super::scramble::Scramble;
use super::{digits, place};
use crate::digital_net::DigitalNet;
use crate::scramble::Randomization;
use crate::sequences::sobol;
use crate::{Error, Seed};

/// A scrambled geometric net.
#[derive(Debug)]
pub struct Product {
    net: DigitalNet,
    scrambles: Vec<Scramble>,
}

impl Product {
    /// Points of `factors` triangles, with one of the randomizations that [`scramble`](super::scramble::ACCEPTS) names.
    ///
    /// # Errors
    /// If it is another one, or there are more triangles than Sobol' has dimensions.
    pub fn new(factors: usize, randomization: Randomization, seed: Seed) -> Result<Self, Error> {
        let sequence = "triangle_product";
        let most = crate::sequences::named("sobol")?.most_dims;
        if !(1..=most).contains(&factors) {
            return Err(Error::Dimensions { sequence, asked: factors, most });
        }
        let scramble = |factor| Scramble::new(sequence, randomization, seed.dimension(factor));
        let scrambles = (0..factors as u64).map(scramble).collect::<Result<_, _>>()?;
        Ok(Self { net: sobol::sobol(factors, Randomization::None, seed), scrambles })
    }

    /// The barycentric coordinates of a point in one of the triangles.
    #[inline]
    pub fn barycentric(&self, index: u64, factor: usize) -> [f64; 3] {
        digits::barycentric(self.scrambles[factor].apply(self.net.word(index, factor), index))
    }

    /// Writes points from index `start` on: for each triangle, three corners of `k` coordinates one after the other.
    ///
    /// # Panics
    /// If `corners` are not those of all triangles, or `out` does not have places for whole points.
    pub fn fill(&self, start: u64, k: usize, corners: &[f64], out: &mut [f64]) {
        let factors = self.scrambles.len();
        assert!(corners.len() == 3 * k * factors && out.len().is_multiple_of(k * factors), "whole points");
        for (index, point) in (start..).zip(out.chunks_exact_mut(k * factors)) {
            for (factor, (x, corners)) in
                point.chunks_exact_mut(k).zip(corners.chunks_exact(3 * k)).enumerate()
            {
                place(self.barycentric(index, factor), corners, x);
            }
        }
    }
}
