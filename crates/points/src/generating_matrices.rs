//! Sequences over the integers modulo a prime, by their generating matrices: in base 2 with its own engine.

use crate::digital_net::{BITS, DigitalNet};
use crate::radix::{Coordinate, RadixNet};
use crate::scramble::Randomization;
use crate::{PointSet, Seed};

/// The matrix of one coordinate: its entries by row and column.
pub(crate) trait Matrix {
    fn entry(&self, row: usize, column: usize) -> u64;

    /// Rows are zero before the last multiple of this up to their number.
    fn group(&self) -> usize {
        1
    }
}

/// The sequence of these matrices modulo a prime.
pub(crate) fn sequence<M: Matrix>(
    prime: u64,
    matrices: impl Iterator<Item = M>,
    randomization: Randomization,
    seed: Seed,
) -> Box<dyn PointSet> {
    if prime == 2 {
        let word = |matrix: &M, column| (0..BITS).fold(0, |word, row| word << 1 | matrix.entry(row, column));
        let columns: Vec<_> =
            matrices.map(|matrix| std::array::from_fn(|column| word(&matrix, column))).collect();
        return Box::new(DigitalNet::new(&columns, randomization, seed));
    }
    let coordinate =
        |matrix: M| Coordinate::matrix(prime, matrix.group(), |row, column| matrix.entry(row, column));
    let coordinates: Vec<_> = matrices.map(coordinate).collect();
    Box::new(RadixNet::new(&coordinates, randomization, seed).balanced_in(prime))
}

/// The radical inverse: the matrix that changes nothing.
#[derive(Debug)]
pub(crate) struct Identity;

impl Matrix for Identity {
    fn entry(&self, row: usize, column: usize) -> u64 {
        u64::from(row == column)
    }
}
