//! MT19937: the pseudo-random numbers of most older software.
//!
//! Every dimension is a stream of its own. The generator cannot skip numbers: a row costs the making of
//! all rows before it, unless the last request ended there. Choose it only where numbers must be those
//! of other software (see [`MersenneTwister::key`]); `independent` is faster and has random access.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use rand_mt::Mt;

use super::Entry;
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "mersenne_twister",
    cite: "M. Matsumoto and T. Nishimura, Mersenne twister, ACM Trans. Model. Comput. Simul. 8(1), 3-30 (1998)",
    accepts: &[Randomization::None],
    takes: &["n"],
    most_dims: 1 << 16,
    build: |spec| Ok(Box::new(MersenneTwister::new(spec.dims, spec.options.n.unwrap_or(ROWS), spec.seed))),
};

/// The rows there are if nothing is said: making them all takes minutes.
const ROWS: u64 = 1 << 32;

/// Rows that one dimension is made of at a time: one refill of its 624 words.
const BLOCK: usize = 312;

/// Independent uniform points.
#[derive(Debug)]
pub struct MersenneTwister {
    streams: Vec<Mutex<Stream>>,
    n: u64,
}

/// The numbers of one dimension. Where the generator stands is a matter of speed alone.
#[derive(Debug)]
struct Stream {
    key: [u32; 2],
    generator: Mt,
    next: u64,
}

impl MersenneTwister {
    /// The first `n` points of `dims` coordinates.
    pub fn new(dims: usize, n: u64, seed: Seed) -> Self {
        let stream = |dim| Mutex::new(Stream::new(Self::key(seed, dim)));
        Self { streams: (0..dims as u64).map(stream).collect(), n }
    }

    /// The two words that initialize the generator of a dimension (`init_by_array` of the reference).
    pub fn key(seed: Seed, dim: u64) -> [u32; 2] {
        let word = seed.dimension(dim).bits64();
        [word as u32, (word >> 32) as u32]
    }
}

impl Stream {
    fn new(key: [u32; 2]) -> Self {
        Self { key, generator: Mt::new_with_key(key), next: 0 }
    }

    /// Moves to a number, from the start if it was passed.
    fn seek(&mut self, index: u64) {
        if index < self.next {
            *self = Self::new(self.key);
        }
        while self.next < index {
            self.number();
        }
    }

    /// The next number: 53 bits of two words, as in `genrand_res53` of the reference.
    fn number(&mut self) -> f64 {
        let [high, low] = [(); 2].map(|()| u64::from(self.generator.next_u32()));
        self.next += 1;
        unit_f64((high >> 5) << 37 | (low >> 6) << 11)
    }
}

impl PointSet for MersenneTwister {
    fn dims(&self) -> usize {
        self.streams.len()
    }

    fn len(&self) -> Option<u64> {
        Some(self.n)
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        Box::new(Self::new(self.dims(), self.n, seed))
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        let mut stream = self.streams[dim].lock().unwrap_or_else(PoisonError::into_inner);
        stream.seek(index);
        stream.number()
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        check_length(&rows, self.dims(), out.len());
        for (start, part) in rows.step_by(BLOCK).zip(out.chunks_mut(BLOCK * self.dims())) {
            for (dim, stream) in self.streams.iter().enumerate() {
                let mut stream = stream.lock().unwrap_or_else(PoisonError::into_inner);
                stream.seek(start);
                part.iter_mut().skip(dim).step_by(self.streams.len()).for_each(|x| *x = stream.number());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `numpy.random.RandomState([1, 2]).random_sample(2000)`, NumPy 2.
    #[test]
    fn numpy_gives_the_same_numbers() {
        let points = MersenneTwister { streams: vec![Mutex::new(Stream::new([1, 2]))], n: ROWS };
        for (index, bits) in NUMPY {
            assert_eq!(points.coord(index, 0), f64::from_bits(bits), "number {index}");
        }
    }

    const NUMPY: [(u64, u64); 4] = [
        (1999, 0x3fd1c518ea2bf0a8),
        (0, 0x3fe2b45704626fe0),
        (1, 0x3fd08bc9db7caa84),
        (0, 0x3fe2b45704626fe0),
    ];
}
