//! Yardsticks for the points: the speed of memory, and the crate `sobol_burley`, callable from Python.

use std::arch::x86_64::{_mm_set1_ps, _mm_sfence, _mm_stream_ps, _mm512_set1_ps, _mm512_stream_ps};
use std::slice::from_raw_parts_mut;

/// Writes one number everywhere, past the caches: nothing can fill an array faster for long.
///
/// # Safety
/// `out` has `count` places; whole lines of cache among them are written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn stream(out: *mut f32, count: usize) {
    // SAFETY: as promised by the caller; the features are checked.
    unsafe {
        let out = from_raw_parts_mut(out, count);
        let lines = out.align_to_mut::<Line>().1;
        if is_x86_feature_detected!("avx512f") {
            wide(lines)
        } else {
            narrow(lines)
        }
        _mm_sfence();
    }
}

/// A line of cache.
#[repr(align(64))]
struct Line([f32; 16]);

#[target_feature(enable = "avx512f")]
fn wide(lines: &mut [Line]) {
    for line in lines {
        // SAFETY: a line is 64 aligned bytes.
        unsafe { _mm512_stream_ps(line.0.as_mut_ptr(), _mm512_set1_ps(0.5)) };
    }
}

fn narrow(lines: &mut [Line]) {
    for line in lines {
        for part in line.0.chunks_exact_mut(4) {
            // SAFETY: a part is 16 aligned bytes.
            unsafe { _mm_stream_ps(part.as_mut_ptr(), _mm_set1_ps(0.5)) };
        }
    }
}

/// Points of `sobol_burley`, four dimensions at a time; a new seed for every 2^16 points, which is all that it has.
///
/// # Safety
/// `out` has `rows * dims` places, and `dims` is a multiple of 4.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn burley(out: *mut f32, rows: u32, dims: u32, seed: u32) {
    // SAFETY: as promised by the caller.
    let out = unsafe { from_raw_parts_mut(out, rows as usize * dims as usize) };
    for (row, point) in (0..).zip(out.chunks_exact_mut(dims as usize)) {
        for (set, four) in (0..).zip(point.chunks_exact_mut(4)) {
            four.copy_from_slice(&sobol_burley::sample_4d(row & 0xffff, set, seed + (row >> 16)));
        }
    }
}
