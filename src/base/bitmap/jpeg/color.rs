//! Rows of pixels from rows of samples.

use super::transform::byte;

/// Red, green and blue as they are.
pub(super) fn rgb(rows: &[&[u8]], out: &mut Vec<u8>) {
    let [red, green, blue] = [rows[0], rows[1], rows[2]];
    for ((red, green), blue) in red.iter().zip(green).zip(blue) {
        out.extend([red, green, blue]);
    }
}

/// Red, green and blue of luminance and two differences (JFIF; Rec. 601), with 16 bits behind the point.
pub(super) fn ycc(rows: &[&[u8]], out: &mut Vec<u8>) {
    const HALF: i32 = 1 << 15;
    let [light, blueness, redness] = [rows[0], rows[1], rows[2]];
    for ((light, blueness), redness) in light.iter().zip(blueness).zip(redness) {
        let light = i32::from(*light);
        let [b, r] = [*blueness, *redness].map(|value| i32::from(value) - 128);
        // 1.402, 0.344 14, 0.714 14 and 1.772 times 65536.
        let red = light + ((91_881 * r + HALF) >> 16);
        let green = light + ((-22_554 * b - 46_802 * r + HALF) >> 16);
        let blue = light + ((116_130 * b + HALF) >> 16);
        out.extend([red, green, blue].map(byte));
    }
}
