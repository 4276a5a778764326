//! `povr check` and the formats of messages, as a user of the program sees them.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

const RIGHT: &str = "camera { location -5*z look_at 0 }\nlight_source { -9*z, rgb 1 }\nsphere { 0, 1 pigment { rgb 1 } }\n";
const FAULTY: &str = "sphere { 0, 1 pigmnet { rgb 1 } }\nbox { -1, 1 rotaet y }\n";

/// The two output streams of the program, and its exit code.
struct Ended {
    out: String,
    err: String,
    code: Option<i32>,
}

/// A loop without end.
const ENDLESS: &str = "#declare I = 0; #while (I >= 0) #declare I = I + 1; #end\n";

/// A folder with a correct and a faulty scene, one in a subfolder, and one that needs a library.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["inner", "library"] {
        fs::create_dir(folder.path().join(name)).expect("a folder in it");
    }
    for (name, text) in [
        ("right.pov", RIGHT),
        ("faulty.pov", FAULTY),
        (
            "inner/doubtful.pov",
            "#debug \"here\\n\"\n#warning \"old\"\n#include \"../right.pov\"\n",
        ),
        ("inner/part.inc", "}"),
        (
            "library/ball.inc",
            "#declare Ball = sphere { 0, Size pigment { rgb 1 } }\n",
        ),
        (
            "needy.txt",
            "#include \"ball.inc\"\ncamera { location -5*z }\nobject { Ball }\n",
        ),
        ("x.ini", "Input_File_Name=right.pov\n"),
    ] {
        fs::write(folder.path().join(name), text).expect("a file in it");
    }
    folder
}

fn povr(folder: &Path, arguments: &[&str], input: &str) -> Ended {
    let mut child = Command::new(env!("CARGO_BIN_EXE_povr"))
        .args(arguments)
        .current_dir(folder)
        .env("HOME", folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // A program that does not read its input may have ended already.
    let _ = child
        .stdin
        .take()
        .expect("a pipe")
        .write_all(input.as_bytes());
    let output = child.wait_with_output().expect("the program ends");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Ended {
        out: text(&output.stdout),
        err: text(&output.stderr),
        code: output.status.code(),
    }
}

#[test]
fn a_correct_scene_is_reported_and_leaves_no_picture() {
    let folder = folder();
    let ended = povr(folder.path(), &["check", "right.pov"], "");
    assert_eq!(
        (ended.out.as_str(), ended.code),
        ("right.pov: ok\n", Some(0))
    );
    assert_eq!(ended.err, "");
    assert!(!folder.path().join("right.png").exists());
}

#[test]
fn a_faulty_scene_is_shown_with_all_its_errors() {
    let folder = folder();
    let ended = povr(folder.path(), &["check", "faulty.pov"], "");
    assert_eq!(ended.code, Some(1));
    assert_eq!(
        ended.out,
        "\
error: expected a modifier (texture, pigment, finish, transform, ...) or `}` in `sphere`, found the undeclared identifier `pigmnet`
 --> faulty.pov:1:15
  |
1 | sphere { 0, 1 pigmnet { rgb 1 } }
  | --------      ^^^^^^^
  | |
  | in this `sphere`
  |
help: Did you mean `pigment`?
  |
1 - sphere { 0, 1 pigmnet { rgb 1 } }
1 + sphere { 0, 1 pigment { rgb 1 } }
  |

error: expected a modifier (texture, pigment, finish, transform, ...) or `}` in `box`, found the undeclared identifier `rotaet`
 --> faulty.pov:2:13
  |
2 | box { -1, 1 rotaet y }
  | -----       ^^^^^^
  | |
  | in this `box`
  |
help: Did you mean `rotate`?
  |
2 - box { -1, 1 rotaet y }
2 + box { -1, 1 rotate y }
  |

faulty.pov: 2 errors
"
    );
}

#[test]
fn a_mistake_is_reported_once_and_no_more_than_twenty_are() {
    let folder = folder();
    let again = format!("#for (I, 1, 30) #declare A = I #end\n{RIGHT}sphere {{ Size, 1 }}\n");
    let ended = povr(
        folder.path(),
        &["check", "-", "--message-format=short"],
        &again,
    );
    let lines: Vec<&str> = ended.out.lines().collect();
    assert_eq!(lines.len(), 3, "{}", ended.out);
    assert!(lines[0].contains("must end with `;`") && lines[1].contains("`Size`"));
    let many: String = (0..30).map(|n| format!("#declare A{n} = {n}\n")).collect();
    let ended = povr(
        folder.path(),
        &["check", "-", "--message-format=short"],
        &many,
    );
    let lines: Vec<&str> = ended.out.lines().collect();
    let says = [
        "warning: nothing is read after 20 errors",
        "standard input: 20 errors, 1 warning",
    ];
    assert_eq!(lines[20..], says, "{}", ended.out);
}

#[test]
fn folders_are_searched_and_all_scenes_are_counted() {
    let folder = folder();
    let ended = povr(folder.path(), &["check", "--message-format=short", "."], "");
    assert_eq!(ended.code, Some(1));
    let lines: Vec<&str> = ended.out.lines().collect();
    assert_eq!(lines.len(), 7, "{}", ended.out);
    assert!(lines[0].starts_with("./faulty.pov:1:15: error: "));
    assert!(
        lines[0].ends_with("(Did you mean `pigment`?)"),
        "{}",
        lines[0]
    );
    assert!(lines[1].starts_with("./faulty.pov:2:13: error: "));
    assert_eq!(
        lines[2..],
        [
            "./faulty.pov: 2 errors",
            "./inner/doubtful.pov:2:1: warning: old",
            "./inner/doubtful.pov: 1 warning",
            "./right.pov: ok",
            "3 scenes: 2 right, 1 faulty; 2 errors, 1 warning",
        ]
    );
    assert_eq!(ended.err, "here\n", "what a scene says is no finding");
}

#[test]
fn quiet_leaves_errors_alone() {
    let folder = folder();
    let ended = povr(
        folder.path(),
        &["check", "--quiet", "inner", "right.pov"],
        "",
    );
    assert_eq!((ended.out.as_str(), ended.err.as_str()), ("", ""));
    assert_eq!(ended.code, Some(0));
}

#[test]
fn json_is_an_object_a_line() {
    let folder = folder();
    let arguments = ["check", "--message-format", "json", "inner", "faulty.pov"];
    let ended = povr(folder.path(), &arguments, "");
    assert_eq!((ended.err.as_str(), ended.code), ("", Some(1)));
    let lines: Vec<serde_json::Value> = ended
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("an object"))
        .collect();
    let types: Vec<&str> = lines
        .iter()
        .filter_map(|line| line["type"].as_str())
        .collect();
    assert_eq!(
        types,
        [
            "scene_output",
            "finding",
            "file",
            "finding",
            "finding",
            "file",
            "total"
        ]
    );
    assert_eq!(
        lines[3],
        serde_json::json!({
            "type": "finding", "severity": "error", "code": "undeclared",
            "message": "expected a modifier (texture, pigment, finish, transform, ...) or `}` in `sphere`, \
                        found the undeclared identifier `pigmnet`",
            "file": "faulty.pov", "line": 1, "column": 15, "end": { "line": 1, "column": 22 },
            "labels": [{
                "text": "in this `sphere`",
                "file": "faulty.pov", "line": 1, "column": 1, "end": { "line": 1, "column": 9 },
            }],
            "trace": [],
            "hints": ["Did you mean `pigment`?"],
            "fix": {
                "text": "pigment",
                "file": "faulty.pov", "line": 1, "column": 15, "end": { "line": 1, "column": 22 },
            },
        })
    );
    assert_eq!(
        lines[6],
        serde_json::json!({ "type": "total", "files": 2, "errors": 2, "warnings": 1 })
    );
}

#[test]
fn switches_and_ini_files_count_and_standard_input_is_a_scene() {
    let folder = folder();
    let arguments = ["check", "needy.txt", "+Llibrary", "Declare=Size=2", "x.ini"];
    let ended = povr(folder.path(), &arguments, "");
    assert_eq!(ended.out, "needy.txt: ok\n", "{}", ended.err);
    let ended = povr(folder.path(), &["check", "x.ini"], "");
    assert_eq!(ended.out, "right.pov: ok\n", "{}", ended.err);
    let ended = povr(folder.path(), &["check", "-"], RIGHT);
    assert_eq!(ended.out, "standard input: ok\n", "{}", ended.err);
}

#[test]
fn a_lint_is_switched_off_on_the_command_line() {
    let folder = folder();
    let bare = RIGHT.replace(" pigment { rgb 1 }", "");
    let check =
        |arguments: &[&str]| povr(folder.path(), &[&["check", "-"], arguments].concat(), &bare);
    assert!(check(&[]).out.contains("[no-pigment]"));
    assert_eq!(
        check(&["--allow", "no-pigment"]).out,
        "standard input: ok\n"
    );
    let refused = check(&["--allow", "no-pigmnt"]);
    let expected =
        "povr: `--allow`: there is no warning `no-pigmnt`\n  hint: Did you mean `no-pigment`?\n";
    assert_eq!((refused.err.as_str(), refused.code), (expected, Some(2)));
}

#[test]
fn a_missing_scene_is_an_error_and_a_bad_option_a_usage_error() {
    let folder = folder();
    let ended = povr(folder.path(), &["check", "none.pov", "right.pov"], "");
    assert_eq!(ended.code, Some(1));
    assert!(
        ended.out.contains("cannot read `none.pov`"),
        "{}",
        ended.out
    );
    assert!(ended.out.contains("right.pov: ok"), "{}", ended.out);
    for arguments in [
        &["check"][..],
        &["check", "--nonsense", "right.pov"],
        &["check", "+Zz"],
    ] {
        let ended = povr(folder.path(), arguments, "");
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.err);
        assert!(ended.err.starts_with("povr: "), "{}", ended.err);
    }
}

#[test]
fn help_names_the_command_and_the_command_has_help() {
    let folder = folder();
    let ended = povr(folder.path(), &["--help"], "");
    assert!(ended.err.contains("povr check"), "{}", ended.err);
    let ended = povr(folder.path(), &["check", "--help"], "");
    assert!(ended.err.contains("--message-format"), "{}", ended.err);
    assert_eq!(ended.code, Some(0));
}

#[test]
fn drawing_reports_in_the_requested_form_and_in_the_order_of_the_scene() {
    let folder = folder();
    let scene = "inner/doubtful.pov";
    let ended = povr(folder.path(), &[scene, "+W8", "+H6", "-F"], "");
    let line = "File 'inner/doubtful.pov' line 2: Parse Warning: old";
    assert_eq!(ended.err, format!("here\n{line}\n"));
    let ended = povr(folder.path(), &[scene, "+W8", "+H6", "-F", "-GD"], "");
    assert_eq!(ended.err, format!("{line}\n"));
    let json = [scene, "+W8", "+H6", "-F", "--message-format", "json"];
    let ended = povr(folder.path(), &json, "");
    let is_object = |line: &str| serde_json::from_str::<serde_json::Value>(line).is_ok();
    assert!(ended.err.lines().all(is_object), "{}", ended.err);
    assert_eq!((ended.err.lines().count(), ended.out.as_str()), (2, ""));
}

/// Impossible bodies of `bevel.inc`, and the reason reported for each.
const BEVELS: [(&str, &str); 9] = [
    (
        "Bevel_box(0*x, <1, 1, 1>, 0)",
        "the bevel of a box must be positive",
    ),
    (
        "Bevel_box(-<1, 1, 1>, <1, 1, 1>, 1)",
        "the bevel of a box must be less than half of its shortest side",
    ),
    (
        "Bevel_cylinder(0, 1, 2, 0.5)",
        "the bevel of a cylinder must be less than half of its height",
    ),
    (
        "Bevel_cylinder(0, 9, 2, 2)",
        "the bevel of a cylinder must be less than its radius",
    ),
    (
        "Bevel_ring(0, 1, 2, 1, 0.1)",
        "the outer radius of a ring must be larger than the inner one, and that positive",
    ),
    (
        "Bevel_ring(0, 9, 1, 2, 0.5)",
        "the bevel of a ring must be less than half of its wall",
    ),
    (
        "Bevel_wedge(0, 1, 1, 2, 0, 180, 0.1)",
        "a wedge must stretch over less than 180 degrees",
    ),
    (
        "Bevel_wedge(0, 9, 1, 3, 0, 10, 0.4)",
        "the bevel of a wedge must be less than half of its inner arc",
    ),
    (
        "Bevel_wedge(0, 9, 0, 3, 0, 10, 0.4)",
        "the outer radius of a wedge must be larger than the inner one, and that positive",
    ),
];

#[test]
fn an_impossible_bevelled_body_is_reported_with_its_position() {
    let folder = folder();
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("pov_scenes/include");
    let library = format!("+L{}", include.display());
    for (body, reason) in BEVELS {
        let scene = format!("#include \"bevel.inc\"\nobject {{ {body} }}\n");
        fs::write(folder.path().join("bevelled.pov"), scene).expect("a scene");
        let ended = povr(folder.path(), &["check", &library, "bevelled.pov"], "");
        assert_eq!(ended.code, Some(1), "{body}: {}", ended.err);
        let output = ended.out + &ended.err;
        assert!(output.contains(reason), "{body}: {output}");
        assert!(output.contains("bevelled.pov:2:"), "{body}: {output}");
    }
}

#[test]
fn the_words_that_need_version_3_8_are_named() {
    let folder = folder();
    let new = "#version 3.8;\ncamera { location -5*z }\nlight_source { -9*z, rgb 1 }\n\
               #declare Sizes = array mixed[2] { 1, y };\nlemon { 0, 0, Sizes[1], 0, Sizes[0] finish { fresnel } }\n";
    let old = "#version 3.7;\n#macro Ball(At, optional Size) sphere { At, 1 } #end\nBall(0,)\n";
    fs::write(folder.path().join("new.pov"), new).expect("a file");
    fs::write(folder.path().join("old.pov"), old).expect("a file");
    let of = |arguments: &[&str]| povr(folder.path(), arguments, "").out;
    let out = of(&["check", "--message-format=short", "new.pov"]);
    assert_eq!(
        out,
        "new.pov: ok; needs POV-Ray 3.8 for `fresnel`, `lemon`, `mixed`\n"
    );
    let out = of(&["check", "--message-format=json", "new.pov"]);
    let file: serde_json::Value =
        serde_json::from_str(out.lines().next().unwrap_or_default()).expect("an object");
    assert_eq!(
        file["words_of_3_8"],
        serde_json::json!(["fresnel", "lemon", "mixed"])
    );
    let marks = "#version 3.8;\ncamera { location -5*z }\nlight_source { -9*z, rgb 1 }\n\
                 #declare (A, B) = (1, 2);\n#declare global.C = A;\nsphere { 0, C matrix <B,0,0, 0,1,0, 0,0,1, 0,0,0,> }\n";
    fs::write(folder.path().join("marks.pov"), marks).expect("a file");
    let out = of(&["check", "--message-format=short", "marks.pov"]);
    let needs = "`#declare (...)`, `global.`, a comma behind the last value";
    assert_eq!(
        out,
        format!("marks.pov: ok; needs POV-Ray 3.8 for {needs}\n")
    );
    let plain =
        "#version 3.8;\ncamera { location -5*z }\nlight_source { -9*z, rgb 1 }\nsphere { 0, 1 }\n";
    fs::write(folder.path().join("plain.pov"), plain).expect("a file");
    let out = of(&["check", "--message-format=short", "plain.pov"]);
    assert_eq!(out, "plain.pov: ok; needs POV-Ray 3.8 for `#version`\n");
    let out = of(&["check", "--message-format=short", "old.pov"]);
    let hint = "(Begin the scene with `#version 3.8;` if parameters are `optional`.)";
    assert!(out.contains(hint), "{out}");
}

/// Words of POV-Ray 3.8, each in a statement.
const OF_3_8: &[(&str, &str)] = &[
    (
        "blend_gamma",
        "sphere { 0, 1 pigment { gradient x color_map { blend_gamma 2.2 [0 rgb 0] [1 rgb 1] } } }",
    ),
    (
        "blend_mode",
        "sphere { 0, 1 pigment { gradient x color_map { blend_mode 2 [0 rgb 0] [1 rgb 1] } } }",
    ),
    (
        "brilliance",
        "global_settings { radiosity { brilliance on } }",
    ),
    ("bt2020", "global_settings { assumed_gamma bt2020 }"),
    ("bt709", "global_settings { assumed_gamma bt709 }"),
    ("dictionary", "#declare D = dictionary { [\"a\"]: 1 };"),
    ("distance", "ovus { 1, 0.5 distance 0.5 }"),
    ("fresnel", "sphere { 0, 1 finish { fresnel 1 } }"),
    ("global.", "#declare A = 1; #declare B = global.A;"),
    ("grey", "#declare C = rgb 1; #declare V = C.grey;"),
    (
        "grey_threshold",
        "global_settings { radiosity { grey_threshold 0 } }",
    ),
    ("hf_grey_16", "global_settings { hf_grey_16 on }"),
    ("lemon", "lemon { 0, 0, y, 0, 1 }"),
    (
        "local.",
        "#macro M(A) sphere { 0, local.A pigment { rgb 1 } } #end M(1)",
    ),
    (
        "map_type",
        "sphere { 0, 1 pigment { image_map { function 2, 2 { x } map_type 7 } } }",
    ),
    ("mixed", "#declare A = array mixed [2] { 1, y };"),
    (
        "optional",
        "#macro M(A, optional B) sphere { A, 1 } #end M(0,)",
    ),
    (
        "polarity",
        "isosurface { function { x*x - 1 } polarity 1 contained_by { box { -2, 2 } } }",
    ),
    (
        "potential",
        "#declare B = sphere { 0, 1 } sphere { 0, 1 pigment { potential { B } } }",
    ),
    ("radius", "ovus { 1, 0.5 radius 2 }"),
    ("repeat", "sphere { 0, 1 pigment { crackle repeat 3 } }"),
    ("tau", "#declare A = tau / 2;"),
    ("union", "torus { 0.3, 0.5 union }"),
    ("use_alpha", "sphere { 0, 1 finish { use_alpha } }"),
    (
        "user_defined",
        "sphere { 0, 1 pigment { user_defined { function { x } } } }",
    ),
    (
        "user_defined",
        "camera { user_defined location { function { x } } }",
    ),
];

/// Words of HG-POV: of cameras, and others.
const OF_HG_POV: [&str; 2] = [
    "aitoff_hammer balthasart behrmann eckert_iv eckert_vi edwards gall hobo_dyer icosa lambert_azimuthal mercator \
     mollweide octa parallaxe peters smyth_craster stereo tetra van_der_grinten",
    "galley gts_load gts_save nurbs rational_bezier_patch stl_save tesselation uv_reference",
];

/// The report on a scene of a version whose fourth line is this.
fn report_on(folder: &Path, version: &str, line: &str) -> String {
    let text = format!("#version {version};\nlight_source {{ -9*z, rgb 1 }}\n\n{line}\n");
    fs::write(folder.join("words.pov"), text).expect("a file");
    let ended = povr(
        folder,
        &["check", "--message-format=short", "words.pov"],
        "",
    );
    ended.out + &ended.err
}

#[test]
fn every_word_of_version_3_8_is_named_with_its_line_in_older_scenes() {
    let folder = folder();
    for (word, line) in OF_3_8 {
        let report = report_on(folder.path(), "3.7", line);
        let about = report.lines().find(|line| line.contains("3.8"));
        let about = about.unwrap_or_else(|| panic!("{word}: {report}"));
        assert!(about.contains(word), "{word}: {report}");
        assert!(about.starts_with("words.pov:4:"), "{word}: {report}");
    }
}

#[test]
fn every_word_of_hg_pov_is_named_with_its_line() {
    let folder = folder();
    for version in ["3.7", "3.8"] {
        let of_cameras = OF_HG_POV[0].split_whitespace();
        let of_cameras =
            of_cameras.map(|word| (word, format!("camera {{ {word} location -4*z }}")));
        let others = OF_HG_POV[1].split_whitespace();
        let others = others.map(|word| (word, format!("sphere {{ 0, 1 {word} 1 }}")));
        for (word, line) in of_cameras.chain(others) {
            let report = report_on(folder.path(), version, &line);
            let named = format!("`{word}` is a word of HG-POV");
            let about = report.lines().find(|line| line.contains(&named));
            let about = about.unwrap_or_else(|| panic!("{word}: {report}"));
            assert!(about.starts_with("words.pov:4:"), "{word}: {report}");
        }
    }
}

#[test]
fn scenes_behind_one_that_takes_too_long_are_read() {
    let folder = folder();
    fs::write(folder.path().join("endless.pov"), ENDLESS).expect("a file");
    let arguments = ["check", "--timeout", "2s", "endless.pov", "right.pov"];
    let ended = povr(folder.path(), &arguments, "");
    assert!(
        ended.out.contains("endless.pov: 1 error\n"),
        "{}",
        ended.out
    );
    assert!(ended.out.contains("right.pov: ok\n"), "{}", ended.out);
    assert!(ended.err.contains("longer than"), "{}", ended.err);
    assert_eq!(ended.code, Some(1));
}
