//! What a picture is to be stored as.

use crate::base::color::Gamma;

/// The kinds of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Portable Network Graphics.
    Png,
    /// Targa without compression.
    Tga,
    /// Targa with run-length compression.
    CompressedTga,
    /// Windows bitmap.
    Bmp,
    /// Portable pixmap, or greymap for a grey picture.
    Ppm,
    /// JPEG.
    Jpeg,
    /// OpenEXR.
    Exr,
    /// Radiance.
    Hdr,
}

/// How a picture becomes bytes. What a format has no room for is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct EncodeOptions {
    /// The kind of file.
    pub format: Format,
    /// Bits a channel: PNG and PPM take 8 or 16 (below 9 is 8), EXR 16 or 32, the others have one size.
    pub bits: u8,
    /// One grey channel instead of three colours (PNG, PPM).
    pub grayscale: bool,
    /// An alpha channel (PNG, TGA, BMP, EXR).
    pub alpha: bool,
    /// The curve of the stored values; EXR and HDR are always linear.
    pub file_gamma: Gamma,
    /// The space of the film; `None` stores its values as they are (EXR and HDR then take them for sRGB, as POV-Ray does).
    pub working: Option<Gamma>,
    /// JPEG quality, 1 to 100; 0 takes POV-Ray's 85.
    pub quality: u8,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 8] = [
        Format::Png,
        Format::Tga,
        Format::CompressedTga,
        Format::Bmp,
        Format::Ppm,
        Format::Jpeg,
        Format::Exr,
        Format::Hdr,
    ];

    /// The ending POV-Ray gives such files, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Tga | Format::CompressedTga => "tga",
            Format::Bmp => "bmp",
            Format::Ppm => "ppm",
            Format::Jpeg => "jpg",
            Format::Exr => "exr",
            Format::Hdr => "hdr",
        }
    }

    /// Whether such a file can keep an alpha channel.
    #[must_use]
    pub fn has_alpha(self) -> bool {
        !matches!(self, Format::Ppm | Format::Jpeg | Format::Hdr)
    }
}

impl EncodeOptions {
    /// POV-Ray's defaults for a format, for a film in linear light.
    #[must_use]
    pub fn new(format: Format) -> Self {
        EncodeOptions {
            format,
            bits: if format == Format::Exr { 16 } else { 8 },
            grayscale: false,
            alpha: false,
            file_gamma: Gamma::Srgb,
            working: Some(Gamma::LINEAR),
            quality: 0,
        }
    }
}
