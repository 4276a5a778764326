//! Lanes as arrays, for targets without an implementation of their own, and as the reference in tests.

use super::lanes::operators;
use super::{F32x8, F64Lanes, F64x4};
use std::array::from_fn;
use std::ops::Neg;

#[derive(Clone, Copy)]
pub(super) struct F64x4Portable([f64; 4]);

#[derive(Clone, Copy)]
pub(super) struct MaskPortable([bool; 4]);

#[derive(Clone, Copy)]
pub(super) struct F32x8Portable([f32; 8]);

impl F64x4Portable {
    #[inline(always)]
    fn each(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        F64x4Portable(from_fn(|i| of(self.0[i], other.0[i])))
    }
}

impl F32x8Portable {
    #[inline(always)]
    fn each(self, other: Self, of: impl Fn(f32, f32) -> f32) -> Self {
        F32x8Portable(from_fn(|i| of(self.0[i], other.0[i])))
    }
}

mod f64s {
    use super::F64x4Portable as F;
    #[inline(always)]
    pub(super) fn add(a: F, b: F) -> F {
        a.each(b, |a, b| a + b)
    }
    #[inline(always)]
    pub(super) fn sub(a: F, b: F) -> F {
        a.each(b, |a, b| a - b)
    }
    #[inline(always)]
    pub(super) fn mul(a: F, b: F) -> F {
        a.each(b, |a, b| a * b)
    }
    #[inline(always)]
    pub(super) fn div(a: F, b: F) -> F {
        a.each(b, |a, b| a / b)
    }
}

mod f32s {
    use super::F32x8Portable as F;
    #[inline(always)]
    pub(super) fn add(a: F, b: F) -> F {
        a.each(b, |a, b| a + b)
    }
    #[inline(always)]
    pub(super) fn sub(a: F, b: F) -> F {
        a.each(b, |a, b| a - b)
    }
    #[inline(always)]
    pub(super) fn mul(a: F, b: F) -> F {
        a.each(b, |a, b| a * b)
    }
    #[inline(always)]
    pub(super) fn div(a: F, b: F) -> F {
        a.each(b, |a, b| a / b)
    }
}

mod masks {
    use super::MaskPortable as M;
    #[inline(always)]
    pub(super) fn and(a: M, b: M) -> M {
        M(std::array::from_fn(|i| a.0[i] & b.0[i]))
    }
    #[inline(always)]
    pub(super) fn or(a: M, b: M) -> M {
        M(std::array::from_fn(|i| a.0[i] | b.0[i]))
    }
}

operators!(F64x4Portable: Add add f64s::add, Sub sub f64s::sub, Mul mul f64s::mul, Div div f64s::div);
operators!(F32x8Portable: Add add f32s::add, Sub sub f32s::sub, Mul mul f32s::mul, Div div f32s::div);
operators!(MaskPortable: BitAnd bitand masks::and, BitOr bitor masks::or);

impl Neg for F64x4Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        F64x4Portable(self.0.map(|x| -x))
    }
}

impl F64Lanes for F64x4Portable {
    type Mask = MaskPortable;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        F64x4Portable([x; 4])
    }
    #[inline(always)]
    fn from_array(from: &[f64; 4]) -> Self {
        F64x4Portable(*from)
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        self.0
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F64x4Portable(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        F64x4Portable(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn lane_min(self, other: Self) -> Self {
        self.each(other, F64Lanes::lane_min)
    }
    #[inline(always)]
    fn lane_max(self, other: Self) -> Self {
        self.each(other, F64Lanes::lane_max)
    }
    #[inline(always)]
    fn xor_sign(self, other: Self) -> Self {
        self.each(other, F64Lanes::xor_sign)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> MaskPortable {
        MaskPortable(from_fn(|i| self.0[i] < other.0[i]))
    }
    #[inline(always)]
    fn le(self, other: Self) -> MaskPortable {
        MaskPortable(from_fn(|i| self.0[i] <= other.0[i]))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> MaskPortable {
        MaskPortable(from_fn(|i| self.0[i] == other.0[i]))
    }
    #[inline(always)]
    fn select(mask: MaskPortable, yes: Self, no: Self) -> Self {
        F64x4Portable(from_fn(|i| if mask.0[i] { yes.0[i] } else { no.0[i] }))
    }
    #[inline(always)]
    fn bitmask(mask: MaskPortable) -> u32 {
        (0..4).fold(0, |bits, i| bits | u32::from(mask.0[i]) << i)
    }
    #[inline(always)]
    fn mask_from_bits(bits: u32) -> MaskPortable {
        MaskPortable(from_fn(|i| bits >> i & 1 == 1))
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> [Self; 2] {
        let each = self.0.map(F64Lanes::exponent_and_mantissa);
        [0, 1].map(|part| F64x4Portable(each.map(|of| of[part])))
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        F64x4Portable(self.0.map(F64Lanes::exp2))
    }
    #[inline(always)]
    fn truncate(self) -> (Self, [i32; 4]) {
        let whole = self.0.map(|x| F64Lanes::truncate(x).1[0]);
        (F64x4Portable(whole.map(f64::from)), whole)
    }
}

impl F64x4 for F64x4Portable {
    type F32 = F32x8Portable;
    #[inline(always)]
    fn columns(rows: [&[f64; 4]; 4]) -> [Self; 4] {
        from_fn(|column| F64x4Portable(rows.map(|row| row[column])))
    }
}

impl F32x8 for F32x8Portable {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        F32x8Portable([x; 8])
    }
    #[inline(always)]
    fn from_array(from: &[f32; 8]) -> Self {
        F32x8Portable(*from)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        self.0
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F32x8Portable(self.0.map(f32::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        F32x8Portable(self.0.map(f32::abs))
    }
    #[inline(always)]
    fn lane_min(self, other: Self) -> Self {
        self.each(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn lane_max(self, other: Self) -> Self {
        self.each(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        (0..8).fold(0, |bits, i| bits | u32::from(self.0[i] <= other.0[i]) << i)
    }
}
