//! Bitmaps read by a scene, for `image_map`, `image_pattern`, `bump_map`, `material_map` and height fields.
//!
//! A bitmap stores the samples of the file and decodes them on lookup; 8-bit samples use a table. Rows run from the
//! top. Alpha becomes transmit.

mod bmp;
mod decode;
mod format;
mod gif;
mod handling;
mod hdr;
mod jpeg;
mod mapping;
mod png;
mod pnm;
mod read;
mod size;
mod tga;
mod tiff;

pub(crate) use decode::content;
pub(crate) use format::Format;
pub(crate) use handling::Content;
pub use mapping::Purpose;
pub use mapping::{Interpolation, MapType, Mapping};
pub(crate) use pnm::divisor as pnm_divisor;
pub use read::{AddedTransparency, Alpha, MappedBitmap, read, read_gamma};
pub(crate) use size::bytes_to_decode;

use crate::base::color::{Color, Gamma, Rgb};

/// A decoded image, ready for lookups.
#[derive(Debug)]
pub struct Bitmap {
    width: usize,
    height: usize,
    samples: Samples,
    has_alpha: bool,
    /// True if POV-Ray stores the alpha of all pixels, as it does in files of some formats without any.
    stores_alpha: bool,
    /// True if colours are stored premultiplied with alpha.
    is_premultiplied: bool,
}

/// Samples in row-major order from the top.
#[derive(Debug)]
enum Samples {
    /// 8-bit samples, and the decoded value of each colour sample.
    Bytes(Pixels<u8>, Box<[f32; 256]>),
    /// 16-bit samples, and the transfer that decodes the colour samples.
    Words(Pixels<u16>, Transfer),
    /// Samples in the working space.
    Floats(Pixels<f32>),
    /// Scene colours with filter and transmit, from a sampled function.
    Colors(Vec<Color>),
    /// Indices into a palette.
    Indexed(Vec<u8>, Vec<Color>),
}

/// Interleaved pixels of one to four channels: grey or RGB, followed by alpha if the file has it.
#[derive(Debug)]
struct Pixels<T> {
    samples: Vec<T>,
    channels: usize,
}

impl<T: Copy> Pixels<T> {
    /// RGBA of the pixel at an index; pixels without alpha get `opaque`.
    #[inline]
    fn get(&self, at: usize, opaque: T) -> [T; 4] {
        match self.samples[at * self.channels..][..self.channels] {
            [grey] => [grey, grey, grey, opaque],
            [grey, alpha] => [grey, grey, grey, alpha],
            [red, green, blue] => [red, green, blue, opaque],
            [red, green, blue, alpha, ..] => [red, green, blue, alpha],
            [] => [opaque; 4],
        }
    }
}

/// The conversion from stored values to the working space; the identity if either gamma is missing.
#[derive(Clone, Copy, Debug)]
struct Transfer {
    /// The gamma of the file.
    file: Option<Gamma>,
    /// The gamma of the working space.
    working: Option<Gamma>,
}

impl Transfer {
    fn apply(self, stored: f32) -> f32 {
        match (self.file, self.working) {
            (Some(file), Some(working)) if !file.is_almost(working) => {
                working.encode(file.decode(stored))
            }
            _ => stored,
        }
    }

    fn is_identity(self) -> bool {
        let both = self.file.zip(self.working);
        both.is_none_or(|(file, working)| file.is_almost(working))
    }

    fn table(self) -> Box<[f32; 256]> {
        let mut table = Box::new([0.0; 256]);
        for (byte, value) in (0u8..=255).zip(table.iter_mut()) {
            *value = self.apply(f32::from(byte) / 255.0);
        }
        table
    }
}

impl Bitmap {
    /// The width in pixels, at least 1.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The height in pixels, at least 1.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// True if the file stores alpha.
    #[must_use]
    pub fn has_alpha(&self) -> bool {
        self.has_alpha
    }

    /// True if pixels have an alpha for `use_alpha`.
    #[must_use]
    pub fn stores_alpha(&self) -> bool {
        self.stores_alpha
    }

    /// The number of palette entries, if there is a palette.
    #[must_use]
    pub fn palette_len(&self) -> Option<usize> {
        match &self.samples {
            Samples::Indexed(_, palette) => Some(palette.len()),
            _ => None,
        }
    }

    /// True if a palette entry or sampled colour has filter or transmit.
    fn has_transparent_colors(&self) -> bool {
        self.has_color(|color| color.is_transparent())
    }

    /// True if a palette entry or sampled colour has transmit.
    fn has_clear_colors(&self) -> bool {
        self.has_color(|color| color.transmit != 0.0)
    }

    fn has_color(&self, is_sought: impl Fn(&Color) -> bool) -> bool {
        match &self.samples {
            Samples::Indexed(_, colors) | Samples::Colors(colors) => colors.iter().any(is_sought),
            _ => false,
        }
    }

    /// The palette, if there is one.
    fn palette_mut(&mut self) -> Option<&mut [Color]> {
        match &mut self.samples {
            Samples::Indexed(_, palette) => Some(palette),
            _ => None,
        }
    }

    /// The palette index of a pixel, if there is a palette. `x < width`, `y < height`, from the top.
    #[must_use]
    pub fn index(&self, x: usize, y: usize) -> Option<u8> {
        match &self.samples {
            Samples::Indexed(indices, _) => Some(indices[y * self.width + x]),
            _ => None,
        }
    }

    /// The colour of one or several pixels as stored, divided by alpha if it is stored multiplied.
    fn divided_by_alpha(&self, stored: Color) -> Color {
        let alpha = 1.0 - stored.transmit;
        if !self.is_premultiplied || alpha <= 0.0 {
            return stored;
        }
        let Rgb { r, g, b } = stored.rgb;
        Color {
            rgb: Rgb::new(r / alpha, g / alpha, b / alpha),
            ..stored
        }
    }

    /// The colour of a pixel before any division by alpha. `x < width`, `y < height`, from the top.
    fn stored_color(&self, x: usize, y: usize) -> Color {
        let at = y * self.width + x;
        let [r, g, b, alpha] = match &self.samples {
            Samples::Indexed(indices, palette) => {
                let color = palette.get(usize::from(indices[at]));
                return color.copied().unwrap_or_default();
            }
            Samples::Bytes(pixels, table) => {
                let [r, g, b, a] = pixels.get(at, u8::MAX);
                let value = |byte: u8| table[usize::from(byte)];
                [value(r), value(g), value(b), f32::from(a) / 255.0]
            }
            Samples::Words(pixels, transfer) => {
                let words = pixels.get(at, u16::MAX);
                let [r, g, b, a] = words.map(|word| f32::from(word) / 65535.0);
                [transfer.apply(r), transfer.apply(g), transfer.apply(b), a]
            }
            Samples::Floats(pixels) => pixels.get(at, 1.0),
            Samples::Colors(colors) => return colors[at],
        };
        Color {
            rgb: Rgb::new(r, g, b),
            filter: 0.0,
            transmit: 1.0 - alpha,
        }
    }
}
