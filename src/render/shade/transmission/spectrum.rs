//! The spectrum of white light, as POV-Ray disperses it.
//!
//! Measured with one plate of `dispersion_samples 70`, whose samples are five nanometres wide each, and with a black
//! edge behind it that hides them one by one; the steps came out at four digits to the last bit.

use crate::base::color::Rgb;

/// The first and last wavelength, in nanometres.
const FIRST_NM: f64 = 380.0;
const LAST_NM: f64 = 730.0;
/// The distance of the entries of [`BELOW`], in nanometres.
const STEP_NM: f64 = 5.0;
/// The wavelength that is refracted by the index of refraction itself, in nanometres.
const MIDDLE_NM: f64 = 555.0;

/// For each wavelength, red, green and blue of all shorter light, in units of 1/10000.
#[rustfmt::skip]
const BELOW: [[u16; 3]; 71] = [
    [0, 0, 0], [20, 0, 75], [49, 0, 184], [85, 0, 325], [126, 0, 496], [169, 0, 696],
    [214, 0, 922], [258, 0, 1172], [299, 0, 1444], [335, 0, 1737], [365, 0, 2047],
    [385, 0, 2374], [395, 0, 2715], [395, 0, 3068], [395, 0, 3432], [395, 0, 3803],
    [395, 0, 4181], [395, 0, 4562], [395, 0, 4946], [395, 0, 5330], [395, 0, 5712],
    [395, 0, 6090], [395, 0, 6462], [395, 0, 6826], [395, 45, 7180], [395, 131, 7522],
    [395, 256, 7850], [395, 417, 8162], [395, 612, 8456], [395, 839, 8730], [395, 1095, 8982],
    [395, 1378, 9210], [395, 1684, 9411], [395, 2013, 9585], [395, 2360, 9729],
    [395, 2724, 9840], [395, 3102, 9918], [395, 3492, 9959], [395, 3891, 9962],
    [420, 4297, 9962], [493, 4707, 9962], [611, 5119, 9962], [771, 5530, 9962],
    [970, 5937, 9962], [1206, 6340, 9962], [1474, 6733, 9962], [1772, 7117, 9962],
    [2096, 7487, 9962], [2445, 7841, 9962], [2814, 8178, 9962], [3201, 8494, 9962],
    [3602, 8786, 9962], [4015, 9054, 9962], [4437, 9293, 9962], [4864, 9501, 9962],
    [5293, 9677, 9962], [5722, 9817, 9962], [6146, 9919, 9962], [6564, 9981, 9962],
    [6973, 10000, 9962], [7368, 10000, 9962], [7747, 10000, 9962], [8107, 10000, 9962],
    [8445, 10000, 9962], [8758, 10000, 9962], [9043, 10000, 9962], [9297, 10000, 9962],
    [9516, 10000, 9962], [9698, 10000, 9962], [9840, 10000, 9962], [9938, 10000, 9962],
];

/// A spectral band of dispersed white light.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::shade) struct SpectralBand {
    /// Its wavelength in nanometres, in single precision.
    pub(in crate::render::shade) wavelength: f64,
    /// Its colour; the mean of all bands is nearly white.
    pub(in crate::render::shade) hue: Rgb,
}

/// The band with this index when light is split into `count`.
#[allow(
    clippy::cast_possible_truncation,
    reason = "wavelengths are single precision, as in POV-Ray"
)]
pub(in crate::render::shade) fn band(number: u32, count: u32) -> SpectralBand {
    let width = (LAST_NM - FIRST_NM) / f64::from(count);
    let wavelength = FIRST_NM + width * (f64::from(number) + 0.5);
    let (low, high) = (
        below(wavelength - 0.5 * width),
        below(wavelength + 0.5 * width),
    );
    SpectralBand {
        wavelength: f64::from(wavelength as f32),
        hue: (high - low) * f64::from(count),
    }
}

/// The factor on the index of refraction at a wavelength, for a `dispersion`.
pub(in crate::render::shade) fn bending(dispersion: f64, wavelength: f64) -> f64 {
    dispersion.powf((MIDDLE_NM - wavelength) / (LAST_NM - FIRST_NM))
}

/// All light of wavelengths up to this one.
fn below(wavelength: f64) -> Rgb {
    let at = ((wavelength - FIRST_NM) / STEP_NM).clamp(0.0, 70.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is clamped to the table"
    )]
    let index = (at as usize).min(BELOW.len() - 2);
    let color = |[r, g, b]: [u16; 3]| {
        let share = |v: u16| f32::from(v) / 10000.0;
        Rgb::new(share(r), share(g), share(b))
    };
    let (from, to) = (color(BELOW[index]), color(BELOW[index + 1]));
    #[allow(clippy::cast_precision_loss, reason = "the table is short")]
    let share = at - index as f64;
    from + (to - from) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_bands_together_are_nearly_white() {
        for count in [2, 7, 30] {
            let mut sum = Rgb::BLACK;
            for number in 0..count {
                sum += band(number, count).hue * (1.0 / f64::from(count));
            }
            let apart = sum - Rgb::new(0.9938, 1.0, 0.9962);
            assert!(apart.r.abs() + apart.g.abs() + apart.b.abs() < 1e-5);
        }
    }

    #[test]
    fn short_waves_are_blue_and_long_ones_red() {
        let (first, last) = (band(0, 7), band(6, 7));
        assert_eq!((first.wavelength, last.wavelength), (405.0, 705.0));
        assert!(first.hue.b > first.hue.r && last.hue.r > last.hue.b);
        assert!(bending(1.1, first.wavelength) > 1.0 && bending(1.1, last.wavelength) < 1.0);
        assert_eq!(bending(1.1, 555.0), 1.0);
    }
}
