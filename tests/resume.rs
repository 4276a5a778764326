//! `+C`: a drawing killed at any moment is resumed, and the picture is the same, bit for bit.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

/// Slow enough to be killed in the middle: some seconds in a debug build.
const SCENE: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 area_light 2*x, 2*z, LAMPS, LAMPS adaptive 4 }
plane { y, -1 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } finish { reflection 0.2 } }
sphere { <-1.2, 0, 0>, 1 pigment { rgbf <0.9, 0.95, 1, 0.9> } interior { ior 1.5 } }
torus { 0.8, 0.2 rotate 60*x translate 1.2*x pigment { rgb <0.8, 0.5, 0.2> } }";

/// Sampling options: POV-Ray's antialiasing, none, and an error target; with the area light samples on a side, so that
/// each takes its time.
const CASES: [(&[&str], &str); 3] = [
    (&["+A0.1", "+R3"], "4"),
    (&["-A"], "12"),
    (&["--error", "4"], "4"),
];

fn povr(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_povr"));
    command
        .current_dir(folder)
        .args(["s.pov", "+W120", "+H90", "+WT2", "-o", "s.png"])
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command
}

fn ended(folder: &Path, arguments: &[&str]) -> Output {
    let output = povr(folder, arguments).output().expect("povr starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

fn started(folder: &Path, arguments: &[&str]) -> Child {
    povr(folder, arguments).spawn().expect("povr starts")
}

/// A folder with the scene, whose area light has this many samples on a side.
fn folder(area_samples: &str) -> tempfile::TempDir {
    let here = tempfile::tempdir().expect("a folder");
    write(here.path(), area_samples);
    here
}

fn write(folder: &Path, area_samples: &str) {
    fs::write(folder.join("s.pov"), SCENE.replace("LAMPS", area_samples)).expect("a scene");
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder");
    let mut names: Vec<String> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

#[test]
fn a_drawing_killed_at_any_moment_resumes_to_the_same_picture() {
    for (arguments, area_samples) in CASES {
        // On a loaded machine every drawing may end before it is killed.
        let went_on = (0..3).any(|_| kill_often(arguments, area_samples) > 0);
        assert!(went_on, "{arguments:?} never went on");
    }
}

/// Kills drawings at many moments, checks the results, and returns how many were resumed.
fn kill_often(arguments: &[&str], area_samples: &str) -> usize {
    let whole = folder(area_samples);
    let start = std::time::Instant::now();
    ended(whole.path(), arguments);
    let took = start.elapsed();
    let expected = fs::read(whole.path().join("s.png")).expect("a picture");
    let with_c: Vec<&str> = arguments.iter().copied().chain(["+C"]).collect();
    let mut went_on = 0;
    // From before the first tile to after the last; each kill adds to the state of those before.
    let broken = folder(area_samples);
    let mut kills = 0;
    for moment in 1..=17_u32 {
        let mut child = started(broken.path(), &with_c);
        std::thread::sleep(took.mul_f64(f64::from(moment * 7 % 17) / 26.0));
        child.kill().expect("it is there");
        child.wait().expect("it ends");
        kills += 1;
        let names = names(broken.path());
        let is_done = names.contains(&"s.png".to_owned());
        if is_done || kills % 4 == 0 {
            let said = if is_done {
                String::new()
            } else {
                let output = ended(broken.path(), &with_c);
                String::from_utf8_lossy(&output.stderr).into_owned()
            };
            went_on += usize::from(said.contains("resuming: "));
            let actual = fs::read(broken.path().join("s.png")).expect("a picture");
            assert!(
                actual == expected,
                "{arguments:?} differs after {kills} kills: {said}"
            );
            let left = self::names(broken.path());
            let is_clean = left.iter().all(|name| !name.ends_with(".povr-state"));
            assert!(is_clean || is_done, "{left:?}");
            fs::remove_file(broken.path().join("s.png")).expect("it is there");
        }
    }
    went_on
}

#[test]
fn another_scene_or_other_options_start_anew() {
    let here = folder("9");
    let here = here.path();
    let killed = |arguments: &[&str]| {
        let mut child = started(here, arguments);
        for _ in 0..2000 {
            std::thread::sleep(Duration::from_millis(5));
            let state = fs::metadata(here.join("s.png.povr-state"));
            if state.is_ok_and(|about| about.len() > 20_000) {
                break;
            }
        }
        child.kill().expect("it is there");
        child.wait().expect("it ends");
    };
    let anew = "ignoring the saved state: it belongs to another scene, other options or another version of povr";
    killed(&["+A0.1", "+C"]);
    let said = ended(here, &["+A0.2", "+C"]).stderr;
    assert!(String::from_utf8_lossy(&said).contains(anew));
    fs::remove_file(here.join("s.png")).expect("a picture");
    killed(&["+A0.1", "+C"]);
    write(here, "4");
    let said = ended(here, &["+A0.1", "+C"]).stderr;
    assert!(String::from_utf8_lossy(&said).contains(anew));
    let continued = fs::read(here.join("s.png")).expect("a picture");
    ended(here, &["+A0.1"]);
    assert!(fs::read(here.join("s.png")).expect("a picture") == continued);
    // As in POV-Ray, a complete picture is not drawn again.
    let said = ended(here, &["+A0.1", "+C"]).stderr;
    assert!(String::from_utf8_lossy(&said).contains("skipping, as `+C` has it"));
    assert_eq!(names(here), ["s.png", "s.pov"]);
}

#[test]
fn a_drawing_without_the_switch_can_be_resumed_too() {
    let here = folder("17");
    let here = here.path();
    let mut child = started(here, &["+A0.0", "+R9"]);
    let state = here.join("s.png.povr-state");
    // After two seconds, as soon as another tile is drawn.
    let has_piece = || fs::metadata(&state).is_ok_and(|about| about.len() > 1000);
    for _ in 0..6000 {
        std::thread::sleep(Duration::from_millis(10));
        if has_piece() {
            break;
        }
    }
    child.kill().expect("it is there");
    child.wait().expect("it ends");
    assert!(has_piece(), "it takes more than two seconds");
    // Quiet runs print nothing; with changed options the old state is replaced once there is a new one.
    let output = ended(here, &["-A", "+Q1", "--quiet"]);
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert_eq!(names(here), ["s.png", "s.pov"]);
}
