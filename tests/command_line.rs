//! The command line compared with POV-Ray's: each row runs both programs in a folder of its own and compares the exit
//! code, the new files and the pictures in them, whether there was any standard output, and, where the scene is drawn,
//! the lines of `#debug` that begin with `= `.

mod support;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Files beside the scene that rows use.
const FILES: [(&str, &str); 9] = [
    (
        "s.pov",
        "#version 3.7; global_settings { assumed_gamma 1 } camera { location <0, 1, -4> look_at 0 }
        light_source { <5, 5, -5>, 1 } sphere { clock*x, 1 pigment { rgb <1, 0.6, 0.3> } } plane { y, -1 pigment { checker } }
        #debug concat(\"= \", str(clock, 0, 6), \" \", str(frame_number, 0, 0), \" \", str(final_frame, 0, 0), \"\\n\")
        #ifdef (Given) #debug concat(\"= given \", str(Given, 0, 3), \"\\n\") #end
        #ifdef (Head) #debug \"= head\\n\" #end
        #ifdef (Beside) #debug \"= beside\\n\" #end",
    ),
    ("plain.ini", "Input_File_Name=s.pov\nWidth=12\nHeight=9\n"),
    (
        "parts.ini",
        "Height=9\n[small]\nWidth=8\n[large]\nWidth=16\nOutput_File_Name=large\n",
    ),
    ("head.inc", "#declare Head = 1;\n"),
    ("include/beside.inc", "#declare Beside = 1;\n"),
    ("uses.pov", "#include \"beside.inc\"\n#include \"s.pov\"\n"),
    ("wrong.pov", "#version 3.7;\nsphere { 0, 1\n"),
    (
        "a b.pov",
        "#version 3.7; global_settings { assumed_gamma 1 } background { rgb <0.2, 0.4, 0.6> }
        #debug \"= spaced\\n\"
        #ifdef (Given) #debug concat(\"= given \", str(Given, 0, 3), \"\\n\") #end",
    ),
    ("empty.pov", "#version 3.7; global_settings { assumed_gamma 1 }\n"),
];

/// The effects of a run.
#[derive(Debug, PartialEq)]
struct Done {
    code: Option<i32>,
    /// New files; with the pixels of lossless pictures, and the text written by the scene.
    files: BTreeMap<String, Option<Vec<u8>>>,
    has_output: bool,
    values: Vec<String>,
}

/// The arguments of a row: split at bars if there is one, otherwise at spaces.
fn arguments(line: &str) -> Vec<&str> {
    match line.contains('|') {
        true => line.split('|').collect(),
        false => line.split_whitespace().collect(),
    }
}

fn run(program: &str, line: &str) -> Done {
    let folder = tempfile::tempdir().expect("temporary folders can be made");
    for (name, text) in FILES {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("it has a name")).expect("folders can be made");
        fs::write(path, text).expect("files can be written");
    }
    let output = Command::new(program)
        .current_dir(folder.path())
        .args(arguments(line))
        .stdin(Stdio::null())
        .output()
        .unwrap_or_else(|error| {
            panic!("{program} cannot be run ({error}); tools/test installs it")
        });
    let stderr = String::from_utf8_lossy(&output.stderr);
    // A faulty scene is read on to detect all of its faults, and writes more.
    let is_whole = output.status.success();
    let values = stderr
        .lines()
        .filter(|line| is_whole && line.starts_with("= "));
    Done {
        code: output.status.code(),
        files: written(folder.path()),
        has_output: !output.stdout.is_empty(),
        values: values.map(|line| line.trim_end().to_owned()).collect(),
    }
}

/// The new files.
fn written(folder: &Path) -> BTreeMap<String, Option<Vec<u8>>> {
    let entries = fs::read_dir(folder).expect("the folder is there").flatten();
    let files = entries.filter(|entry| entry.path().is_file());
    let names = files.map(|entry| entry.file_name().to_string_lossy().into_owned());
    // Each program has its own format for the state of an unfinished picture.
    let names = names.filter(|name| !name.ends_with("-state"));
    let fresh = names.filter(|name| FILES.iter().all(|(known, _)| known != name));
    fresh
        .map(|name| {
            if ["d.txt", "debug.out"].contains(&&*name) {
                let text = fs::read(folder.join(&name)).ok();
                return (name, text);
            }
            // Other formats round in ways of their own and are compared elsewhere.
            let is_exact = [".png", ".ppm", ".bmp", ".tga"];
            let is_exact = is_exact.iter().any(|end| name.ends_with(end));
            let picture = is_exact.then(|| image::open(folder.join(&name)).ok());
            let pixels = picture
                .flatten()
                .map(|picture| picture.to_rgba8().into_raw());
            (name, pixels)
        })
        .collect()
}

/// Runs both programs with each of these rows and compares.
fn agree(rows: &[&str]) {
    support::for_each_row(rows, |row| {
        let expected = run("povray", row);
        let actual = run(env!("CARGO_BIN_EXE_povr"), row);
        assert!(
            actual == expected,
            "{row}\npovr {actual:?}\nPOV-Ray {expected:?}"
        );
    });
}

#[test]
fn scenes_and_pictures_are_named() {
    agree(&[
        "+Is.pov +W12 +H9 -D",
        "s.pov +W12 +H9 -D",
        "-is.pov -w12 -h9 -D",
        "s +W12 +H9 -D",
        "+Is +W12 +H9 -D",
        "+Inone.pov +W12 +H9 -D",
        "+Is.pov +Oout +W12 +H9 -D",
        "+Is.pov +Oout.png +W12 +H9 -D",
        "+Is.pov +Oq.PNG +W12 +H9 -D",
        "+Is.pov +Oq.tga +W12 +H9 -D",
        "+Is.pov +Onone/q.png +W12 +H9 -D",
        "+Is.pov -F +W12 +H9 -D",
        "+Is.pov Output_To_File=off +W12 +H9 -D",
        "+Iempty.pov +W12 +H9 -D",
        "+Iwrong.pov +W12 +H9 -D",
    ]);
}

#[test]
fn formats_are_chosen() {
    agree(&[
        "+Is.pov +FN +W12 +H9 -D",
        "+Is.pov +FN16 +W12 +H9 -D",
        "+Is.pov +FT +W12 +H9 -D",
        "+Is.pov +FB +W12 +H9 -D",
        "+Is.pov +FP +W12 +H9 -D",
        "+Is.pov +FJ +W12 +H9 -D",
        "+Is.pov +FE +W12 +H9 -D",
        "+Is.pov +FH +W12 +H9 -D",
        "+Is.pov +FN +Ou.png +UA +W12 +H9 -D",
        "+Is.pov +O- +FP +W12 +H9 -D",
        "+Is.pov Output_File_Type=N Bits_Per_Color=8 +W12 +H9 -D",
    ]);
}

#[test]
fn sizes_and_parts() {
    agree(&[
        "+Is.pov +W8.5 +H9 -D",
        "+Is.pov +W0 +H9 -D",
        "+Is.pov Width=10 Height=7 -D",
        "+Is.pov +W12 +H9 +SC3 +EC8 +SR2 +ER7 -D",
        "+Is.pov +W12 +H9 +SC0.25 +EC0.75 +SR0.5 -D",
        "+Is.pov +W12 +H9 +W6 -D",
        "+Is.pov +W12 +H9 +WT3 +BS8 +RP2 +MB2 +SU -UR -D",
        "+Is.pov +W12 +H9 +Q3 -D",
        "+Is.pov +W12 +H9 +A0.1 +AM2 +R2 -J -D",
        "+Is.pov +W12 +H9 Antialias=on Antialias_Threshold=3 -J -D",
    ]);
}

#[test]
fn values_come_from_outside() {
    agree(&[
        "+Is.pov +K0.75 +W12 +H9 -D",
        "+Is.pov Clock=0.5 +W12 +H9 -D",
        "+Is.pov Declare=Given=3.25 +W12 +H9 -D",
        "+Is.pov Declare=Given=-2 +W12 +H9 -D",
        "+Is.pov Declare=Given=\"text\" +W12 +H9 -D",
        "+Is.pov +HIhead.inc +W12 +H9 -D",
        "+Is.pov Include_Header=head.inc +W12 +H9 -D",
        "+Iuses.pov +Linclude +W12 +H9 -D",
        "+Iuses.pov Library_Path=include +W12 +H9 -D",
        "+Iuses.pov +W12 +H9 -D",
    ]);
}

#[test]
fn ini_files_and_faults() {
    agree(&[
        "plain.ini -D",
        "plain.ini +W6 -D",
        "+W6 plain.ini -D",
        "parts.ini[small] +Is.pov -D",
        "parts.ini[large] +Is.pov -D",
        "none.ini +Is.pov -D",
        "+Is.pov +W12 +H9 +ZZ9 -D",
        "+Is.pov +W12 +H9 Nonsense=3 -D",
        "",
    ]);
}

#[test]
fn messages_can_be_left_out() {
    agree(&[
        "+Is.pov +W12 +H9 -D -GA",
        "+Is.pov +W12 +H9 -D -GD",
        "+Is.pov +W12 +H9 -D -GR -GS -GW",
        "+Iwrong.pov +W12 +H9 -D -GA",
    ]);
}

#[test]
fn messages_go_to_files() {
    agree(&[
        "+Is.pov +W12 +H9 -D +GDd.txt +GWw.txt +GRr.txt +GSs.txt +GFf.txt +GAa.txt",
        "+Is.pov +W12 +H9 -D -GDd.txt -GA",
        "+Is.pov +W12 +H9 -D +GDd.txt +GDe.txt",
        "+Is.pov +W12 +H9 -D Debug_File=on Fatal_File=1 Statistic_File=true Warning_File=yes Render_File=true All_File=true",
        "+Is.pov +W12 +H9 -D +GDoff",
        "+Is.pov +W12 +H9 -D +GDmissing/d.txt",
        "+Iwrong.pov +W12 +H9 -D +GFf.txt",
        "+Is.pov +KFF3 +W12 +H9 -D +GDd.txt",
    ]);
}

#[test]
fn animations_are_numbered() {
    agree(&[
        "+Is.pov +KFF3 +W12 +H9 -D",
        "+Is.pov +KFI9 +KFF11 +KI2 +KF4 +W12 +H9 -D",
        "+Is.pov +KFI2 +KFF4 +KC +W12 +H9 -D",
        "+Is.pov +KFF12 +SF3 +EF4 +W12 +H9 -D",
    ]);
}

#[test]
fn an_argument_holds_several_options() {
    agree(&[
        "+Is.pov +W12 +H9|-D",
        "+Is.pov|+W12 +H9|-D",
        "+Is.pov| +W12   +H9 |-D",
        "+Is.pov|+W12|+H9\t-D",
        "s.pov +W12 +H9|-D",
        "+W12 s.pov +H9|-D",
        "+W12 +H9 s.pov|-D",
        "Width=12 Height=9|+Is.pov|-D",
        "Height=9 +W12|+Is.pov|-D",
        "Input_File_Name=s.pov +W12 +H9|-D",
        "Declare=Given=3 Declare=Other=4 +W12|+H9|+Is.pov|-D",
        "+W12 parts.ini[large]|+Is.pov|-D",
        "+W12 plain.ini|-D",
        "+Is.pov|+W12 +H9|-D -F",
        "+Is.pov|+W12 +H9 -D +ZZ9",
        "+Is.pov|+W12 +H9 -D nonsense",
    ]);
}

#[test]
fn quotes_keep_a_space_in_a_name() {
    agree(&[
        "+I\"a b.pov\" +W12 +H9|-D",
        "+I'a b.pov' +W12 +H9|-D",
        "\"a b.pov\" +W12 +H9|-D",
        "'a b.pov' +W12 +H9|-D",
        "Input_File_Name=\"a b.pov\" Width=12 Height=9 Display=off|+A0.3",
        "Input_File_Name='a b.pov' Width=12 Height=9 Display=off|+A0.3",
        "+O\"o p.png\" Width=12|+Is.pov|Height=9|-D",
        "+W\"12\" +H'9'|+Is.pov|-D",
        "\"+W12 +H9\"|+Is.pov|-D",
    ]);
}
