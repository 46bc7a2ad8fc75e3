//! The generating matrices of four dimensions that are good in base 4 together and in base 2 in pairs.
//!
//! Over the field of four elements 0, 1, w, w² the powers a = 0, 1, w, w² of Pascal's matrix, with entries `C(j, i) a^(j - i)`, generate a
//! (0, 4)-sequence in base 4 (Faure 1982; Niederreiter 1987). Base 4 leaves open which two bits write a digit. A search over the
//! choices for each digit showed that one choice for all digits makes dimensions 0 and 1, and 2 and 3, (0, 2)-sequences in base 2:
//! the element x + y w is written (x, y) in the even dimensions and (x + y, x) in the odd ones.

/// How many dimensions there are.
pub(super) const DIMS: usize = 4;

/// Groups of four bits in half an index.
pub(super) const NIBBLES: usize = 4;

/// `WORDS[h][n][v]`: the coordinates of the point whose only index bits are in group n of half h, first digit in the lowest bit. The index
/// bits `v` come with the first, which is worth least, as the highest: what the hash of the shuffle leaves behind.
pub(super) static WORDS: [[[[u32; DIMS]; 16]; NIBBLES]; 2] = words();

const fn words() -> [[[[u32; DIMS]; 16]; NIBBLES]; 2] {
    let mut words = [[[[0; DIMS]; 16]; NIBBLES]; 2];
    let mut nibble = 0;
    while nibble < 2 * NIBBLES {
        let mut bits = 0;
        while bits < 16 {
            let value = (bits as u32).reverse_bits() >> 28;
            let mut dim = 0;
            while dim < DIMS {
                let low = column(dim, 2 * nibble, value & 3);
                let high = column(dim, 2 * nibble + 1, value >> 2);
                words[nibble / NIBBLES][nibble % NIBBLES][bits][dim] = low ^ high;
                dim += 1;
            }
            bits += 1;
        }
        nibble += 1;
    }
    words
}

/// The coordinate of the point whose only base-4 digit, number `j`, is `digit`.
const fn column(dim: usize, j: usize, digit: u32) -> u32 {
    let mut word = 0;
    let mut element = digit; // times a^(j - i)
    let mut i = j;
    loop {
        if i & j == i {
            // C(j, i) is odd (Lucas)
            let (x, y) = (element & 1, element >> 1);
            let written = if dim.is_multiple_of(2) { x | y << 1 } else { x ^ y | x << 1 };
            word |= written << (2 * i);
        }
        if i == 0 {
            return word;
        }
        i -= 1;
        element = product(element, dim as u32);
    }
}

/// The product in the field of four elements x + y w, written as the number x + 2y; w² = w + 1.
const fn product(a: u32, b: u32) -> u32 {
    let carry = (a >> 1) & (b >> 1);
    let x = (a & b & 1) ^ carry;
    let y = ((a & 1) & (b >> 1)) ^ ((a >> 1) & (b & 1)) ^ carry;
    x | y << 1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of the matrix of a dimension over the index bits, first digit first.
    fn rows(dim: usize) -> Vec<u32> {
        let column = |bit: usize| WORDS[bit / 16][bit / 4 % 4][8 >> (bit % 4)][dim];
        (0..32).map(|digit| (0..32).map(|bit| (column(bit) >> digit & 1) << bit).sum()).collect()
    }

    /// Whether the rows are independent when only the first `bits` of the index count.
    fn independent<'a>(rows: impl Iterator<Item = &'a u32>, bits: usize) -> bool {
        let mut basis = [0_u32; 32];
        for row in rows {
            let mut row = (u64::from(*row) & ((1 << bits) - 1)) as u32;
            while row != 0 {
                let top = row.ilog2() as usize;
                if basis[top] == 0 {
                    basis[top] = row;
                    break;
                }
                row ^= basis[top];
            }
            if row == 0 {
                return false;
            }
        }
        true
    }

    #[test]
    fn pairs_are_nets_in_base_two() {
        for (a, b) in [(rows(0), rows(1)), (rows(2), rows(3))] {
            for k in 0..=32 {
                for first in 0..=k {
                    assert!(independent(a[..first].iter().chain(&b[..k - first]), k), "{first} of {k}");
                }
            }
        }
    }

    #[test]
    fn quadruples_are_nets_in_base_four() {
        let rows: Vec<_> = (0..DIMS).map(rows).collect();
        for k in 0..=8_usize {
            for code in 0..9_usize.pow(3) {
                let [a, b, c] = [code % 9, code / 9 % 9, code / 81];
                let Some(d) = k.checked_sub(a + b + c) else { continue };
                let taken = [a, b, c, d].into_iter().zip(&rows).flat_map(|(n, rows)| &rows[..2 * n]);
                assert!(independent(taken, 2 * k), "{a} {b} {c} {d}");
            }
        }
    }
}
