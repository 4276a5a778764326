//! TIFF decoding that matches POV-Ray (measured): palettes of 8 bits keep their indices; samples of 16 bits become bytes, and
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
/// The tag of the kinds of samples beyond the colours: a fourth one of no kind is alpha that colours are multiplied by.
const EXTRA_SAMPLES: u16 = 338;
const UNSPECIFIED: u16 = 0;
const ASSOCIATED: u16 = 1;
const UNASSOCIATED: u16 = 2;
const BITS_PER_SAMPLE: u16 = 258;
const SAMPLES_PER_PIXEL: u16 = 277;
/// The number that follows the byte order in the head of a file.
const MAGIC: u16 = 42;

/// Decodes the pixels of a file.
pub(super) fn content(bytes: &[u8]) -> Result<Content, Fault> {
    let directory = Directory::of(bytes);
    let mut image = bytes_of(decode_by_crate(&decodable(bytes), Format::Tiff)?);
    if let Some(directory) = directory.filter(Directory::has_palette) {
        let (Some(palette), DynamicImage::ImageLuma8(indices)) = (directory.palette(), image)
        else {
            return Err("its palette is not one of 8 bits".to_owned());
        };
        return Ok(Content::Indexed {
            width: indices.width() as usize,
            height: indices.height() as usize,
            indices: indices.into_raw(),
            palette,
        });
    }
    let extra = directory.and_then(|directory| directory.short(EXTRA_SAMPLES, 0));
    if extra == Some(UNASSOCIATED)
        && let DynamicImage::ImageRgba8(image) = &mut image
    {
        image.pixels_mut().for_each(|pixel| multiply(&mut pixel.0));
    }
    Ok(Content::Colors(image))
}

/// The file in a form that the `image` crate decodes: indices as grey, and a fourth sample of no kind as alpha.
pub(super) fn decodable(bytes: &[u8]) -> Cow<'_, [u8]> {
    let Some(directory) = Directory::of(bytes) else {
        return Cow::Borrowed(bytes);
    };
    let is_unspecified = directory.short(EXTRA_SAMPLES, 0) == Some(UNSPECIFIED)
        && directory.short(SAMPLES_PER_PIXEL, 0) == Some(4);
    let kinds = [
        (PHOTOMETRIC, GREY, directory.has_palette()),
        (EXTRA_SAMPLES, ASSOCIATED, is_unspecified),
    ];
    let mut file = Cow::Borrowed(bytes);
    for (tag, kind, _) in kinds.into_iter().filter(|kind| kind.2) {
        if let Some(value) = directory.values(tag) {
            let kind = match directory.is_little {
                true => kind.to_le_bytes(),
                false => kind.to_be_bytes(),
            };
            file.to_mut()[value..value + 2].copy_from_slice(&kind);
        }
    }
    file
}

/// The samples in 8 bits; the high bytes of grey, and the nearest values of colours.
fn bytes_of(image: DynamicImage) -> DynamicImage {
    match image {
        DynamicImage::ImageLuma16(mut it) => {
            it.iter_mut()
                .for_each(|sample| *sample = (*sample >> 8) * 257);
            DynamicImage::ImageLuma16(it).into_luma8().into()
        }
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
        let is_classic = file.short_at(2)? == MAGIC;
        let at = file.long_at(4).filter(|_| is_classic)?;
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

    /// The first byte of the values of a tag of short numbers.
    fn values(&self, tag: u16) -> Option<usize> {
        let entry = self.entry(tag)?;
        match self.long_at(entry + 4)? {
            0..=2 => Some(entry + 8),
            _ => self.long_at(entry + 8),
        }
    }

    /// A value of a tag of short numbers.
    fn short(&self, tag: u16, index: usize) -> Option<u16> {
        let count = self.long_at(self.entry(tag)? + 4)?;
        let at = self.values(tag)?.checked_add(2 * index)?;
        (index < count).then(|| self.short_at(at))?
    }

    /// True if the samples are indices into a palette.
    fn has_palette(&self) -> bool {
        self.short(PHOTOMETRIC, 0) == Some(PALETTE)
    }

    /// The palette of indices of 8 bits.
    fn palette(&self) -> Option<Vec<[u16; 4]>> {
        (self.short(BITS_PER_SAMPLE, 0)? == 8).then_some(())?;
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
