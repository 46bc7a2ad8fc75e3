//! Nested uniform scrambling in base 2 as published: a random bit of its own at every node of the tree of digits.
//!
//! Choose it to check `owen`, which hashes whole words and costs a tenth, or where no approximation is wanted. The bits are
//! those of a hash of (key, node), so that nothing is stored and any point comes alone: 63 bits of one hash serve the 63 nodes
//! of six levels below a node. From the 54th digit on, beyond the precision of a double, all points with the same first digits share
//! their bits.

use super::{Entry, Randomization};
use crate::seed::mix;

pub(super) const ENTRY: Entry = Entry {
    randomization: Randomization::OwenExact,
    name: "owen_exact",
    cite: "A. B. Owen, Randomly permuted (t,m,s)-nets and (t,s)-sequences, LNS 106, 299-317 (1995)",
    apply: |word, key| exact_scramble(word, key.bits64()),
    affine: false,
    nested: true,
};

/// The levels that one hash serves: 2^6 − 1 nodes.
const LEVELS: u32 = 6;

/// Groups of levels: 54 digits, one more than a double has.
const GROUPS: u32 = 9;

/// Scrambles a word, first digit in its most significant bit.
fn exact_scramble(word: u64, key: u64) -> u64 {
    let mut words = [word];
    exact_scrambles(&mut words, &[key]);
    words[0]
}

/// Scrambles words, each with its key: level by level, so that the loops over the words become vector instructions.
#[inline(always)]
pub(crate) fn exact_scrambles<const N: usize>(words: &mut [u64; N], keys: &[u64; N]) {
    let mut flips = [0; N];
    for group in 0..GROUPS {
        let mut bits = [0; N];
        for i in 0..N {
            // the node: the digits before the group, after a 1 that tells nodes of different depths apart
            let node = (words[i] >> 1 | 1 << 63) >> (63 - LEVELS * group);
            bits[i] = mix(mix(node ^ keys[i]).wrapping_add(keys[i]));
        }
        for level in 0..LEVELS {
            let place = LEVELS * group + level;
            for i in 0..N {
                // of the heap that the group's nodes make in `bits`: 1, then 2 and 3, then 4 to 7, …
                let digits = words[i] >> (64 - LEVELS * group - level).min(63) & ((1 << level) - 1);
                flips[i] |= (bits[i] >> (1 << level | digits) & 1) << (63 - place);
            }
        }
    }
    for i in 0..N {
        let tail = mix((words[i] >> 10) ^ mix(keys[i])) >> 54;
        words[i] ^= flips[i] | tail;
    }
}
