//! Four numbers in double precision, worked on together: what rays meet exactly.
#![allow(
    unsafe_code,
    reason = "a function for a machine known only at run time cannot be called otherwise"
)]

use super::SimdLevel;

/// Four numbers, worked on together. Each operation rounds as that on single numbers does.
pub(crate) trait F64Lanes: Copy {
    /// One truth for each number.
    type Mask: Copy;
    fn all(x: f64) -> Self;
    fn load(from: &[f64; 4]) -> Self;
    fn store(self) -> [f64; 4];
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    fn root(self) -> Self;
    /// The second where one is not a number.
    fn smaller(self, other: Self) -> Self;
    /// The second where one is not a number.
    fn larger(self, other: Self) -> Self;
    fn size(self) -> Self;
    fn negated(self) -> Self;
    /// Negated where the other is negative, or minus zero.
    fn turned_by(self, other: Self) -> Self;
    /// False where one is not a number, as the other comparisons.
    fn below(self, other: Self) -> Self::Mask;
    fn not_above(self, other: Self) -> Self::Mask;
    fn equals(self, other: Self) -> Self::Mask;
    /// The first where the mask is true, the second elsewhere.
    fn pick(mask: Self::Mask, first: Self, second: Self) -> Self;
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    fn either(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// One bit each.
    fn bits(mask: Self::Mask) -> u32;
    /// The mask of these bits.
    fn mask(bits: u32) -> Self::Mask;
    /// `e` and `m` of `2^e · m` with `1 <= m < 2`, for positive normal numbers.
    fn split(self) -> [Self; 2];
    /// `2^n` for whole numbers `n` from -1022 to 1023.
    fn power_of_two(self) -> Self;
    /// The whole parts toward zero of numbers below 2^31 in size.
    fn truncated(self) -> (Self, [i32; 4]);
}

/// A double with these bits and those of a whole number below 2^52 is 2^52 more than that number.
const WHOLE: u64 = (1023 + 52) << 52;
/// 2^52.
const WHOLES: f64 = f64::from_bits(WHOLE);
/// What the exponent of a double is held with.
const BIAS: f64 = 1023.0;
/// The bits of the mantissa.
const MANTISSA: u64 = (1 << 52) - 1;

fn split_one(x: f64) -> [f64; 2] {
    let exponent = f64::from_bits(x.to_bits() >> 52 | WHOLE) - (WHOLES + BIAS);
    let mantissa = f64::from_bits(x.to_bits() & MANTISSA | 1.0_f64.to_bits());
    [exponent, mantissa]
}

fn power_of_two_one(n: f64) -> f64 {
    f64::from_bits((n + (WHOLES + BIAS)).to_bits() << 52)
}

#[allow(clippy::cast_possible_truncation, reason = "the whole part is wanted")]
fn truncated_one(x: f64) -> i32 {
    x as i32
}

/// Four numbers that may all be different.
pub(crate) trait F64x4: F64Lanes {
    /// Columns for rows.
    fn turned(rows: [Self; 4]) -> [Self; 4];
}

/// Work on four numbers at once, written once for every machine.
pub(crate) trait FourKernel {
    type Answer;
    fn run<F: F64x4>(&self) -> Self::Answer;
}

/// Runs a kernel in these lanes.
#[inline(always)]
pub(crate) fn four<K: FourKernel>(lanes: SimdLevel, kernel: &K) -> K::Answer {
    #[cfg(target_arch = "x86_64")]
    if lanes.are_wide {
        // SAFETY: lanes are wide only where the machine has the instructions.
        return unsafe { four_wide(kernel) };
    }
    debug_assert!(!lanes.are_wide, "wide lanes are known on x86-64 alone");
    kernel.run::<[f64; 4]>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
#[inline]
fn four_wide<K: FourKernel>(kernel: &K) -> K::Answer {
    kernel.run::<std::arch::x86_64::__m256d>()
}

/// Work on one four after the other, written once for every machine.
pub(crate) trait FourWork {
    type Answer;
    fn run<F: F64x4>(self) -> Self::Answer;
}

/// Does such work in these lanes.
#[inline(always)]
pub(crate) fn fours<W: FourWork>(lanes: SimdLevel, work: W) -> W::Answer {
    #[cfg(target_arch = "x86_64")]
    if lanes.are_wide {
        // SAFETY: lanes are wide only where the machine has the instructions.
        return unsafe { fours_wide(work) };
    }
    debug_assert!(!lanes.are_wide, "wide lanes are known on x86-64 alone");
    work.run::<[f64; 4]>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
#[inline]
fn fours_wide<W: FourWork>(work: W) -> W::Answer {
    work.run::<std::arch::x86_64::__m256d>()
}

/// Anywhere.
impl F64Lanes for [f64; 4] {
    type Mask = [bool; 4];
    #[inline(always)]
    fn all(x: f64) -> Self {
        [x; 4]
    }
    #[inline(always)]
    fn load(from: &[f64; 4]) -> Self {
        *from
    }
    #[inline(always)]
    fn store(self) -> [f64; 4] {
        self
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] + other[i])
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] - other[i])
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] * other[i])
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] / other[i])
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.map(f64::sqrt)
    }
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        std::array::from_fn(|i| {
            if self[i] < other[i] {
                self[i]
            } else {
                other[i]
            }
        })
    }
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        std::array::from_fn(|i| {
            if self[i] > other[i] {
                self[i]
            } else {
                other[i]
            }
        })
    }
    #[inline(always)]
    fn size(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn negated(self) -> Self {
        self.map(|x| -x)
    }
    #[inline(always)]
    fn turned_by(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i].turned_by(other[i]))
    }
    #[inline(always)]
    fn below(self, other: Self) -> [bool; 4] {
        std::array::from_fn(|i| self[i] < other[i])
    }
    #[inline(always)]
    fn not_above(self, other: Self) -> [bool; 4] {
        std::array::from_fn(|i| self[i] <= other[i])
    }
    #[inline(always)]
    fn equals(self, other: Self) -> [bool; 4] {
        std::array::from_fn(|i| self[i] == other[i])
    }
    #[inline(always)]
    fn pick(mask: [bool; 4], first: Self, second: Self) -> Self {
        std::array::from_fn(|i| if mask[i] { first[i] } else { second[i] })
    }
    #[inline(always)]
    fn both(a: [bool; 4], b: [bool; 4]) -> [bool; 4] {
        std::array::from_fn(|i| a[i] & b[i])
    }
    #[inline(always)]
    fn either(a: [bool; 4], b: [bool; 4]) -> [bool; 4] {
        std::array::from_fn(|i| a[i] | b[i])
    }
    #[inline(always)]
    fn bits(mask: [bool; 4]) -> u32 {
        (0..4).fold(0, |bits, i| bits | u32::from(mask[i]) << i)
    }
    #[inline(always)]
    fn mask(bits: u32) -> [bool; 4] {
        std::array::from_fn(|i| bits >> i & 1 == 1)
    }
    #[inline(always)]
    fn split(self) -> [Self; 2] {
        let each = self.map(split_one);
        [0, 1].map(|part| each.map(|of| of[part]))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        self.map(power_of_two_one)
    }
    #[inline(always)]
    fn truncated(self) -> (Self, [i32; 4]) {
        let whole = self.map(truncated_one);
        (whole.map(f64::from), whole)
    }
}

impl F64x4 for [f64; 4] {
    #[inline(always)]
    fn turned(rows: [Self; 4]) -> [Self; 4] {
        std::array::from_fn(|column| rows.map(|row| row[column]))
    }
}

/// A single number, as if it stood in all four places: what is written for four gives one ray the same bits.
impl F64Lanes for f64 {
    type Mask = bool;
    #[inline(always)]
    fn all(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn load(from: &[f64; 4]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn store(self) -> [f64; 4] {
        [self; 4]
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn negated(self) -> Self {
        -self
    }
    #[inline(always)]
    fn turned_by(self, other: Self) -> Self {
        f64::from_bits(self.to_bits() ^ other.to_bits() & (-0.0_f64).to_bits())
    }
    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn not_above(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn equals(self, other: Self) -> bool {
        self == other
    }
    #[inline(always)]
    fn pick(mask: bool, first: Self, second: Self) -> Self {
        if mask { first } else { second }
    }
    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn either(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        if mask { 0b1111 } else { 0 }
    }
    #[inline(always)]
    fn mask(bits: u32) -> bool {
        bits & 1 == 1
    }
    #[inline(always)]
    fn split(self) -> [Self; 2] {
        split_one(self)
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        power_of_two_one(self)
    }
    #[inline(always)]
    fn truncated(self) -> (Self, [i32; 4]) {
        let whole = truncated_one(self);
        (f64::from(whole), [whole; 4])
    }
}

/// Only for work that runs inside [`four_wide`].
#[cfg(target_arch = "x86_64")]
mod wide {
    use super::{BIAS, F64Lanes, F64x4, MANTISSA, WHOLES};
    use std::arch::x86_64::*;

    macro_rules! each {
        ($($name:ident by $intrinsic:ident $(<$how:ident>)?),+) => {
            $(
                #[inline(always)]
                fn $name(self, other: Self) -> Self {
                    // SAFETY: such numbers are made by `all` and `load` alone, on machines that have the instructions.
                    unsafe { $intrinsic$(::<$how>)?(self, other) }
                }
            )+
        };
    }

    /// By the bits of a mask, numbers that are negative where a bit is set.
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

    impl F64Lanes for __m256d {
        type Mask = __m256d;
        #[inline(always)]
        fn all(x: f64) -> Self {
            // SAFETY: called by work inside `four_wide` alone.
            unsafe { _mm256_set1_pd(x) }
        }
        #[inline(always)]
        fn load(from: &[f64; 4]) -> Self {
            // SAFETY: called by work inside `four_wide` alone, and an array of four numbers is what is read.
            unsafe { _mm256_loadu_pd(from.as_ptr()) }
        }
        #[inline(always)]
        fn store(self) -> [f64; 4] {
            let mut to = [0.0; 4];
            // SAFETY: as in `load`.
            unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self) };
            to
        }
        each! {
            plus by _mm256_add_pd,
            minus by _mm256_sub_pd,
            times by _mm256_mul_pd,
            over by _mm256_div_pd,
            smaller by _mm256_min_pd,
            larger by _mm256_max_pd,
            below by _mm256_cmp_pd<_CMP_LT_OQ>,
            not_above by _mm256_cmp_pd<_CMP_LE_OQ>,
            equals by _mm256_cmp_pd<_CMP_EQ_OQ>
        }
        #[inline(always)]
        fn root(self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_sqrt_pd(self) }
        }
        #[inline(always)]
        fn size(self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self) }
        }
        #[inline(always)]
        fn negated(self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_xor_pd(_mm256_set1_pd(-0.0), self) }
        }
        #[inline(always)]
        fn turned_by(self, other: Self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_xor_pd(self, _mm256_and_pd(_mm256_set1_pd(-0.0), other)) }
        }
        #[inline(always)]
        fn pick(mask: __m256d, first: Self, second: Self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_blendv_pd(second, first, mask) }
        }
        #[inline(always)]
        fn both(a: __m256d, b: __m256d) -> __m256d {
            // SAFETY: as in the others.
            unsafe { _mm256_and_pd(a, b) }
        }
        #[inline(always)]
        fn either(a: __m256d, b: __m256d) -> __m256d {
            // SAFETY: as in the others.
            unsafe { _mm256_or_pd(a, b) }
        }
        #[inline(always)]
        fn bits(mask: __m256d) -> u32 {
            // SAFETY: as in the others.
            unsafe { _mm256_movemask_pd(mask) }.cast_unsigned()
        }
        #[inline(always)]
        fn mask(bits: u32) -> __m256d {
            // Only the sign of a number of a mask is ever looked at, except by `both` and `either`, which keep it.
            Self::load(&SIGNS[bits as usize % 16])
        }
        #[inline(always)]
        fn split(self) -> [Self; 2] {
            // SAFETY: as in the others.
            unsafe {
                let bits = _mm256_castpd_si256(self);
                let whole = _mm256_castpd_si256(Self::all(WHOLES));
                let exponent = _mm256_or_si256(_mm256_srli_epi64::<52>(bits), whole);
                let one = Self::all(1.0);
                let mantissa = _mm256_and_pd(self, Self::all(f64::from_bits(MANTISSA)));
                [
                    _mm256_castsi256_pd(exponent).minus(Self::all(WHOLES + BIAS)),
                    _mm256_or_pd(mantissa, one),
                ]
            }
        }
        #[inline(always)]
        fn power_of_two(self) -> Self {
            let biased = self.plus(Self::all(WHOLES + BIAS));
            // SAFETY: as in the others.
            unsafe { _mm256_castsi256_pd(_mm256_slli_epi64::<52>(_mm256_castpd_si256(biased))) }
        }
        #[inline(always)]
        fn truncated(self) -> (Self, [i32; 4]) {
            let mut to = [0; 4];
            // SAFETY: as in the others, and an array of four integers is what is written.
            unsafe {
                let whole = _mm256_cvttpd_epi32(self);
                _mm_storeu_si128(to.as_mut_ptr().cast(), whole);
                (_mm256_cvtepi32_pd(whole), to)
            }
        }
    }

    impl F64x4 for __m256d {
        #[inline(always)]
        fn turned([a, b, c, d]: [Self; 4]) -> [Self; 4] {
            // SAFETY: as in the others.
            unsafe {
                let (ab, cd) = (_mm256_unpacklo_pd(a, b), _mm256_unpacklo_pd(c, d));
                let (ab_odd, cd_odd) = (_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d));
                [
                    _mm256_permute2f128_pd::<0x20>(ab, cd),
                    _mm256_permute2f128_pd::<0x20>(ab_odd, cd_odd),
                    _mm256_permute2f128_pd::<0x31>(ab, cd),
                    _mm256_permute2f128_pd::<0x31>(ab_odd, cd_odd),
                ]
            }
        }
    }
}
