//! The program under the name `povray`, as other programs start it: each row runs both programs by a shell, in a
//! folder of its own, and compares exit codes, new files, pictures, and the lines that callers look for.

#![cfg(unix)]

mod support;

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Instant;

const FILES: [(&str, &str); 10] = [
    (
        "s.pov",
        "#version 3.7; global_settings { assumed_gamma 1 } camera { location <0, 1, -4> look_at 0 }
        light_source { <5, 5, -5>, 1 } sphere { clock*x, 1 pigment { rgb <1, 0.6, 0.3> } } plane { y, -1 pigment { checker } }
        #ifdef (Given) #debug concat(\"= given \", str(Given, 0, 3), \"\\n\") #end
        #ifdef (Head) #debug \"= head\\n\" #end",
    ),
    ("plain.ini", "Input_File_Name=s.pov\nWidth=12\nHeight=9\n"),
    (
        "parts.ini",
        "Input_File_Name=s.pov\nHeight=9\nWidth=10\n[small]\nWidth=8\n[large]\nWidth=16\nOutput_File_Name=large\n",
    ),
    (
        "frames.ini",
        "Input_File_Name=s.pov\nHeight=9 ; low\nWidth=12\nFinal_Frame=4\nFinal_Clock=3\nCyclic_Animation=on\n# end\n",
    ),
    ("head.inc", "#declare Head = 1;\n"),
    ("inc/deep.inc", "#declare Head = 1;\n"),
    ("uses.pov", "#include \"deep.inc\"\n#include \"s.pov\"\n"),
    ("wrong.pov", "#version 3.7;\nsphere { 0, 1\n"),
    ("stops.pov", "#version 3.7;\n#error \"enough\"\n"),
    ("shell.ini", "Pre_Scene_Command=touch made\nPost_Scene_Command=touch made\n"),
];

/// Runs a shell command in which `$P` is the program.
fn shell(folder: &Path, program: &Path, command: &str) -> Output {
    for (name, text) in FILES {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("it has a name")).expect("folders can be made");
        fs::write(path, text).expect("files can be written");
    }
    Command::new("bash")
        .args(["-c", command])
        .current_dir(folder)
        .env("P", program)
        .env("HOME", folder)
        .stdin(Stdio::null())
        .output()
        .expect("bash runs")
}

/// New files, with the pixels of pictures.
fn written(folder: &Path) -> BTreeMap<String, Option<Vec<u8>>> {
    let entries = fs::read_dir(folder).expect("the folder is there").flatten();
    let entries = entries.filter(|entry| !entry.path().is_dir());
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let fresh = names.filter(|name| {
        FILES.iter().all(|(known, _)| known != name)
            && name != "povray"
            && !name.ends_with("-state")
    });
    let pixels = |name: &String| {
        let picture = image::open(folder.join(name)).ok()?;
        Some(
            picture
                .to_rgba16()
                .iter()
                .flat_map(|p| p.to_ne_bytes())
                .collect(),
        )
    };
    fresh
        .map(|name| {
            let pixels = pixels(&name);
            (name, pixels)
        })
        .collect()
}

/// The lines that callers look for. Times and counts of POV-Ray's own kind are left out.
fn signs(output: &Output) -> Vec<String> {
    const LINES: [&str; 28] = [
        "==== [",
        "  Input file: ",
        "  Clock value: ",
        "  Initial Frame: ",
        "  Frame Step: ",
        "  Initial Clock: ",
        "  Cyclic Animation.",
        "  Image resolution.",
        "  Output file",
        "  Continued trace",
        "  Dithering.",
        "  Antialiasing.",
        "  All Streams",
        "  Fatal Stream",
        "  Statistics Stream",
        "  Warning Stream",
        "Rendering frame ",
        "Parser Time",
        "Render Statistics",
        "Image Resolution",
        "Execution of shellout",
        "Problem with option setting",
        "Failed to parse",
        "No input file provided",
        "Parse Error: Cannot open",
        "Fatal error in parser",
        "Render failed",
        "POV-Ray finished",
    ];
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines: Vec<&str> = said.split(['\r', '\n']).map(str::trim_end).collect();
    let is_sign = |line: &&&str| LINES.iter().any(|begin| line.starts_with(begin));
    let mut signs: Vec<String> = lines
        .iter()
        .filter(is_sign)
        .map(|l| (*l).to_owned())
        .collect();
    // Other threads of POV-Ray write progress and what the scene says, before or after the title of the stage.
    let is_free = |line: &&&str| line.starts_with("= ") || line.ends_with("pixels (100%)");
    let free = lines.iter().filter(is_free);
    signs.extend(free.map(|line| (*line).to_owned()));
    // POV-Ray announces the first frame twice.
    signs.dedup();
    signs
}

#[derive(Debug, PartialEq)]
struct Done {
    code: Option<i32>,
    files: BTreeMap<String, Option<Vec<u8>>>,
    has_output: bool,
    signs: Vec<String>,
}

fn done(program: Option<&Path>, command: &str) -> Done {
    let folder = tempfile::tempdir().expect("temporary folders can be made");
    let link = folder.path().join("povray");
    if program.is_none() {
        symlink(env!("CARGO_BIN_EXE_povr"), &link).expect("links can be made");
    }
    let output = shell(folder.path(), program.unwrap_or(&link), command);
    Done {
        code: output.status.code(),
        files: written(folder.path()),
        has_output: !output.stdout.is_empty(),
        signs: signs(&output),
    }
}

fn agree(rows: &[&str]) {
    support::for_each_row(rows, |row| {
        let (ours, theirs) = (done(None, row), done(Some(Path::new("povray")), row));
        assert!(ours == theirs, "{row}\npovr {ours:#?}\nPOV-Ray {theirs:#?}");
    });
}

#[test]
fn messages_have_the_lines_of_povray() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D",
        "$P +Is.pov +W12 +H9 -D -V",
        "$P +Is.pov +W12 +H9 -D Verbose=Off",
        "$P +Is.pov +W12 +H9 -D +V",
        "$P +Is.pov +W12 +H9 -D -GA",
        "$P +Is.pov +W12 +H9 -D -GA -V",
        "$P +Is.pov +W12 +H9 -D -GS -GW",
        "$P +Is.pov +W12 +H9 -D +FN16 +UA +Oout.png",
        "$P +Is.pov +W12 +H9 -D +FNg",
        "$P +Is.pov +W12 +H9 -D +FT +A0.1 +R2 -J",
        "$P +Is.pov +W12 +H9 -D -F +C",
        "$P s.pov +W12 +H9 -D +KFF3",
        "$P s.pov +W12 +H9 -D +KFF12 +SF3 +EF4 -V",
    ]);
}

#[test]
fn failures_have_the_lines_and_the_code_of_povray() {
    agree(&[
        "$P",
        "$P +Is.pov +ZZ9 -D",
        "$P +Is.pov +W12 +H9 -D 'Declare=Given=\"text\"'",
        "$P +Is.pov Nonsense=3 -D",
        "$P +Is.pov +W12 +H9 -D +THXX",
        "$P +Is.pov +W12 +H9 -D +GI",
        "$P +Iwrong.pov +W12 +H9 -D -V",
    ]);
    let row = "$P +Inone.pov";
    let (ours, theirs) = (done(None, row), done(Some(Path::new("povray")), row));
    assert_eq!((ours.code, ours.files), (theirs.code, theirs.files));
    let last = |signs: &[String]| signs[signs.len() - 3..].to_vec();
    assert_eq!(last(&ours.signs), last(&theirs.signs));
}

#[test]
fn output_types_have_the_names_and_pixels_of_povray() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D +FN8",
        "$P +Is.pov +W12 +H9 -D +FN5",
        "$P +Is.pov +W12 +H9 -D +FN17",
        "$P +Is.pov +W12 +H9 -D +fn16",
        "$P +Is.pov +W12 +H9 -D -FN",
        "$P +Is.pov +W12 +H9 -D +F",
        "$P +Is.pov +W12 +H9 -D +FC",
        "$P +Is.pov +W12 +H9 -D +FC +UA",
        "$P +Is.pov +W12 +H9 -D +FB",
        "$P +Is.pov +W12 +H9 -D +FP16",
        "$P +Is.pov +W12 +H9 -D Output_File_Type=t",
        "$P +Is.pov +W12 +H9 -D Output_File_Type=B",
        "$P +Is.pov +W12 +H9 -D Bits_Per_Color=16",
        "$P +Is.pov +W12 +H9 -D Bits_Per_Color=3",
        "$P +Is.pov +W12 +H9 -D Grayscale_Output=on",
        "$P +Is.pov +W12 +H9 -D +FN8 Grayscale_Output=on",
        "$P +Is.pov +W12 +H9 -D Compression=0",
        "$P +Is.pov +W12 +H9 -D File_Gamma=1.0",
        "$P +Is.pov +W12 +H9 -D +FN File_Gamma=2.2",
        "$P +Is.pov +W12 +H9 -D +O-",
        "$P +Is.pov +W12 +H9 -D +O- +FT",
        "$P +Is.pov +W12 +H9 -D +O./",
        "$P +Is.pov +W12 +H9 -D +Oout.bmp",
        "$P +Is.pov +W12 +H9 -D +Oinc/",
    ]);
}

#[test]
fn parts_of_a_picture_are_announced() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D +SC3",
        "$P +Is.pov +W12 +H9 -D +EC8",
        "$P +Is.pov +W12 +H9 -D +SC3 +EC8",
        "$P +Is.pov +W12 +H9 -D +SR4",
        "$P +Is.pov +W12 +H9 -D +SC0.5",
        "$P +Is.pov +W12 +H9 -D +SC0 +EC12",
        "$P +Is.pov +W12 +H9 -D +SR0.2 +ER0.8",
        "$P +Is.pov +W12 +H9 -D Start_Column=2 End_Column=6 Start_Row=3 End_Row=5",
    ]);
}

#[test]
fn clocks_and_frames_are_announced() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D +K0.5",
        "$P +Is.pov +W12 +H9 -D +K.5",
        "$P +Is.pov +W12 +H9 -D +K-1",
        "$P +Is.pov +W12 +H9 -D Clock=abc",
        "$P +Is.pov +W12 +H9 -D +KFI2 +KFF4",
        "$P +Is.pov +W12 +H9 -D +KFI0 +KFF2",
        "$P +Is.pov +W12 +H9 -D +KFF3 +KI1 +KF2",
        "$P +Is.pov +W12 +H9 -D +KFF4 +KC",
        "$P +Is.pov +W12 +H9 -D +KFF4 +SF2 +EF3",
        "$P +Is.pov +W12 +H9 -D +KFF10 +SF0.5 +EF0.7",
        "$P +Is.pov +W12 +H9 -D +KFF120 +SF118",
        "$P +Is.pov +W12 +H9 -D +KFF3 -F",
        "$P +Is.pov +W12 +H9 -D +KFF3 +Oq07",
        "$P +Is.pov +W12 +H9 -D Final_Frame=3 Frame_Step=2",
        "$P +Is.pov +W12 +H9 -D Final_Frame=abc",
        "$P frames.ini -D",
        "$P frames.ini +SF4 -D",
    ]);
}

#[test]
fn ini_files_sections_and_libraries() {
    agree(&[
        "$P parts.ini -D",
        "$P parts -D",
        "$P 'parts.ini[small]' -D",
        "$P 'parts[LARGE]' -D",
        "$P 'parts.ini[none]' -D",
        "$P 'parts.ini[small' -D",
        "$P none.ini -D",
        "$P +Is.pov Include_Ini=plain.ini -D",
        "$P +Is.pov Include_Ini=none.ini +W12 +H9 -D",
        "$P +Iuses.pov +W12 +H9 -D +Linc",
        "$P +Iuses.pov +W12 +H9 -D +Lnone +Linc",
        "$P +Iuses.pov +W12 +H9 -D Library_Path=inc",
        "$P +Iuses.pov +W12 +H9 -D",
        "$P +Is.pov +W12 +H9 -D +L",
        "$P +Is.pov +W12 +H9 -D Declare=Given=1e2",
        "$P +Is.pov +W12 +H9 -D declare=Given=-4 Declare=Other=7",
        "$P +Is.pov +W12 +H9 -D +HIhead.inc",
    ]);
}

#[test]
fn antialiasing_is_announced() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D +A",
        "$P +Is.pov +W12 +H9 -D -A0.3",
        "$P +Is.pov +W12 +H9 -D +A0.1 +AM2 +R3",
        "$P +Is.pov +W12 +H9 -D +A0.1 +R10",
        "$P +Is.pov +W12 +H9 -D +A0.1 +J0.5",
        "$P +Is.pov +W12 +H9 -D +A0.1 -J0.5",
        "$P +Is.pov +W12 +H9 -D +A0.1 +AG1.5",
        "$P +Is.pov +W12 +H9 -D Antialias=on Sampling_Method=2 Antialias_Depth=2",
        "$P +Is.pov +W12 +H9 -D Antialias=maybe",
    ]);
}

#[test]
fn values_end_where_their_number_ends() {
    agree(&[
        "$P +Is.pov +W12abc +H9,5 -D",
        "$P +Is.pov +W1e1 +H9 -D",
        "$P +Is.pov Width=12.9 Height=9x -D",
        "$P +Is.pov +W12 +H9 -D +A0.3,2",
        "$P +Is.pov +W12 +H9 -D +A0.1 +R2.9 +J0x1",
        "$P +Is.pov +W12 +H9 -D +K0.5,1",
        "$P +Is.pov +W12 +H9 -D +Q5abc",
        "$P +Is.pov +W12 +H9 -D +MV3.5",
        "$P +Is.pov +W12 +H9 -D Version=3.1x",
        "$P +Is.pov +W12 +H9 -D +BS4 +RP2x +WT2x",
    ]);
}

#[test]
fn what_povray_refuses_is_refused() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D +A.3,.2",
        "$P +Is.pov +W12 +H9 -D +A0",
        "$P +Is.pov +W12 +H9 -D +A1.5",
        "$P +Is.pov +W12 +H9 -D +A-1",
        "$P +Is.pov +W12 +H9 -D +Ax",
        "$P +Is.pov +W12 +H9 -D +AM",
        "$P +Is.pov +W12 +H9 -D +R.3",
        "$P +Is.pov +W12 +H9 -D +Q",
        "$P +Is.pov +W12 +H9 -D +MVx",
        "$P +Is.pov +W12 +H9 -D +WT",
        "$P +Is.pov +W12 +H9 -D +RPx",
        "$P +Is.pov +W12 +H9 -D +B100",
        "$P +Is.pov +W12 +H9 -D +BP",
        "$P +Is.pov +W12 +H9 -D +FN16g",
        "$P +Is.pov +W12 +H9 -D +FNg8",
        "$P +Is.pov +W12 +H9 -D +FX",
        "$P +Is.pov +W12 +H9 -D +THBN",
        "$P +Is.pov +W12 +H9 -D +HI",
        "$P +Is.pov +W12 +H9 -D +K",
        "$P +Is.pov +W 12 +H 9 -D",
        "$P +I s.pov +W12 +H9 -D",
        "$P +Is.pov Width= Height=9 -D",
        "$P +Is.pov Bounding_Threshold=x +W12 +H9 -D",
        "$P +Is.pov Display_Gamma=x +W12 +H9 -D",
        "$P +Is.pov +W12 +H9 -D --unknown",
        "$P +Is.pov +W12 +H9 -D unknown",
    ]);
    let row = "$P +Is.pov +W12 +H9 -D +BS3";
    let (ours, theirs) = (done(None, row), done(Some(Path::new("povray")), row));
    assert_eq!((ours.code, ours.files), (theirs.code, theirs.files));
}

#[test]
fn options_without_a_picture_of_their_own() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D +MB0 -UV -UL -UR +SU",
        "$P +Is.pov +W12 +H9 -D +B +C +X +P",
        "$P +Is.pov +W12 +H9 -D -UF -UO -TH",
        "$P +Is.pov +W12 +H9 -D +BM2",
        "$P +Is.pov +W12 +H9 -D +Q0",
        "$P +Is.pov +W12 +H9 -D Max_Image_Buffer_Memory=10 Test_Abort_Count=9",
        "$P +Istops.pov +W12 +H9 -D",
        "$P +Istops.pov +W12 +H9 -D -GF",
        "$P +Istops.pov +W12 +H9 -D -GA",
        "$P +Is.pov +W12 +H9 -D -GD -GR",
        "$P +Is.pov +W12 +H9 -D +GDd.txt",
    ]);
}

#[test]
fn one_argument_may_hold_all_options() {
    agree(&[
        "$P +Is.pov 'Output_File_Type=N Bits_Per_Color=16 +Q8 +UR +A' +W12 +H9 -D",
        "$P '+Is.pov +Oo +W12 +H9 -D'",
        "$P 'Output_File_Name=out -D +W12 +H9 +Is.pov'",
        "$P s.pov 'Width=12 Height=9 Display=off'",
    ]);
}

#[test]
fn what_povray_accepts_is_no_error() {
    agree(&[
        "$P +Is.pov +W12 +H9 -D Declare=Given=text",
        "$P +Is.pov +W12 +H9 -D Declare=Given=1,2",
        "$P +Is.pov +W12 +H9 -D Declare=Given=0x10",
        "$P +Is.pov +W12 +H9 -D Declare=Given",
        "$P +Is.pov +W12 +H9 -D Declare=Given=",
        "$P +Is.pov +W12 +H9 -D +UF",
        "$P +Is.pov +W12 +H9 -D Field_Render=on",
        "$P +Is.pov +W12 +H9 -D Clockless_Animation=on",
        "$P +Is.pov +W12 +H9 -D +RFI",
        "$P +Is.pov +W12 +H9 -D Dither_Method=FS",
        "$P +Is.pov +W12 +H9 -D Dither=on",
        "$P +Is.pov +W12 +H9 -D +THB3",
        "$P +Is.pov +W12 +H9 -D +WT999",
    ]);
}

#[test]
fn programs_of_ini_files_are_named_and_not_run() {
    agree(&["$P shell.ini +Is.pov +W12 +H9 -D"]);
}

#[test]
fn create_ini_writes_the_options_of_povray() {
    const ROWS: [&str; 3] = [
        "plain.ini -D +GIz.ini",
        "+Is.pov +W12 +H9 -D Create_Ini=z.ini Declare=B=2 Declare=A=1.5 +K0.5 +FN16 +UA +Oout.png +Q5",
        "+Is.pov +W12 +H9 -D +GIz.ini +A0.1 +AM2 +R2 +J0.5 -UR +SU +SC2 +EC10 +WT1 -V +HIhead.inc",
    ];
    for row in ROWS {
        let text = |program: &Path| {
            let folder = tempfile::tempdir().expect("a folder");
            shell(folder.path(), program, &format!("$P {row}"));
            let text = fs::read_to_string(folder.path().join("z.ini")).expect("it is written");
            let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
            lines.sort();
            lines
        };
        let (ours, theirs) = (
            text(Path::new(env!("CARGO_BIN_EXE_povr"))),
            text(Path::new("povray")),
        );
        assert_eq!(ours, theirs, "{row}");
    }
}

/// POV-Ray opens its scene several times, so that it draws an empty scene from a pipe, and finds no options in one.
#[test]
fn pipes_of_the_user_are_read_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = Path::new(env!("CARGO_BIN_EXE_povr"));
    let pixels = |command: &str| {
        let _ = fs::remove_file(folder.path().join("o.png"));
        let output = shell(folder.path(), program, command);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{command}: {said}");
        let picture = image::open(folder.path().join("o.png")).expect("it is drawn");
        (picture.to_rgba8().into_raw(), said.contains("= head"))
    };
    let (expected, _) = pixels("$P +Is.pov +Oo.png +W12 +H9");
    for command in [
        "cat s.pov | $P +I/dev/stdin +Oo.png +W12 +H9",
        "cat s.pov | $P +I- +Oo.png +W12 +H9",
        "$P +I<(cat s.pov) +Oo.png +W12 +H9",
        "mkfifo f.pov; timeout 9 bash -c 'cat s.pov > f.pov' & while ! test -p f.pov; do sleep 0.1; done; $P f.pov +Oo.png +W12 +H9",
        "$P <(cat plain.ini) +Oo.png",
        "cat plain.ini | $P /dev/stdin +Oo.png",
    ] {
        assert_eq!(pixels(command), (expected.clone(), false), "{command}");
    }
    let with_header = pixels("$P +Is.pov +HI<(cat head.inc) +Oo.png +W12 +H9");
    assert_eq!(with_header, (expected, true));
}

#[test]
fn pipes_named_by_scenes_and_ini_files_are_not_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = Path::new(env!("CARGO_BIN_EXE_povr"));
    for command in [
        "mkfifo a.inc; echo '#include \"a.inc\"' > t.pov; timeout 20 $P t.pov +W12 +H9",
        "mkfifo b.inc; echo 'Include_Header=b.inc' > t.ini; timeout 20 $P t.ini s.pov +W12 +H9",
        "mkfifo c.ini; echo 'Include_Ini=c.ini' > u.ini; timeout 20 $P u.ini s.pov +W12 +H9",
    ] {
        let output = shell(folder.path(), program, command);
        assert_eq!(output.status.code(), Some(1), "{command}: {output:?}");
    }
}

#[test]
fn an_interrupt_that_the_parent_ignores_ends_it_with_code_2() {
    let slow = "echo '#version 3.7; global_settings { assumed_gamma 1 } camera { location -5*z } light_source { 9, 1 area_light x*3, \
        y*3, 17, 17 } plane { y, -1 pigment { checker } finish { reflection 0.3 } } sphere { 0, 1 pigment { rgb 1 } }' > slow.pov; \
        trap '' INT; $P +Islow.pov +W3000 +H2000 +A0.01 -D & sleep 3; kill -INT $!; wait $!";
    agree_on_code(slow, 2);
}

fn agree_on_code(row: &str, code: i32) {
    let (ours, theirs) = (done(None, row), done(Some(Path::new("povray")), row));
    assert_eq!(
        (ours.code, theirs.code),
        (Some(code), Some(code)),
        "{ours:?}"
    );
}

#[test]
fn many_threads_are_not_slower_than_two() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = Path::new(env!("CARGO_BIN_EXE_povr"));
    let time = |threads: u32| {
        let start = Instant::now();
        let command = format!("$P +Is.pov +Oo.png +W640 +H480 +A0.01 +R4 +WT{threads}");
        assert!(shell(folder.path(), program, &command).status.success());
        start.elapsed()
    };
    time(2);
    let best = |threads| (0..3).map(|_| time(threads)).min().expect("three");
    // Beyond noise; 999 threads on two cores took twice as long.
    assert!(best(999) < best(2) * 3 / 2, "{:?} {:?}", best(999), best(2));
}

#[test]
fn a_link_is_made_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = Path::new(env!("CARGO_BIN_EXE_povr"));
    let code = |command: &str| shell(folder.path(), program, command).status.code();
    assert_eq!(
        code("$P install-as-povray a/b && a/b/povray --version 2>&1 | grep -q '^POV-Ray 3.7'"),
        Some(0)
    );
    assert_eq!(code("$P install-as-povray a/b"), Some(0));
    assert_eq!(
        code("mkdir c; touch c/povray; $P install-as-povray c"),
        Some(2)
    );
    assert_eq!(code("$P install-as-povray"), Some(2));
}

#[test]
fn png_files_are_no_larger_than_those_of_povray() {
    const PARTS: &str = "#version 3.7; global_settings { assumed_gamma 1 } camera { location <0, 1, -4> look_at 0 } \
        light_source { <5, 5, -5>, 1 } plane { y, -1 pigment { bozo color_map { [0 rgb 1] [1 rgb x] } } } \
        sphere { 0, 1 pigment { rgb <1, 0.6, 0.3> } finish { phong 0.5 } }";
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("parts.pov"), PARTS).expect("a scene");
    let own = folder.path().join("povray");
    symlink(env!("CARGO_BIN_EXE_povr"), &own).expect("links can be made");
    for options in [
        "+Is.pov",
        "+Iparts.pov",
        "+Iparts.pov +A0.1",
        "+Iparts.pov +UA",
        "+Iparts.pov +FN16",
    ] {
        let size = |program: &Path| {
            let command = format!("$P {options} +Oq.png +W320 +H240 -D");
            assert!(shell(folder.path(), program, &command).status.success());
            fs::metadata(folder.path().join("q.png"))
                .expect("it is drawn")
                .len()
        };
        let (ours, theirs) = (size(&own), size(Path::new("povray")));
        assert!(ours <= theirs, "{options}: {ours} bytes, POV-Ray {theirs}");
    }
}
