//! Anchored boxes as whole numbers: in each coordinate, how many of its different values are below.
//!
//! A box that matters for the star discrepancy has its faces at coordinates of points or at 1. A *cut* c of a coordinate
//! with the different values `v[0] < … < v[m−1] = 1` keeps the points of rank < c. The open box with the most volume that
//! has just these points reaches up to `v[c]`, the closed box with the least volume to `v[c−1]`: one count serves both.

use super::Rows;

/// The points by ranks.
pub(super) struct Cuts {
    pub(super) n: usize,
    pub(super) dims: usize,
    /// The different values of each coordinate, ascending, and 1 at the end.
    values: Vec<Vec<f64>>,
    /// Which of them each point has, point by point.
    ranks: Vec<u32>,
}

impl Cuts {
    pub(super) fn new(rows: &Rows<'_>) -> Self {
        let (n, dims) = (rows.len(), rows.dims());
        let mut ranks = vec![0; n * dims];
        let mut values = Vec::with_capacity(dims);
        for dim in 0..dims {
            let mut found: Vec<f64> = rows.iter().map(|row| row[dim]).chain([1.0]).collect();
            found.sort_unstable_by(f64::total_cmp);
            found.dedup();
            for (row, ranks) in rows.iter().zip(ranks.chunks_exact_mut(dims)) {
                ranks[dim] = found.partition_point(|&value| value < row[dim]) as u32;
            }
            values.push(found);
        }
        Self { n, dims, values, ranks }
    }

    /// The ranks of one point.
    pub(super) fn ranks(&self, point: usize) -> &[u32] {
        &self.ranks[point * self.dims..][..self.dims]
    }

    /// The largest cut: all points.
    pub(super) fn most(&self, dim: usize) -> u32 {
        self.values[dim].len() as u32
    }

    /// How far an open box may reach that has only the points below a cut.
    #[inline]
    pub(super) fn grown(&self, dim: usize, cut: u32) -> f64 {
        self.values[dim][(cut as usize).min(self.values[dim].len() - 1)]
    }

    /// How far a closed box must reach that has the points below a cut; cut 0 has none, and counts as 1.
    #[inline]
    pub(super) fn shrunk(&self, dim: usize, cut: u32) -> f64 {
        self.values[dim][cut.max(1) as usize - 1]
    }

    /// The points below all cuts.
    pub(super) fn count(&self, cuts: &[u32]) -> usize {
        let below = |ranks: &&[u32]| ranks.iter().zip(cuts).all(|(rank, cut)| rank < cut);
        self.ranks.chunks_exact(self.dims).filter(below).count()
    }

    /// The largest cut of a coordinate in which no value is above x.
    pub(super) fn cut_at(&self, dim: usize, x: f64) -> u32 {
        self.values[dim].partition_point(|&value| value <= x) as u32
    }
}
