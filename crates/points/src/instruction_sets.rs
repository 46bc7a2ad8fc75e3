//! One loop, compiled for several instruction sets.
//!
//! The hot loops are plain Rust that the compiler turns into vector instructions; the widest set the
//! machine has is chosen at run time. They consist of integer arithmetic, exact conversions, and operations on
//! floats one by one, in places of their own and without fusion, so that all versions give the same bits.

/// Defines a function `$name` that runs `$body` with the widest instruction set of this machine.
/// `$body` must be `#[inline(always)]`, to be compiled anew for each of them. Where its generics end in
/// `VECTOR`, that is the number of bytes of a vector, and 0 for the version without any.
macro_rules! for_this_machine {
    ($(#[$doc:meta])* $name:ident = $body:ident <$generic:ident: $bound:path, VECTOR>
     ($($arg:ident : $type:ty),* $(,)?)) => {
        crate::instruction_sets::for_this_machine! {
            @define $(#[$doc])* $name <$generic: $bound> ($($arg: $type),*)
            { $body::<$generic, 64>($($arg),*) } { $body::<$generic, 32>($($arg),*) } { $body::<$generic, 0>($($arg),*) }
        }
    };
    ($(#[$doc:meta])* $name:ident = $body:ident $(<$generic:ident: $bound:path>)?
     ($($arg:ident : $type:ty),* $(,)?)) => {
        crate::instruction_sets::for_this_machine! {
            @define $(#[$doc])* $name $(<$generic: $bound>)? ($($arg: $type),*)
            { $body($($arg),*) } { $body($($arg),*) } { $body($($arg),*) }
        }
    };
    (@define $(#[$doc:meta])* $name:ident $(<$generic:ident: $bound:path>)? ($($arg:ident : $type:ty),*)
     $avx512:block $avx2:block $plain:block) => {
        $(#[$doc])*
        pub(crate) fn $name $(<$generic: $bound>)? ($($arg: $type),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,gfni")]
                fn avx512 $(<$generic: $bound>)? ($($arg: $type),*) $avx512
                #[target_feature(enable = "avx2")]
                fn avx2 $(<$generic: $bound>)? ($($arg: $type),*) $avx2
                if crate::instruction_sets::has_avx512() {
                    #[allow(unsafe_code, reason = "the instruction set was checked the line before")]
                    // SAFETY: the features that `avx512` needs were found on this machine.
                    return unsafe { avx512 $(::<$generic>)? ($($arg),*) };
                }
                if crate::instruction_sets::has_avx2() {
                    #[allow(unsafe_code, reason = "the instruction set was checked the line before")]
                    // SAFETY: the feature that `avx2` needs was found on this machine.
                    return unsafe { avx2 $(::<$generic>)? ($($arg),*) };
                }
            }
            $plain
        }
    };
}

pub(crate) use for_this_machine;

/// Ice Lake, Zen 4 and later: what the 512-bit versions use.
#[cfg(target_arch = "x86_64")]
pub(crate) fn has_avx512() -> bool {
    #[cfg(test)]
    if WIDEST.load(std::sync::atomic::Ordering::Relaxed) < 64 {
        return false;
    }
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512vbmi")
        && is_x86_feature_detected!("gfni")
}

/// Haswell, Zen and later: what the 256-bit versions use.
#[cfg(target_arch = "x86_64")]
pub(crate) fn has_avx2() -> bool {
    #[cfg(test)]
    if WIDEST.load(std::sync::atomic::Ordering::Relaxed) < 32 {
        return false;
    }
    is_x86_feature_detected!("avx2")
}

/// Other processors have none of these.
#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn has_avx2() -> bool {
    false
}

/// The widest vectors that may be used, so that the unit tests run the narrower versions too.
#[cfg(test)]
pub(crate) static WIDEST: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(64);
