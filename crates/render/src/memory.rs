//! Hints to the memory: large pages for what rays touch at random, and fetching what will be needed soon.
//!
//! A scene's trees, triangles and texels are read all over the place. In pages of 4 KiB nearly each read also waits for the
//! page's address; pages of 2 MiB need 512 times fewer addresses, which the processor keeps at hand.

/// Ask for large pages under a table that is complete. A hint: elsewhere than on Linux, and for small tables, nothing happens.
pub(crate) fn use_large_pages<T>(table: &[T]) {
    #[cfg(target_os = "linux")]
    {
        const PAGE: usize = 2 << 20;
        let start = table.as_ptr().addr().next_multiple_of(PAGE);
        let end = (table.as_ptr().addr() + size_of_val(table)) / PAGE * PAGE;
        if start < end {
            let address = table.as_ptr().with_addr(start).cast_mut().cast();
            // SAFETY: the range lies within `table`; the advice moves pages, not what they hold.
            #[expect(unsafe_code, reason = "a hint that safe Rust has no word for")]
            unsafe {
                // an old kernel may refuse either, and nothing is lost
                libc::madvise(address, end - start, libc::MADV_HUGEPAGE);
                libc::madvise(address, end - start, libc::MADV_COLLAPSE);
            }
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = table;
}

/// Ask for the memory of a value, without waiting for it.
#[inline(always)]
pub(crate) fn prefetch<T>(value: &T) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of::<T>()).step_by(64) {
        let address = std::ptr::from_ref(value).cast::<i8>().wrapping_add(line);
        // SAFETY: a prefetch reads nothing; SSE is part of x86-64.
        #[expect(unsafe_code, reason = "a hint that safe Rust has no word for")]
        unsafe {
            std::arch::x86_64::_mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>(address);
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = value;
}
