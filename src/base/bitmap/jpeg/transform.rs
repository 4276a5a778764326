//! The inverse DCT of a block, by the flow graph of Loeffler, Ligtenberg and Moschytz 1989 ("Practical fast 1-D DCT
//! algorithms with 11 multiplications") in fixed point. Factors have 13 fractional bits, and the column pass passes two
//! fractional bits on to the row pass. This is libjpeg's `islow` with the same rounding.

use super::tables::QuantTable;

/// Fractional bits of the factors.
const FACTOR_BITS: u32 = 13;
/// Fractional bits between the two passes.
const PASS_BITS: u32 = 2;

/// A factor of the flow graph in fixed point.
const fn factor(value: f64) -> i32 {
    #[allow(clippy::cast_possible_truncation, reason = "the factors are below 4")]
    {
        (value * (1 << FACTOR_BITS) as f64 + 0.5) as i32
    }
}

// c(n) = cos(n pi / 16) sqrt(2).
/// c(6).
const C6: i32 = factor(0.541_196_100);
/// c(2) - c(6).
const C2_MINUS_C6: i32 = factor(0.765_366_865);
/// c(2) + c(6).
const C2_PLUS_C6: i32 = factor(1.847_759_065);
/// c(3).
const C3: i32 = factor(1.175_875_602);
/// c(3) - c(5).
const C3_MINUS_C5: i32 = factor(0.390_180_644);
/// c(3) + c(5).
const C3_PLUS_C5: i32 = factor(1.961_570_560);
/// c(3) - c(7).
const C3_MINUS_C7: i32 = factor(0.899_976_223);
/// c(1) + c(3).
const C1_PLUS_C3: i32 = factor(2.562_915_447);
/// -c(1) + c(3) + c(5) - c(7).
const ODD_7: i32 = factor(0.298_631_336);
/// c(1) + c(3) - c(5) + c(7).
const ODD_5: i32 = factor(2.053_119_869);
/// c(1) + c(3) + c(5) - c(7).
const ODD_3: i32 = factor(3.072_711_026);
/// c(1) + c(3) - c(5) - c(7).
const ODD_1: i32 = factor(1.501_321_110);

/// One-dimensional inverse DCT, scaled by sqrt(8), with [`FACTOR_BITS`] fractional bits. Wraps around for coefficients
/// outside the range of valid files.
#[inline(always)]
fn idct_1d(c: [i32; 8]) -> [i32; 8] {
    let times = i32::wrapping_mul;
    let sum = |terms: &[i32]| {
        terms
            .iter()
            .fold(0_i32, |sum, term| sum.wrapping_add(*term))
    };

    let rotated = times(c[2].wrapping_add(c[6]), C6);
    let low = rotated.wrapping_add(times(c[2], C2_MINUS_C6));
    let high = rotated.wrapping_sub(times(c[6], C2_PLUS_C6));
    let plus = wrap_to_i16(c[0] + c[4]) << FACTOR_BITS;
    let minus = wrap_to_i16(c[0] - c[4]) << FACTOR_BITS;
    let even = [
        plus.wrapping_add(low),
        minus.wrapping_add(high),
        minus.wrapping_sub(high),
        plus.wrapping_sub(low),
    ];

    let [sum_7_3, sum_5_1] = [wrap_to_i16(c[7] + c[3]), wrap_to_i16(c[5] + c[1])];
    let common = times(sum_7_3 + sum_5_1, C3);
    let term_7_3 = common.wrapping_sub(times(sum_7_3, C3_PLUS_C5));
    let term_5_1 = common.wrapping_sub(times(sum_5_1, C3_MINUS_C5));
    let term_7_1 = times(c[7].wrapping_add(c[1]), -C3_MINUS_C7);
    let term_5_3 = times(c[5].wrapping_add(c[3]), -C1_PLUS_C3);
    let odd = [
        sum(&[times(c[1], ODD_1), term_7_1, term_5_1]),
        sum(&[times(c[3], ODD_3), term_5_3, term_7_3]),
        sum(&[times(c[5], ODD_5), term_5_3, term_5_1]),
        sum(&[times(c[7], ODD_7), term_7_1, term_7_3]),
    ];

    let mut samples = [0; 8];
    for at in 0..4 {
        samples[at] = even[at].wrapping_add(odd[at]);
        samples[7 - at] = even[at].wrapping_sub(odd[at]);
    }
    samples
}

/// A sum reduced to 16 bits with wrap-around, as in libjpeg.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "wraps as it does in libjpeg"
)]
fn wrap_to_i16(sum: i32) -> i32 {
    i32::from(sum as i16)
}

/// Removes `bits` fractional bits with rounding, and saturates to 16 bits.
#[inline(always)]
fn descale(number: i32, bits: u32) -> i32 {
    let number = number.wrapping_add(1 << (bits - 1)) >> bits;
    number.clamp(i32::from(i16::MIN), i32::from(i16::MAX))
}

/// Dequantises a block and transforms it to samples, both in row-major order.
pub(super) fn inverse_dct(coefficients: &[i16; 64], quant_table: &QuantTable) -> [u8; 64] {
    #[allow(clippy::cast_possible_wrap, reason = "wraps as it does in libjpeg")]
    let dequantized = |at: usize| i32::from(coefficients[at].wrapping_mul(quant_table[at] as i16));
    let mut columns = [[0; 8]; 8];
    // With the first row of coefficients alone, columns are constant; libjpeg then wraps the sums instead of
    // saturating.
    let is_constant_along_y = coefficients[8..] == [0; 56];
    for (x, column) in columns.iter_mut().enumerate() {
        if is_constant_along_y {
            *column = [wrap_to_i16(dequantized(x) << PASS_BITS); 8];
            continue;
        }
        let sums = idct_1d(std::array::from_fn(|y| dequantized(y * 8 + x)));
        *column = sums.map(|sum| descale(sum, FACTOR_BITS - PASS_BITS));
    }
    let mut samples = [0; 64];
    for (y, row) in samples.chunks_exact_mut(8).enumerate() {
        let sums = idct_1d(std::array::from_fn(|x| columns[x][y]));
        for (sample, sum) in row.iter_mut().zip(sums) {
            *sample = clamp_to_byte(descale(sum, FACTOR_BITS + PASS_BITS + 3) + 128);
        }
    }
    samples
}

/// Clamps a sample to 0..=255.
#[inline(always)]
pub(super) fn clamp_to_byte(value: i32) -> u8 {
    u8::try_from(value.clamp(0, 255)).unwrap_or(0)
}
