//! Pirsic's matrices of the Niederreiter–Xing sequences.

/// The columns of a matrix in the table, and the digits of a column.
pub(crate) const COLUMNS: usize = 30;

/// The dimensions of the sequences in the table.
pub(crate) const DIMENSIONS: std::ops::RangeInclusive<usize> = 4..=32;

static MATRICES: &[u8] = include_bytes!("niederreiter_xing.bin");

/// The columns of matrix `dim` of the sequence in `dims` dimensions, first digit in the most significant bit.
pub(crate) fn niederreiter_xing(dims: usize, dim: usize) -> [u64; COLUMNS] {
    assert!(DIMENSIONS.contains(&dims) && dim < dims, "matrix {dim} of the sequence in {dims} dimensions");
    let first = (dims * (dims - 1) / 2 - 6 + dim) * COLUMNS;
    let (words, _) = MATRICES.as_chunks();
    std::array::from_fn(|k| u64::from(u32::from_le_bytes(words[first + k])) << (u64::BITS as usize - COLUMNS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_all_matrices() {
        let matrices: usize = DIMENSIONS.sum();
        assert_eq!(MATRICES.len(), matrices * COLUMNS * 4);
        assert_eq!(niederreiter_xing(4, 0)[0], 0b0010_0111_0010_0111_0010_0111_0010_0111 << 34);
        assert_eq!(niederreiter_xing(32, 31)[0] % (1 << 34), 0);
    }
}
