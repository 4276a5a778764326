//! Picture formats, and options of their encoders.

use crate::base::color::Gamma;

/// A picture format. Its properties, and the constant that names it, stand in the file of its encoder in
/// [`crate::output`], which has the list of all formats.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Format(pub(crate) &'static FormatProperties);

/// Properties of a picture format.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct FormatProperties {
    /// Name in messages.
    pub name: &'static str,
    /// Letter in POV-Ray's switch `+F` and in `Output_File_Type`.
    pub letter: char,
    /// Extensions of file names without the dot; the first is the one that POV-Ray gives.
    pub extensions: &'static [&'static str],
    /// True if there can be an alpha channel.
    pub has_alpha: bool,
    /// True if there can be a single grey channel.
    pub has_grey: bool,
    /// True if channels can have 16 bits.
    pub has_words: bool,
    /// True if the values are always linear light.
    pub is_linear: bool,
    /// Bits for each channel where nothing else is requested.
    pub bits: u8,
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

/// Options of an encoder. What a format cannot hold is left out.
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
    /// The extension that POV-Ray gives such files, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        self.extensions[0]
    }
}

impl EncodeOptions {
    /// POV-Ray's defaults for a format, for a film in linear light.
    #[must_use]
    pub fn new(format: Format) -> Self {
        EncodeOptions {
            format,
            bits: format.bits,
            grayscale: false,
            alpha: false,
            file_gamma: Gamma::Srgb,
            working: Some(Gamma::LINEAR),
            quality: 0,
        }
    }
}
