//! Published tables that ship with the crate. `data/README.md` names sources, formats and licenses.

/// The number of dimensions in the Joe–Kuo table.
pub(crate) const SOBOL_DIMS: usize = SOBOL.len() / SOBOL_RECORD;

/// Bytes of one dimension of the packed table.
const SOBOL_RECORD: usize = 24;

/// Of these, the bytes that hold the initial numbers; the polynomial fills the rest.
const SOBOL_NUMBERS: usize = 20;

static SOBOL: &[u8] = include_bytes!("sobol.bin");

/// The primitive polynomial (all coefficients, constant term in bit 0) and the initial numbers
/// `m_1, m_2, …` of one dimension of the Joe–Kuo table.
pub(crate) fn sobol_initial(dim: usize) -> (u32, Vec<u64>) {
    let (numbers, polynomial) = SOBOL[dim * SOBOL_RECORD..][..SOBOL_RECORD].split_at(SOBOL_NUMBERS);
    let polynomial = little_endian(polynomial) as u32;
    let mut position = 0;
    let initial = (0..polynomial.ilog2()).map(|width| {
        // `width` bits from bit `position` on; 64 bits from its byte on always contain them.
        let byte = position / 8;
        let window = little_endian(&numbers[byte..SOBOL_NUMBERS.min(byte + 8)]) >> (position % 8);
        position += width as usize;
        (window & ((1 << width) - 1)) << 1 | 1
    });
    (polynomial, initial.collect())
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_and_last_records_are_those_of_the_published_table() {
        assert_eq!(SOBOL_DIMS, 21_201);
        assert_eq!(sobol_initial(0), (1, vec![]));
        assert_eq!(sobol_initial(5), (19, vec![1, 1, 3, 3]));
        let last =
            vec![1, 1, 7, 11, 15, 7, 37, 239, 337, 245, 1557, 3681, 7357, 9639, 27367, 26869, 114603, 86317];
        assert_eq!(sobol_initial(SOBOL_DIMS - 1), (524_263, last));
    }
}
