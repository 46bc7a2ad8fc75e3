//! What statistical tests of scrambles share: means over replicates with standard errors, and integrands.
#![expect(clippy::print_stdout, reason = "the measured errors are worth reading")]

/// The dimensions of the integrands.
pub(crate) const DIMS: usize = 4;

/// The mean of a quantity over replicates, with its standard error.
#[derive(Clone, Copy, Default)]
pub(crate) struct Mean {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Mean {
    pub(crate) fn add(&mut self, x: f64) {
        *self = Self { count: self.count + 1.0, sum: self.sum + x, squares: self.squares + x * x };
    }

    pub(crate) fn value(self) -> f64 {
        self.sum / self.count
    }

    /// The square of the standard error.
    pub(crate) fn variance(self) -> f64 {
        (self.squares / self.count - self.value().powi(2)).max(0.0) / (self.count - 1.0)
    }
}

/// A difference in units of its standard error; what does not vary must be equal.
pub(crate) fn deviation(difference: f64, variance: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference.abs() / variance.sqrt() }
}

/// Integrands over the four-dimensional cube: a name, the function and its integral.
type Integrand = (&'static str, fn(&[f64]) -> f64, f64);

/// Additive, smooth, with a kink (E |Σx − 2| = 7/15), with a jump.
const INTEGRANDS: [Integrand; 5] = [
    ("sum of x", |x| x.iter().sum(), 2.0),
    ("sum of x²", |x| x.iter().map(|x| x * x).sum(), 4.0 / 3.0),
    ("product of x exp x", |x| x.iter().map(|x| x * x.exp()).product(), 1.0),
    ("kink", |x| (x.iter().sum::<f64>() - 2.0).max(0.0), 7.0 / 30.0),
    ("jump", |x| f64::from(u8::from(x.iter().sum::<f64>() >= 2.0)), 0.5),
];

/// The mean squared errors of the integrands over replicates.
#[derive(Default)]
pub(crate) struct SquaredErrors([Mean; INTEGRANDS.len()]);

impl SquaredErrors {
    /// Adds the points of one replicate.
    pub(crate) fn add(&mut self, rows: &[f64]) {
        let n = (rows.len() / DIMS) as f64;
        for (error, (_, f, truth)) in self.0.iter_mut().zip(INTEGRANDS) {
            error.add((rows.chunks_exact(DIMS).map(f).sum::<f64>() / n - truth).powi(2));
        }
    }

    /// The largest deviation from those of the exact scramble; prints all of them.
    pub(crate) fn deviation(&self, exact: &Self, label: &str) -> f64 {
        let mut worst = 0.0_f64;
        for ((ours, exact), (name, ..)) in self.0.iter().zip(exact.0).zip(INTEGRANDS) {
            let z = deviation(ours.value() - exact.value(), ours.variance() + exact.variance());
            worst = worst.max(z);
            let rmse = [*ours, exact].map(|mean| mean.value().sqrt());
            println!("{label}, {name}: {:.3e}, exact {:.3e}, {z:.1} standard errors", rmse[0], rmse[1]);
        }
        worst
    }

    /// The deviation for the sum of x from theory, if each coordinate alone fills n slices: without interaction, that alone
    /// decides, and Var = d / (12 n³).
    pub(crate) fn deviation_of_sum(&self, n: u64) -> f64 {
        let theory = DIMS as f64 / (12.0 * (n as f64).powi(3));
        deviation(self.0[0].value() - theory, self.0[0].variance())
    }
}
