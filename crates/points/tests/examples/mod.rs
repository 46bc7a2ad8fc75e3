//! One example of every sequence with every randomization it takes: what the laws run on.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::sobol::direction_numbers;
use evenlight_points::sequences::{self, Entry, Options, Spec};
use evenlight_points::{PointSet, Seed};

/// The options with which a sequence is tried, for those that do not do without.
pub(crate) fn options(name: &str, dims: usize) -> Options {
    let n = match name {
        "latin_hypercube" | "multi_jittered" | "correlated_multi_jittered" => Some(1200),
        "hammersley" => Some(1 << 14),
        // What no number of points could be made of in many dimensions has a single one.
        "stratified" => Some(if dims > 12 {
            1
        } else {
            4096_f64.powf(1.0 / dims as f64).floor().powi(dims as i32) as u64
        }),
        "orthogonal_array" => {
            let primes = (dims.max(12) as u64 - 1..).filter(|p| (2..*p).all(|divisor| p % divisor > 0));
            primes.map(|p| p * p).next()
        }
        "fibonacci" => Some(1597),
        "korobov" => Some(1021),
        "mersenne_twister" => Some(5000), // it cannot skip rows
        _ => None,
    };
    let net = name == "digital_net";
    // Sobol' points, cut to 2^20 points and 40 digits.
    let columns = |dim| direction_numbers(dim)[..20].iter().map(|column| column >> 24).collect();
    let matrices = net.then(|| (0..dims).map(columns).collect());
    Options { n, matrices, bits: net.then_some(40), ..Options::default() }
}

/// A registered sequence, of as many of the dimensions as it has.
pub(crate) fn build(
    entry: &Entry,
    dims: usize,
    randomization: Randomization,
    seed: Seed,
) -> Box<dyn PointSet> {
    // The cost of an exact scramble grows with the base, and the base with the dimension.
    let most = if randomization == Randomization::OwenExact { 300 } else { usize::MAX };
    let dims = dims.min(entry.most_dims).min(most);
    let spec = Spec { options: options(entry.name, dims), ..Spec::new(dims, randomization, seed) };
    sequences::build(entry.name, &spec).expect("the registry accepts its own randomizations")
}

/// All pairs that are legal.
pub(crate) fn pairs() -> impl Iterator<Item = (&'static Entry, Randomization)> {
    sequences::ALL.iter().flat_map(|&entry| entry.accepts.iter().map(move |&accepted| (entry, accepted)))
}
