//! Finds the scenes in a folder and its subfolders.

use std::fs;
use std::path::{Path, PathBuf};

use fast_glob::glob_match;

use super::BatchError;

/// Maximum depth of subfolders.
const DEEPEST: usize = 64;

/// Glob patterns that select files below a folder.
#[derive(Clone, Debug, Default)]
pub struct Globs {
    /// Only these, if there are any.
    only: Option<Patterns>,
    except: Patterns,
}

impl Globs {
    /// Selects files with paths below their folder that match one of `only`, or all if it is empty, but none of
    /// `except`. `*` stops at a `/`, `**` does not. A pattern without `/` matches the name of a file, or a folder with
    /// everything in it.
    ///
    /// # Errors
    /// When a pattern is malformed.
    pub fn new(only: &[String], except: &[String]) -> Result<Self, BatchError> {
        Ok(Globs {
            only: (!only.is_empty())
                .then(|| Patterns::new(only))
                .transpose()?,
            except: Patterns::new(except)?,
        })
    }

    /// True if a file is selected, by its path below its folder.
    #[must_use]
    pub fn has(&self, path: &Path) -> bool {
        let is_in = |patterns: &Patterns| {
            path.ancestors().any(|part| {
                let name = part.file_name().map(Path::new);
                patterns.match_any(part) || name.is_some_and(|name| patterns.match_any(name))
            })
        };
        self.only.as_ref().is_none_or(is_in) && !is_in(&self.except)
    }
}

/// Patterns that one path is matched against.
#[derive(Clone, Debug, Default)]
struct Patterns(Vec<String>);

impl Patterns {
    fn new(patterns: &[String]) -> Result<Self, BatchError> {
        let checked = patterns.iter().map(|pattern| {
            let text = pattern.strip_prefix("./").unwrap_or(pattern);
            let text = text.trim_end_matches('/');
            // A `!` before the pattern would negate it.
            let escape = if text.starts_with('!') { "\\" } else { "" };
            let glob = format!("{escape}{text}");
            match fast_glob::validate(&glob) {
                Ok(()) => Ok(glob),
                Err(error) => Err(BatchError::new(format!(
                    "`{pattern}` is not a pattern: {error}"
                ))),
            }
        });
        Ok(Patterns(checked.collect::<Result<_, _>>()?))
    }

    fn match_any(&self, path: &Path) -> bool {
        let path = path.as_os_str().as_encoded_bytes();
        self.0.iter().any(|glob| glob_match(glob, path))
    }
}

/// The files with the ending `.pov` in a folder and the folders inside it, sorted. Folders whose names begin with a dot
/// are not searched.
///
/// # Errors
/// When a folder cannot be read.
pub fn scenes_below(folder: &Path) -> Result<Vec<PathBuf>, BatchError> {
    let mut scenes = Vec::new();
    search(folder, DEEPEST, &mut scenes)?;
    Ok(scenes)
}

fn search(folder: &Path, depth: usize, to: &mut Vec<PathBuf>) -> Result<(), BatchError> {
    let cannot_read = |error| BatchError::of_file("read", folder, &error);
    let mut entries: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder).map_err(cannot_read)? {
        entries.push(entry.map_err(cannot_read)?.path());
    }
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        // A link to a folder may lead back to a parent.
        if path.is_dir() && !path.is_symlink() && depth > 0 && !name.starts_with('.') {
            search(&path, depth - 1, to)?;
        } else if name.to_ascii_lowercase().ends_with(".pov") && path.is_file() {
            to.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_about_names_or_paths() {
        for (only, except, path, expected) in [
            ("", "", "a/b.pov", true),
            ("b*.pov", "", "a/b.pov", true),
            ("a/*.pov", "", "a/b.pov", true),
            ("*/c.pov", "", "a/b/c.pov", false),
            ("**/c.pov", "", "a/b/c.pov", true),
            ("./a", "", "a/b/c.pov", true),
            ("", "old/", "a/old/c.pov", false),
            ("", "a/old", "b/old/c.pov", true),
            ("", "*_test.pov", "a/x_test.pov", false),
            ("a/**", "**/b*", "a/b.pov", false),
            ("{a,c}/[b-d]?.pov", "", "a/b1.pov", true),
            ("!b.pov", "", "a/b.pov", false),
            ("!b.pov", "", "a/!b.pov", true),
        ] {
            let list = |text: &str| match text {
                "" => Vec::new(),
                text => vec![text.to_owned()],
            };
            let globs = Globs::new(&list(only), &list(except)).unwrap();
            assert_eq!(
                globs.has(Path::new(path)),
                expected,
                "{only} {except} {path}"
            );
        }
        assert!(Globs::new(&["[".to_owned()], &[]).is_err());
    }
}
