//! One loop, compiled for several instruction sets.
//!
//! The hot loops are plain Rust that the compiler turns into vector instructions; the widest set the
//! machine has is chosen at run time. They consist of integer arithmetic and exact conversions only,
//! so that all versions give the same bits.

/// Defines a function `$name` that runs `$body` with the widest instruction set of this machine.
/// `$body` must be `#[inline(always)]`, to be compiled anew for each of them.
macro_rules! for_this_machine {
    ($(#[$doc:meta])* $name:ident = $body:ident $(<$generic:ident: $bound:path>)? ($($arg:ident : $type:ty),*)) => {
        $(#[$doc])*
        pub(crate) fn $name $(<$generic: $bound>)? ($($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,gfni")]
                fn avx512 $(<$generic: $bound>)? ($($arg: $type),*) {
                    $body($($arg),*);
                }
                #[target_feature(enable = "avx2")]
                fn avx2 $(<$generic: $bound>)? ($($arg: $type),*) {
                    $body($($arg),*);
                }
                if crate::instruction_sets::has_avx512() {
                    #[allow(unsafe_code, reason = "the instruction set was checked the line before")]
                    // SAFETY: the features that `avx512` needs were found on this machine.
                    return unsafe { avx512($($arg),*) };
                }
                if is_x86_feature_detected!("avx2") {
                    #[allow(unsafe_code, reason = "the instruction set was checked the line before")]
                    // SAFETY: the feature that `avx2` needs was found on this machine.
                    return unsafe { avx2($($arg),*) };
                }
            }
            $body($($arg),*);
        }
    };
}

pub(crate) use for_this_machine;

/// Ice Lake, Zen 4 and later: what the 512-bit versions use.
#[cfg(target_arch = "x86_64")]
pub(crate) fn has_avx512() -> bool {
    #[cfg(test)]
    if WITHOUT_AVX512.load(std::sync::atomic::Ordering::Relaxed) {
        return false;
    }
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512vbmi")
        && is_x86_feature_detected!("gfni")
}

/// Lets the unit tests run the narrower version on a machine that has the wider one.
#[cfg(test)]
pub(crate) static WITHOUT_AVX512: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);
