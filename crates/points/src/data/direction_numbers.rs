//! Sobol' matrices from the table of Joe and Kuo, at compile time or at run time, without a heap.

/// The digits of a coordinate, and of an index.
pub(crate) const BITS: usize = 64;

/// The number of dimensions in the table.
#[cfg(feature = "std")]
pub(crate) const SOBOL_DIMS: usize = SOBOL.len() / RECORD;

/// Bytes of one dimension of the packed table, which `README.md` here describes.
const RECORD: usize = 24;

/// Of these, the bytes that hold the initial numbers; the polynomial fills the rest.
const NUMBERS: usize = 20;

static SOBOL: &[u8] = include_bytes!("sobol.bin");

/// The columns of one generating matrix, first digit in the most significant bit: what a renderer needs
/// to build tables of its own. Column k is the word of point 2^k.
///
/// With the polynomial `x^s + a_1 x^(s-1) + … + a_s` and `v_k = m_k / 2^k`, Bratley and Fox (1988,
/// equation 5) give `v_k = a_1 v_(k-1) ⊕ … ⊕ a_s v_(k-s) ⊕ v_(k-s) / 2^s`.
///
/// # Panics
/// If `dim` is not below 21,201.
pub const fn direction_numbers(dim: usize) -> [u64; BITS] {
    let polynomial = little_endian(dim * RECORD + NUMBERS, RECORD - NUMBERS) as u32;
    let degree = polynomial.ilog2() as usize;
    // Dimension 0 has degree 0 and the matrix of van der Corput.
    let given = if degree == 0 { BITS } else { degree };
    let mut columns = [0; BITS];
    let mut k = 0;
    while k < given {
        columns[k] = initial_number(dim, k, degree) << (BITS - 1 - k);
        k += 1;
    }
    continued(columns, given, polynomial)
}

/// All columns, from as many as the degree of the polynomial, or from all of them.
pub(super) const fn continued(mut columns: [u64; BITS], given: usize, polynomial: u32) -> [u64; BITS] {
    let degree = polynomial.ilog2() as usize;
    let mut k = given;
    while k < BITS {
        columns[k] = recurrence(&columns, k, degree, polynomial);
        k += 1;
    }
    columns
}

const fn recurrence(columns: &[u64; BITS], k: usize, degree: usize, polynomial: u32) -> u64 {
    let mut sum = columns[k - degree] >> degree;
    let mut j = 1;
    while j <= degree {
        if polynomial >> (degree - j) & 1 == 1 {
            sum ^= columns[k - j];
        }
        j += 1;
    }
    sum
}

/// The number `m_(k+1)`, which is odd and has `k + 1` bits; the last of them is not stored.
const fn initial_number(dim: usize, k: usize, degree: usize) -> u64 {
    if degree == 0 {
        return 1;
    }
    let position = k * (k - (k > 0) as usize) / 2;
    let byte = position / 8;
    let bytes = if NUMBERS - byte < 8 { NUMBERS - byte } else { 8 };
    let window = little_endian(dim * RECORD + byte, bytes) >> (position % 8);
    (window & ((1 << k) - 1)) << 1 | 1
}

const fn little_endian(start: usize, bytes: usize) -> u64 {
    let mut word = 0;
    let mut i = bytes;
    while i > 0 {
        i -= 1;
        word = word << 8 | SOBOL[start + i] as u64;
    }
    word
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_and_last_records_are_those_of_the_published_table() {
        let initial = |dim, degree| (0..degree).map(|k| initial_number(dim, k, degree)).collect::<Vec<_>>();
        assert_eq!(SOBOL_DIMS, 21_201);
        assert_eq!(direction_numbers(0), std::array::from_fn(|k| 1 << (63 - k)));
        assert_eq!(initial(5, 4), [1, 1, 3, 3]);
        let last =
            [1, 1, 7, 11, 15, 7, 37, 239, 337, 245, 1557, 3681, 7357, 9639, 27367, 26869, 114603, 86317];
        assert_eq!(initial(SOBOL_DIMS - 1, 18), last);
        assert_eq!(little_endian((SOBOL_DIMS - 1) * RECORD + NUMBERS, 4), 524_263);
        assert_eq!(little_endian(5 * RECORD + NUMBERS, 4), 19);
    }
}
