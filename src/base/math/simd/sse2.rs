//! SSE2 lanes, which every x86-64 machine supports: pairs of 128-bit registers.

use super::lanes::{BIAS, INTEGER, MANTISSA, operators};
use super::{F32x8, F64Lanes, F64x4};
use std::arch::x86_64::*;
use std::ops::Neg;

/// Lanes 0 and 1, then lanes 2 and 3.
#[derive(Clone, Copy)]
pub(super) struct F64x4Sse2(__m128d, __m128d);

/// All bits of a lane are set if it is true, else none.
#[derive(Clone, Copy)]
pub(super) struct MaskSse2(__m128d, __m128d);

/// Lanes 0 to 3, then lanes 4 to 7.
#[derive(Clone, Copy)]
pub(super) struct F32x8Sse2(__m128, __m128);

/// Defines binary functions by the intrinsic for each half.
macro_rules! halves {
    ($($name:ident($type:ident) -> $result:ident by $intrinsic:ident),+ $(,)?) => {
        $(
            #[inline(always)]
            fn $name(a: $type, b: $type) -> $result {
                // SAFETY: every x86-64 has SSE2.
                unsafe { $result($intrinsic(a.0, b.0), $intrinsic(a.1, b.1)) }
            }
        )+
    };
}

halves! {
    add(F64x4Sse2) -> F64x4Sse2 by _mm_add_pd,
    sub(F64x4Sse2) -> F64x4Sse2 by _mm_sub_pd,
    mul(F64x4Sse2) -> F64x4Sse2 by _mm_mul_pd,
    div(F64x4Sse2) -> F64x4Sse2 by _mm_div_pd,
    min(F64x4Sse2) -> F64x4Sse2 by _mm_min_pd,
    max(F64x4Sse2) -> F64x4Sse2 by _mm_max_pd,
    and(F64x4Sse2) -> F64x4Sse2 by _mm_and_pd,
    and_not(F64x4Sse2) -> F64x4Sse2 by _mm_andnot_pd,
    or(F64x4Sse2) -> F64x4Sse2 by _mm_or_pd,
    xor(F64x4Sse2) -> F64x4Sse2 by _mm_xor_pd,
    less(F64x4Sse2) -> MaskSse2 by _mm_cmplt_pd,
    less_or_equal(F64x4Sse2) -> MaskSse2 by _mm_cmple_pd,
    equal(F64x4Sse2) -> MaskSse2 by _mm_cmpeq_pd,
    both(MaskSse2) -> MaskSse2 by _mm_and_pd,
    either(MaskSse2) -> MaskSse2 by _mm_or_pd,
    add_f32(F32x8Sse2) -> F32x8Sse2 by _mm_add_ps,
    sub_f32(F32x8Sse2) -> F32x8Sse2 by _mm_sub_ps,
    mul_f32(F32x8Sse2) -> F32x8Sse2 by _mm_mul_ps,
    div_f32(F32x8Sse2) -> F32x8Sse2 by _mm_div_ps,
    min_f32(F32x8Sse2) -> F32x8Sse2 by _mm_min_ps,
    max_f32(F32x8Sse2) -> F32x8Sse2 by _mm_max_ps,
    and_not_f32(F32x8Sse2) -> F32x8Sse2 by _mm_andnot_ps,
    less_or_equal_f32(F32x8Sse2) -> F32x8Sse2 by _mm_cmple_ps,
}

operators!(F64x4Sse2: Add add add, Sub sub sub, Mul mul mul, Div div div);
operators!(F32x8Sse2: Add add add_f32, Sub sub sub_f32, Mul mul mul_f32, Div div div_f32);
operators!(MaskSse2: BitAnd bitand both, BitOr bitor either);

impl Neg for F64x4Sse2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        xor(Self::splat(-0.0), self)
    }
}

/// Masks of two lanes for each two-bit mask.
const PAIRS: [[u64; 2]; 4] = [[0, 0], [u64::MAX, 0], [0, u64::MAX], [u64::MAX, u64::MAX]];

impl F64Lanes for F64x4Sse2 {
    type Mask = MaskSse2;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        // SAFETY: every x86-64 has SSE2; so in all functions of this file.
        unsafe { F64x4Sse2(_mm_set1_pd(x), _mm_set1_pd(x)) }
    }
    #[inline(always)]
    fn from_array(from: &[f64; 4]) -> Self {
        // SAFETY: each load reads two of the four numbers.
        unsafe {
            F64x4Sse2(
                _mm_loadu_pd(from.as_ptr()),
                _mm_loadu_pd(from[2..].as_ptr()),
            )
        }
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        let mut to = [0.0; 4];
        // SAFETY: each store writes two of the four numbers.
        unsafe {
            _mm_storeu_pd(to.as_mut_ptr(), self.0);
            _mm_storeu_pd(to[2..].as_mut_ptr(), self.1);
        }
        to
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as in `splat`.
        unsafe { F64x4Sse2(_mm_sqrt_pd(self.0), _mm_sqrt_pd(self.1)) }
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
    fn lt(self, other: Self) -> MaskSse2 {
        less(self, other)
    }
    #[inline(always)]
    fn le(self, other: Self) -> MaskSse2 {
        less_or_equal(self, other)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> MaskSse2 {
        equal(self, other)
    }
    #[inline(always)]
    fn select(mask: MaskSse2, yes: Self, no: Self) -> Self {
        let mask = F64x4Sse2(mask.0, mask.1);
        or(and(mask, yes), and_not(mask, no))
    }
    #[inline(always)]
    fn bitmask(mask: MaskSse2) -> u32 {
        // SAFETY: as in `splat`.
        let [low, high] = unsafe { [_mm_movemask_pd(mask.0), _mm_movemask_pd(mask.1)] };
        (low | high << 2).cast_unsigned()
    }
    #[inline(always)]
    fn mask_from_bits(bits: u32) -> MaskSse2 {
        let [low, high] = [bits as usize % 4, bits as usize / 4 % 4];
        // SAFETY: each load reads the two numbers of a pair.
        unsafe {
            MaskSse2(
                _mm_loadu_pd(PAIRS[low].as_ptr().cast()),
                _mm_loadu_pd(PAIRS[high].as_ptr().cast()),
            )
        }
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> [Self; 2] {
        // SAFETY: as in `splat`.
        let shifted = unsafe {
            let shift = |x| _mm_castsi128_pd(_mm_srli_epi64::<52>(_mm_castpd_si128(x)));
            F64x4Sse2(shift(self.0), shift(self.1))
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
            let shift = |x| _mm_castsi128_pd(_mm_slli_epi64::<52>(_mm_castpd_si128(x)));
            F64x4Sse2(shift(biased.0), shift(biased.1))
        }
    }
    #[inline(always)]
    fn truncate(self) -> (Self, [i32; 4]) {
        let mut to = [0; 4];
        // SAFETY: the store writes four integers.
        unsafe {
            let [low, high] = [_mm_cvttpd_epi32(self.0), _mm_cvttpd_epi32(self.1)];
            _mm_storeu_si128(to.as_mut_ptr().cast(), _mm_unpacklo_epi64(low, high));
            (F64x4Sse2(_mm_cvtepi32_pd(low), _mm_cvtepi32_pd(high)), to)
        }
    }
}

impl F64x4Sse2 {
    /// Four columns of four rows.
    #[inline(always)]
    fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        // SAFETY: as in `splat`.
        unsafe {
            [
                F64x4Sse2(_mm_unpacklo_pd(a.0, b.0), _mm_unpacklo_pd(c.0, d.0)),
                F64x4Sse2(_mm_unpackhi_pd(a.0, b.0), _mm_unpackhi_pd(c.0, d.0)),
                F64x4Sse2(_mm_unpacklo_pd(a.1, b.1), _mm_unpacklo_pd(c.1, d.1)),
                F64x4Sse2(_mm_unpackhi_pd(a.1, b.1), _mm_unpackhi_pd(c.1, d.1)),
            ]
        }
    }
}

impl F64x4 for F64x4Sse2 {
    type F32 = F32x8Sse2;
    #[inline(always)]
    fn columns([a, b, c, d]: [&[f64; 4]; 4]) -> [Self; 4] {
        Self::transpose([
            Self::from_array(a),
            Self::from_array(b),
            Self::from_array(c),
            Self::from_array(d),
        ])
    }
}

impl F32x8 for F32x8Sse2 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as for doubles.
        unsafe { F32x8Sse2(_mm_set1_ps(x), _mm_set1_ps(x)) }
    }
    #[inline(always)]
    fn from_array(from: &[f32; 8]) -> Self {
        // SAFETY: each load reads four of the eight numbers.
        unsafe {
            F32x8Sse2(
                _mm_loadu_ps(from.as_ptr()),
                _mm_loadu_ps(from[4..].as_ptr()),
            )
        }
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        let mut to = [0.0; 8];
        // SAFETY: each store writes four of the eight numbers.
        unsafe {
            _mm_storeu_ps(to.as_mut_ptr(), self.0);
            _mm_storeu_ps(to[4..].as_mut_ptr(), self.1);
        }
        to
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as for doubles.
        unsafe { F32x8Sse2(_mm_sqrt_ps(self.0), _mm_sqrt_ps(self.1)) }
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
        let is = less_or_equal_f32(self, other);
        // SAFETY: as for doubles.
        let [low, high] = unsafe { [_mm_movemask_ps(is.0), _mm_movemask_ps(is.1)] };
        (low | high << 4).cast_unsigned()
    }
}
