//! The picture while it is linear: one pixel after the other, in the working space of the scene. Of a picture that is
//! only to be written, the levels of its file take the place of its light as soon as a part of it is drawn.

pub(crate) mod quantize;

pub use quantize::Levels;
pub(crate) use quantize::Quantizer;

use crate::base::color::Rgb;
use std::ops::Range;

/// What one camera ray, or the mean of several, brought back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Light of the scene, in its working space. The share of the background that shows through is not in it.
    pub rgb: Rgb,
    /// How much of a transparent background shows through; 0 is opaque.
    pub transmit: f32,
}

impl Pixel {
    /// A pixel for a file: what is no number is black there, and what no number can hold is the largest.
    #[must_use]
    #[inline]
    pub fn new(rgb: Rgb, transmit: f32) -> Pixel {
        if (rgb.r.abs() + rgb.g.abs() + rgb.b.abs() + transmit.abs()).is_finite() {
            return Pixel { rgb, transmit };
        }
        let told = |c: f32| {
            if c.is_nan() {
                0.0
            } else {
                c.clamp(f32::MIN, f32::MAX)
            }
        };
        Pixel {
            rgb: rgb.map(told),
            transmit: told(transmit),
        }
    }
}

/// Makes of samples pixels for a file, as [`Pixel::new`] does.
pub(crate) fn sanitize_all(pixels: &mut [Pixel]) {
    // Zero times what is not finite is not a number.
    let mut off = [0.0; 4];
    for Pixel { rgb, transmit } in &*pixels {
        for (off, c) in off.iter_mut().zip([rgb.r, rgb.g, rgb.b, *transmit]) {
            *off += c * 0.0;
        }
    }
    if off.iter().any(|off| off.is_nan()) {
        for pixel in pixels {
            *pixel = Pixel::new(pixel.rgb, pixel.transmit);
        }
    }
}

/// A picture in the working space, row by row from the top.
///
/// A partial drawing is a picture of full size whose other pixels are opaque black, as POV-Ray leaves them.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The columns that were drawn, counted from 0.
    pub columns: Range<u32>,
    /// The rows that were drawn, counted from 0.
    pub rows: Range<u32>,
    /// Row-major, `width * height` of them; none where `levels` stand for them.
    pub pixels: Vec<Pixel>,
    /// The same as the levels of the one kind of file that is asked for.
    pub levels: Option<Levels>,
}

impl Film {
    /// A black picture of which the given rectangle is about to be drawn.
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

    /// The same for a picture of which only these levels are kept.
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

    /// A black picture that is to be drawn as a whole.
    #[must_use]
    pub fn whole(width: u32, height: u32) -> Self {
        Film::new(width, height, 0..width, 0..height)
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
    fn what_is_no_number_is_black() {
        let pixel = Pixel::new(Rgb::new(f32::NAN, f32::INFINITY, -0.5), f32::NAN);
        assert_eq!(pixel.rgb, Rgb::new(0.0, f32::MAX, -0.5));
        assert_eq!(pixel.transmit, 0.0);
        let some = Pixel {
            rgb: Rgb::new(0.5, f32::MAX, f32::MAX),
            transmit: 0.25,
        };
        let odd = [
            (f32::NAN, 0.0),
            (f32::INFINITY, f32::MAX),
            (f32::NEG_INFINITY, f32::MIN),
        ];
        for (light, told) in odd {
            let rgb = Rgb::new(light, 1.0, -1.0);
            let mut pixels = [some, Pixel { rgb, ..some }, some];
            sanitize_all(&mut pixels);
            let rgb = Rgb::new(told, 1.0, -1.0);
            assert_eq!(pixels, [some, Pixel { rgb, ..some }, some]);
        }
    }
}
