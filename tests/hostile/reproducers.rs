//! Attacks that succeeded once.

use crate::folder::Sandbox;
use std::fs;
use std::path::Path;

/// Pictures of attacks.
const CASES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/hostile/cases");

const VIEW: &str = "camera { location <0, 1.5, -4> look_at 0 } light_source { <1, 5, -2> rgb 1 }\n";

/// Runs the scene with little memory and returns what it said; the exit code must be `code`.
fn drawn(scene: &str, code: i32) -> String {
    let sandbox = Sandbox::new();
    sandbox.write("here/s.pov", scene);
    for entry in fs::read_dir(Path::new(CASES)).expect("the folder is readable") {
        let path = entry.expect("the folder is readable").path();
        let name = path.file_name().expect("it is a file").to_owned();
        fs::copy(&path, sandbox.path("here").join(name)).expect("files can be copied");
    }
    sandbox.pipe("here/ff");
    let draw =
        "ulimit -v 3500000; exec $POVR s.pov +W32 +H24 -D -A +WT2 --max-memory 500M -o s.png";
    let ended = sandbox.shell(draw);
    assert_eq!(ended.code, Some(code), "{scene}: {}", ended.said);
    assert_eq!(sandbox.path("here/s.png").is_file(), code == 0, "{scene}");
    ended.said
}

#[test]
fn valid_scenes_that_broke_the_program_are_drawn() {
    let surface = "function { u } function { sin(v) } function { cos(v) }";
    for scene in [
        "height_field { bmp \"bmp_1bit.bmp\" }",
        "height_field { bmp \"valid_4bit.bmp\" }",
        &format!(
            "{VIEW}parametric {{ {surface} <0, 0>, <1, 2*pi> contained_by {{ sphere {{ 0, 1.6 }} }} accuracy 2 }}"
        ),
        &format!(
            "{VIEW}parametric {{ {surface} <0, 0>, <0.0009, 2*pi> contained_by {{ sphere {{ 0, 1.6 }} }} }}"
        ),
        &format!(
            "{VIEW}parametric {{ {surface} <1, -1>, <1, 1> contained_by {{ sphere {{ 0, 1.6 }} }} }}"
        ),
        "#local I = 0; #while (I < 200000) #local A = seed(1); #local I = I + 1; #end sphere { 0, 1 }",
    ] {
        drawn(scene, 0);
    }
}

#[test]
fn scenes_that_took_memory_or_time_without_limit_are_refused() {
    for (scene, says) in [
        (
            "sphere { 0, 1 pigment { image_map { exr \"exr_16000.exr\" } } }",
            "its 313 bytes are too few for 16000 by 16000 pixels",
        ),
        (
            "sphere { 0, 1 pigment { image_map { bmp \"rle_16384.bmp\" } } }",
            "its 1080 bytes are too few for 16384 by 16384 pixels",
        ),
        (
            "#while (rand(seed(1)) < 0.999) #end",
            "this loop never ends",
        ),
        ("#include \"ff\"", "`ff` is not a regular file but a pipe"),
        (
            "global_settings { photons { spacing 0.1 save_file \"../other/map\" } }",
            "this scene may not write to `../other/map`",
        ),
    ] {
        let said = drawn(scene, 1);
        assert!(said.contains(says), "not `{says}`, but {said}");
    }
}

#[test]
fn a_file_larger_than_the_memory_is_refused() {
    for scene in [
        "#include \"big\"",
        "#fopen F \"big\" read",
        "text { ttf \"big\" \"a\", 1, 0 }",
        "sphere { 0, 1 pigment { image_map { png \"big\" } } }",
    ] {
        let sandbox = Sandbox::with(scene);
        let big = fs::File::create(sandbox.path("here/big")).expect("files can be made");
        big.set_len(2000 << 20).expect("files may be sparse");
        let ended = sandbox.shell("ulimit -v 1500000; exec $POVR s.pov -F -D");
        assert_eq!(ended.code, Some(1), "{}", ended.said);
        let says = "File 's.pov' line 3: Parse Error: cannot read `big`: it is too large";
        assert!(ended.said.contains(says), "{}", ended.said);
    }
}
