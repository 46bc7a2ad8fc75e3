//! Vectors of a few floats: what the traversal needs of SIMD, and no more.
//!
//! The traversal is written once over [`Lanes`]. [`Avx8`] and [`Sse4`] are x86 registers; [`Array`] is plain Rust for every
//! other CPU. All operations round alike, so every implementation finds the same hits.
#![allow(unsafe_code)] // the one place that speaks to x86 intrinsics

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{
    __m128, __m256, _CMP_EQ_OQ, _CMP_GT_OQ, _CMP_LE_OQ, _mm_add_ps, _mm_cmpeq_ps, _mm_cmpgt_ps, _mm_cmple_ps,
    _mm_div_ps, _mm_fmadd_ps, _mm_loadu_ps, _mm_max_ps, _mm_min_ps, _mm_movemask_ps, _mm_mul_ps, _mm_set1_ps,
    _mm_storeu_ps, _mm_sub_ps, _mm256_add_ps, _mm256_cmp_ps, _mm256_div_ps, _mm256_fmadd_ps, _mm256_loadu_ps,
    _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps, _mm256_set1_ps, _mm256_storeu_ps,
    _mm256_sub_ps,
};

/// A vector of `WIDTH` floats. Comparisons give one bit per lane and are false for NaN.
///
/// A value is proof that the CPU has the instructions: only the two `unsafe` constructors make one from nothing, and their
/// callers vouch for the CPU. That is why the operations on values are safe to call.
pub(super) trait Lanes: Copy {
    /// The number of lanes, at most 8.
    const WIDTH: usize;

    /// The same value in all lanes.
    ///
    /// # Safety
    /// The CPU must support this implementation.
    unsafe fn splat(x: f32) -> Self;

    /// `WIDTH` consecutive floats.
    ///
    /// # Safety
    /// The CPU must support this implementation, and `source` must be readable for `WIDTH` floats.
    unsafe fn load(source: *const f32) -> Self;

    /// The lanes as an array; lanes past `WIDTH` are 0.
    fn to_array(self) -> [f32; 8];
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// `self * factor + term`; fused or not.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn le(self, other: Self) -> u32;
    fn gt(self, other: Self) -> u32;
    fn eq(self, other: Self) -> u32;
}

/// Three numbers, each in all lanes of its own vector.
///
/// # Safety
/// The CPU must support `L`.
#[inline(always)]
pub(super) unsafe fn splat3<L: Lanes>(xyz: [f32; 3]) -> [L; 3] {
    // SAFETY: the caller promises the CPU. (Array::map would hide these calls from the inliner.)
    unsafe { [L::splat(xyz[0]), L::splat(xyz[1]), L::splat(xyz[2])] }
}

/// Portable vector of `N` floats.
#[derive(Clone, Copy, Debug)]
pub(super) struct Array<const N: usize>([f32; N]);

impl<const N: usize> Array<N> {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }

    #[inline(always)]
    fn mask(self, other: Self, f: impl Fn(f32, f32) -> bool) -> u32 {
        (0..N).fold(0, |mask, lane| mask | u32::from(f(self.0[lane], other.0[lane])) << lane)
    }
}

impl<const N: usize> Lanes for Array<N> {
    const WIDTH: usize = N;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Self([x; N])
    }

    #[inline(always)]
    unsafe fn load(source: *const f32) -> Self {
        // SAFETY: the caller promises N readable floats.
        Self(unsafe { source.cast::<[f32; N]>().read_unaligned() })
    }

    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        std::array::from_fn(|lane| if lane < N { self.0[lane] } else { 0.0 })
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // Not f32::mul_add: without the instruction that is a slow library call.
        self.mul(factor).add(term)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.mask(other, |a, b| a <= b)
    }

    #[inline(always)]
    fn gt(self, other: Self) -> u32 {
        self.mask(other, |a, b| a > b)
    }

    #[inline(always)]
    fn eq(self, other: Self) -> u32 {
        self.mask(other, |a, b| a == b)
    }
}

/// One x86 register type: the intrinsic behind each operation.
#[cfg(target_arch = "x86_64")]
macro_rules! register {
    ($(#[$doc:meta])* $name:ident($register:ty) x $width:literal;
     $splat:ident $load:ident $store:ident $add:ident $sub:ident $mul:ident $div:ident $fma:ident $min:ident $max:ident;
     $movemask:ident le $le:path; gt $gt:path; eq $eq:path;) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(super) struct $name($register);

        impl Lanes for $name {
            const WIDTH: usize = $width;

            #[inline(always)]
            unsafe fn splat(x: f32) -> Self {
                // SAFETY: the caller vouches for the CPU.
                Self(unsafe { $splat(x) })
            }

            #[inline(always)]
            unsafe fn load(source: *const f32) -> Self {
                // SAFETY: the caller vouches for the CPU and for the floats.
                Self(unsafe { $load(source) })
            }

            #[inline(always)]
            fn to_array(self) -> [f32; 8] {
                let mut out = [0.0; 8];
                // SAFETY: `self` proves the CPU; `out` has room for all lanes.
                unsafe { $store(out.as_mut_ptr(), self.0) };
                out
            }

            register!(@binary add $add);
            register!(@binary sub $sub);
            register!(@binary mul $mul);
            register!(@binary div $div);
            register!(@binary min $min);
            register!(@binary max $max);
            register!(@compare le $movemask $le);
            register!(@compare gt $movemask $gt);
            register!(@compare eq $movemask $eq);

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                // SAFETY: `self` proves the CPU.
                Self(unsafe { $fma(self.0, factor.0, term.0) })
            }
        }
    };
    (@binary $name:ident $intrinsic:ident) => {
        #[inline(always)]
        fn $name(self, other: Self) -> Self {
            // SAFETY: `self` proves the CPU.
            Self(unsafe { $intrinsic(self.0, other.0) })
        }
    };
    (@compare $name:ident $movemask:ident $compare:path) => {
        #[inline(always)]
        fn $name(self, other: Self) -> u32 {
            // SAFETY: `self` proves the CPU.
            unsafe { $movemask($compare(self.0, other.0)) as u32 }
        }
    };
}

#[cfg(target_arch = "x86_64")]
register! {
    /// Eight floats; needs AVX2 and FMA.
    Avx8(__m256) x 8;
    _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps
    _mm256_fmadd_ps _mm256_min_ps _mm256_max_ps;
    _mm256_movemask_ps le _mm256_cmp_ps::<_CMP_LE_OQ>; gt _mm256_cmp_ps::<_CMP_GT_OQ>; eq _mm256_cmp_ps::<_CMP_EQ_OQ>;
}

#[cfg(target_arch = "x86_64")]
register! {
    /// Four floats; needs FMA.
    Sse4(__m128) x 4;
    _mm_set1_ps _mm_loadu_ps _mm_storeu_ps _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps
    _mm_fmadd_ps _mm_min_ps _mm_max_ps;
    _mm_movemask_ps le _mm_cmple_ps; gt _mm_cmpgt_ps; eq _mm_cmpeq_ps;
}
