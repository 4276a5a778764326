//! POV-Ray's pictures, kept under a hash of all that goes into them: only new and changed scenes cost its time again.

use super::check::CheckError;
use super::renderer::{Picture, Renderer};
use super::{Ended, tail};
use rustc_hash::FxHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A longer text between quotes is no name of a file.
const LONGEST_NAME: usize = 200;

/// A picture that a renderer has drawn once.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Its file.
    pub file: PathBuf,
    /// The seconds that it took, start and end of the process included.
    pub seconds: f64,
}

/// Draws a picture into a folder, or takes it from there if it was drawn before.
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
    let kept = folder.join(format!("{key}.png"));
    let told = folder.join(format!("{key}.seconds"));
    let seconds = fs::read_to_string(&told).ok();
    if let Some(seconds) = seconds.and_then(|text| text.trim().parse().ok())
        && kept.exists()
    {
        return Ok(Reference {
            file: kept,
            seconds,
        });
    }
    // In a folder of its own: the scene may write files, and another process may draw the same.
    let own = tempfile::tempdir_in(folder).map_err(|error| CheckError::file(folder, &error))?;
    let file = own.path().join("picture.png");
    let took = draw(
        renderer,
        &Picture {
            file: &file,
            ..*picture
        },
    )?;
    fs::rename(&file, &kept).map_err(|error| CheckError::file(&kept, &error))?;
    let seconds = took.as_secs_f64();
    fs::write(&told, seconds.to_string()).map_err(|error| CheckError::file(&told, &error))?;
    Ok(Reference {
        file: kept,
        seconds,
    })
}

/// Draws, and is content with nothing less than a picture.
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
            said: stderr,
        }),
        Some(_) if !picture.file.exists() => Err(CheckError::NoPicture(program(), tail(&stderr))),
        Some(_) => Ok(took),
    }
}

/// Takes in a scene and all files it may include from its own folder. Names in comments only cost a needless drawing.
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
