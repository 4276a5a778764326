//! Every kind of access to files by every kind of file.

use crate::folder::{Ended, Sandbox};
use std::fs;
use std::os::unix::fs::symlink;

/// Reads the file `FILE`.
const READERS: [&str; 7] = [
    "#include \"FILE\"",
    "#fopen F \"FILE\" read #read(F, A)",
    "sphere { 0, 1 pigment { image_map { png \"FILE\" } } }",
    "height_field { tga \"FILE\" }",
    "text { ttf \"FILE\" \"a\", 1, 0 }",
    "sphere { 0, 1 hollow interior { media { density { density_file df3 \"FILE\" } } } }",
    "global_settings { photons { spacing 0.1 load_file \"FILE\" } }",
];

/// Writes to the file `FILE`.
const WRITERS: [&str; 3] = [
    "#fopen F \"FILE\" write #write(F, \"1\")",
    "#fopen F \"FILE\" append #write(F, \"1\")",
    "global_settings { photons { spacing 0.3 save_file \"FILE\" } }
sphere { 0, 1 pigment { rgbt 1 } interior { ior 1.5 } photons { target refraction on } }",
];

/// A word that no message and no picture may contain.
const SECRET: &str = "hunter2";

fn sandbox(scene: &str) -> Sandbox {
    let sandbox = Sandbox::with(scene);
    sandbox.pipe("here/pipe");
    fs::create_dir(sandbox.path("here/folder")).expect("folders can be made");
    sandbox.write("other/secret", SECRET);
    for (link, to) in [("out", "other/secret"), ("out_folder", "other")] {
        symlink(sandbox.path(to), sandbox.path("here").join(link)).expect("links can be made");
    }
    sandbox
}

/// Draws with some options; the scene must be rejected without a word of a file outside, and nothing may change.
fn refused(sandbox: &Sandbox, options: &str) -> Ended {
    let before = sandbox.files();
    let ended = sandbox.shell(&format!(
        "$POVR s.pov +W16 +H12 -D -A +WT2 -o s.png {options}"
    ));
    assert_eq!(ended.code, Some(1), "{options}: {}", ended.said);
    assert!(ended.said.contains("File 's.pov' line 3"), "{}", ended.said);
    assert!(!ended.said.contains(SECRET), "{}", ended.said);
    assert!(sandbox.files() == before, "{}", ended.said);
    ended
}

#[test]
fn no_reader_takes_what_is_no_file() {
    for reader in READERS {
        for file in ["pipe", "/dev/zero", "folder"] {
            for options in ["", "--sandbox"] {
                refused(&sandbox(&reader.replace("FILE", file)), options);
            }
        }
    }
}

#[test]
fn no_reader_leaves_the_sandbox() {
    for reader in READERS {
        for file in [
            "out",
            "out_folder/secret",
            "../other/secret",
            "OTHER/secret",
            "/proc/self/environ",
            "/etc/passwd",
        ] {
            let sandbox = sandbox("");
            let other = sandbox.path("other").display().to_string();
            let file = file.replace("OTHER", &other);
            let scene = reader.replace("FILE", &file);
            sandbox.write("here/s.pov", &format!("{}{scene}\n", crate::folder::REST));
            let ended = refused(&sandbox, "--sandbox");
            assert!(ended.said.contains("cannot find"), "{}", ended.said);
            let says = "This run lets scenes read only files in";
            assert!(ended.said.contains(says), "{}", ended.said);
        }
    }
}

#[test]
fn no_writer_leaves_its_folders() {
    for writer in WRITERS {
        for file in [
            "out",
            "out_folder/new",
            "../other/new",
            "folder/../../other/new",
            "../none/../other/new",
        ] {
            refused(&sandbox(&writer.replace("FILE", file)), "");
        }
        // Photons are saved after the picture, so these end in a warning only.
        for file in ["folder", "pipe", "none/new"] {
            let sandbox = sandbox(&writer.replace("FILE", file));
            let before = sandbox.files();
            let ended = sandbox.shell("$POVR s.pov +W16 +H12 -D -A +WT2 -F");
            assert!(!ended.said.is_empty());
            assert!(sandbox.files() == before, "{}", ended.said);
        }
        for file in ["new", "folder/new", "../tmp/new"] {
            for options in ["--sandbox", "--no-write"] {
                let ended = refused(&sandbox(&writer.replace("FILE", file)), options);
                let says = "This run lets scenes write no files";
                assert!(ended.said.contains(says), "{}", ended.said);
            }
            let sandbox = sandbox(&writer.replace("FILE", file));
            let ended = sandbox.shell(
                "$POVR s.pov +W16 +H12 -D -A +WT2 -o s.png --sandbox --allow-write . --allow-write ../tmp",
            );
            assert_eq!(ended.code, Some(0), "{}", ended.said);
            assert!(sandbox.path("here").join(file).is_file(), "{file}");
        }
    }
}
