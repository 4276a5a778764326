//! Animations: frames, clocks, names, and the end at a faulty frame, compared with POV-Ray.

mod support;

use povr::app::compare::{Limits, Verdict, compare};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

const TIME_LIMIT: Duration = Duration::from_secs(120);

/// Reports each frame in a line that begins with `@`.
const TELLING: &str = "// Tells what it is told of its frame.
#version 3.7;
global_settings { assumed_gamma 1 }
#debug concat(\"@\", str(frame_number, 0, 0), \" \", str(clock, 0, 15), \" \", str(clock_on, 0, 0), \"\\n\")
#debug concat(\"@\", str(clock_delta, 0, 9), \" \", str(initial_clock, 0, 6), \" \", str(final_clock, 0, 6), \"\\n\")
#debug concat(\"@\", str(initial_frame, 0, 0), \" \", str(final_frame, 0, 0), \"\\n\")
camera { location -4*z look_at 0 }
light_source { <-3, 5, -8>, rgb 1 }
sphere { clock*x, 1 pigment { rgb <0.9, 0.5, 0.2> } }
";

/// A folder with these files, given as names and texts.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a file in it");
    }
    folder
}

/// Runs a renderer in a folder; returns whether it succeeded, and the lines that the scene wrote there.
fn run(renderer: &OsStr, folder: &Path, arguments: &[&str]) -> (bool, Vec<String>) {
    let mut command = Command::new(renderer);
    command.current_dir(folder).args(arguments);
    // POV-Ray reads files only below the folder it runs in and the home folder.
    command.env("HOME", support::SCENES);
    let ended = support::run(&mut command, TIME_LIMIT).expect("the renderer starts");
    let status = ended.status.expect("the renderer ends");
    let lines = ended.stderr.lines().filter(|line| line.starts_with('@'));
    (status.success(), lines.map(str::to_owned).collect())
}

/// The names of the pictures in a folder.
fn pictures(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder is there").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| !name.contains(".pov") && !name.contains(".ini"))
        .collect();
    names.sort();
    names
}

#[test]
fn an_animation_whose_files_cannot_be_written_is_not_begun() {
    let folder = folder(&[("tell.pov", TELLING), ("file", "")]);
    fs::create_dir(folder.path().join("a2.png")).expect("a folder");
    for output in ["none/a.png", "file/a.png", "a.png"] {
        let arguments = ["+Itell.pov", "+KFF3", "-D", "-o", output];
        let (has_succeeded, lines) = run(&support::renderer(), folder.path(), &arguments);
        assert!(!has_succeeded && lines.is_empty(), "{output}: {lines:?}");
    }
}

#[test]
fn frames_are_named_and_reported_as_in_povray() {
    for arguments in [
        "+KFF3",
        "+KFF10 +SF9 +EF11",
        "+KFI98 +KFF101 +EF99 +KI0.1 +KF0.7",
        "+KI2 +KF5 +KFF3 +KC +Oname.tga",
        "+KFF9 +KC +SF0.95 +FT",
        "Final_Frame=5 Frame_Step=2 Initial_Clock=-1",
        "+K0.1",
    ] {
        let (theirs, ours) = (folder(&[("s.pov", TELLING)]), folder(&[("s.pov", TELLING)]));
        let usual = ["+Is.pov", "+W4", "+H3", "-D", "-A"];
        let arguments: Vec<&str> = usual.into_iter().chain(arguments.split(' ')).collect();
        let expected = run("povray".as_ref(), theirs.path(), &arguments);
        let actual = run(&support::renderer(), ours.path(), &arguments);
        assert_eq!(actual, expected, "{arguments:?}");
        assert_eq!(
            pictures(ours.path()),
            pictures(theirs.path()),
            "{arguments:?}"
        );
    }
}

/// The lecture notes' two-link arm: its joints follow the clock.
#[test]
fn the_arm_moves_as_in_povray() {
    let ini = Path::new(support::SCENES).join("transform/arm.ini");
    let scenes = format!("+L{}/transform", support::SCENES);
    let ini = ini.display().to_string();
    let arguments = [&scenes, &ini, "+W160", "+H120", "-D", "-A", "Frame_Step=3"];
    let (theirs, ours) = (folder(&[]), folder(&[]));
    assert!(
        run(
            "povray".as_ref(),
            theirs.path(),
            &[&arguments[..], &["+WT1", "+Oarm"]].concat()
        )
        .0
    );
    assert!(
        run(
            &support::renderer(),
            ours.path(),
            &[&arguments[..], &["+Oarm"]].concat()
        )
        .0
    );
    let names = pictures(theirs.path());
    assert_eq!(names.len(), 10);
    assert_eq!(pictures(ours.path()), names);
    let mut last = None;
    for name in names {
        let open = |folder: &Path| image::open(folder.join(&name)).expect("a picture");
        let (expected, actual) = (open(theirs.path()), open(ours.path()));
        let comparison = compare(&expected, &actual).expect("one size");
        let verdict = Limits::DEFAULT.verdict(&comparison);
        assert_eq!(verdict, Verdict::Within, "{name}: {comparison}");
        assert_ne!(last.as_ref(), Some(&actual), "{name}: the arm stands still");
        last = Some(actual);
    }
}

#[test]
fn a_faulty_frame_ends_the_animation_as_in_povray() {
    let text = format!("{TELLING}#if (frame_number = 3) #error \"three is bad\" #end\n");
    let arguments = ["+Is.pov", "+W4", "+H3", "-D", "-A", "+KFF9"];
    let (theirs, ours) = (folder(&[("s.pov", &text)]), folder(&[("s.pov", &text)]));
    let expected = run("povray".as_ref(), theirs.path(), &arguments);
    let actual = run(&support::renderer(), ours.path(), &arguments);
    assert!(!expected.0);
    assert_eq!(actual, expected);
    assert_eq!(pictures(ours.path()), ["s1.png", "s2.png"]);
    assert_eq!(pictures(theirs.path()), ["s1.png", "s2.png"]);
}

#[test]
fn parallel_frames_equal_sequential_frames() {
    let include = "#declare Ball = sphere { clock*x, 0.8 pigment { bozo } }\n";
    let text = format!("{TELLING}#include \"ball.inc\"\nobject {{ Ball translate y }}\n");
    let files = [("s.pov", text.as_str()), ("ball.inc", include)];
    let (together, alone) = (folder(&files), folder(&files));
    let arguments = ["+Is.pov", "+W64", "+H48", "+A", "+KFF12"];
    let side_by_side = [&arguments[..], &["+WT4"]].concat();
    let (is_done, lines) = run(&support::renderer(), together.path(), &side_by_side);
    assert!(is_done);
    let mut each = Vec::new();
    for number in 1..=12 {
        let part = [format!("+SF{number}"), format!("+EF{number}")];
        let part = [&arguments[..], &[&part[0], &part[1], "+WT1"]].concat();
        each.extend(run(&support::renderer(), alone.path(), &part).1);
    }
    assert_eq!(lines, each);
    let names = pictures(together.path());
    assert_eq!(names.len(), 13, "12 pictures and the include file");
    for name in names {
        let bytes = |folder: &Path| fs::read(folder.join(&name)).expect("a file");
        assert_eq!(bytes(together.path()), bytes(alone.path()), "{name}");
    }
}

/// A scene may pass data on to its next frame by a file, from any frame on.
#[test]
fn a_frame_reads_what_the_one_before_it_wrote() {
    let text = format!(
        "{TELLING}#if (frame_number > 3)
#declare N = 0;
#if (file_exists(\"state.txt\")) #fopen In \"state.txt\" read #read (In, N) #fclose In #end
#debug concat(\"@ N \", str(N, 0, 0), \"\\n\")
#fopen Out \"state.txt\" write #write (Out, N + 1) #fclose Out
#end\n"
    );
    let ours = folder(&[("s.pov", &text)]);
    let arguments = ["+Is.pov", "+W4", "+H3", "+KFF9", "+WT4"];
    let (is_done, lines) = run(&support::renderer(), ours.path(), &arguments);
    assert!(is_done);
    let counted: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.strip_prefix("@ N "))
        .collect();
    assert_eq!(counted, ["0", "1", "2", "3", "4", "5"]);
    assert_eq!(
        fs::read_to_string(ours.path().join("state.txt"))
            .unwrap()
            .trim(),
        "6"
    );
    let numbers = lines.iter().filter(|line| line.contains(" 1")).count();
    assert!(numbers >= 9, "each frame is told once: {lines:?}");
    assert_eq!(pictures(ours.path()).len(), 10);
}
