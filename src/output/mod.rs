//! Image encoders, one module per format, and atomic file replacement.
//!
//! PNG, TGA, BMP, JPEG and PPM store encoded values (sRGB by default), EXR and HDR store linear light. The stored
//! values of each were compared with the files of POV-Ray 3.7.0.10, pixel by pixel. Known differences: greyscale PPM
//! files are valid P5 files here, POV-Ray's have twice the announced bytes and no gamma; BMP files with alpha have the
//! header that declares the alpha channel; no file contains a date.

mod atomic_file;
mod bmp;
mod exr;
mod hdr;
mod jpeg;
mod png;
mod ppm;
mod tga;

#[cfg(feature = "cli")]
pub(crate) use jpeg::POVRAY_QUALITY;

pub use crate::base::encoding::{
    DitherMethod, Effort, EncodeOptions, Format, FormatProperties, OptionsOf38,
};

use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::de::{Deserialize, Deserializer, Error};
use serde::{Serialize, Serializer};

use crate::base::file::folder_of;
use crate::base::film::{Film, quantize};

/// The destination of an encoded picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// A file, replaced atomically.
    File(PathBuf),
    /// Standard output.
    Stdout,
}

/// Failure to write a picture.
#[derive(Debug)]
pub enum OutputError {
    /// The format cannot store this picture.
    Encode {
        /// The format.
        format: Format,
        /// The reason, for the message.
        reason: String,
    },
    /// The operating system reported an error.
    Write {
        /// The destination.
        target: Target,
        /// The system's error.
        source: io::Error,
    },
}

type EncodeResult = Result<Vec<u8>, String>;

/// The cause of an [`OutputError`], without its context.
enum WriteError {
    /// The format cannot store the picture.
    Format(String),
    System(io::Error),
}

impl From<io::Error> for WriteError {
    fn from(error: io::Error) -> Self {
        WriteError::System(error)
    }
}

type Encode = fn(&Film, &EncodeOptions) -> EncodeResult;

/// All formats with their encoders. Of two formats with the same extension, the extension selects the first.
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

/// A format is its name.
impl Serialize for Format {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl<'de> Deserialize<'de> for Format {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let format = formats().find(|format| format.name == name);
        format.ok_or_else(|| D::Error::custom("no such picture format"))
    }
}

fn encoder(format: Format) -> Encode {
    let mut matches = FORMATS.iter().filter(|(known, _)| *known == format);
    matches.next().expect("every format is in the list").1
}

/// Encodes a picture to the bytes of a file.
///
/// # Errors
/// The format cannot store the picture: a side has no pixels or exceeds the format's limit.
pub fn encode(film: &Film, options: &EncodeOptions) -> Result<Vec<u8>, OutputError> {
    let format = options.format;
    let error = |reason| OutputError::Encode { format, reason };
    check_film(film, format).map_err(error)?;
    encoder(format)(film, options).map_err(error)
}

/// Checks before a picture of this size is rendered that it can be written. Nothing is opened or written.
///
/// # Errors
/// As for [`write()`], as far as the reasons are known.
pub fn check(target: &Target, size: (u32, u32), format: Format) -> Result<(), OutputError> {
    check_size(size, format).map_err(|reason| OutputError::Encode { format, reason })?;
    let Target::File(path) = target else {
        return Ok(());
    };
    atomic_file::check(path).map_err(|source| OutputError::Write {
        target: target.clone(),
        source,
    })
}

/// Checks the requirements that are independent of the encoder. The error is the reason.
fn check_film(film: &Film, format: Format) -> Result<(), String> {
    check_size((film.width, film.height), format)?;
    if film.levels.is_some() && format.is_linear {
        return Err(quantize::WRONG_FILE_KIND.to_owned());
    }
    Ok(())
}

fn check_size((width, height): (u32, u32), format: Format) -> Result<(), String> {
    if width == 0 || height == 0 {
        return Err("it has no pixels".to_owned());
    }
    let longest = format.max_side;
    if width.max(height) > longest {
        return Err(format!("a side is longer than {longest} pixels"));
    }
    Ok(())
}

/// Writes a picture. Files are replaced atomically; on failure an existing file stays unchanged.
///
/// # Errors
/// The format cannot store the picture, or the operating system reports an error.
pub fn write(film: &Film, target: &Target, options: &EncodeOptions) -> Result<(), OutputError> {
    let format = options.format;
    let (Target::File(path), Format::PNG) = (target, format) else {
        return put(&encode(film, options)?, target);
    };
    let result = check_film(film, format).map_err(WriteError::Format);
    let result =
        result.and_then(|()| atomic_file::replace_by(path, |file| png::write(film, options, file)));
    result.map_err(|error| match error {
        WriteError::Format(reason) => OutputError::Encode { format, reason },
        WriteError::System(source) => OutputError::Write {
            target: target.clone(),
            source,
        },
    })
}

/// Writes encoded bytes, as [`write()`] does.
///
/// # Errors
/// The operating system reports an error.
pub fn put(bytes: &[u8], target: &Target) -> Result<(), OutputError> {
    let result = match target {
        Target::File(path) => atomic_file::replace(path, bytes),
        Target::Stdout => write_stdout(bytes),
    };
    result.map_err(|source| OutputError::Write {
        target: target.clone(),
        source,
    })
}

impl OutputError {
    /// True if there is no space for the file: the disk is full, or a quota or size limit is reached.
    #[must_use]
    pub fn is_out_of_space(&self) -> bool {
        use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
        matches!(self, OutputError::Write { source, .. }
            if matches!(source.kind(), FileTooLarge | QuotaExceeded | StorageFull))
    }

    /// Advice on how to resolve the error.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        let OutputError::Write { target, source } = self else {
            return Some("Another file type may hold it: `+FN` for PNG, `+FE` for EXR.".to_owned());
        };
        let Target::File(path) = target else {
            return None;
        };
        let folder = folder_of(path);
        match source.kind() {
            io::ErrorKind::NotFound => Some(format!(
                "The folder `{}` does not exist: create it, or name another file with `+O`.",
                folder.display()
            )),
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Some(format!(
                "The folder `{}` is not open to you for writing: name another file with `+O`.",
                folder.display()
            )),
            io::ErrorKind::NotADirectory => {
                Some("A part of this path is a file: name a file in a folder with `+O`.".to_owned())
            }
            io::ErrorKind::IsADirectory => {
                Some("A folder has this name: name another file with `+O`.".to_owned())
            }
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                Some("Make room, or name a file on another disk with `+O`.".to_owned())
            }
            io::ErrorKind::FileTooLarge => {
                Some("Files have a limit in size here, which `ulimit -f` shows.".to_owned())
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
                write!(f, "cannot write {target}: {}", system_message(source))
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

/// The system's message without the error number and without the name of the temporary file.
fn system_message(error: &io::Error) -> String {
    let inner = error.get_ref().and_then(|wrapped| wrapped.source());
    if let Some(inner) = inner.and_then(|e| e.downcast_ref::<io::Error>()) {
        return system_message(inner);
    }
    let text = error.to_string();
    let message = text.split(" (os error").next().unwrap_or_default();
    let mut chars = message.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(chars).collect()
    })
}

fn write_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

#[cfg(test)]
mod tests;
