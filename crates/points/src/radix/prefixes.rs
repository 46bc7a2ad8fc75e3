//! What is known of some prefixes, in the form in which loops read it.

/// One entry for each of some prefixes; what a randomization has no use for is empty.
#[derive(Clone, Debug, Default)]
pub(super) struct Prefixes {
    /// Where their cells begin, in units of 2^-64.
    pub(super) words: Vec<u64>,
    /// The rest of their digits, in units of 2^-64 of a cell.
    pub(super) fractions: Vec<u64>,
    /// High digit `place` of prefix i at `place * words.len() + i`.
    pub(super) digits: Vec<u16>,
}

impl Prefixes {
    /// Room for some prefixes, and for some high digits of each.
    pub(super) fn of(count: usize, digits: usize) -> Self {
        Self { words: vec![0; count], fractions: vec![0; count], digits: vec![0; count * digits] }
    }
}
