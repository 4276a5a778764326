//! Stored pictures of POV-Ray, keyed by a hash of all inputs: only new and changed scenes are rendered again.

use super::error::CheckError;
use super::renderer::{Picture, Renderer};
use super::{Ended, tail};
use rustc_hash::FxHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A longer text between quotes is not a file name.
const LONGEST_NAME: usize = 200;

/// A stored picture of a renderer.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Its file.
    pub file: PathBuf,
    /// The run time in seconds, including start and end of the process.
    pub seconds: f64,
}

/// Renders a picture into a folder, or returns it from there if it was rendered before.
pub(super) fn drawn(
    renderer: &Renderer,
    picture: &Picture<'_>,
    text: &str,
    folder: &Path,
) -> Result<Reference, CheckError> {
    let mut hasher = FxHasher::default();
    (&renderer.version, &renderer.switches, picture.switches).hash(&mut hasher);
    picture.scene.hash(&mut hasher);
    let beside = picture.scene.parent().unwrap_or(Path::new("."));
    hash_with_includes(text, beside, &mut hasher);
    let key = format!("{:016x}", hasher.finish());
    let stored = folder.join(format!("{key}.png"));
    let seconds_file = folder.join(format!("{key}.seconds"));
    let seconds = fs::read_to_string(&seconds_file).ok();
    if let Some(seconds) = seconds.and_then(|text| text.trim().parse().ok())
        && stored.exists()
    {
        return Ok(Reference {
            file: stored,
            seconds,
        });
    }
    // In a temporary folder: the scene may write files, and another process may render the same picture.
    let own = tempfile::tempdir_in(folder).map_err(|error| CheckError::file(folder, &error))?;
    let file = own.path().join("picture.png");
    let took = draw(
        renderer,
        &Picture {
            file: &file,
            ..*picture
        },
    )?;
    fs::rename(&file, &stored).map_err(|error| CheckError::file(&stored, &error))?;
    let seconds = took.as_secs_f64();
    fs::write(&seconds_file, seconds.to_string())
        .map_err(|error| CheckError::file(&seconds_file, &error))?;
    Ok(Reference {
        file: stored,
        seconds,
    })
}

/// Renders; anything but a complete picture is an error.
pub(super) fn draw(renderer: &Renderer, picture: &Picture<'_>) -> Result<Duration, CheckError> {
    let name = Path::new(&renderer.program).file_name();
    let program = || name.unwrap_or_default().display().to_string();
    let Ended {
        status,
        stderr,
        took,
    } = renderer
        .draw(picture)
        .map_err(|error| CheckError::NotStarted(program(), error.to_string()))?;
    match status {
        None => Err(CheckError::OutOfTime(program(), picture.limit)),
        Some(status) if !status.success() => Err(CheckError::Refused {
            program: program(),
            status: status.to_string(),
            stderr,
        }),
        Some(_) if !picture.file.exists() => Err(CheckError::NoPicture(program(), tail(&stderr))),
        Some(_) => Ok(took),
    }
}

/// Hashes a scene and all files it may include from its own folder. Names in comments only cause a needless rendering.
fn hash_with_includes(text: &str, folder: &Path, hasher: &mut impl Hasher) {
    let mut texts = vec![text.to_owned()];
    let mut seen = Vec::new();
    while let Some(text) = texts.pop() {
        text.hash(hasher);
        for name in text.split('"').skip(1) {
            if name.len() >= LONGEST_NAME || name.is_empty() {
                continue;
            }
            let path = folder.join(name);
            if !seen.contains(&path) && path.is_file() {
                texts.extend(
                    fs::read(&path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()),
                );
                seen.push(path);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_include_of_an_include_changes_the_key() {
        let here = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(here.path().join(name), text).unwrap();
        let key = || {
            let mut hasher = FxHasher::default();
            hash_with_includes("#include \"a.inc\"", here.path(), &mut hasher);
            hasher.finish()
        };
        let without = key();
        write("a.inc", "#include \"b.inc\" // and \"a.inc\"");
        write("b.inc", "sphere");
        let with = key();
        write("b.inc", "box");
        let other = key();
        assert!(without != with && with != other && other == key());
    }
}
