//! Steps that decoders share: gamma, limits on the size, and decoding by the `image` crate.

use super::format::Format;
use super::png::palette_color;
use super::{Bitmap, Pixels, Samples, Transfer};
use crate::base::color::Gamma;
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// Pixel limit of an image: above any real scene's images, and low enough to fit in memory.
pub(crate) const MAX_PIXELS: u64 = 1 << 28;

/// Memory limit for the `image` crate. The scene's own memory limit has been checked before decoding starts.
pub(crate) const MAX_BYTES: u64 = 1 << 34;

/// The scene's settings for decoding a file.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Handling {
    /// The file gamma, if the scene specifies one.
    pub(crate) gamma: Option<Gamma>,
    /// The working gamma; `None` without gamma handling.
    pub(crate) working: Option<Gamma>,
    /// True if files without gamma information are sRGB, as from version 3.7 on.
    pub(crate) assumes_srgb: bool,
    /// True if grey values that no gamma changes stay as they are, as in version 3.8.
    pub(crate) keeps_grey: bool,
    /// The scene's `premultiplied`: true if colours are multiplied by their alpha. `None` leaves it to the format.
    pub(crate) is_premultiplied: Option<bool>,
}

impl Handling {
    /// The transfer from stored values to the working space. `declared` is the gamma that the file declares; the
    /// scene's setting overrides it.
    pub(crate) fn transfer(&self, format: Format, declared: Option<Gamma>) -> Transfer {
        let default = if format.is_linear() {
            Some(Gamma::LINEAR)
        } else if format.is_srgb() && self.assumes_srgb {
            Some(Gamma::Srgb)
        } else {
            None
        };
        Transfer {
            file: self.gamma.or(declared).or(default),
            working: self.working,
        }
    }
}

/// Decoded pixels, before any colour conversion.
pub(crate) enum Content {
    /// Indices into an RGBA palette of 16 bits.
    Indexed {
        width: usize,
        height: usize,
        indices: Vec<u8>,
        palette: Vec<[u16; 4]>,
    },
    /// Samples of grey or colours.
    Colors(DynamicImage),
}

/// The reason why a file cannot be decoded.
pub(crate) type Fault = String;

/// Rejects empty images and images above [`MAX_PIXELS`].
pub(crate) fn check_size(width: u64, height: u64) -> Result<(), Fault> {
    match width.checked_mul(height) {
        Some(0) => Err("it has no pixels".to_owned()),
        Some(pixels) if pixels <= MAX_PIXELS => Ok(()),
        _ => Err(format!("it has more than {MAX_PIXELS} pixels")),
    }
}

/// The `image` crate's name for a format.
pub(crate) fn image_format(format: Format) -> ImageFormat {
    match format {
        Format::Bmp => ImageFormat::Bmp,
        Format::Exr => ImageFormat::OpenExr,
        Format::Gif => ImageFormat::Gif,
        Format::Hdr => ImageFormat::Hdr,
        Format::Jpeg => ImageFormat::Jpeg,
        Format::Pgm | Format::Ppm => ImageFormat::Pnm,
        Format::Png => ImageFormat::Png,
        Format::Tga => ImageFormat::Tga,
        Format::Tiff => ImageFormat::Tiff,
    }
}

pub(crate) fn decode_by_crate(bytes: &[u8], format: Format) -> Result<DynamicImage, Fault> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), image_format(format));
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    reader.decode().map_err(|error| error.to_string())
}

/// Builds a bitmap from decoded pixels.
pub(crate) fn bitmap_from_content(
    content: Content,
    transfer: Transfer,
    handling: &Handling,
) -> Result<Bitmap, Fault> {
    match content {
        Content::Colors(image) => bitmap_from_image(image, transfer, handling),
        Content::Indexed {
            width,
            height,
            indices,
            palette,
        } => {
            let has_alpha = palette.iter().any(|color| color[3] != u16::MAX);
            let palette = palette
                .into_iter()
                .map(|rgba| palette_color(rgba, transfer));
            Ok(Bitmap {
                width,
                height,
                samples: Samples::Indexed(indices, palette.collect()),
                has_alpha,
                stores_alpha: false,
                is_premultiplied: handling.is_premultiplied.unwrap_or(false),
            })
        }
    }
}

/// Builds a bitmap from a decoded image. Float samples are converted to the working space here, integer samples on
/// lookup.
pub(crate) fn bitmap_from_image(
    image: DynamicImage,
    transfer: Transfer,
    handling: &Handling,
) -> Result<Bitmap, Fault> {
    check_size(u64::from(image.width()), u64::from(image.height()))?;
    let (width, height) = (image.width() as usize, image.height() as usize);
    let has_alpha = image.color().has_alpha();
    let channels = usize::from(image.color().channel_count());
    let bytes = |samples| Samples::Bytes(Pixels { samples, channels }, transfer.table());
    let words = |samples| Samples::Words(Pixels { samples, channels }, transfer);
    let samples = match image {
        DynamicImage::ImageLuma8(it) => bytes(it.into_raw()),
        DynamicImage::ImageLumaA8(it) => bytes(it.into_raw()),
        DynamicImage::ImageRgb8(it) => bytes(it.into_raw()),
        DynamicImage::ImageRgba8(it) => bytes(it.into_raw()),
        DynamicImage::ImageLuma16(it) => words(it.into_raw()),
        DynamicImage::ImageLumaA16(it) => words(it.into_raw()),
        DynamicImage::ImageRgb16(it) => words(it.into_raw()),
        DynamicImage::ImageRgba16(it) => words(it.into_raw()),
        other => {
            let mut samples = match other {
                DynamicImage::ImageRgb32F(it) => it.into_raw(),
                other => other.into_rgba32f().into_raw(),
            };
            for pixel in samples.chunks_exact_mut(channels) {
                let colors = pixel.iter_mut().take(3);
                colors.for_each(|value| *value = transfer.apply(*value));
            }
            Samples::Floats(Pixels { samples, channels })
        }
    };
    Ok(Bitmap {
        width,
        height,
        samples,
        has_alpha,
        stores_alpha: false,
        is_premultiplied: handling.is_premultiplied.unwrap_or(false),
    })
}
