//! One example of every sequence with every randomization it takes: what the laws run on.

use evenlight_points::scramble::Randomization;
use evenlight_points::sequences::{self, Entry, Options, Spec};
use evenlight_points::{PointSet, Seed};

/// The options with which a sequence is tried, for those that do not do without.
pub(crate) fn options(_name: &str) -> Options {
    Options::default()
}

/// A registered sequence, of as many of the dimensions as it has.
pub(crate) fn build(
    entry: &Entry,
    dims: usize,
    randomization: Randomization,
    seed: Seed,
) -> Box<dyn PointSet> {
    let spec =
        Spec { options: options(entry.name), ..Spec::new(dims.min(entry.most_dims), randomization, seed) };
    sequences::build(entry.name, &spec).expect("the registry accepts its own randomizations")
}

/// All pairs that are legal.
pub(crate) fn pairs() -> impl Iterator<Item = (&'static Entry, Randomization)> {
    sequences::ALL.iter().flat_map(|&entry| entry.accepts.iter().map(move |&accepted| (entry, accepted)))
}
