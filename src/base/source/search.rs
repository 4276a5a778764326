//! The search for the files that a scene names, and what is said when there is none.

use super::Diagnostic;
use std::fs;
use std::path::{Path, PathBuf};

/// What POV-Ray appends to the name of an include file that it does not find.
pub(super) const INCLUDES: [&str; 3] = ["", ".inc", ".INC"];

/// Where a file is looked for, in this order.
pub(super) fn places(
    name: &str,
    folders: &[PathBuf],
    endings: &[&str],
) -> impl Iterator<Item = PathBuf> {
    folders.iter().flat_map(move |folder| {
        let named = move |ending: &&str| folder.join(format!("{name}{ending}"));
        endings.iter().map(named)
    })
}

/// What to say about a file that is nowhere; `what` is "the include file" or the like.
pub(super) fn not_found(what: &str, name: &str, folders: &[PathBuf]) -> Diagnostic {
    let places = if Path::new(name).is_absolute() {
        String::new()
    } else {
        let places: Vec<String> = folders.iter().map(|folder| place(folder)).collect();
        format!(" in {}", one_of(&places))
    };
    let mut error = Diagnostic::error(None, format!("cannot find {what} `{name}`{places}"));
    for (found, written) in other_cases(name, folders) {
        error = error.with_hint(format!(
            "`{}` differs only in case: write `{written}`.",
            found.display()
        ));
    }
    if name.contains('\\') {
        error = error.with_hint("Write `/` between folders, not `\\`.");
    }
    if error.hints.is_empty() && !Path::new(name).is_absolute() {
        error = error
            .with_hint("Put the file into one of these folders, or name its folder with `+L`.");
    }
    error
}

fn place(folder: &Path) -> String {
    if folder.as_os_str().is_empty() {
        "the current folder".to_owned()
    } else {
        format!("`{}`", folder.display())
    }
}

/// `a`, `a or b`, `a, b or c`.
fn one_of(places: &[String]) -> String {
    match places {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// Files in the folders searched whose names differ from `name` only in case, each with how to write it.
fn other_cases(name: &str, folders: &[PathBuf]) -> Vec<(PathBuf, String)> {
    let (inner, last) = match name.rfind('/') {
        Some(slash) => name.split_at(slash + 1),
        None => ("", name),
    };
    let wanted = INCLUDES.map(|extension| format!("{last}{extension}").to_lowercase());
    let mut found = Vec::new();
    for folder in folders {
        let folder = folder.join(inner);
        let listed = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            &folder
        };
        let entries = fs::read_dir(listed).into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let mut names: Vec<String> = names
            .filter(|name| wanted.contains(&name.to_lowercase()))
            .collect();
        names.sort();
        found.extend(
            names
                .into_iter()
                .map(|name| (folder.join(&name), format!("{inner}{name}"))),
        );
    }
    found.dedup();
    found
}
