//! POV-Ray's jitter: a fixed offset for each sample position on the image.

use super::hash::hashed;
use std::sync::LazyLock;

/// POV-Ray's table of offsets, which it rounds to six decimals.
static OFFSETS: LazyLock<[f64; 256]> = LazyLock::new(|| {
    let mut offsets = [0.0; 256];
    for (i, offset) in (0u32..).zip(offsets.iter_mut()) {
        let parity = i.count_ones() & 1;
        let number = ((i ^ (2 * i)) & 511) ^ (256 * parity);
        let exact = -0.5 + f64::from(number) / 512.0 + f64::from(parity) / 32768.0;
        #[allow(
            clippy::cast_possible_truncation,
            reason = "POV-Ray stores the table in single precision"
        )]
        let decimals = ((exact * 1e6).round() / 1e6) as f32;
        *offset = f64::from(decimals);
    }
    offsets
});

/// The offset at an image position, each component from -0.5 to 0.5 (exclusive).
#[must_use]
pub fn jitter(x: f64, y: f64) -> (f64, f64) {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "pictures have fewer than 2^20 columns and rows"
    )]
    let whole = |v: f64| v as i32;
    let offset = |a: f64, b: f64| {
        let mixed = hashed(hashed(whole(a)) ^ whole(b));
        OFFSETS[(mixed & 255) as usize]
    };
    (
        offset(1021.0 * x, 1019.0 * y),
        offset(1019.0 * x, 1021.0 * y),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_offsets_are_those_of_pov_ray() {
        let single = [-0.5_f32, 0.005_890, 0.011_749, -0.490_234];
        assert_eq!(OFFSETS[..4], single.map(f64::from));
        assert_eq!(OFFSETS[255], f64::from(0.001_953_f32));
    }

    #[test]
    fn every_offset_stays_within_half_a_pixel() {
        for i in -50..50 {
            let (x, y) = jitter(f64::from(i) * 0.37, f64::from(i) * 1.91);
            assert!((-0.5..0.5).contains(&x) && (-0.5..0.5).contains(&y));
        }
    }
}
