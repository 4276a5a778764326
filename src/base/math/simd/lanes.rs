//! The traits through which kernels use the lane types.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

/// Lanes of `f64`: four rays or numbers side by side, or a scalar `f64`. Each operation rounds like its scalar
/// counterpart.
pub(crate) trait F64Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A boolean per lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask>;
    fn splat(x: f64) -> Self;
    fn from_array(from: &[f64; 4]) -> Self;
    fn to_array(self) -> [f64; 4];
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The smaller number; `other` if either is NaN, unlike `f64::min`.
    fn lane_min(self, other: Self) -> Self;
    /// The larger number; `other` if either is NaN, unlike `f64::max`.
    fn lane_max(self, other: Self) -> Self;
    /// `self`, negated in lanes where the sign bit of `other` is set.
    fn xor_sign(self, other: Self) -> Self;
    /// Less than. Like the other comparisons it is false if either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    fn le(self, other: Self) -> Self::Mask;
    fn eq(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is true, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Bit `i` is the truth value of lane `i`; a scalar sets all four bits or none.
    fn bitmask(mask: Self::Mask) -> u32;
    fn mask_from_bits(bits: u32) -> Self::Mask;
    /// `e` and `m` with `self = 2^e · m` and `1 <= m < 2`, for positive normal numbers.
    fn exponent_and_mantissa(self) -> [Self; 2];
    /// `2^n` for integers `n` from -1022 to 1023.
    fn exp2(self) -> Self;
    /// The integer part, rounded toward zero, of numbers of magnitude below 2^31.
    fn truncate(self) -> (Self, [i32; 4]);
}

/// Four independent lanes of `f64`.
pub(crate) trait F64x4: F64Lanes {
    /// The single precision lanes of the same level.
    type F32: F32x8;
    /// The columns of four rows in memory.
    fn columns(rows: [&[f64; 4]; 4]) -> [Self; 4];
}

/// Eight lanes of `f32`.
pub(crate) trait F32x8:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn splat(x: f32) -> Self;
    fn from_array(from: &[f32; 8]) -> Self;
    fn to_array(self) -> [f32; 8];
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The smaller number; `other` if either is NaN.
    fn lane_min(self, other: Self) -> Self;
    /// The larger number; `other` if either is NaN.
    fn lane_max(self, other: Self) -> Self;
    /// A bitmask of the lanes that are less than or equal to those of `other`; false if either is NaN.
    fn le(self, other: Self) -> u32;
}

/// Implements operators of a lane type by the given functions.
macro_rules! operators {
    ($type:ty: $($operator:ident $name:ident $function:path),+ $(,)?) => {
        $(
            impl std::ops::$operator for $type {
                type Output = Self;
                #[inline(always)]
                fn $name(self, other: Self) -> Self {
                    $function(self, other)
                }
            }
        )+
    };
}
pub(super) use operators;

/// The bits of 2^52. A double with these bits or-ed with an integer below 2^52 is 2^52 plus that integer.
pub(super) const INTEGER_BITS: u64 = (1023 + 52) << 52;
/// 2^52.
pub(super) const INTEGER: f64 = f64::from_bits(INTEGER_BITS);
/// The exponent bias of a double.
pub(super) const BIAS: f64 = 1023.0;
/// The mantissa bits of a double.
pub(super) const MANTISSA: u64 = (1 << 52) - 1;
