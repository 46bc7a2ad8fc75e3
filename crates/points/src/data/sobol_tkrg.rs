//! Sobol' matrices from the table tkrg-a-ap5, one dimension after the other: records have no fixed length.

use super::direction_numbers::{BITS, continued};

/// The number of dimensions in the table.
pub(crate) const TKRG_DIMS: usize = 50_000;

static RECORDS: &[u8] = include_bytes!("sobol_tkrg.bin");

/// The columns of the generating matrices, first digit in the most significant bit.
pub(crate) fn matrices() -> impl Iterator<Item = [u64; BITS]> {
    let (mut polynomial, mut rest) = (1, RECORDS);
    let later = std::iter::from_fn(move || {
        let (&step, numbers) = rest.split_first()?;
        polynomial += 2 * u32::from(step);
        let degree = polynomial.ilog2() as usize;
        let (numbers, records) = numbers.split_at((degree * (degree - 1) / 2).div_ceil(8));
        rest = records;
        let mut columns = [0; BITS];
        let mut position = 0;
        for (k, column) in columns.iter_mut().enumerate().take(degree) {
            *column = (bits(numbers, position, k) << 1 | 1) << (BITS - 1 - k);
            position += k;
        }
        Some(continued(columns, degree, polynomial))
    });
    std::iter::once(std::array::from_fn(|k| 1 << (BITS - 1 - k))).chain(later)
}

/// `count` bits from a place on, the least significant first; at most 20, which are in four bytes.
fn bits(bytes: &[u8], position: usize, count: usize) -> u64 {
    let window =
        bytes[position / 8..].iter().take(4).rev().fold(0, |word, &byte| word << 8 | u64::from(byte));
    window >> (position % 8) & ((1 << count) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_and_last_records_are_those_of_the_published_table() {
        let initial = |columns: [u64; BITS], degree: usize| {
            (0..degree).map(|k| columns[k] >> (BITS - 1 - k)).collect::<Vec<_>>()
        };
        let all: Vec<_> = matrices().collect();
        assert_eq!(all.len(), TKRG_DIMS);
        assert_eq!(initial(all[1], 2), [1, 3]);
        assert_eq!(initial(all[2], 3), [1, 1, 7]);
        let last = [
            1, 3, 7, 5, 7, 33, 107, 51, 397, 345, 873, 1579, 7059, 2593, 4519, 58555, 39623, 240_347,
            242_303, 563_961,
        ];
        assert_eq!(initial(all[TKRG_DIMS - 1], 20), last);
        // degree 20, inner coefficients 25877
        let mut columns = all[TKRG_DIMS - 1];
        columns[20..].fill(0);
        assert_eq!(continued(columns, 20, 1 << 20 | 25_877 << 1 | 1), all[TKRG_DIMS - 1]);
    }
}
