//! Pictures that a scene reads: for `image_map`, `image_pattern`, bumps and heights.
//!
//! A picture keeps its samples as they are stored and decodes them when they are looked up: eight bits by a table.
//! Rows are from the top. What the file says of alpha becomes transmit.

mod bmp;
mod decode;
mod format;
mod gif;
mod jpeg;
mod mapping;
mod png;
mod read;
mod size;

pub(crate) use bmp::{Content as BmpContent, content as bmp_content};
pub(crate) use decode::picture;
pub(crate) use format::Format;
pub use mapping::{Interpolation, MapType, Mapping};
pub use read::{Alpha, Purpose, Source, read};
pub(crate) use size::bytes_to_decode;

use crate::base::color::{Color, Gamma, Rgb};

/// A picture ready to be looked up.
#[derive(Debug)]
pub struct Bitmap {
    width: usize,
    height: usize,
    samples: Samples,
    has_alpha: bool,
    /// Whether colours are stored already multiplied with alpha.
    is_premultiplied: bool,
}

/// The samples of a picture, row by row from the top.
#[derive(Debug)]
enum Samples {
    /// Samples of eight bits, and the numbers that those of colours stand for.
    Bytes(Pixels<u8>, Box<[f32; 256]>),
    /// The same of sixteen bits.
    Words(Pixels<u16>, Transfer),
    /// Numbers of the working space.
    Floats(Pixels<f32>),
    /// Colours of the scene.
    Colors(Vec<Color>),
    /// Indices into a palette.
    Indexed(Vec<u8>, Vec<Color>),
}

/// Pixels of one to four samples, as files hold them: grey or red, green and blue, and then alpha if there is any.
#[derive(Debug)]
struct Pixels<T> {
    samples: Vec<T>,
    channels: usize,
}

impl<T: Copy> Pixels<T> {
    /// Red, green, blue and alpha of a pixel, where `opaque` is the alpha of pixels without any.
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

/// How stored values become numbers of the scene; nothing is done without gamma handling.
#[derive(Clone, Copy, Debug)]
struct Transfer {
    /// How the file stores light.
    file: Option<Gamma>,
    /// How the scene counts it.
    working: Option<Gamma>,
}

impl Transfer {
    fn apply(self, stored: f32) -> f32 {
        match (self.file, self.working) {
            (Some(file), Some(working)) if file != working => working.encode(file.decode(stored)),
            _ => stored,
        }
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

    /// Whether the file stores alpha.
    #[must_use]
    pub fn has_alpha(&self) -> bool {
        self.has_alpha
    }

    /// How many colours the palette has, if there is one.
    #[must_use]
    pub fn palette_len(&self) -> Option<usize> {
        match &self.samples {
            Samples::Indexed(_, palette) => Some(palette.len()),
            _ => None,
        }
    }

    /// Whether some colour of the scene or of the palette lets light through.
    fn has_clear_colors(&self) -> bool {
        match &self.samples {
            Samples::Indexed(_, colors) | Samples::Colors(colors) => {
                colors.iter().any(|color| color.is_transparent())
            }
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

    /// The index of a pixel in the palette, if there is one. `x < width`, `y < height`, from the top.
    #[must_use]
    pub fn index(&self, x: usize, y: usize) -> Option<u8> {
        match &self.samples {
            Samples::Indexed(indices, _) => Some(indices[y * self.width + x]),
            _ => None,
        }
    }

    /// The colour of a pixel. `x < width`, `y < height`, from the top.
    #[must_use]
    pub fn color(&self, x: usize, y: usize) -> Color {
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
        let rgb = if self.is_premultiplied && alpha != 0.0 {
            Rgb::new(r / alpha, g / alpha, b / alpha)
        } else {
            Rgb::new(r, g, b)
        };
        Color {
            rgb,
            filter: 0.0,
            transmit: 1.0 - alpha,
        }
    }
}
