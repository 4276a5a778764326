//! Output files of scenes: where they may be, when they are visible; and the dependencies of a reading.

use povr::base::file::Folders;
use povr::base::options::ReadOptions;
use povr::base::source::{Severity, Sources};
use povr::lang::{Reading, evaluate};
use std::fs;
use std::path::{Path, PathBuf};

/// Reads a scene that may write into `folder`; `@` in it stands for that folder.
fn read(scene: &str, folder: &Path) -> Reading {
    let mut sources = Sources::new(Vec::new());
    let text = scene.replace('@', &folder.display().to_string());
    let file = sources.add_text("scene.pov", text);
    let options = ReadOptions {
        writable: Folders::Only(vec![folder.to_owned()]),
        ..ReadOptions::default()
    };
    evaluate(file, &mut sources, &options)
}

fn first_error(reading: &Reading) -> &str {
    let mut findings = reading.findings.iter();
    let error = findings.find(|finding| finding.severity == Severity::Error);
    error.map_or("", |error| &error.message)
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary folders can be made")
}

fn names(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder is readable");
    entries.flatten().map(|entry| entry.path()).collect()
}

#[test]
fn a_file_is_whole_at_the_end_even_if_it_is_not_closed() {
    let folder = folder();
    let reading = read(
        "#fopen F \"@/a.txt\" write #write(F, 1, \" \", x)",
        folder.path(),
    );
    assert_eq!(first_error(&reading), "");
    let written = fs::read_to_string(folder.path().join("a.txt"));
    assert_eq!(written.expect("the file is there"), "1 <1,0,0> ");
    assert_eq!(names(folder.path()).len(), 1);
}

#[test]
fn a_failing_scene_leaves_old_files_unchanged() {
    let folder = folder();
    fs::write(folder.path().join("a.txt"), "old").expect("files can be written");
    let scene = "#fopen F \"@/a.txt\" write #write(F, \"new\") #error \"stop\"";
    assert!(read(scene, folder.path()).scene.is_none());
    let content = fs::read_to_string(folder.path().join("a.txt"));
    assert_eq!(content.expect("the file is there"), "old");
    assert_eq!(names(folder.path()).len(), 1);
}

#[test]
fn a_file_is_visible_once_the_scene_accesses_it() {
    let folder = folder();
    let scene = "#fopen F \"@/a.inc\" write #write(F, \"#declare A = 3;\")
        #include \"@/a.inc\"
        #write(F, \"#declare A = 4;\") #fclose F
        #declare Before = A;
        #include \"@/a.inc\"
        #debug concat(str(Before, 0, 0), str(A, 0, 0), str(file_exists(\"@/a.inc\"), 0, 0))";
    let reading = read(scene, folder.path());
    assert_eq!(first_error(&reading), "");
    assert_eq!(reading.messages, "341");
}

#[test]
fn nothing_is_written_outside_of_the_allowed_folders() {
    let (inner, outer) = (folder(), folder());
    let outside = outer.path().display().to_string();
    fs::create_dir(inner.path().join("sub")).expect("folders can be made");
    for name in [
        &format!("{outside}/a.txt"),
        &format!(
            "@/../{}/a.txt",
            outer.path().file_name().expect("it has a name").display()
        ),
        "@/sub/../../a.txt",
        "@",
        "@/..",
        "/dev/null",
    ] {
        for mode in ["write", "append"] {
            let reading = read(&format!("#fopen F \"{name}\" {mode}"), inner.path());
            assert!(!first_error(&reading).is_empty(), "{name}");
        }
    }
    assert!(names(outer.path()).is_empty());
    let reading = read("#fopen F \"@/sub/a.txt\" write", inner.path());
    assert_eq!(first_error(&reading), "");
    let none = read("#fopen F \"/tmp/povr-not-here/a.txt\" write", inner.path());
    assert!(first_error(&none).starts_with("this scene may not write to"));
}

#[cfg(unix)]
#[test]
fn links_do_not_escape_the_allowed_folders() {
    let (inner, outer) = (folder(), folder());
    let link = |from: &Path, name: &str| {
        std::os::unix::fs::symlink(from, inner.path().join(name)).expect("links can be made");
    };
    fs::write(outer.path().join("there.txt"), "old").expect("files can be written");
    link(&outer.path().join("there.txt"), "there");
    link(&outer.path().join("new.txt"), "new");
    link(outer.path(), "folder");
    for name in ["there", "new", "folder/a.txt"] {
        let scene = format!("#fopen F \"@/{name}\" write #write(F, \"bad\")");
        let reading = read(&scene, inner.path());
        assert!(
            first_error(&reading).starts_with("this scene may not write to"),
            "{name}"
        );
    }
    assert_eq!(names(outer.path()).len(), 1);
}

#[test]
fn too_many_open_files_are_refused() {
    let folder = folder();
    let many: String = (0..65)
        .map(|n| format!("#fopen F{n} \"@/{n}.txt\" write\n"))
        .collect();
    let reading = read(&many, folder.path());
    assert_eq!(
        first_error(&reading),
        "a scene has at most 64 files open at once"
    );
}

#[test]
fn dependencies_are_the_files_read_or_looked_for() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    for (name, text) in [
        ("a.inc", "#declare A = 1;"),
        ("d.txt", "1, 2"),
        ("e.txt", ""),
    ] {
        fs::write(path(name), text).expect("files can be written");
    }
    let scene = "#include \"@/a.inc\"
        #fopen F \"@/d.txt\" read #read(F, One, Two)
        #declare There = file_exists(\"@/e.txt\") + file_exists(\"@/none.txt\");
        #fopen G \"@/own.inc\" write #write(G, \"#declare B = 2;\") #fclose G
        #include \"@/own.inc\"
        #fopen G \"@/own.inc\" read";
    let reading = read(scene, folder.path());
    assert_eq!(first_error(&reading), "");
    let seen = reading.dependencies.iter();
    let seen: Vec<_> = seen.map(|one| (one.path.clone(), one.is_there)).collect();
    let expected = [
        ("a.inc", true),
        ("d.txt", true),
        ("e.txt", true),
        ("none.txt", false),
    ];
    assert_eq!(
        seen,
        expected.map(|(name, is_there)| (path(name), is_there))
    );
}
