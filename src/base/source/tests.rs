//! Tests of the source texts and of the file search.

use super::*;
use crate::base::file::MAX_FILE_BYTES;
use std::fs::{self, File};
use std::path::Path;

fn folder_with(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

#[test]
fn lines_and_columns_count_from_one_in_characters() {
    let mut sources = Sources::new(Vec::new());
    let file = sources.add_text("x", "ab\n\u{e9}c\r\nd\re");
    let position = |at| sources.line_column(Span::new(file, at, at));
    let positions: Vec<_> = (0..=10).map(position).collect();
    let line_2 = [(2, 1), (2, 1), (2, 2), (2, 3), (2, 4)];
    assert_eq!(positions[..3], [(1, 1), (1, 2), (1, 3)]);
    assert_eq!(positions[3..8], line_2);
    assert_eq!(positions[8..], [(3, 1), (3, 2), (4, 1)]);
    assert_eq!(sources.line_column(Span::new(file, 99, 99)), (4, 2));
}

#[test]
fn a_file_is_read_once() {
    let folder = folder_with(&[("a.pov", "x"), ("sub/b.inc", "y")]);
    let mut sources = Sources::new(Vec::new());
    let first = sources.load_file(folder.path().join("a.pov")).unwrap();
    let again = sources
        .load_file(folder.path().join("sub/../a.pov"))
        .unwrap();
    assert_eq!(first, again);
    sources.find_include("sub/b", first).unwrap();
    sources.find_include("sub/b.inc", first).unwrap();
    let read = [("a.pov", true), ("sub/b", false), ("sub/b.inc", true)];
    let read = read.map(|(name, is_there)| Dependency {
        path: folder.path().join(name),
        is_there,
    });
    assert_eq!(sources.dependencies(), read);
}

#[test]
fn a_large_file_is_read_whole() {
    // Several threads read it; the last chunk is shorter than the others.
    let line = |at: usize| format!("{at:>9} sphere\n");
    let text: String = (0..300_000).map(line).collect();
    assert!(text.len() > 4 << 20 && !text.len().is_multiple_of(1 << 20));
    let folder = folder_with(&[("a.pov", &text)]);
    let mut sources = Sources::new(Vec::new());
    let file = sources.load_file(folder.path().join("a.pov")).unwrap();
    assert!(**sources.text(file) == text);
}

#[test]
fn requested_files_are_dependencies_and_files_that_the_scene_wrote_are_not() {
    let folder = folder_with(&[("a.pov", "x"), ("data.txt", "1"), ("own.inc", "old")]);
    let path = |name: &str| folder.path().join(name);
    let name = |name: &str| path(name).display().to_string();
    let mut sources = Sources::new(Vec::new());
    let scene = sources.add_text("stdin", "");
    assert!(sources.has_data("data.txt", scene) == Path::new("data.txt").exists());
    assert!(!sources.has_data(&name("none"), scene));
    assert!(sources.has_data(&name("data.txt"), scene));
    assert!(sources.has_data(&name("data.txt"), scene));
    let old = sources.find_include(&name("own"), scene).unwrap();
    fs::write(path("own.inc"), "new").unwrap();
    sources.record_write(&path("own.inc"));
    let new = sources.find_include(&name("own"), scene).unwrap();
    assert_eq!(
        (sources.text(old).as_str(), sources.text(new).as_str()),
        ("old", "new")
    );
    fs::write(path("made.inc"), "").unwrap();
    sources.record_write(&path("made.inc"));
    sources.find_data(&name("made.inc"), scene).unwrap();
    assert!(sources.find_data(&name("made"), scene).is_err());
    let paths = sources.dependencies().iter();
    let seen: Vec<_> = paths.map(|one| (one.path.clone(), one.is_there)).collect();
    let expected = [
        ("none", false),
        ("data.txt", true),
        ("own", false),
        ("own.inc", true),
        ("made", false),
    ];
    assert_eq!(
        seen[1..],
        expected.map(|(name, is_there)| (path(name), is_there))
    );
}

#[test]
fn include_files_are_searched_near_first_then_in_the_library_in_order() {
    let scenes = folder_with(&[("a.pov", ""), ("near.inc", "scene"), ("dir.inc/x", "")]);
    let first = folder_with(&[("near.inc", "1"), ("lib.INC", "1"), ("dir.inc", "1")]);
    let second = folder_with(&[("lib.inc", "2"), ("far", "2"), ("far.inc", "wrong")]);
    let library = vec![first.path().to_owned(), second.path().to_owned()];
    let mut sources = Sources::new(library);
    let scene = sources.load_file(scenes.path().join("a.pov")).unwrap();
    let stdin = sources.add_text("stdin", "");
    let mut find = |name: &str, from: FileId| {
        let file = sources.find_include(name, from).unwrap();
        sources.text(file).to_string()
    };
    assert_eq!(find("near.inc", scene), "scene");
    assert_eq!(find("near", stdin), "1");
    assert_eq!(find("lib", scene), "1");
    assert_eq!(find("lib.inc", scene), "2");
    assert_eq!(find("far", scene), "2");
    assert_eq!(find("dir.inc", scene), "1", "a folder is no file");
    let absolute = second.path().join("lib").display().to_string();
    assert_eq!(find(&absolute, stdin), "2");
}

#[test]
fn each_version_has_its_library() {
    let old = folder_with(&[("colors.inc", "3.7"), ("old.inc", "3.7")]);
    let new = folder_with(&[("colors.inc", "3.8")]);
    let [old, new] = [&old, &new].map(|folder| folder.path().to_owned());
    let mut sources = Sources::new(vec![old.clone()]).with_paths_of_3_8(vec![new, old]);
    let scene = sources.add_text("stdin", "");
    let mut find = |is_for_3_8: bool, name: &str| {
        sources.search_paths_of_3_8(is_for_3_8);
        let file = sources.find_include(name, scene).unwrap();
        sources.text(file).to_string()
    };
    assert_eq!(find(false, "colors.inc"), "3.7");
    assert_eq!(find(true, "colors.inc"), "3.8");
    assert_eq!(find(true, "old.inc"), "3.7");
    assert_eq!(find(false, "colors.inc"), "3.7");
}

#[test]
fn a_missing_include_file_is_reported_with_folders_and_other_cases() {
    let scenes = folder_with(&[("a.pov", "")]);
    let library = folder_with(&[("Colors.inc", ""), ("sub/colors.INC", "")]);
    let mut sources = Sources::new(vec![library.path().to_owned()]);
    let scene = sources.load_file(scenes.path().join("a.pov")).unwrap();
    let error = sources.find_include("colors", scene).unwrap_err();
    let (near, far) = (scenes.path().display(), library.path().display());
    assert_eq!(
        error.message,
        format!("cannot find the include file `colors` in `{near}`, the current folder or `{far}`")
    );
    assert_eq!(
        error.hints,
        [format!(
            "`{far}/Colors.inc` differs only in case: write `Colors.inc`."
        )]
    );
    let error = sources.find_include("sub/Colors", scene).unwrap_err();
    assert_eq!(
        error.hints,
        [format!(
            "`{far}/sub/colors.INC` differs only in case: write `sub/colors.INC`."
        )]
    );
    let error = sources.find_include("sub\\colors", scene).unwrap_err();
    assert_eq!(error.hints, ["Write `/` between folders, not `\\`."]);
    let error = sources
        .find_include("/nowhere/colors.inc", scene)
        .unwrap_err();
    assert_eq!(
        error.message,
        "cannot find the include file `/nowhere/colors.inc`"
    );
}

#[test]
fn an_unreadable_file_is_reported() {
    let folder = folder_with(&[]);
    let mut sources = Sources::new(Vec::new());
    let error = sources
        .load_file(folder.path().join("none.pov"))
        .unwrap_err();
    assert!(
        error.message.starts_with("cannot read `"),
        "{}",
        error.message
    );
    assert!(sources.load_file(folder.path()).is_err());
}

#[test]
fn a_file_over_the_limit_is_refused() {
    let folder = folder_with(&[]);
    let path = folder.path().join("huge.pov");
    File::create(&path)
        .unwrap()
        .set_len(MAX_FILE_BYTES + 1)
        .unwrap();
    let error = Sources::new(Vec::new()).load_file(&path).unwrap_err();
    assert!(
        error
            .message
            .contains("is too large: a scene file may have 2 GiB")
    );
}
