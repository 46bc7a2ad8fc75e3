//! Writing past the caches: what a large array of points needs to be made at the speed of memory.
//!
//! An ordinary store first reads the line that it will overwrite, and leaves it in a cache from which it
//! will have been displaced before anyone reads it. Non-temporal stores of whole lines avoid both, and
//! are two to three times as fast once an array is larger than the caches; below that size they would only
//! send to memory what its reader would have found in cache.

use crate::convert::Unit;

/// The smallest array that is written past the caches: half of the last-level cache of today's servers.
static LARGE_BYTES: std::sync::LazyLock<usize> = std::sync::LazyLock::new(|| std::env::var("LARGE").map_or(16 << 20, |s| s.parse().unwrap()));

/// An array that is written from its first place to its last.
pub(crate) struct Writer<'a, T: Unit> {
    rest: &'a mut [T],
    /// Where a block is made before it is streamed to memory; nothing if it is made in place.
    block: Option<Vec<T>>,
}

impl<'a, T: Unit> Writer<'a, T> {
    /// A writer to `out`, past the caches if that is large.
    pub(crate) fn new(out: &'a mut [T]) -> Self {
        let large = size_of_val(out) >= *LARGE_BYTES;
        Self { rest: out, block: (large && can_stream()).then(Vec::new) }
    }

    /// The places that are not written yet.
    pub(crate) fn places_left(&self) -> usize {
        self.rest.len()
    }

    /// Writes the next `places` with what `make` puts into them.
    pub(crate) fn write(&mut self, places: usize, make: impl FnOnce(&mut [T])) {
        let (part, later) = std::mem::take(&mut self.rest).split_at_mut(places);
        self.rest = later;
        let Some(block) = &mut self.block else { return make(part) };
        if block.len() < places {
            block.resize(places, T::default());
        }
        make(&mut block[..places]);
        stream(&block[..places], part);
    }
}

impl<T: Unit> Drop for Writer<'_, T> {
    fn drop(&mut self) {
        #[cfg(target_arch = "x86_64")]
        if self.block.is_some() {
            unsafe { std::arch::x86_64::_mm_sfence() };
        }
    }
}

/// The bytes of a line of cache, which are also those of the widest vector.
const LINE: usize = 64;

fn can_stream() -> bool {
    cfg!(target_arch = "x86_64")
}

/// Copies `from` to `to`, whole lines without reading them and past the caches.
fn stream<T: Unit>(from: &[T], to: &mut [T]) {
    let per_line = LINE / size_of::<T>();
    let head = to.as_ptr().align_offset(LINE).min(to.len());
    let lines = (to.len() - head) / per_line;
    let (from_head, from_rest) = from.split_at(head);
    let (to_head, to_rest) = to.split_at_mut(head);
    let (from_lines, from_tail) = from_rest.split_at(lines * per_line);
    let (to_lines, to_tail) = to_rest.split_at_mut(lines * per_line);
    to_head.copy_from_slice(from_head);
    stream_lines(from_lines, to_lines);
    to_tail.copy_from_slice(from_tail);
}

#[cfg(target_arch = "x86_64")]
fn stream_lines<T: Unit>(from: &[T], to: &mut [T]) {
    use std::arch::x86_64::{__m512i, _mm512_loadu_si512, _mm512_stream_si512};
    #[target_feature(enable = "avx512f")]
    unsafe fn avx512(from: *const __m512i, to: *mut __m512i, lines: usize) {
        for line in 0..lines {
            unsafe { _mm512_stream_si512(to.add(line), _mm512_loadu_si512(from.add(line))) };
        }
    }
    unsafe { avx512(from.as_ptr().cast(), to.as_mut_ptr().cast(), size_of_val(to) / LINE) }
}
#[cfg(not(target_arch = "x86_64"))]
fn stream_lines<T: Unit>(from: &[T], to: &mut [T]) {
    to.copy_from_slice(from);
}
