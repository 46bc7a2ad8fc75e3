//! Random lower triangular matrices over {0, 1}, for the linear scrambles: what they have in common.

use crate::Seed;

/// The tag under which a key gives the random digits of its matrix; the digital shift takes the key itself.
const MATRIX: u64 = 4;

/// `L · digits + shift`, where column k of L has its 1 on the diagonal and `below(k)` random digits under it.
///
/// `column` gives 64 digits for column k, of which those before place k are ignored and that at place k is 1.
#[inline]
pub(super) fn multiply(word: u64, key: Seed, column: impl Fn(Seed, u32) -> u64) -> u64 {
    let random = key.split(MATRIX, 0);
    let mut image = key.bits64();
    let mut rest = word;
    while rest != 0 {
        let place = rest.leading_zeros();
        let diagonal = 1 << (63 - place);
        image ^= column(random, place) & (diagonal - 1) | diagonal;
        rest ^= diagonal;
    }
    image
}
