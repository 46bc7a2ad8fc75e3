//! The field of 2^16 elements, and inside it those of 2, 4, 16 and 256: a tower in which each smaller
//! field is the first numbers of the next. Elements are words, added by exclusive-or.
//!
//! Above a field of 2^q elements comes the one that adjoins z with z² = z + 2^(q − 1): the number
//! a + b · 2^q means a + b z. These are J. H. Conway's nim-multiplication tables (*On Numbers and Games*, 1976).

/// The binary logarithm of the size of the largest field.
pub(crate) const BITS: u32 = 16;

/// The product of two elements of the field of 2^`bits`.
pub(crate) const fn product(a: u32, b: u32, bits: u32) -> u32 {
    if bits == 1 || a < 2 || b < 2 {
        return if a == 0 || b == 0 {
            0
        } else if a == 1 {
            b
        } else if b == 1 {
            a
        } else {
            1
        };
    }
    let half = bits / 2;
    let mask = (1 << half) - 1;
    let ([a0, a1], [b0, b1]) = ([a & mask, a >> half], [b & mask, b >> half]);
    let low = product(a0, b0, half);
    let high = product(a1, b1, half);
    let cross = product(a0 ^ a1, b0 ^ b1, half) ^ low;
    (cross << half) | (low ^ product(high, 1 << (half - 1), half))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonzero_elements_form_a_group() {
        for bits in [1, 2, 4, 8] {
            for a in 1..1 << bits {
                let mut row: Vec<_> = (1..1 << bits).map(|b| product(a, b, bits)).collect();
                assert!(row.iter().zip(1..).all(|(&ab, b)| ab == product(b, a, bits)), "commutes");
                row.sort_unstable();
                assert!(row.into_iter().eq(1..1 << bits), "{a} in the field of 2^{bits}");
            }
        }
    }

    #[test]
    fn multiplication_is_associative_and_distributes() {
        let words = (0..2000_u64).map(|i| crate::seed::mix(i) as u32);
        for (word, next) in words.clone().zip(words.skip(1)) {
            let (a, b, c) = (word & 0xffff, word >> 16, next & 0xffff);
            let times = |a, b| product(a, b, BITS);
            assert_eq!(times(a, times(b, c)), times(times(a, b), c));
            assert_eq!(times(a, b ^ c), times(a, b) ^ times(a, c));
        }
    }

    #[test]
    fn smaller_fields_are_inside_larger_ones() {
        assert_eq!(
            [product(2, 2, BITS), product(2, 3, BITS), product(4, 4, BITS), product(16, 16, BITS)],
            [3, 1, 6, 24]
        );
        for (a, b) in (0..16).flat_map(|a| (0..16).map(move |b| (a, b))) {
            assert_eq!(product(a, b, 4), product(a, b, BITS));
        }
    }
}
