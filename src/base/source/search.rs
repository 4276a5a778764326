//! Search for the files that a scene names, and the error for a missing one.

use super::{Code, Diagnostic, FileId, Sources};
use crate::base::file::Folders;
use crate::base::nearest::nearest;
use std::fs;
use std::path::{Path, PathBuf};

/// Endings that POV-Ray tries for the name of an include file, in this order.
pub(super) const INCLUDES: [&str; 3] = ["", ".inc", ".INC"];

/// An include file that POV-Ray 3.8 has and 3.7 lacks.
const INCLUDE_OF_3_8: &str = "colors_ral.inc";

/// Folders with more entries are not fully searched for a similar name.
const MAX_ENTRIES: usize = 10_000;

/// Candidate paths of a file, in search order.
pub(super) fn candidates(
    name: &str,
    folders: &[PathBuf],
    endings: &[&str],
) -> impl Iterator<Item = PathBuf> {
    folders.iter().flat_map(move |folder| {
        let named = move |ending: &&str| folder.join(format!("{name}{ending}"));
        endings.iter().map(named)
    })
}

/// The start of a comment that switches lints off.
const ALLOW: &str = "// povr: allow ";

/// True if a comment in the text of a scene switches a lint off.
pub(crate) fn allows_lint(text: &str, name: &str) -> bool {
    let comments = text
        .match_indices(ALLOW)
        .map(|(at, _)| &text[at + ALLOW.len()..]);
    let mut names = comments.flat_map(|rest| {
        let line = rest.lines().next().unwrap_or_default();
        line.split([' ', ',']).map(str::trim)
    });
    names.any(|one| one == name)
}

impl Sources {
    /// True if a finding is a lint that is switched off: by one of these names, or by a comment in the scene.
    pub(crate) fn allows(&self, scene: FileId, finding: &Diagnostic, allowed: &[String]) -> bool {
        let Some(name) = finding.code.and_then(Code::lint_name) else {
            return false;
        };
        allowed.iter().any(|one| one == name) || allows_lint(self.text(scene), name)
    }

    /// The error for a missing file; `what` is "the include file" or the like.
    pub(super) fn not_found(&self, what: &str, name: &str, folders: &[PathBuf]) -> Diagnostic {
        let searched = if Path::new(name).is_absolute() {
            String::new()
        } else {
            let names: Vec<String> = folders.iter().map(|folder| folder_name(folder)).collect();
            format!(" in {}", one_of(&names))
        };
        let message = format!("cannot find {what} `{name}`{searched}");
        let mut error = Diagnostic::error(None, message).with_code(Code::MissingFile);
        for (path, written) in self.other_cases(name, folders) {
            error = error.with_hint(format!(
                "`{}` differs only in case: write `{written}`.",
                path.display()
            ));
        }
        if let Some(folder) = folders
            .iter()
            .map(|folder| folder.join(name))
            .find(|path| path.is_dir())
        {
            error = error.with_hint(format!(
                "`{}` is a folder: name a file in it.",
                folder.display()
            ));
        }
        if name.contains('\\') {
            error = error.with_hint("Write `/` between folders, not `\\`.");
        }
        if name == INCLUDE_OF_3_8 {
            error = error.with_hint(
                "This file comes with POV-Ray 3.8: name the folder of its include files with `+L`.",
            );
        }
        if error.hints.is_empty()
            && let Some(near) = self.nearest_file(name, folders)
        {
            error = error.with_hint(format!("Did you mean `{near}`?"));
        }
        if error.hints.is_empty() && !Path::new(name).is_absolute() {
            error = error
                .with_hint("Put the file into one of these folders, or name its folder with `+L`.");
        }
        if let Folders::Only(readable) = &self.limits.folders {
            let names: Vec<String> = readable.iter().map(|folder| folder_name(folder)).collect();
            error = error.with_hint(match names.as_slice() {
                [] => "This run lets scenes read no files.".to_owned(),
                names => format!("This run lets scenes read only files in {}.", one_of(names)),
            });
        }
        error
    }

    /// Files in the searched folders whose names differ from `name` only in case, each with the name to write instead.
    fn other_cases(&self, name: &str, folders: &[PathBuf]) -> Vec<(PathBuf, String)> {
        let (inner, last) = in_folder(name);
        let wanted = INCLUDES.map(|extension| format!("{last}{extension}").to_lowercase());
        let mut cases = Vec::new();
        for folder in folders {
            let folder = folder.join(inner);
            let mut names: Vec<String> = entries(&folder)
                .filter(|name| wanted.contains(&name.to_lowercase()))
                .filter(|name| !folder.join(name).is_dir())
                .collect();
            names.sort();
            cases.extend(
                names
                    .into_iter()
                    .filter(|name| self.limits.folders.hold(&folder.join(name)))
                    .map(|name| (folder.join(&name), format!("{inner}{name}"))),
            );
        }
        cases.dedup();
        cases
    }

    /// The file in the searched folders whose name is nearest to a missing one. The extension is the same, that of
    /// include files where `name` has none, or all that differs.
    fn nearest_file(&self, name: &str, folders: &[PathBuf]) -> Option<String> {
        let (inner, last) = in_folder(name);
        let (stem, extension) = last.rsplit_once('.').unwrap_or((last, "inc"));
        let mut other_type = None;
        let mut similar = Vec::new();
        for folder in folders {
            let folder = folder.join(inner);
            for name in entries(&folder) {
                let Some((its_stem, its_extension)) = name.rsplit_once('.') else {
                    continue;
                };
                let is_same_type = its_extension.eq_ignore_ascii_case(extension);
                if !is_same_type && its_stem != stem
                    || !self.limits.folders.hold(&folder.join(&name))
                {
                    continue;
                }
                if is_same_type {
                    similar.push((its_stem.to_owned(), name));
                } else {
                    other_type = other_type.max(Some(name));
                }
            }
        }
        let near = nearest(stem, similar.iter().map(|(stem, _)| stem.as_str()));
        let near = near.and_then(|near| similar.iter().find(|(stem, _)| stem == near));
        let near = near.map(|(_, name)| name.clone()).or(other_type)?;
        Some(format!("{inner}{near}"))
    }
}

/// The folder of a name, with its `/`, and the rest.
fn in_folder(name: &str) -> (&str, &str) {
    name.split_at(name.rfind('/').map_or(0, |slash| slash + 1))
}

/// The names in a folder, of at most [`MAX_ENTRIES`]; an empty path is the current folder.
fn entries(folder: &Path) -> impl Iterator<Item = String> {
    let listed = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let entries = fs::read_dir(listed).into_iter().flatten().flatten();
    entries
        .take(MAX_ENTRIES)
        .filter_map(|entry| entry.file_name().into_string().ok())
}

fn folder_name(folder: &Path) -> String {
    if folder.as_os_str().is_empty() {
        "the current folder".to_owned()
    } else {
        format!("`{}`", folder.display())
    }
}

/// `a`, `a or b`, `a, b or c`.
fn one_of(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}
