//! Output of the program while it draws: on a terminal, through a pipe, under the name `povray`, and when it is
//! interrupted.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const SCENE: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location -4*z look_at 0 } light_source { <5, 5, -5>, 1 }
sphere { 0, 1 pigment { rgb 1 } }
";

/// Three independent mistakes.
const WRONG: &str = "#version 3.7; global_settings { assumed_gamma 1 }
sphere { 0, 1 pigmnet { rgb 1 } }
light_sorce { 0, 1 }
box { 0, 1 pigment { rgb Rod } }
";

/// Some seconds of work, more at 2000x1500.
const SLOW: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 area_light 2*x, 2*z, 17, 17 adaptive 4 }
plane { y, -1 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } finish { reflection 0.2 } }
sphere { <-1.2, 0, 0>, 1 pigment { rgbf <0.9, 0.95, 1, 0.9> } interior { ior 1.5 } }
";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [("s.pov", SCENE), ("wrong.pov", WRONG), ("slow.pov", SLOW)] {
        fs::write(folder.path().join(name), text).expect("a scene");
    }
    symlink(env!("CARGO_BIN_EXE_povr"), folder.path().join("povray")).expect("a link");
    folder
}

/// Runs povr on a terminal; returns its text and its exit code.
fn on_a_terminal(folder: &Path, arguments: &str) -> (String, Option<i32>) {
    let output = Command::new("script")
        .args([
            "-qec",
            &format!("{} {arguments}", env!("CARGO_BIN_EXE_povr")),
        ])
        .arg("/dev/null")
        .current_dir(folder)
        .env("TERM", "xterm")
        .env("HOME", folder)
        .env_remove("NO_COLOR")
        .stdin(Stdio::null())
        .output()
        .expect("`script` of util-linux makes a terminal");
    let said = String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n");
    (said, output.status.code())
}

/// Runs a program whose output goes to pipes.
fn through_a_pipe(folder: &Path, program: &str, arguments: &str) -> Output {
    Command::new(program)
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env("HOME", folder)
        .stdin(Stdio::null())
        .output()
        .expect("it starts")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Counts the occurrences of a text.
fn count(text: &str, part: &str) -> usize {
    text.matches(part).count()
}

#[test]
fn people_see_an_error_once_with_its_lines_and_in_colour() {
    let folder = folder();
    let (said, code) = on_a_terminal(folder.path(), "wrong.pov +W8 +H6");
    assert_eq!(code, Some(1), "{said}");
    assert_eq!(count(&said, "undeclared identifier `pigmnet`"), 1, "{said}");
    assert!(said.contains("\x1b["), "{said}");
    assert!(!said.contains("Parse Error"), "{said}");
    assert!(said.contains("wrong.pov:2:15"), "{said}");
    assert!(said.contains("sphere { 0, 1 pigmnet { rgb 1 } }"), "{said}");
    assert!(said.ends_with("wrong.pov: 3 errors\n"), "{said}");
}

#[test]
fn people_are_warned_of_a_picture_of_one_colour() {
    let folder = folder();
    let flat = SCENE.replace("look_at 0", "look_at -9*z");
    fs::write(folder.path().join("flat.pov"), &flat).expect("a scene");
    let allowed = format!("// povr: allow one-color\n{flat}");
    fs::write(folder.path().join("allowed.pov"), allowed).expect("a scene");
    for (name, is_warned) in [("flat", true), ("allowed", false), ("s", false)] {
        let (said, _) = on_a_terminal(folder.path(), &format!("{name}.pov +W64 +H48"));
        assert_eq!(said.contains("[one-color]"), is_warned, "{said}");
    }
    let output = through_a_pipe(
        folder.path(),
        env!("CARGO_BIN_EXE_povr"),
        "flat.pov +W64 +H48",
    );
    assert_eq!(said(&output), "");
}

#[test]
fn a_console_switch_selects_povrays_format() {
    let folder = folder();
    for switch in ["+GD", "-GW", "-GA", "--message-format povray"] {
        let (said, _) = on_a_terminal(folder.path(), &format!("wrong.pov +W8 +H6 {switch}"));
        let line = "File 'wrong.pov' line 2: Parse Error: expected a modifier";
        assert_eq!(count(&said, line), 1, "{switch}: {said}");
        assert!(!said.contains("\x1b["), "{switch}: {said}");
    }
    let (said, _) = on_a_terminal(
        folder.path(),
        "wrong.pov +W8 +H6 -GA --message-format human",
    );
    assert!(
        said.contains("\x1b[") && !said.contains("Parse Error"),
        "{said}"
    );
}

#[test]
fn programs_get_one_line_for_each_error() {
    let folder = folder();
    let output = through_a_pipe(
        folder.path(),
        env!("CARGO_BIN_EXE_povr"),
        "wrong.pov +W8 +H6",
    );
    let said = said(&output);
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 4, "{said}");
    for (line, number) in lines.iter().zip(2..5) {
        let begin = format!("File 'wrong.pov' line {number}: Parse Error: ");
        assert!(line.starts_with(&begin), "{line}");
    }
    assert!(lines[0].ends_with("(Did you mean `pigment`?)"), "{said}");
    assert_eq!(lines[3], "wrong.pov: 3 errors");
}

#[test]
fn a_finished_picture_is_reported_only_on_a_terminal() {
    let folder = folder();
    let line = |said: &str| {
        let mut lines = said
            .lines()
            .map(|line| line.rsplit(['\r', 'K']).next().unwrap_or(line));
        let ready = lines.find(|line| line.starts_with("s.png  8x6  ") && line.ends_with(" s"));
        ready.is_some()
    };
    let (said, code) = on_a_terminal(folder.path(), "s.pov +W8 +H6");
    assert_eq!(code, Some(0), "{said}");
    assert!(line(&said), "{said:?}");
    for switch in ["--quiet", "-GA", "--json"] {
        let (said, _) = on_a_terminal(folder.path(), &format!("s.pov +W8 +H6 {switch}"));
        assert!(!line(&said), "{switch}: {said:?}");
    }
    let (said, _) = on_a_terminal(folder.path(), "s.pov +W8 +H6 +KFF3");
    assert!(said.contains("s1.png to s3.png  8x6  "), "{said:?}");
    let output = through_a_pipe(folder.path(), env!("CARGO_BIN_EXE_povr"), "s.pov +W8 +H6");
    assert_eq!(self::said(&output), "");
}

#[test]
fn help_is_a_command_too() {
    let folder = folder();
    let text = |arguments: &str| {
        let output = through_a_pipe(folder.path(), env!("CARGO_BIN_EXE_povr"), arguments);
        (output.status.code(), said(&output))
    };
    assert_eq!(text("help"), text("--help"));
    for command in [
        "batch", "check", "compare", "curve", "man", "sheet", "watch", "help",
    ] {
        let (code, help) = text(&format!("help {command}"));
        assert_eq!(code, Some(0), "{help}");
        assert_eq!((code, help), text(&format!("{command} --help")));
    }
    assert_eq!(
        text("help wacth"),
        (
            Some(2),
            "povr: there is no command `wacth`\n  hint: Did you mean `watch`?\n".to_owned()
        )
    );
    for command in ["curve", "watch"] {
        let (code, refusal) = text(command);
        assert_eq!(code, Some(2));
        assert_eq!(
            refusal,
            format!(
                "povr: no scene is named\n  hint: Write `povr {command} scene.pov`, or `povr {command} --help`.\n"
            )
        );
    }
}

/// The lines on standard error that other programs wait for, as POV-Ray 3.7 writes them. The progress line is put last:
/// another thread of POV-Ray writes it, now and then before the title of the stage.
fn signs(said: &str) -> Vec<String> {
    const ALL_DONE: &str = "Rendered 48 of 48 pixels (100%)";
    let lines = said.split(['\r', '\n']).map(str::trim_end);
    let mut signs: Vec<String> = lines
        .filter(|line| {
            line.starts_with("==== [")
                || line.starts_with("  Image resolution.")
                || line.starts_with("  Input file: ")
                || line.starts_with("Render Time:")
                || *line == ALL_DONE
                || line.starts_with("Rendering frame ")
                || line.starts_with("Render failed")
                || line.starts_with("POV-Ray finished")
                || line.starts_with("Fatal error in parser")
        })
        .map(str::to_owned)
        .collect();
    signs.sort_by_key(|line| line == ALL_DONE);
    signs.dedup();
    signs
}

#[test]
fn under_the_name_povray_it_prints_povrays_messages() {
    let folder = folder();
    let own = folder.path().join("povray").display().to_string();
    for arguments in [
        "+Is.pov +W8 +H6 -D",
        "+Is.pov +W8 +H6 -D -GA",
        "+Is.pov +W8 +H6 -D -GR -GS",
        "+Iwrong.pov +W8 +H6 -D",
        "+Iwrong.pov +W8 +H6 -D -GA",
    ] {
        let actual = through_a_pipe(folder.path(), &own, arguments);
        let expected = through_a_pipe(folder.path(), "povray", arguments);
        assert_eq!(actual.status.code(), expected.status.code(), "{arguments}");
        assert_eq!(
            signs(&said(&actual)),
            signs(&said(&expected)),
            "{arguments}"
        );
        assert!(actual.stdout.is_empty());
    }
    let said = said(&through_a_pipe(folder.path(), &own, "+Is.pov +W8 +H6 -D"));
    let banner = "Persistence of Vision(tm) Ray Tracer Version 3.7.";
    assert!(
        said.starts_with(banner) && said.contains("This is povr "),
        "{said}"
    );
    assert!(!said.contains("Copyright"), "{said}");
    let quiet = through_a_pipe(folder.path(), &own, "+Is.pov +W8 +H6 -D --quiet");
    assert_eq!(self::said(&quiet), "");
}

#[test]
fn under_the_name_povray_it_has_povrays_version_and_no_commands() {
    let folder = folder();
    let own = folder.path().join("povray").display().to_string();
    for argument in ["--version", "-version"] {
        let output = through_a_pipe(folder.path(), &own, argument);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(said.starts_with("POV-Ray 3.7.0"), "{said}");
        assert!(said.contains("This is povr "), "{said}");
    }
    let output = through_a_pipe(folder.path(), &own, "check");
    assert_eq!(output.status.code(), Some(1));
}

/// Starts a drawing, sends a signal once some of its state is stored, and returns its result.
fn interrupted(folder: &Path, program: &str, state_name: &str, signal: &str) -> Output {
    let state = folder.join(state_name);
    let child = Command::new(program)
        .args(["slow.pov", "+W2000", "+H1500", "+A0.1", "+R3", "-D"])
        .current_dir(folder)
        .env("HOME", folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let start = Instant::now();
    while fs::metadata(&state).map_or(0, |state| state.len()) < 20_000 {
        assert!(start.elapsed() < Duration::from_secs(60), "nothing is kept");
        std::thread::sleep(Duration::from_millis(20));
    }
    let sent = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(sent.expect("`kill` runs").success());
    child.wait_with_output().expect("it ends")
}

#[test]
fn an_interrupted_drawing_ends_like_povrays_and_can_be_resumed() {
    for signal in ["-INT", "-TERM"] {
        let folder = folder();
        let theirs = interrupted(folder.path(), "povray", "slow.pov-state", signal);
        assert!(!folder.path().join("slow.png").exists());
        let ours = env!("CARGO_BIN_EXE_povr");
        let ours = interrupted(folder.path(), ours, "slow.png.povr-state", signal);
        assert_eq!(ours.status.code(), theirs.status.code(), "{signal}");
        assert!(!folder.path().join("slow.png").exists());
        assert!(folder.path().join("slow.png.povr-state").exists());
        let said = said(&ours);
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(
            said.starts_with("povr: interrupted; ")
                && said.ends_with(
                    " of 3000000 pixels are saved: the same command with `+C` resumes\n"
                ),
            "{said}"
        );
    }
}

#[test]
fn an_interrupted_reading_ends_with_the_same_code() {
    let folder = folder();
    // Seconds of work even in an optimised build.
    let long = "#declare I = 0; #while (I < 1e8) #declare I = I + 1; \
        #declare S = concat(\"a\", str(I, 0, 3)); #declare V = vnormalize(<I, sin(I), strlen(S)>); #end";
    fs::write(folder.path().join("long.pov"), long).expect("a scene");
    let child = Command::new(env!("CARGO_BIN_EXE_povr"))
        .args(["long.pov", "+W8", "+H6"])
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    std::thread::sleep(Duration::from_millis(500));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.expect("`kill` runs").success());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(said(&output), "povr: interrupted; nothing is saved\n");
}
