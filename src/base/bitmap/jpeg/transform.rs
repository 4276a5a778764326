//! The inverse cosine transform of a block, by the flow graph of Loeffler, Ligtenberg and Moschytz 1989 ("Practical fast
//! 1-D DCT algorithms with 11 multiplications") in integers: factors have 13 bits behind the point, and columns leave
//! two bits to the rows. libjpeg calls this `islow`; the rounding is its own.

use super::tables::Steps;

/// Bits behind the point of factors.
const FACTOR_BITS: u32 = 13;
/// Bits behind the point between the two passes.
const PASS_BITS: u32 = 2;

/// A factor of the flow graph.
const fn factor(value: f64) -> i32 {
    #[allow(clippy::cast_possible_truncation, reason = "the factors are below 4")]
    {
        (value * (1 << FACTOR_BITS) as f64 + 0.5) as i32
    }
}

// With c(n) = cos(n pi / 16) sqrt(2).
/// c(6).
const C6: i32 = factor(0.541_196_100);
/// c(2) - c(6).
const C2_LESS_C6: i32 = factor(0.765_366_865);
/// c(2) + c(6).
const C2_MORE_C6: i32 = factor(1.847_759_065);
/// c(3).
const C3: i32 = factor(1.175_875_602);
/// c(3) - c(5).
const C3_LESS_C5: i32 = factor(0.390_180_644);
/// c(3) + c(5).
const C3_MORE_C5: i32 = factor(1.961_570_560);
/// c(3) - c(7).
const C3_LESS_C7: i32 = factor(0.899_976_223);
/// c(1) + c(3).
const C1_MORE_C3: i32 = factor(2.562_915_447);
/// -c(1) + c(3) + c(5) - c(7).
const ODD_7: i32 = factor(0.298_631_336);
/// c(1) + c(3) - c(5) + c(7).
const ODD_5: i32 = factor(2.053_119_869);
/// c(1) + c(3) + c(5) - c(7).
const ODD_3: i32 = factor(3.072_711_026);
/// c(1) + c(3) - c(5) - c(7).
const ODD_1: i32 = factor(1.501_321_110);

/// Eight samples of eight coefficients, times eight and with the bits of the factors behind the point. Wraps around for
/// coefficients that no picture has.
#[inline(always)]
fn eight(c: [i32; 8]) -> [i32; 8] {
    let times = i32::wrapping_mul;
    let sum = |terms: &[i32]| {
        terms
            .iter()
            .fold(0_i32, |sum, term| sum.wrapping_add(*term))
    };

    let turned = times(c[2].wrapping_add(c[6]), C6);
    let low = turned.wrapping_add(times(c[2], C2_LESS_C6));
    let high = turned.wrapping_sub(times(c[6], C2_MORE_C6));
    let plus = within(c[0] + c[4]) << FACTOR_BITS;
    let minus = within(c[0] - c[4]) << FACTOR_BITS;
    let even = [
        plus.wrapping_add(low),
        minus.wrapping_add(high),
        minus.wrapping_sub(high),
        plus.wrapping_sub(low),
    ];

    let [sum_7_3, sum_5_1] = [within(c[7] + c[3]), within(c[5] + c[1])];
    let common = times(sum_7_3 + sum_5_1, C3);
    let of_7_3 = common.wrapping_sub(times(sum_7_3, C3_MORE_C5));
    let of_5_1 = common.wrapping_sub(times(sum_5_1, C3_LESS_C5));
    let of_7_1 = times(c[7].wrapping_add(c[1]), -C3_LESS_C7);
    let of_5_3 = times(c[5].wrapping_add(c[3]), -C1_MORE_C3);
    let odd = [
        sum(&[times(c[1], ODD_1), of_7_1, of_5_1]),
        sum(&[times(c[3], ODD_3), of_5_3, of_7_3]),
        sum(&[times(c[5], ODD_5), of_5_3, of_5_1]),
        sum(&[times(c[7], ODD_7), of_7_1, of_7_3]),
    ];

    let mut samples = [0; 8];
    for at in 0..4 {
        samples[at] = even[at].wrapping_add(odd[at]);
        samples[7 - at] = even[at].wrapping_sub(odd[at]);
    }
    samples
}

/// A sum that wraps around beyond 16 bits.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "wraps as it does in libjpeg"
)]
fn within(sum: i32) -> i32 {
    i32::from(sum as i16)
}

/// A number without so many bits behind its point, rounded, and kept within 16 bits.
#[inline(always)]
fn rounded(number: i32, bits: u32) -> i32 {
    let number = number.wrapping_add(1 << (bits - 1)) >> bits;
    number.clamp(i32::from(i16::MIN), i32::from(i16::MAX))
}

/// The samples of a block of coefficients, both row by row.
pub(super) fn samples(coefficients: &[i16; 64], steps: &Steps) -> [u8; 64] {
    // What lies beyond 16 bits wraps around.
    #[allow(clippy::cast_possible_wrap, reason = "wraps as it does in libjpeg")]
    let value = |at: usize| i32::from(coefficients[at].wrapping_mul(steps[at] as i16));
    let mut columns = [[0; 8]; 8];
    // Without change along y the columns are even, and sums are not kept within 16 bits but wrap.
    let is_even = coefficients[8..] == [0; 56];
    for (x, column) in columns.iter_mut().enumerate() {
        if is_even {
            *column = [within(value(x) << PASS_BITS); 8];
            continue;
        }
        let sums = eight(std::array::from_fn(|y| value(y * 8 + x)));
        *column = sums.map(|sum| rounded(sum, FACTOR_BITS - PASS_BITS));
    }
    let mut samples = [0; 64];
    for (y, row) in samples.chunks_exact_mut(8).enumerate() {
        let sums = eight(std::array::from_fn(|x| columns[x][y]));
        for (sample, sum) in row.iter_mut().zip(sums) {
            *sample = byte(rounded(sum, FACTOR_BITS + PASS_BITS + 3) + 128);
        }
    }
    samples
}

/// A sample within its range.
#[inline(always)]
pub(super) fn byte(value: i32) -> u8 {
    u8::try_from(value.clamp(0, 255)).unwrap_or(0)
}
