//! Cumulative weights: what discrete warps, histograms and images share.

/// Cumulative probabilities, from 0 to 1.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    below: Vec<f64>,
}

impl Steps {
    /// Steps of these sizes, up to a factor; equal ones if all are 0.
    pub(crate) fn new(weights: impl ExactSizeIterator<Item = f64> + Clone) -> Self {
        let total: f64 = weights.clone().sum();
        let mut sum = 0.0;
        let mut below = Vec::with_capacity(weights.len() + 1);
        below.push(0.0);
        for weight in weights {
            sum += if total > 0.0 { weight } else { 1.0 };
            below.push(sum);
        }
        Self { below: below.into_iter().map(|below| below / sum).collect() }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.below.len() - 1
    }

    /// The size of a step.
    pub(crate) fn size(&self, step: usize) -> f64 {
        self.below[step + 1] - self.below[step]
    }

    /// The step of a number, and how far within it the number is, in [0, 1). Steps of size 0 are never met.
    pub(crate) fn find(&self, u: f64) -> (usize, f64) {
        let mut step = self.below.partition_point(|&below| below <= u).clamp(1, self.len()) - 1;
        while self.size(step) == 0.0 {
            step -= 1; // the number is at the end, before steps of size 0
        }
        (step, ((u - self.below[step]) / self.size(step)).clamp(0.0, BELOW_ONE))
    }

    /// The inverse of [`find`](Self::find).
    pub(crate) fn number(&self, step: usize, within: f64) -> f64 {
        (self.below[step] + within * self.size(step)).clamp(0.0, 1.0)
    }
}

/// The largest number below 1.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;
