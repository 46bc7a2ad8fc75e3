//! As many draws from a discrete distribution as it has values, by inversion of ascending numbers: how particle filters select.
//!
//! Choose it before [`warp::discrete`](crate::warp) where numbers are ascending: values and numbers are gone through side by side, so
//! that a draw takes a few nanoseconds however many values there are.

/// For each ascending number in [0, 1], the value into whose share of the weights it falls; never one without weight.
pub fn drawn(weights: &[f64], numbers: &[f64], out: &mut [i64]) {
    let total: f64 = weights.iter().sum();
    let mut shares = weights.iter().copied().enumerate().filter(|&(_, weight)| weight > 0.0);
    let (mut place, mut sum) = shares.next().unwrap_or_default();
    for (number, out) in numbers.iter().zip(out) {
        let target = number * total;
        while sum <= target {
            let Some((next, weight)) = shares.next() else { break };
            (place, sum) = (next, sum + weight);
        }
        *out = place as i64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_falls_into_the_share_around_it() {
        let numbers = [0.0, 0.124, 0.125, 0.5, 0.624, 0.625, 0.999, 1.0];
        let mut out = [0; 8];
        drawn(&[1.0, 0.0, 4.0, 3.0, 0.0], &numbers, &mut out);
        assert_eq!(out, [0, 0, 2, 2, 2, 3, 3, 3]);
        drawn(&[0.0, 3.0, 4.0, 0.0, 1.0], &numbers, &mut out);
        assert_eq!(out, [1, 1, 1, 2, 2, 2, 4, 4]);
    }
}
