//! `independent`: plain Monte Carlo, by hashing a counter. The yardstick; choose it where nothing else may be assumed.

use evenlight_points::Seed;

use crate::sampler::{BLOCK, Entry, GOLDEN, Sharing, mix, unit_f32};

pub(crate) const ENTRY: Entry = Entry {
    name: "independent",
    cite: "Metropolis & Ulam 1949, The Monte Carlo Method, JASA 44",
    base: None,
    sharing: Sharing::Pixel,
    fill,
};

fn fill(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]) {
    let start = key.split(TAG, u64::from(index) << 32 | u64::from(block)).bits64();
    for (pair, numbers) in (1..).zip(out.as_chunks_mut::<2>().0) {
        let bits = mix(start.wrapping_add(GOLDEN.wrapping_mul(pair)));
        *numbers = [unit_f32((bits >> 32) as u32), unit_f32(bits as u32)];
    }
}

const TAG: u64 = 16;
