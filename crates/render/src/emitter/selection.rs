//! Which light to sample: in proportion to its power.

use std::sync::Arc;

use crate::emitter::{Emitter, SceneSphere};

/// Probabilities of all lights, proportional to power; inverted, so that stratified numbers stay stratified.
pub struct Selection {
    cumulative: Vec<f32>,
    probability: Vec<f32>,
}

impl Selection {
    /// Weigh the lights. Lights of no measurable power are chosen as if all were alike, if none has any.
    pub fn by_power(emitters: &[Arc<dyn Emitter>], scene: &SceneSphere) -> Self {
        let mut powers: Vec<f32> = emitters.iter().map(|emitter| emitter.power(scene)).collect();
        let total: f32 = powers.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            powers.fill(1.0);
        }
        let total: f32 = powers.iter().sum();
        let probability: Vec<f32> = powers.iter().map(|power| power / total).collect();
        let mut sum = 0.0;
        let cumulative = probability.iter().map(|p| {
            sum += p;
            sum
        });
        Self { cumulative: cumulative.collect(), probability }
    }

    /// The chosen light and its probability; `None` without lights.
    #[inline]
    pub fn sample(&self, u: f32) -> Option<(usize, f32)> {
        let last = self.probability.len().checked_sub(1)?;
        let mut chosen = self.cumulative.partition_point(|&sum| sum <= u).min(last);
        while self.probability[chosen] == 0.0 && chosen > 0 {
            chosen -= 1; // rounding at the upper end must not choose a dark light
        }
        Some((chosen, self.probability[chosen]))
    }

    /// The probability of one light.
    #[inline]
    pub fn probability(&self, emitter: usize) -> f32 {
        self.probability[emitter]
    }
}
