//! Picture file formats and encoder options.

use crate::base::color::Gamma;
use serde::{Deserialize, Serialize};

/// A picture file format. Each encoder in [`crate::output`] defines the properties and the constant of its format; that
/// module lists all formats.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Format(pub(crate) &'static FormatProperties);

/// Properties of a picture file format.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct FormatProperties {
    /// Name in messages.
    pub name: &'static str,
    /// Letter in POV-Ray's option `+F` and in `Output_File_Type`.
    pub letter: char,
    /// File name extensions without the dot; the first is the one that POV-Ray uses.
    pub extensions: &'static [&'static str],
    /// True if there can be an alpha channel.
    pub has_alpha: bool,
    /// True if there can be a single grey channel.
    pub has_grey: bool,
    /// True if channels can have 16 bits.
    pub has_words: bool,
    /// True if stored values are always linear.
    pub is_linear: bool,
    /// Default bits per channel.
    pub bits: u8,
    /// Maximum width and height.
    pub max_side: u32,
}

impl std::ops::Deref for Format {
    type Target = FormatProperties;
    fn deref(&self) -> &FormatProperties {
        self.0
    }
}

impl std::fmt::Debug for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// Encoder options. A format ignores what it does not support.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EncodeOptions {
    /// The file format.
    pub format: Format,
    /// Bits per channel: PNG and PPM take 5 to 16, from version 3.8 on 1 to 16; EXR 16 or 32, the others have one size.
    pub bits: u8,
    /// One grey channel instead of three colours (PNG, PPM).
    pub grayscale: bool,
    /// An alpha channel (PNG, TGA, BMP, EXR).
    pub alpha: bool,
    /// The curve of the stored values; EXR and HDR are always linear.
    pub file_gamma: Gamma,
    /// The working space of the film; `None` stores its values unchanged (EXR and HDR then interpret them as sRGB, as
    /// POV-Ray does).
    pub working: Option<Gamma>,
    /// The rule by which values become levels.
    pub rounding: Rounding,
    /// JPEG quality, 1 to 100; 0 selects POV-Ray's 85.
    pub quality: u8,
    /// Compression of PNG files.
    pub effort: Effort,
    /// Decimal numbers instead of bytes (PPM).
    pub is_plain: bool,
    /// The method of dithering; `None` rounds each pixel by itself. Files of linear light have none.
    pub dither: Option<DitherMethod>,
    /// Overrides for scenes from version 3.8 on.
    pub of_3_8: OptionsOf38,
}

/// Encoder options for scenes from version 3.8 on, in place of those for older ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OptionsOf38 {
    /// Bits per channel; `None` for the same.
    pub bits: Option<u8>,
    /// The curve of the stored values; `None` for the same.
    pub file_gamma: Option<Gamma>,
    /// Decimal numbers instead of bytes (PPM).
    pub is_plain: bool,
    /// The method of dithering; `None` for the same.
    pub dither: Option<DitherMethod>,
}

/// POV-Ray's methods of dithering. The thresholds and kernels of some depend on the version of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DitherMethod {
    /// Bayer's thresholds, 2 by 2.
    Bayer2,
    /// Thresholds, 3 by 3.
    Bayer3,
    /// Bayer's thresholds, 4 by 4.
    Bayer4,
    /// Blue noise, 64 by 64 thresholds.
    BlueNoise,
    /// The same, inverted for red and blue.
    BlueNoiseInverted,
    /// Error diffusion to the right.
    Diffusion1D,
    /// Error diffusion to the right and down.
    Diffusion2D,
    /// Error diffusion by Floyd and Steinberg.
    FloydSteinberg,
    /// Error diffusion by Atkinson.
    Atkinson,
    /// Error diffusion by Burkes.
    Burkes,
    /// Error diffusion by Jarvis, Judice and Ninke.
    JarvisJudiceNinke,
    /// Error diffusion by Sierra in two rows.
    Sierra2,
    /// Error diffusion by Sierra in three rows.
    Sierra3,
    /// Error diffusion by Stucki.
    Stucki,
}

impl DitherMethod {
    /// All methods with their names in `Dither_Method`.
    pub const ALL: [(&'static str, DitherMethod); 14] = [
        ("AT", DitherMethod::Atkinson),
        ("B2", DitherMethod::Bayer2),
        ("B3", DitherMethod::Bayer3),
        ("B4", DitherMethod::Bayer4),
        ("BK", DitherMethod::Burkes),
        ("BN", DitherMethod::BlueNoise),
        ("BNX", DitherMethod::BlueNoiseInverted),
        ("D1", DitherMethod::Diffusion1D),
        ("D2", DitherMethod::Diffusion2D),
        ("FS", DitherMethod::FloydSteinberg),
        ("JN", DitherMethod::JarvisJudiceNinke),
        ("S2", DitherMethod::Sierra2),
        ("S3", DitherMethod::Sierra3),
        ("ST", DitherMethod::Stucki),
    ];

    /// Returns true if POV-Ray 3.7 has the method.
    #[must_use]
    pub fn is_of_3_7(self) -> bool {
        use DitherMethod::{Bayer2, Bayer3, Bayer4, Diffusion1D, Diffusion2D, FloydSteinberg};
        matches!(
            self,
            Bayer2 | Bayer3 | Bayer4 | Diffusion1D | Diffusion2D | FloydSteinberg
        )
    }
}

/// The level that a value between two of them is rounded to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rounding {
    /// The nearer one in the file's encoding, as POV-Ray 3.7 does.
    #[default]
    Encoded,
    /// The nearer one in the working space, as POV-Ray 3.8 does: that in light where `assumed_gamma` is 1.
    Working,
}

/// The time spent on compression without loss.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Effort {
    /// As little as possible.
    #[default]
    Fastest,
    /// As much as makes files no larger than POV-Ray's: 13 ms for 640 by 480 pixels, where the least takes 1 ms.
    Balanced,
}

impl Format {
    /// The extension that POV-Ray uses, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        self.extensions[0]
    }
}

impl EncodeOptions {
    /// POV-Ray's defaults for a format, for a linear film.
    #[must_use]
    pub fn new(format: Format) -> Self {
        EncodeOptions {
            format,
            bits: format.bits,
            grayscale: false,
            alpha: false,
            file_gamma: Gamma::Srgb,
            working: Some(Gamma::LINEAR),
            rounding: Rounding::default(),
            quality: 0,
            effort: Effort::default(),
            is_plain: false,
            dither: None,
            of_3_8: OptionsOf38::default(),
        }
    }

    /// The options for the picture of a scene with this working space and rounding, which tells its version.
    #[must_use]
    pub fn for_scene(&self, working: Option<Gamma>, rounding: Rounding) -> Self {
        let mut options = EncodeOptions {
            working,
            rounding,
            ..self.clone()
        };
        if rounding == Rounding::Working {
            options.bits = self.of_3_8.bits.unwrap_or(self.bits);
            options.file_gamma = self.of_3_8.file_gamma.unwrap_or(self.file_gamma);
            options.is_plain |= self.of_3_8.is_plain;
            options.dither = self.of_3_8.dither.or(self.dither);
        }
        options
    }
}
