//! Files from pictures: one file of this room a format, and one way for the bytes to reach their place.
//!
//! PNG, TGA, BMP, JPEG and PPM hold encoded values (sRGB unless told otherwise), EXR and HDR hold linear light.
//! What each holds was compared with the files of POV-Ray 3.7.0.10, pixel by pixel. Known differences:
//! grey PPM files are valid P5 files here, there they have twice the announced bytes and no gamma;
//! BMP files with alpha carry the header that names the alpha channel; no file carries a date.

mod bmp;
mod exr;
mod hdr;
mod jpeg;
mod place;
mod png;
mod ppm;
mod tga;

pub use crate::base::encoding::{EncodeOptions, Format, FormatProperties};
pub(crate) use place::{Pending, save, try_to_append, try_to_write};

use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::base::film::{Film, quantize};

/// Where the bytes go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// A file, replaced as a whole or not at all.
    File(PathBuf),
    /// Standard output.
    Stdout,
}

/// Why no picture was written.
#[derive(Debug)]
pub enum OutputError {
    /// The format cannot hold this picture.
    Encode {
        /// The format.
        format: Format,
        /// What stands in the way.
        reason: String,
    },
    /// The system refused.
    Write {
        /// Where the bytes were to go.
        target: Target,
        /// What the system said.
        source: io::Error,
    },
}

type EncodeResult = Result<Vec<u8>, String>;

/// Who refuses to write a picture.
enum Refusal {
    /// The format, which cannot hold it.
    ByFormat(String),
    BySystem(io::Error),
}

impl From<io::Error> for Refusal {
    fn from(error: io::Error) -> Self {
        Refusal::BySystem(error)
    }
}

type Encode = fn(&Film, &EncodeOptions) -> EncodeResult;

/// All formats with their encoders. The first of two with the same extension is the one that the extension names.
static FORMATS: &[(Format, Encode)] = &[
    (Format::PNG, png::encode),
    (Format::TGA, tga::encode),
    (Format::COMPRESSED_TGA, tga::encode),
    (Format::BMP, bmp::encode),
    (Format::PPM, ppm::encode),
    (Format::JPEG, jpeg::encode),
    (Format::EXR, exr::encode),
    (Format::HDR, hdr::encode),
];

/// All formats.
pub fn formats() -> impl Iterator<Item = Format> {
    FORMATS.iter().map(|(format, _)| *format)
}

fn encoder(format: Format) -> Encode {
    let mut known = FORMATS.iter().filter(|(known, _)| *known == format);
    known.next().expect("every format is in the list").1
}

/// The bytes of a file that holds the picture.
///
/// # Errors
/// When the format cannot hold the picture: a side of no pixels, or one too long for it.
pub fn encode(film: &Film, options: &EncodeOptions) -> Result<Vec<u8>, OutputError> {
    let format = options.format;
    let refuse = |reason| OutputError::Encode { format, reason };
    can_hold(film, format).map_err(refuse)?;
    encoder(format)(film, options).map_err(refuse)
}

/// Why a format cannot hold a picture at all, if it cannot.
fn can_hold(film: &Film, format: Format) -> Result<(), String> {
    if film.width == 0 || film.height == 0 {
        return Err("it has no pixels".to_owned());
    }
    if film.levels.is_some() && format.is_linear {
        return Err(quantize::OF_ANOTHER.to_owned());
    }
    Ok(())
}

/// Writes the picture. A file appears whole or not at all; one that was there stays as it was on any failure.
///
/// # Errors
/// When the format cannot hold the picture, or the system refuses to write.
pub fn write(film: &Film, target: &Target, options: &EncodeOptions) -> Result<(), OutputError> {
    let format = options.format;
    let (Target::File(path), Format::PNG) = (target, format) else {
        return put(&encode(film, options)?, target);
    };
    let written = can_hold(film, format).map_err(Refusal::ByFormat);
    let written =
        written.and_then(|()| place::replace_by(path, |file| png::write(film, options, file)));
    written.map_err(|refusal| match refusal {
        Refusal::ByFormat(reason) => OutputError::Encode { format, reason },
        Refusal::BySystem(source) => OutputError::Write {
            target: target.clone(),
            source,
        },
    })
}

/// Writes the bytes of a file, as [`write()`] does.
///
/// # Errors
/// When the system refuses to write.
pub fn put(bytes: &[u8], target: &Target) -> Result<(), OutputError> {
    let written = match target {
        Target::File(path) => place::replace(path, bytes),
        Target::Stdout => to_stdout(bytes),
    };
    written.map_err(|source| OutputError::Write {
        target: target.clone(),
        source,
    })
}

impl OutputError {
    /// True if there is no room for the file: the disk is full, or a limit is reached.
    #[must_use]
    pub fn lacks_room(&self) -> bool {
        use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
        matches!(self, OutputError::Write { source, .. }
            if matches!(source.kind(), FileTooLarge | QuotaExceeded | StorageFull))
    }

    /// Something to do about it.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        let OutputError::Write { target, source } = self else {
            return Some("another file type may hold it: `+FN` for PNG, `+FE` for EXR".to_owned());
        };
        let Target::File(path) = target else {
            return None;
        };
        let folder = place::folder_of(path);
        match source.kind() {
            io::ErrorKind::NotFound => Some(format!(
                "the folder `{}` does not exist: create it, or name another file with `+O`",
                folder.display()
            )),
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Some(format!(
                "the folder `{}` is not open to you for writing: name another file with `+O`",
                folder.display()
            )),
            io::ErrorKind::IsADirectory => {
                Some("a folder has this name: name another file with `+O`".to_owned())
            }
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                Some("make room, or name a file on another disk with `+O`".to_owned())
            }
            io::ErrorKind::FileTooLarge => {
                Some("files have a limit in size here, which `ulimit -f` shows".to_owned())
            }
            _ => None,
        }
    }
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OutputError::Encode { format, reason } => write!(
                f,
                "cannot make a {} file of this picture: {reason}",
                format.extension()
            ),
            OutputError::Write { target, source } => {
                write!(f, "cannot write {target}: {}", plain(source))
            }
        }
    }
}

impl std::error::Error for OutputError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            OutputError::Write { source, .. } => Some(source),
            OutputError::Encode { .. } => None,
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Target::File(path) => write!(f, "`{}`", Path::display(path)),
            Target::Stdout => f.write_str("to standard output"),
        }
    }
}

/// The system's words without the number of the error and without the name of the temporary file.
fn plain(error: &io::Error) -> String {
    let inner = error.get_ref().and_then(|wrapped| wrapped.source());
    if let Some(inner) = inner.and_then(|e| e.downcast_ref::<io::Error>()) {
        return plain(inner);
    }
    let text = error.to_string();
    let words = text.split(" (os error").next().unwrap_or_default();
    let mut chars = words.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(chars).collect()
    })
}

fn to_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

#[cfg(test)]
mod tests;
