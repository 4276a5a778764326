//! The formats of pictures: their words, the endings of their names, and how they store light.

use crate::base::args::Word;

/// A format that is read.
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

/// The formats with their words and endings of file names.
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
    /// The format that a scene names.
    pub(super) fn of_word(word: Word) -> Option<Self> {
        let entry = FORMATS.iter().find(|entry| entry.1 == word);
        entry.map(|entry| entry.0)
    }

    /// The format by the ending of a file name.
    pub(super) fn of_name(name: &str) -> Option<Self> {
        let name = name.to_lowercase();
        let is_its =
            |entry: &&(Format, Word, &[&str])| entry.2.iter().any(|ending| name.ends_with(ending));
        FORMATS.iter().find(is_its).map(|entry| entry.0)
    }

    /// The endings of names of such files.
    pub(super) fn endings(self) -> &'static [&'static str] {
        let entry = FORMATS.iter().find(|entry| entry.0 == self);
        entry.map_or(&[], |entry| entry.2)
    }

    /// Whether files that do not say it hold light by the sRGB curve (measured). The others are taken as they are.
    pub(super) fn is_srgb(self) -> bool {
        matches!(
            self,
            Format::Bmp | Format::Gif | Format::Jpeg | Format::Png | Format::Tga
        )
    }

    /// Whether files hold light itself.
    pub(super) fn is_linear(self) -> bool {
        matches!(self, Format::Exr | Format::Hdr)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_is_known_by_its_word_and_by_the_name_of_the_file() {
        assert_eq!(Format::of_name("a.b/Photo.JPEG"), Some(Format::Jpeg));
        assert_eq!(Format::of_name("photo"), None);
        assert_eq!(Format::of_word(Word::Tiff), Some(Format::Tiff));
    }
}
