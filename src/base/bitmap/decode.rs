//! From the bytes of a file to a picture.

use super::format::Format;
use super::{Bitmap, Pixels, Samples, Transfer, bmp, gif, jpeg, png};
use crate::base::color::Gamma;
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// Most pixels of a picture: more than any file of a scene has, and not yet all of the memory.
pub(super) const MOST_PIXELS: u64 = 1 << 28;
/// Most bytes that decoding may take. What there is to take has been looked at before.
const MOST_BYTES: u64 = 1 << 34;

/// What a scene says about a file beside its name.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Handling {
    /// The gamma of the file where the scene gives it.
    pub(super) gamma: Option<Gamma>,
    /// The working gamma; `None` without gamma handling.
    pub(super) working: Option<Gamma>,
    /// Whether files that say nothing hold light by the sRGB curve: from version 3.7 on.
    pub(super) assumes_srgb: bool,
    /// Whether colours are multiplied with alpha.
    pub(super) is_premultiplied: bool,
}

impl Handling {
    /// How the values of a file of this format become numbers of the scene; `own` is what the file says.
    pub(super) fn transfer(&self, format: Format, own: Option<Gamma>) -> Transfer {
        let default = if format.is_linear() {
            Some(Gamma::LINEAR)
        } else if format.is_srgb() && self.assumes_srgb {
            Some(Gamma::Srgb)
        } else {
            None
        };
        Transfer {
            file: self.gamma.or(own).or(default),
            working: self.working,
        }
    }
}

/// Why a file is no picture.
pub(super) type Fault = String;

/// The picture of a file.
pub(super) fn decode(bytes: &[u8], format: Format, handling: &Handling) -> Result<Bitmap, Fault> {
    match format {
        Format::Bmp => bmp::decode(bytes, handling),
        Format::Png => png::decode(bytes, handling),
        Format::Gif => gif::decode(bytes, handling),
        _ => of_picture(
            picture(bytes, format)?,
            handling.transfer(format, None),
            handling,
        ),
    }
}

/// The samples of a file without a palette, as they are stored.
pub(crate) fn picture(bytes: &[u8], format: Format) -> Result<DynamicImage, Fault> {
    match format {
        Format::Jpeg => jpeg::decode(bytes),
        _ => by_crate(bytes, format),
    }
}

/// Whether a picture of this size is too large or empty.
pub(super) fn check_size(width: u64, height: u64) -> Result<(), Fault> {
    match width.checked_mul(height) {
        Some(0) => Err("it has no pixels".to_owned()),
        Some(pixels) if pixels <= MOST_PIXELS => Ok(()),
        _ => Err(format!("it has more than {MOST_PIXELS} pixels")),
    }
}

/// The format as the crate `image` calls it.
pub(super) fn crate_format(format: Format) -> ImageFormat {
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

pub(super) fn by_crate(bytes: &[u8], format: Format) -> Result<DynamicImage, Fault> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), crate_format(format));
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    reader.decode().map_err(|error| error.to_string())
}

/// The picture that the `image` crate decodes.
pub(super) fn of_picture(
    picture: DynamicImage,
    transfer: Transfer,
    handling: &Handling,
) -> Result<Bitmap, Fault> {
    check_size(u64::from(picture.width()), u64::from(picture.height()))?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let has_alpha = picture.color().has_alpha();
    let channels = usize::from(picture.color().channel_count());
    let bytes = |samples| Samples::Bytes(Pixels { samples, channels }, transfer.table());
    let words = |samples| Samples::Words(Pixels { samples, channels }, transfer);
    let samples = match picture {
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
        is_premultiplied: handling.is_premultiplied,
    })
}
