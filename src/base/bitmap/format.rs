//! Image file formats: their keywords, file name extensions and default transfer curves.

use crate::base::args::Word;

/// A supported image format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Bmp,
    Exr,
    Gif,
    Hdr,
    Jpeg,
    Pgm,
    Png,
    Ppm,
    Tga,
    Tiff,
}

/// The formats with their keywords and file name extensions.
const FORMATS: [(Format, Word, &[&str]); 10] = [
    (Format::Bmp, Word::Bmp, &[".bmp", ".BMP"]),
    (Format::Exr, Word::Exr, &[".exr", ".EXR"]),
    (Format::Gif, Word::Gif, &[".gif", ".GIF"]),
    (Format::Hdr, Word::Hdr, &[".hdr", ".HDR"]),
    (
        Format::Jpeg,
        Word::Jpeg,
        &[".jpg", ".JPG", ".jpeg", ".JPEG"],
    ),
    (Format::Pgm, Word::Pgm, &[".pgm", ".PGM"]),
    (Format::Png, Word::Png, &[".png", ".PNG"]),
    (Format::Ppm, Word::Ppm, &[".ppm", ".PPM"]),
    (Format::Tga, Word::Tga, &[".tga", ".TGA"]),
    (
        Format::Tiff,
        Word::Tiff,
        &[".tif", ".TIF", ".tiff", ".TIFF"],
    ),
];

impl Format {
    /// The format for a keyword of the scene language.
    pub(super) fn of_word(word: Word) -> Option<Self> {
        let entry = FORMATS.iter().find(|entry| entry.1 == word);
        entry.map(|entry| entry.0)
    }

    /// The format for the extension of a file name, in any case.
    pub(super) fn of_name(name: &str) -> Option<Self> {
        let name = name.to_lowercase();
        let has_extension = |entry: &&(Format, Word, &[&str])| {
            entry.2.iter().any(|extension| name.ends_with(extension))
        };
        FORMATS.iter().find(has_extension).map(|entry| entry.0)
    }

    /// The file name extensions of the format.
    pub(super) fn extensions(self) -> &'static [&'static str] {
        let entry = FORMATS.iter().find(|entry| entry.0 == self);
        entry.map_or(&[], |entry| entry.2)
    }

    /// True if POV-Ray assumes sRGB for files without gamma information (measured). Other formats are used as stored.
    pub(super) fn is_srgb(self) -> bool {
        matches!(
            self,
            Format::Bmp | Format::Gif | Format::Jpeg | Format::Png | Format::Tga
        )
    }

    /// True if files store linear light.
    pub(super) fn is_linear(self) -> bool {
        matches!(self, Format::Exr | Format::Hdr)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_is_known_by_its_keyword_and_by_its_file_name() {
        assert_eq!(Format::of_name("a.b/Photo.JPEG"), Some(Format::Jpeg));
        assert_eq!(Format::of_name("photo"), None);
        assert_eq!(Format::of_word(Word::Tiff), Some(Format::Tiff));
    }
}
