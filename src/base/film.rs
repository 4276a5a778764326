//! The film: rendered pixels in the working space of the scene, row-major. A picture that is only written to a file
//! stores the quantized levels of that file instead, converted as soon as each tile is finished.

mod dither;
pub(crate) mod quantize;

pub(crate) use quantize::Quantizer;
pub use quantize::{Levels, levels_of};

use crate::base::color::Rgb;
use std::ops::Range;

/// The radiance of one camera ray, or the mean of several.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Radiance in the working space, without the transmitted fraction of the background.
    pub rgb: Rgb,
    /// The fraction of a transparent background that is transmitted; 0 is opaque.
    pub transmit: f32,
}

impl Pixel {
    /// Sanitizes a pixel for a file: NaN becomes 0, and infinities become the largest finite values.
    #[must_use]
    #[inline]
    pub fn new(rgb: Rgb, transmit: f32) -> Pixel {
        if (rgb.r.abs() + rgb.g.abs() + rgb.b.abs() + transmit.abs()).is_finite() {
            return Pixel { rgb, transmit };
        }
        let finite = |c: f32| {
            if c.is_nan() {
                0.0
            } else {
                c.clamp(f32::MIN, f32::MAX)
            }
        };
        Pixel {
            rgb: rgb.map(finite),
            transmit: finite(transmit),
        }
    }
}

/// Sanitizes pixels in place, as [`Pixel::new`] does.
pub(crate) fn sanitize_all(pixels: &mut [Pixel]) {
    // Zero times a NaN or an infinity is NaN: one pass without branches finds out if there are any.
    let mut zero_sums = [0.0; 4];
    for Pixel { rgb, transmit } in &*pixels {
        for (sum, c) in zero_sums.iter_mut().zip([rgb.r, rgb.g, rgb.b, *transmit]) {
            *sum += c * 0.0;
        }
    }
    if zero_sums.iter().any(|sum| sum.is_nan()) {
        for pixel in pixels {
            *pixel = Pixel::new(pixel.rgb, pixel.transmit);
        }
    }
}

/// A picture in the working space, row by row from the top.
///
/// A partial render has the full size; the pixels outside the crop are opaque black, as in POV-Ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The rendered columns, from 0.
    pub columns: Range<u32>,
    /// The rendered rows, from 0.
    pub rows: Range<u32>,
    /// Row-major, `width * height` pixels; empty if `levels` is present.
    pub pixels: Vec<Pixel>,
    /// The quantized levels of the requested kind of file, instead of `pixels`.
    pub levels: Option<Levels>,
}

impl Film {
    /// A black picture for a render of the given rectangle.
    #[must_use]
    pub fn new(width: u32, height: u32, columns: Range<u32>, rows: Range<u32>) -> Self {
        Film {
            width,
            height,
            columns,
            rows,
            pixels: vec![Pixel::default(); width as usize * height as usize],
            levels: None,
        }
    }

    /// A picture that has only quantized levels.
    #[must_use]
    pub fn of_levels(levels: Levels, columns: Range<u32>, rows: Range<u32>) -> Self {
        let (width, height) = levels.size();
        Film {
            width,
            height,
            columns,
            rows,
            pixels: Vec::new(),
            levels: Some(levels),
        }
    }

    /// A black picture for a full render.
    #[must_use]
    pub fn whole(width: u32, height: u32) -> Self {
        Film::new(width, height, 0..width, 0..height)
    }

    /// True if all pixels have one colour, those outside of the rendered part among them.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        match &self.levels {
            Some(levels) => levels.is_flat(),
            None => self.pixels.windows(2).all(|two| two[0] == two[1]),
        }
    }

    /// The pixels of each row, from the top.
    pub fn rows_of_pixels(&self) -> impl Iterator<Item = &[Pixel]> {
        self.pixels.chunks(self.width.max(1) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::{Film, Pixel, sanitize_all};
    use crate::base::color::Rgb;

    #[test]
    fn a_partial_film_has_the_full_size() {
        let film = Film::new(4, 3, 1..2, 0..1);
        assert_eq!(film.pixels.len(), 12);
        assert_eq!(film.rows_of_pixels().count(), 3);
    }

    #[test]
    fn nan_becomes_black_and_infinity_finite() {
        let pixel = Pixel::new(Rgb::new(f32::NAN, f32::INFINITY, -0.5), f32::NAN);
        assert_eq!(pixel.rgb, Rgb::new(0.0, f32::MAX, -0.5));
        assert_eq!(pixel.transmit, 0.0);
        let some = Pixel {
            rgb: Rgb::new(0.5, f32::MAX, f32::MAX),
            transmit: 0.25,
        };
        let cases = [
            (f32::NAN, 0.0),
            (f32::INFINITY, f32::MAX),
            (f32::NEG_INFINITY, f32::MIN),
        ];
        for (light, expected) in cases {
            let rgb = Rgb::new(light, 1.0, -1.0);
            let mut pixels = [some, Pixel { rgb, ..some }, some];
            sanitize_all(&mut pixels);
            let rgb = Rgb::new(expected, 1.0, -1.0);
            assert_eq!(pixels, [some, Pixel { rgb, ..some }, some]);
        }
    }
}
