//! How many points a finite design has: what it needs to be told, and what to say if that cannot be.

use crate::Error;
use crate::sequences::Spec;
use crate::shuffle;

/// The option `n` of a design that cannot do without.
pub(crate) fn counted_points(sequence: &'static str, spec: &Spec) -> Result<u64, Error> {
    counted_up_to(sequence, spec, shuffle::MOST)
}

/// The option `n` of a set that has at most so many points.
pub(crate) fn counted_up_to(sequence: &'static str, spec: &Spec, most: u64) -> Result<u64, Error> {
    let n = spec.options.n;
    n.filter(|n| (1..=most).contains(n)).ok_or_else(|| Error::Option {
        sequence,
        option: "n",
        asked: n.map_or("nothing".into(), |n| n.to_string()),
        allowed: format!("a number of points from 1 to {most}"),
    })
}

/// The error that a design has no such number of points, with those near it that it has, up to `most`.
pub(crate) fn wrong_count(
    sequence: &'static str,
    n: u64,
    allowed: &str,
    near: [Option<u64>; 2],
    most: u64,
) -> Error {
    let near = near.into_iter().flatten().filter(|n| *n <= most).map(|n| n.to_string());
    let near = near.collect::<Vec<_>>().join(" or ");
    let allowed = if near.is_empty() { allowed.into() } else { format!("{allowed}, such as {near}") };
    Error::Option { sequence, option: "n", asked: n.to_string(), allowed }
}

/// The largest number whose `power`-th power is at most `n`.
pub(crate) fn root(n: u64, power: usize) -> u64 {
    let power = u32::try_from(power).unwrap_or(u32::MAX);
    let mut root = (n as f64).powf(1.0 / f64::from(power)).round() as u64 + 1;
    while root.checked_pow(power).is_none_or(|value| value > n) {
        root -= 1;
    }
    root
}
