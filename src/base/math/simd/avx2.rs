//! AVX2 lanes in 256-bit registers. Values of these types exist only inside kernels that [`super::SimdLevel::run`] has
//! started for the wide level. Each `SAFETY` comment below relies on that.

use super::lanes::{BIAS, INTEGER, MANTISSA, operators};
use super::{F32x8, F64Lanes, F64x4};
use std::arch::x86_64::*;
use std::ops::Neg;

#[derive(Clone, Copy)]
pub(super) struct F64x4Avx2(__m256d);

/// A lane is true if its sign bit is set; comparisons set all of its bits.
#[derive(Clone, Copy)]
pub(super) struct MaskAvx2(__m256d);

#[derive(Clone, Copy)]
pub(super) struct F32x8Avx2(__m256);

/// Defines binary functions by their intrinsic.
macro_rules! instructions {
    ($($name:ident($type:ident) -> $result:ident by $intrinsic:ident $(<$predicate:ident>)?),+ $(,)?) => {
        $(
            #[inline(always)]
            fn $name(a: $type, b: $type) -> $result {
                // SAFETY: only kernels of the wide level have such values.
                unsafe { $result($intrinsic$(::<$predicate>)?(a.0, b.0)) }
            }
        )+
    };
}

instructions! {
    add(F64x4Avx2) -> F64x4Avx2 by _mm256_add_pd,
    sub(F64x4Avx2) -> F64x4Avx2 by _mm256_sub_pd,
    mul(F64x4Avx2) -> F64x4Avx2 by _mm256_mul_pd,
    div(F64x4Avx2) -> F64x4Avx2 by _mm256_div_pd,
    min(F64x4Avx2) -> F64x4Avx2 by _mm256_min_pd,
    max(F64x4Avx2) -> F64x4Avx2 by _mm256_max_pd,
    and(F64x4Avx2) -> F64x4Avx2 by _mm256_and_pd,
    and_not(F64x4Avx2) -> F64x4Avx2 by _mm256_andnot_pd,
    or(F64x4Avx2) -> F64x4Avx2 by _mm256_or_pd,
    xor(F64x4Avx2) -> F64x4Avx2 by _mm256_xor_pd,
    less(F64x4Avx2) -> MaskAvx2 by _mm256_cmp_pd<_CMP_LT_OQ>,
    less_or_equal(F64x4Avx2) -> MaskAvx2 by _mm256_cmp_pd<_CMP_LE_OQ>,
    equal(F64x4Avx2) -> MaskAvx2 by _mm256_cmp_pd<_CMP_EQ_OQ>,
    both(MaskAvx2) -> MaskAvx2 by _mm256_and_pd,
    either(MaskAvx2) -> MaskAvx2 by _mm256_or_pd,
    add_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_add_ps,
    sub_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_sub_ps,
    mul_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_mul_ps,
    div_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_div_ps,
    min_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_min_ps,
    max_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_max_ps,
    and_not_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_andnot_ps,
    less_or_equal_f32(F32x8Avx2) -> F32x8Avx2 by _mm256_cmp_ps<_CMP_LE_OQ>,
}

operators!(F64x4Avx2: Add add add, Sub sub sub, Mul mul mul, Div div div);
operators!(F32x8Avx2: Add add add_f32, Sub sub sub_f32, Mul mul mul_f32, Div div div_f32);
operators!(MaskAvx2: BitAnd bitand both, BitOr bitor either);

impl Neg for F64x4Avx2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        xor(Self::splat(-0.0), self)
    }
}

/// Lane values for each four-bit mask: -0.0 where the bit is set, 0.0 elsewhere.
const SIGNS: [[f64; 4]; 16] = {
    let mut signs = [[0.0; 4]; 16];
    let mut bits = 0;
    while bits < 16 {
        let mut lane = 0;
        while lane < 4 {
            if bits >> lane & 1 == 1 {
                signs[bits][lane] = -0.0;
            }
            lane += 1;
        }
        bits += 1;
    }
    signs
};

impl F64Lanes for F64x4Avx2 {
    type Mask = MaskAvx2;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        // SAFETY: only kernels of the wide level know this type.
        unsafe { F64x4Avx2(_mm256_set1_pd(x)) }
    }
    #[inline(always)]
    fn from_array(from: &[f64; 4]) -> Self {
        // SAFETY: as in `splat`, and an array of four numbers is read.
        unsafe { F64x4Avx2(_mm256_loadu_pd(from.as_ptr())) }
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        let mut to = [0.0; 4];
        // SAFETY: as in `splat`, and an array of four numbers is written.
        unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) };
        to
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as in `splat`.
        unsafe { F64x4Avx2(_mm256_sqrt_pd(self.0)) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        and_not(Self::splat(-0.0), self)
    }
    #[inline(always)]
    fn lane_min(self, other: Self) -> Self {
        min(self, other)
    }
    #[inline(always)]
    fn lane_max(self, other: Self) -> Self {
        max(self, other)
    }
    #[inline(always)]
    fn xor_sign(self, other: Self) -> Self {
        xor(self, and(Self::splat(-0.0), other))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> MaskAvx2 {
        less(self, other)
    }
    #[inline(always)]
    fn le(self, other: Self) -> MaskAvx2 {
        less_or_equal(self, other)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> MaskAvx2 {
        equal(self, other)
    }
    #[inline(always)]
    fn select(mask: MaskAvx2, yes: Self, no: Self) -> Self {
        // SAFETY: as in `splat`.
        unsafe { F64x4Avx2(_mm256_blendv_pd(no.0, yes.0, mask.0)) }
    }
    #[inline(always)]
    fn bitmask(mask: MaskAvx2) -> u32 {
        // SAFETY: as in `splat`.
        unsafe { _mm256_movemask_pd(mask.0) }.cast_unsigned()
    }
    #[inline(always)]
    fn mask_from_bits(bits: u32) -> MaskAvx2 {
        MaskAvx2(Self::from_array(&SIGNS[bits as usize % 16]).0)
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> [Self; 2] {
        // SAFETY: as in `splat`.
        let shifted = unsafe {
            let bits = _mm256_castpd_si256(self.0);
            F64x4Avx2(_mm256_castsi256_pd(_mm256_srli_epi64::<52>(bits)))
        };
        let mantissa = and(self, Self::splat(f64::from_bits(MANTISSA)));
        [
            or(shifted, Self::splat(INTEGER)) - Self::splat(INTEGER + BIAS),
            or(mantissa, Self::splat(1.0)),
        ]
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        let biased = self + Self::splat(INTEGER + BIAS);
        // SAFETY: as in `splat`.
        unsafe {
            let bits = _mm256_castpd_si256(biased.0);
            F64x4Avx2(_mm256_castsi256_pd(_mm256_slli_epi64::<52>(bits)))
        }
    }
    #[inline(always)]
    fn truncate(self) -> (Self, [i32; 4]) {
        let mut to = [0; 4];
        // SAFETY: as in `splat`, and an array of four integers is written.
        unsafe {
            let whole = _mm256_cvttpd_epi32(self.0);
            _mm_storeu_si128(to.as_mut_ptr().cast(), whole);
            (F64x4Avx2(_mm256_cvtepi32_pd(whole)), to)
        }
    }
}

/// Two numbers of either array, from index 0 or 2 on.
#[inline(always)]
fn halves(low: &[f64; 4], high: &[f64; 4], from: usize) -> __m256d {
    // SAFETY: only kernels of the wide level call it; the bounds of both slices are checked, and the loads need no
    // alignment.
    unsafe {
        let low = _mm256_castpd128_pd256(_mm_loadu_pd(low[from..from + 2].as_ptr()));
        _mm256_insertf128_pd::<1>(low, _mm_loadu_pd(high[from..from + 2].as_ptr()))
    }
}

impl F64x4 for F64x4Avx2 {
    type F32 = F32x8Avx2;
    #[inline(always)]
    fn columns([a, b, c, d]: [&[f64; 4]; 4]) -> [Self; 4] {
        let [ac, bd] = [halves(a, c, 0), halves(b, d, 0)];
        let [ac_end, bd_end] = [halves(a, c, 2), halves(b, d, 2)];
        // SAFETY: as in `splat`.
        unsafe {
            [
                F64x4Avx2(_mm256_unpacklo_pd(ac, bd)),
                F64x4Avx2(_mm256_unpackhi_pd(ac, bd)),
                F64x4Avx2(_mm256_unpacklo_pd(ac_end, bd_end)),
                F64x4Avx2(_mm256_unpackhi_pd(ac_end, bd_end)),
            ]
        }
    }
}

impl F32x8 for F32x8Avx2 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: only kernels of the wide level know this type.
        unsafe { F32x8Avx2(_mm256_set1_ps(x)) }
    }
    #[inline(always)]
    fn from_array(from: &[f32; 8]) -> Self {
        // SAFETY: as in `splat`, and an array of eight numbers is read.
        unsafe { F32x8Avx2(_mm256_loadu_ps(from.as_ptr())) }
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        let mut to = [0.0; 8];
        // SAFETY: as in `splat`, and an array of eight numbers is written.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) };
        to
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as in `splat`.
        unsafe { F32x8Avx2(_mm256_sqrt_ps(self.0)) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        and_not_f32(Self::splat(-0.0), self)
    }
    #[inline(always)]
    fn lane_min(self, other: Self) -> Self {
        min_f32(self, other)
    }
    #[inline(always)]
    fn lane_max(self, other: Self) -> Self {
        max_f32(self, other)
    }
    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        // SAFETY: as in `splat`.
        unsafe { _mm256_movemask_ps(less_or_equal_f32(self, other).0) }.cast_unsigned()
    }
}
