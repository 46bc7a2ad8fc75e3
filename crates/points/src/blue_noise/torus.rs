//! Points of the torus in buckets, so that those near a place are found without looking at all.

use super::MOST_DIMS;

/// No further point in a bucket.
const NONE: u32 = u32::MAX;

/// The squared distance on the torus.
#[inline(always)]
pub(super) fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        let along = (a - b).abs();
        let along = along.min(1.0 - along);
        sum += along * along;
    }
    sum
}

/// A grid of buckets; points are known by the order of their insertion.
pub(super) struct Buckets {
    dims: usize,
    per_axis: usize,
    /// The last point of each bucket.
    last: Vec<u32>,
    /// The point before each point in its bucket.
    before: Vec<u32>,
}

impl Buckets {
    /// Buckets for about `n` points, none narrower than `radius`.
    pub(super) fn new(dims: usize, n: usize, radius: f64) -> Self {
        let (roomy, wide) = ((n as f64).powf(1.0 / dims as f64), 1.0 / radius);
        let per_axis = (roomy.min(wide) as usize).max(1);
        Self { dims, per_axis, last: vec![NONE; per_axis.pow(dims as u32)], before: Vec::with_capacity(n) }
    }

    /// The bucket of a coordinate; the last one for numbers that rounding has taken beyond it.
    fn along(&self, x: f64) -> usize {
        ((x * self.per_axis as f64) as usize).min(self.per_axis - 1)
    }

    /// Adds the next point.
    pub(super) fn insert(&mut self, x: &[f64]) {
        let bucket = x.iter().fold(0, |bucket, &x| bucket * self.per_axis + self.along(x));
        let number = self.before.len() as u32;
        self.before.push(std::mem::replace(&mut self.last[bucket], number));
    }

    /// Visits the points of all buckets that a cube of this half side around `x` meets, until `found` says so; whether it did.
    pub(super) fn any(&self, x: &[f64], radius: f64, mut found: impl FnMut(usize) -> bool) -> bool {
        let mut first = [0; MOST_DIMS];
        let mut count = [1; MOST_DIMS];
        for (dim, &x) in x.iter().enumerate() {
            [first[dim], count[dim]] = self.span(x, radius);
        }
        let last_axis = self.dims - 1;
        let mut step = [0; MOST_DIMS];
        loop {
            let row =
                (0..last_axis).fold(0, |row, dim| row * self.per_axis + self.wrapped(first[dim] + step[dim]));
            for along in first[last_axis]..first[last_axis] + count[last_axis] {
                let mut number = self.last[row * self.per_axis + self.wrapped(along)];
                while number != NONE {
                    if found(number as usize) {
                        return true;
                    }
                    number = self.before[number as usize];
                }
            }
            let Some(dim) = (0..last_axis).rev().find(|&dim| step[dim] + 1 < count[dim]) else {
                return false;
            };
            step[dim] += 1;
            step[dim + 1..].fill(0);
        }
    }

    /// The first bucket that an interval meets, and how many there are.
    fn span(&self, x: f64, radius: f64) -> [usize; 2] {
        let [low, high] = [x - radius, x + radius].map(|end| (end * self.per_axis as f64).floor());
        if high - low + 1.0 >= self.per_axis as f64 {
            return [0, self.per_axis];
        }
        let first = if low < 0.0 { low + self.per_axis as f64 } else { low };
        [first as usize, (high - low) as usize + 1]
    }

    fn wrapped(&self, along: usize) -> usize {
        if along < self.per_axis { along } else { along - self.per_axis }
    }
}

#[cfg(test)]
mod tests {
    use super::super::uniform;
    use super::*;
    use crate::Seed;

    #[test]
    fn what_is_near_is_found_across_all_faces() {
        for (dims, n, radius) in [(1, 50, 0.05), (2, 300, 0.07), (2, 300, 0.6), (3, 300, 0.2), (5, 200, 0.3)]
        {
            let x: Vec<f64> = uniform(Seed::new(dims as u64), 0..(n * dims) as u64).collect();
            let mut buckets = Buckets::new(dims, n, 1e-9);
            x.chunks_exact(dims).for_each(|x| buckets.insert(x));
            for own in x.chunks_exact(dims) {
                let near = |other: usize| squared_distance(own, &x[other * dims..][..dims]) < radius * radius;
                let mut met = vec![0; n];
                buckets.any(own, radius, |other| {
                    met[other] += usize::from(near(other));
                    false
                });
                let wanted: Vec<_> = (0..n).map(|other| usize::from(near(other))).collect();
                assert_eq!(met, wanted, "dims = {dims}, radius = {radius}");
            }
        }
    }
}
