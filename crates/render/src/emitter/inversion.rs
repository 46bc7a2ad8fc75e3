//! A piecewise-constant density, sampled by inversion: stratified numbers stay stratified.
//!
//! A guide table says where to begin, so that a sample takes two steps on average, whatever the number of intervals
//! (Chen & Asau 1974, "On Generating Random Variates from an Empirical Distribution").

/// Weights of equally long intervals, ready to be sampled.
pub(crate) struct Inversion {
    /// Sum of the weights up to and including each interval.
    cumulative: Vec<f32>,
    /// The interval in which each of as many equal parts of the total begins.
    guide: Vec<u32>,
}

impl Inversion {
    /// From weights that are not negative.
    pub(crate) fn new(weights: impl Iterator<Item = f32>) -> Self {
        let mut sum = 0.0_f64;
        let cumulative: Vec<f32> = weights
            .map(|weight| {
                sum += f64::from(weight);
                sum as f32
            })
            .collect();
        let count = cumulative.len();
        let total = cumulative.last().copied().unwrap_or(0.0);
        let mut interval = 0;
        let guide = (0..count).map(|part| {
            let target = part as f32 / count as f32 * total;
            while interval + 1 < count && cumulative[interval] <= target {
                interval += 1;
            }
            interval as u32
        });
        Self { guide: guide.collect(), cumulative }
    }

    /// The sum of all weights.
    #[inline]
    pub(crate) fn total(&self) -> f32 {
        self.cumulative.last().copied().unwrap_or(0.0)
    }

    /// The weight of one interval.
    #[inline]
    pub(crate) fn weight(&self, interval: usize) -> f32 {
        let below = if interval == 0 { 0.0 } else { self.cumulative[interval - 1] };
        self.cumulative[interval] - below
    }

    /// The chosen interval and where in it, in [0, 1).
    #[inline]
    pub(crate) fn invert(&self, u: f32) -> (usize, f32) {
        let count = self.cumulative.len();
        let target = u * self.total();
        let mut interval = self.guide[((u * count as f32) as usize).min(count - 1)] as usize;
        // rounding may have put the guide one interval too far
        while interval > 0 && self.cumulative[interval - 1] > target {
            interval -= 1;
        }
        while interval + 1 < count && self.cumulative[interval] <= target {
            interval += 1;
        }
        let below = if interval == 0 { 0.0 } else { self.cumulative[interval - 1] };
        let width = self.cumulative[interval] - below;
        (
            interval,
            if width > 0.0 { ((target - below) / width).clamp(0.0, 1.0 - f32::EPSILON / 2.0) } else { 0.5 },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inversion_is_monotone_and_meets_every_boundary() {
        let weights = [0.0, 3.0, 0.0, 0.0, 1.0, 4.0, 0.0];
        let inversion = Inversion::new(weights.into_iter());
        for step in 0..8000 {
            let u = step as f32 / 8000.0;
            let (interval, fraction) = inversion.invert(u);
            let below: f32 = weights[..interval].iter().sum();
            assert!(
                (below + fraction * weights[interval] - 8.0 * u).abs() < 1e-5,
                "u = {u}: {interval}, {fraction}"
            );
            assert!(weights[interval] > 0.0);
        }
        assert_eq!(inversion.weight(4), 1.0);
    }
}
