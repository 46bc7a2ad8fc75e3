//! Arrays written past the caches: points at the speed of memory.
//!
//! An ordinary store first reads the line that it will overwrite, and leaves it in a cache from which it
//! is displaced before anyone reads it. Non-temporal stores of whole lines avoid both, which is worth a
//! factor of up to two once an array is larger than the caches; below that they would only send to memory
//! what a reader would have found in cache.
//!
//! A line that is written in parts is read after all, and everything waits for it. A [`Stream`] therefore
//! keeps the numbers of an unfinished line until it is whole. Vectors go to memory one by one, as they are
//! made: copying finished blocks would take turns with making them.

use crate::convert::Unit;

/// Numbers that are made and written together: a line of cache in single precision, two in double.
pub(crate) const LANES: usize = 16;

/// Numbers that are made and written together.
pub(crate) type Lanes<T> = [T; LANES];

/// The bytes of a line of cache.
const LINE: usize = 64;

/// The smallest array that is written past the caches: what a core has of the caches of today's servers.
const LARGE: usize = 8 << 20;

/// Whether `out` is worth it, and this machine can.
pub(crate) fn pays<T>(out: &[T]) -> bool {
    size_of_val(out) >= LARGE && cfg!(target_arch = "x86_64") && crate::instruction_sets::has_avx2()
}

/// An array that is written from its first place to its last, past the caches if that pays.
pub(crate) struct Stream<'a, T: Unit> {
    rest: &'a mut [T],
    past: bool,
    /// Numbers that wait until their line is whole.
    waiting: Lanes<T>,
    /// Where the first of them is, and where the next will be.
    first: usize,
    next: usize,
}

impl<'a, T: Unit> Stream<'a, T> {
    /// All of `out`, whose first line may begin before it.
    pub(crate) fn new(out: &'a mut [T]) -> Self {
        let past = pays(out);
        Self::of(out, past)
    }

    /// The same, past the caches or not.
    pub(crate) fn of(out: &'a mut [T], past: bool) -> Self {
        let first = (LANES - out.as_ptr().align_offset(LINE) % LANES) % LANES;
        Self { past, rest: out, waiting: [T::default(); LANES], first, next: first }
    }

    /// Whether whole lines go past the caches.
    #[inline(always)]
    pub(crate) fn past(&self) -> bool {
        self.past
    }

    /// How many numbers are still to come.
    #[inline(always)]
    pub(crate) fn places_left(&self) -> usize {
        self.rest.len() - (self.next - self.first)
    }

    /// How many numbers the line that is begun still lacks; 0 if none is begun.
    #[inline(always)]
    pub(crate) fn lacking(&self) -> usize {
        (LANES - self.next) % LANES
    }

    /// Writes the first `count` numbers, no more than the line that is begun has place for.
    #[inline(always)]
    pub(crate) fn write_part(&mut self, numbers: &Lanes<T>, count: usize) {
        self.waiting[self.next..][..count].copy_from_slice(&numbers[..count]);
        self.next += count;
        if self.next == LANES {
            self.flush();
        }
    }

    /// The next whole lines, to be written with [`store`]. None may be begun.
    #[inline(always)]
    pub(crate) fn take_lines(&mut self, count: usize) -> &mut [Lanes<T>] {
        debug_assert_eq!(self.next, 0, "a line is begun");
        let (lines, rest) = std::mem::take(&mut self.rest).split_at_mut(count * LANES);
        self.rest = rest;
        lines.as_chunks_mut().0
    }

    /// Writes what is waiting in the ordinary way: the first and the last line of an array.
    fn flush(&mut self) {
        let (part, rest) = std::mem::take(&mut self.rest).split_at_mut(self.next - self.first);
        part.copy_from_slice(&self.waiting[self.first..self.next]);
        self.rest = rest;
        (self.first, self.next) = (0, 0);
    }
}

impl<T: Unit> Drop for Stream<'_, T> {
    fn drop(&mut self) {
        self.flush();
        #[cfg(target_arch = "x86_64")]
        if self.past {
            Self::fence();
        }
    }
}

impl<T: Unit> Stream<'_, T> {
    /// Other threads then see what was streamed.
    #[cfg(target_arch = "x86_64")]
    fn fence() {
        #[allow(unsafe_code, reason = "an instruction that every x86-64 machine has")]
        // SAFETY: it belongs to SSE, which is part of x86-64.
        unsafe {
            std::arch::x86_64::_mm_sfence();
        }
    }
}

/// Writes a line `past` the caches, in vectors of `VECTOR` bytes; without any, or not past them, in the ordinary way.
#[inline(always)]
pub(crate) fn store<T: Unit, const VECTOR: usize>(past: bool, line: &Lanes<T>, to: &mut Lanes<T>) {
    #[cfg(target_arch = "x86_64")]
    if VECTOR > 0 && past {
        use std::arch::x86_64::{_mm256_loadu_ps, _mm256_stream_ps, _mm512_loadu_ps, _mm512_stream_ps};
        assert!(to.as_ptr().addr().is_multiple_of(LINE), "lines begin at lines");
        let (from, to): (*const f32, *mut f32) = (line.as_ptr().cast(), to.as_mut_ptr().cast());
        for at in (0..size_of::<Lanes<T>>() / size_of::<f32>()).step_by(VECTOR / size_of::<f32>()) {
            #[allow(unsafe_code, reason = "there is no other way to a non-temporal store")]
            // SAFETY: both arrays have whole lines, the second begins at one, and any bits may be stored as floats.
            // `for_this_machine` gives VECTOR the width that the instruction set it found has.
            unsafe {
                if VECTOR == 64 {
                    _mm512_stream_ps(to.add(at), _mm512_loadu_ps(from.add(at)));
                } else {
                    _mm256_stream_ps(to.add(at), _mm256_loadu_ps(from.add(at)));
                }
            }
        }
        return;
    }
    *to = *line;
}
