//! TIFF decoding that matches POV-Ray (measured): palettes of 8 bits keep their indices; all other samples have 8 bits, and
//! colours are multiplied by their alpha in these, so that any gamma is that of the products.

use super::format::Format;
use super::handling::{Content, Fault, decode_by_crate};
use image::DynamicImage;
use std::borrow::Cow;

/// The tag of the meaning of samples, and its values for grey and for indices into a palette.
const PHOTOMETRIC: u16 = 262;
const GREY: u16 = 1;
const PALETTE: u16 = 3;
/// The tag of the palette: all red values, then green and blue.
const COLOR_MAP: u16 = 320;
/// The tag of the kinds of samples beyond the colours, and its value for alpha that colours are not multiplied by.
const EXTRA_SAMPLES: u16 = 338;
const UNASSOCIATED: u16 = 2;

/// Decodes the pixels of a file.
pub(super) fn content(bytes: &[u8]) -> Result<Content, Fault> {
    let directory = Directory::of(bytes);
    let mut image = bytes_of(decode_by_crate(&decodable(bytes), Format::Tiff)?);
    if let Some(directory) = directory.filter(Directory::has_palette) {
        let (Some(palette), DynamicImage::ImageLuma8(indices)) = (directory.palette(), image)
        else {
            return Err("its palette does not have 256 colours".to_owned());
        };
        return Ok(Content::Indexed {
            width: indices.width() as usize,
            height: indices.height() as usize,
            indices: indices.into_raw(),
            palette,
        });
    }
    let extra = directory.and_then(|directory| directory.short(EXTRA_SAMPLES, 0));
    if extra == Some(UNASSOCIATED) {
        match &mut image {
            DynamicImage::ImageLumaA8(it) => it.pixels_mut().for_each(|it| multiply(&mut it.0)),
            DynamicImage::ImageRgba8(it) => it.pixels_mut().for_each(|it| multiply(&mut it.0)),
            _ => {}
        }
    }
    Ok(Content::Colors(image))
}

/// The file in a form that the `image` crate decodes: indices as grey.
pub(super) fn decodable(bytes: &[u8]) -> Cow<'_, [u8]> {
    let directory = Directory::of(bytes).filter(Directory::has_palette);
    let Some((directory, at)) = directory.and_then(|it| Some((it, it.entry(PHOTOMETRIC)? + 8)))
    else {
        return Cow::Borrowed(bytes);
    };
    let mut file = bytes.to_vec();
    let grey = match directory.is_little {
        true => GREY.to_le_bytes(),
        false => GREY.to_be_bytes(),
    };
    file[at..at + 2].copy_from_slice(&grey);
    Cow::Owned(file)
}

/// The samples in 8 bits; the high bytes of grey, and the nearest values of colours.
fn bytes_of(image: DynamicImage) -> DynamicImage {
    match image {
        DynamicImage::ImageLuma16(mut it) => {
            it.iter_mut()
                .for_each(|sample| *sample = (*sample >> 8) * 257);
            DynamicImage::ImageLuma16(it).into_luma8().into()
        }
        DynamicImage::ImageLumaA16(_) => image.into_luma_alpha8().into(),
        DynamicImage::ImageRgb16(_) => image.into_rgb8().into(),
        DynamicImage::ImageRgba16(_) => image.into_rgba8().into(),
        image => image,
    }
}

fn multiply(pixel: &mut [u8]) {
    if let Some((&mut alpha, colors)) = pixel.split_last_mut() {
        for color in colors {
            let product = (u16::from(*color) * u16::from(alpha) + 127) / 255;
            *color = u8::try_from(product).expect("it is below 256");
        }
    }
}

/// The first directory of tags of a file.
#[derive(Clone, Copy)]
struct Directory<'a> {
    bytes: &'a [u8],
    is_little: bool,
    /// Its first byte.
    at: usize,
}

impl<'a> Directory<'a> {
    fn of(bytes: &'a [u8]) -> Option<Self> {
        let is_little = bytes.starts_with(b"II");
        let file = Directory {
            bytes,
            is_little,
            at: 0,
        };
        let at = file.long_at(4)?;
        Some(Directory { at, ..file })
    }

    fn short_at(&self, at: usize) -> Option<u16> {
        let bytes = *self.bytes.get(at..)?.first_chunk()?;
        Some(match self.is_little {
            true => u16::from_le_bytes(bytes),
            false => u16::from_be_bytes(bytes),
        })
    }

    fn long_at(&self, at: usize) -> Option<usize> {
        let bytes = *self.bytes.get(at..)?.first_chunk()?;
        let value = match self.is_little {
            true => u32::from_le_bytes(bytes),
            false => u32::from_be_bytes(bytes),
        };
        usize::try_from(value).ok()
    }

    /// The first byte of the entry of a tag.
    fn entry(&self, tag: u16) -> Option<usize> {
        let entries = 0..usize::from(self.short_at(self.at)?);
        let mut entries = entries.map(|entry| self.at + 2 + 12 * entry);
        entries.find(|&at| self.short_at(at) == Some(tag))
    }

    /// A value of a tag of short numbers.
    fn short(&self, tag: u16, index: usize) -> Option<u16> {
        let entry = self.entry(tag)?;
        let count = self.long_at(entry + 4)?;
        let values = match count {
            0..=2 => entry + 8,
            _ => self.long_at(entry + 8)?,
        };
        (index < count).then(|| self.short_at(values.checked_add(2 * index)?))?
    }

    /// True if the samples are indices into a palette.
    fn has_palette(&self) -> bool {
        self.short(PHOTOMETRIC, 0) == Some(PALETTE)
    }

    /// The palette of indices of 8 bits.
    fn palette(&self) -> Option<Vec<[u16; 4]>> {
        let levels = (0..3 * 256).map(|index| self.short(COLOR_MAP, index));
        let levels: Vec<u16> = levels.collect::<Option<_>>()?;
        // Some programs write bytes.
        let scale = match levels.iter().any(|&level| level > 255) {
            true => 1,
            false => 257,
        };
        let level = |index: usize| levels[index] * scale;
        let color = |index| {
            [
                level(index),
                level(256 + index),
                level(512 + index),
                u16::MAX,
            ]
        };
        Some((0..256).map(color).collect())
    }
}
