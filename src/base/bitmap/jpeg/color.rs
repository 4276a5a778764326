//! Conversion of sample rows to interleaved RGB pixels.

use super::transform::clamp_to_byte;

/// Interleaves red, green and blue samples.
pub(super) fn interleave_rgb(rows: &[&[u8]], out: &mut Vec<u8>) {
    let [red, green, blue] = [rows[0], rows[1], rows[2]];
    for ((red, green), blue) in red.iter().zip(green).zip(blue) {
        out.extend([red, green, blue]);
    }
}

/// Converts YCbCr to RGB (JFIF; Rec. 601) in fixed point with 16 fractional bits.
pub(super) fn ycc_to_rgb(rows: &[&[u8]], out: &mut Vec<u8>) {
    const HALF: i32 = 1 << 15;
    let [luma, cb, cr] = [rows[0], rows[1], rows[2]];
    for ((luma, cb), cr) in luma.iter().zip(cb).zip(cr) {
        let luma = i32::from(*luma);
        let [b, r] = [*cb, *cr].map(|value| i32::from(value) - 128);
        // 1.402, 0.344 14, 0.714 14 and 1.772 times 65536.
        let red = luma + ((91_881 * r + HALF) >> 16);
        let green = luma + ((-22_554 * b - 46_802 * r + HALF) >> 16);
        let blue = luma + ((116_130 * b + HALF) >> 16);
        out.extend([red, green, blue].map(clamp_to_byte));
    }
}
