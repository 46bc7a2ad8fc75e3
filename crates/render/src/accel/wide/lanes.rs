//! Vectors of eight floats: what the traversal needs of SIMD, and no more.
//!
//! The traversal is written once over [`Lanes`]. [`Avx`] is an x86 register; [`Portable`] is plain Rust for every other CPU.
//! Triangles are tested with operations that round alike in both, so both find the same hits. Only the (conservative) box
//! test uses the fused operations, which may differ in the last bit.
#![allow(unsafe_code)] // the one place that speaks to x86 intrinsics

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{
    __m256, _CMP_EQ_OQ, _CMP_GT_OQ, _CMP_LE_OQ, _mm256_add_ps, _mm256_cmp_ps, _mm256_div_ps, _mm256_fmadd_ps,
    _mm256_fmsub_ps, _mm256_loadu_ps, _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps,
    _mm256_set1_ps, _mm256_storeu_ps, _mm256_sub_ps,
};

/// Lanes per vector.
pub(super) const WIDTH: usize = 8;

/// A vector of [`WIDTH`] floats. Comparisons give one bit per lane and are false for NaN.
///
/// A value is proof that the CPU has the instructions: only the two `unsafe` constructors make one from nothing, and their
/// callers vouch for the CPU. That is why the operations on values are safe to call.
pub(super) trait Lanes: Copy {
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

    fn to_array(self) -> [f32; WIDTH];
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// `self * factor + term`; fused or not.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// `self * factor - term`; fused or not.
    fn mul_sub(self, factor: Self, term: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn le(self, other: Self) -> u32;
    fn gt(self, other: Self) -> u32;
    fn eq(self, other: Self) -> u32;
}

/// Plain Rust.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable([f32; WIDTH]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }

    #[inline(always)]
    fn mask(self, other: Self, f: impl Fn(f32, f32) -> bool) -> u32 {
        (0..WIDTH).fold(0, |mask, lane| mask | u32::from(f(self.0[lane], other.0[lane])) << lane)
    }
}

impl Lanes for Portable {
    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Self([x; WIDTH])
    }

    #[inline(always)]
    unsafe fn load(source: *const f32) -> Self {
        // SAFETY: the caller promises the floats.
        Self(unsafe { source.cast::<[f32; WIDTH]>().read_unaligned() })
    }

    #[inline(always)]
    fn to_array(self) -> [f32; WIDTH] {
        self.0
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
    fn mul_sub(self, factor: Self, term: Self) -> Self {
        self.mul(factor).sub(term)
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

/// An x86 register; needs AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx(__m256);

/// Methods that are one intrinsic each: the intrinsic and its operands.
#[cfg(target_arch = "x86_64")]
macro_rules! intrinsics {
    ($($name:ident($($operand:ident),*) = $intrinsic:ident;)*) => {
        $(
            #[inline(always)]
            fn $name(self, $($operand: Self),*) -> Self {
                // SAFETY: `self` proves the CPU.
                Self(unsafe { $intrinsic(self.0, $($operand.0),*) })
            }
        )*
    };
    ($($name:ident is $comparison:ident;)*) => {
        $(
            #[inline(always)]
            fn $name(self, other: Self) -> u32 {
                // SAFETY: `self` proves the CPU.
                unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<$comparison>(self.0, other.0)) as u32 }
            }
        )*
    };
}

#[cfg(target_arch = "x86_64")]
impl Lanes for Avx {
    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller vouches for the CPU.
        Self(unsafe { _mm256_set1_ps(x) })
    }

    #[inline(always)]
    unsafe fn load(source: *const f32) -> Self {
        // SAFETY: the caller vouches for the CPU and for the floats.
        Self(unsafe { _mm256_loadu_ps(source) })
    }

    #[inline(always)]
    fn to_array(self) -> [f32; WIDTH] {
        let mut out = [0.0; WIDTH];
        // SAFETY: `self` proves the CPU; `out` has room for all lanes.
        unsafe { _mm256_storeu_ps(out.as_mut_ptr(), self.0) };
        out
    }

    intrinsics! {
        add(other) = _mm256_add_ps;
        sub(other) = _mm256_sub_ps;
        mul(other) = _mm256_mul_ps;
        div(other) = _mm256_div_ps;
        mul_add(factor, term) = _mm256_fmadd_ps;
        mul_sub(factor, term) = _mm256_fmsub_ps;
        min(other) = _mm256_min_ps;
        max(other) = _mm256_max_ps;
    }

    intrinsics! {
        le is _CMP_LE_OQ;
        gt is _CMP_GT_OQ;
        eq is _CMP_EQ_OQ;
    }
}
