//! A scalar `f64` as lanes: a kernel run on a single ray gives the same bits as on a packet.

use super::F64Lanes;
use super::lanes::{BIAS, INTEGER, INTEGER_BITS, MANTISSA};

impl F64Lanes for f64 {
    type Mask = bool;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn from_array(from: &[f64; 4]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        [self; 4]
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn lane_min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn lane_max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn xor_sign(self, other: Self) -> Self {
        f64::from_bits(self.to_bits() ^ other.to_bits() & (-0.0_f64).to_bits())
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self == other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn bitmask(mask: bool) -> u32 {
        if mask { 0b1111 } else { 0 }
    }
    #[inline(always)]
    fn mask_from_bits(bits: u32) -> bool {
        bits & 1 == 1
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> [Self; 2] {
        let exponent = f64::from_bits(self.to_bits() >> 52 | INTEGER_BITS) - (INTEGER + BIAS);
        let mantissa = f64::from_bits(self.to_bits() & MANTISSA | 1.0_f64.to_bits());
        [exponent, mantissa]
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        f64::from_bits((self + (INTEGER + BIAS)).to_bits() << 52)
    }
    #[inline(always)]
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the integer part is wanted"
    )]
    fn truncate(self) -> (Self, [i32; 4]) {
        let whole = self as i32;
        (f64::from(whole), [whole; 4])
    }
}
