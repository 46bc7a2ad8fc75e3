//! Niederreiter–Xing points: the smallest quality parameter t in base 2 in 4 to 11 dimensions, and there are up to 32.
//!
//! Built from function fields over {0, 1} with many rational places, whose genus is t: 1, 2, 3, 4, 5, 6, 8 and 9 in 4 to 11
//! dimensions, where the bounds of `sobol` are 3, 5, 8, 11, 15, 19, 23 and 27. The matrices are G. Pirsic's. They differ with
//! the dimension of the sequence, so fewer dimensions are not the first of more. Single coordinates and pairs are not as even
//! as those of `sobol`: choose it where all of some ten coordinates matter at once, and compare. From 14 dimensions
//! on, it shows no advantage up to 2^20 points.
//!
//! The published matrices have 30 columns of 30 digits: there are 2^30 points, and further digits are those of the scramble.
//! In three dimensions they are the first of the sequence in four, whose t = 1 is the best possible; in one and two
//! dimensions, where t = 0, those of van der Corput and Pascal, which the field of rational functions gives.

use super::Entry;
use crate::Seed;
use crate::data::niederreiter_xing::{COLUMNS, DIMENSIONS, niederreiter_xing as matrix};
use crate::digital_net::DigitalNet;
use crate::dyadic_pairs;
use crate::scramble::Randomization;

pub(super) const ENTRY: Entry = Entry {
    name: "niederreiter_xing",
    cite: "H. Niederreiter and C. Xing, Finite Fields Appl. 2, 241-273 (1996), with the matrices of G. Pirsic, A software \
           implementation of Niederreiter-Xing sequences, MCQMC 2000, 434-445, Springer (2002)",
    accepts: Randomization::BASE_2,
    takes: &[],
    most_dims: *DIMENSIONS.end(),
    build: |spec| Ok(Box::new(niederreiter_xing(spec.dims, spec.randomization, spec.seed))),
};

/// 2^30 points of that many dimensions.
///
/// # Panics
/// If there are more than 32 dimensions, or none.
pub fn niederreiter_xing(dims: usize, randomization: Randomization, seed: Seed) -> DigitalNet {
    if dims < 3 {
        let matrices: Vec<_> =
            dyadic_pairs::matrices(dims).iter().map(|matrix| matrix[..COLUMNS].to_vec()).collect();
        return DigitalNet::finite(&matrices, randomization, seed);
    }
    let sequence = dims.max(*DIMENSIONS.start());
    let matrices: Vec<_> = (0..dims).map(|dim| matrix(sequence, dim)).collect();
    DigitalNet::finite(&matrices, randomization, seed)
}
