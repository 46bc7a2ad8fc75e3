//! Which light to sample: half of the time in proportion to power, half of the time any that is not dark.
//!
//! Power alone starves lights that are weak but near; with the even share, no light is chosen less often than half as often as if all
//! were alike (a defensive mixture: Hesterberg 1995, "Weighted Average Importance Sampling and Defensive Mixture Distributions").

use std::sync::Arc;

use crate::emitter::{Emitter, SceneSphere};

/// Probabilities of all lights; inverted, so that stratified numbers stay stratified.
pub struct Selection {
    cumulative: Vec<f32>,
    probability: Vec<f32>,
    /// The last light that is not dark.
    last: Option<usize>,
}

impl Selection {
    /// Weigh the lights; all alike if none has any measurable power.
    pub fn new(emitters: &[Arc<dyn Emitter>], scene: &SceneSphere) -> Self {
        let mut powers: Vec<f32> = emitters.iter().map(|emitter| emitter.power(scene)).collect();
        let total: f32 = powers.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            powers.fill(1.0);
        }
        let total: f32 = powers.iter().sum();
        let even = 1.0 / powers.iter().filter(|power| **power > 0.0).count() as f32;
        let share = |&power: &f32| if power > 0.0 { 0.5 * (power / total + even) } else { 0.0 };
        let probability: Vec<f32> = powers.iter().map(share).collect();
        let last = probability.iter().rposition(|&p| p > 0.0);
        let mut sum = 0.0;
        let cumulative = probability.iter().map(|p| {
            sum += p;
            sum
        });
        Self { cumulative: cumulative.collect(), probability, last }
    }

    /// The chosen light and its probability; `None` without lights.
    #[inline]
    pub fn sample(&self, u: f32) -> Option<(usize, f32)> {
        // rounding at the upper end must not choose a dark light
        let chosen = self.cumulative.partition_point(|&sum| sum <= u).min(self.last?);
        Some((chosen, self.probability[chosen]))
    }

    /// The probability of one light.
    #[inline]
    pub fn probability(&self, emitter: usize) -> f32 {
        self.probability[emitter]
    }
}
