//! The error of a picture relative to the truth, in linear light between black and white.

use image::RgbImage;
use serde::{Deserialize, Serialize};

use crate::base::color::Gamma;
use crate::base::film::Film;

/// A picture in linear light, row by row, every channel from 0 to 1: the range of a screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Linear {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue.
    pub pixels: Vec<[f32; 3]>,
}

/// Error measures of two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// The root of the mean of the squared differences of all channels.
    pub rmse: f64,
    /// The largest difference of a channel.
    pub max: f64,
    /// The difference of the worst channel that 99.9 % of the pixels do not exceed.
    pub p999: f64,
    /// The mean of FLIP (Andersson et al. 2020) over sRGB pictures at the usual distance of 67 pixels a degree.
    pub flip: f64,
}

impl Linear {
    /// Converts a film; `working` is its colour space, `None` for values that are stored as they are.
    #[must_use]
    pub fn of_film(film: &Film, working: Option<Gamma>) -> Linear {
        let working = working.unwrap_or(Gamma::Srgb);
        let linear = |c: f32| working.decode(c.clamp(0.0, 1.0)).clamp(0.0, 1.0);
        Linear {
            width: film.width,
            height: film.height,
            pixels: film
                .pixels
                .iter()
                .map(|pixel| [pixel.rgb.r, pixel.rgb.g, pixel.rgb.b].map(linear))
                .collect(),
        }
    }

    /// The bytes of the sRGB picture, channels interleaved.
    #[must_use]
    pub fn srgb(&self) -> Vec<u8> {
        let stored = self.pixels.iter().flatten();
        stored.map(|&c| level(Gamma::Srgb.encode(c))).collect()
    }

    /// The difference of another picture from this one, magnified ten times, as sRGB bytes.
    #[must_use]
    pub fn difference(&self, other: &Linear) -> Vec<u8> {
        let pairs = self
            .pixels
            .iter()
            .flatten()
            .zip(other.pixels.iter().flatten());
        pairs
            .map(|(a, b)| level((a - b).abs() * ENLARGED))
            .collect()
    }

    /// The errors of another picture of the same size.
    #[must_use]
    pub fn errors(&self, other: &Linear) -> Errors {
        let mut worst = Vec::with_capacity(self.pixels.len());
        let mut squares = 0.0;
        for (a, b) in self.pixels.iter().zip(&other.pixels) {
            let mut largest = 0f64;
            for (a, b) in a.iter().zip(b) {
                let d = f64::from(*a) - f64::from(*b);
                squares += d * d;
                largest = largest.max(d.abs());
            }
            worst.push(largest);
        }
        worst.sort_unstable_by(f64::total_cmp);
        let thousandth = worst.len().div_ceil(1000);
        Errors {
            rmse: (squares / as_f64(3 * worst.len().max(1))).sqrt(),
            max: worst.last().copied().unwrap_or(0.0),
            p999: worst
                .get(worst.len().saturating_sub(thousandth + 1))
                .copied()
                .unwrap_or(0.0),
            flip: self.flip(other),
        }
    }

    fn flip(&self, other: &Linear) -> f64 {
        let image = |picture: &Linear| {
            RgbImage::from_raw(picture.width, picture.height, picture.srgb()).unwrap_or_default()
        };
        crate::app::compare::flip(&image(self).into(), &image(other).into())
    }
}

/// The magnification of differences, for visibility.
pub(super) const ENLARGED: f32 = 10.0;

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and 255"
)]
fn level(v: f32) -> u8 {
    (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

#[allow(clippy::cast_precision_loss, reason = "counts of pixels")]
fn as_f64(n: usize) -> f64 {
    n as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(value: f32) -> Linear {
        Linear {
            width: 40,
            height: 30,
            pixels: vec![[value; 3]; 1200],
        }
    }

    #[test]
    fn equal_pictures_have_no_error() {
        let errors = grey(0.3).errors(&grey(0.3));
        assert_eq!((errors.rmse, errors.max, errors.p999), (0.0, 0.0, 0.0));
        assert!(errors.flip.abs() < 1e-6);
    }

    #[test]
    fn one_wrong_pixel_of_a_thousand_is_beyond_the_percentile() {
        let mut other = grey(0.25);
        other.pixels[77] = [0.5, 0.25, 0.25];
        let errors = grey(0.25).errors(&other);
        assert!((errors.max - 0.25).abs() < 1e-7);
        assert!((errors.rmse - 0.25 / 60.0).abs() < 1e-7, "{errors:?}");
        assert!(errors.p999.abs() < 1e-9 && errors.flip > 0.0);
    }

    #[test]
    fn values_above_white_are_clipped() {
        let mut film = Film::whole(1, 1);
        film.pixels[0].rgb = crate::base::color::Rgb::new(7.0, -1.0, 0.25);
        let linear = Linear::of_film(&film, Some(Gamma::LINEAR));
        assert_eq!(linear.pixels, [[1.0, 0.0, 0.25]]);
    }
}
