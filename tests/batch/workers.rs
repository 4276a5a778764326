//! The worker processes of a batch: failures, limits and the sandbox of single scenes.

use super::{batch, command, files, folder, many_scenes, pictures, ran, scene, support, text};
use std::fs;
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A scene that takes minutes.
const SLOW: &str = "sphere { 0, 3 hollow pigment { rgbt 1 }
interior { media { scattering { 1, 1 } intervals 1000 samples 1000 } } }\n";

/// A scene that is read without end.
const ENDLESS: &str = "#declare A = 1; #while (A > 0) #declare A = sin(A) + 2; #end\n";

/// Waits until something is so.
fn wait_until(is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(30));
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_scene_that_brings_its_process_down_fails_alone() {
    let scenes = folder(&[
        ("a_slow.pov", &scene(SLOW)),
        ("b_right.pov", &scene("")),
        ("c_right.pov", &scene("box { 1, 2 }\n")),
    ]);
    let out = folder(&[]);
    let run = command(&[text(scenes.path()), "-o", text(out.path()), "--jobs", "1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("povr starts");
    wait_until(|| !support::children(run.id()).is_empty());
    // Not while it is started.
    std::thread::sleep(Duration::from_millis(300));
    for child in support::children(run.id()) {
        let killed = Command::new("kill").args(["-ABRT", &child]).status();
        assert!(killed.expect("there is `kill`").success());
    }
    let output = run.wait_with_output().expect("povr ends");
    let log = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(1), "{log}");
    let lost = log.lines().find(|line| line.contains("a_slow")).unwrap();
    let says = "its process ended (signal: 6 (SIGABRT)";
    assert!(lost.contains(says), "{lost}");
    let names: Vec<PathBuf> = pictures(out.path()).into_keys().collect();
    assert_eq!(names, ["b_right.png", "c_right.png"].map(PathBuf::from));
}

#[test]
fn a_timeout_ends_a_worker_that_is_stopped() {
    let scenes = folder(&[("a_slow.pov", &scene(SLOW)), ("b_right.pov", &scene(""))]);
    let out = folder(&[]);
    let more = ["--jobs", "2", "--timeout", "3s"];
    let run = command(&[&[text(scenes.path()), "-o", text(out.path())], &more[..]].concat())
        .stdout(Stdio::piped())
        .spawn()
        .expect("povr starts");
    wait_until(|| out.path().join("b_right.png").exists());
    // An idle worker is ended.
    wait_until(|| support::children(run.id()).len() == 1);
    let start = Instant::now();
    for child in support::children(run.id()) {
        let stopped = Command::new("kill").args(["-STOP", &child]).status();
        assert!(stopped.expect("there is `kill`").success());
    }
    let output = run.wait_with_output().expect("povr ends");
    assert!(start.elapsed() < Duration::from_secs(20));
    let log = String::from_utf8_lossy(&output.stdout).into_owned();
    let lost = log.lines().find(|line| line.contains("a_slow")).unwrap();
    assert!(lost.contains("it took longer than 3s"), "{lost}");
}

#[test]
fn an_interrupt_leaves_no_temporary_files_of_scenes() {
    let writes = "#fopen F \"mine.txt\" write\n#write (F, \"text\")\n";
    let scenes = folder(&[("a.pov", &scene(&format!("{writes}{ENDLESS}")))]);
    let out = folder(&[]);
    let mut run = command(&[text(scenes.path()), "-o", text(out.path())])
        .current_dir(scenes.path())
        .process_group(0)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("povr starts");
    let has_part = || {
        let mut names = files(scenes.path()).into_keys();
        names.any(|name| name.to_string_lossy().contains(".povr-"))
    };
    wait_until(has_part);
    let group = format!("-{}", run.id());
    let interrupted = Command::new("kill").args(["-INT", "--", &group]).status();
    assert!(interrupted.expect("there is `kill`").success());
    let _ = run.wait();
    wait_until(|| !has_part());
}

#[test]
fn scenes_are_drawn_by_the_workers_that_can_be_started() {
    let scenes = many_scenes(60);
    let out = folder(&[]);
    let command =
        "ulimit -n 24; exec \"$0\" batch \"$1\" -o \"$2\" --json --size 32x24 --threads 16";
    let mut run = Command::new("sh");
    run.args(["-c", command])
        .arg(support::renderer())
        .args([scenes.path(), out.path()])
        .stdin(Stdio::null());
    let ran = ran(&mut run);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(ran.drawn().len(), 60);
}

#[test]
fn workers_start_only_their_share_of_threads() {
    let names = ["a.pov", "b.pov", "c.pov", "d.pov", "e.pov", "f.pov"];
    let slow = scene(SLOW);
    let scenes = folder(&names.map(|name| (name, &*slow)));
    let out = folder(&[]);
    let more = ["--jobs", "4", "--threads", "16"];
    let mut run = command(&[&[text(scenes.path()), "-o", text(out.path())], &more[..]].concat())
        .stdout(Stdio::null())
        .spawn()
        .expect("povr starts");
    wait_until(|| support::children(run.id()).len() == 4);
    std::thread::sleep(Duration::from_secs(1));
    let threads = |process: &String| {
        let tasks = fs::read_dir(format!("/proc/{process}/task"));
        tasks.map_or(0, Iterator::count)
    };
    let counts: Vec<usize> = support::children(run.id()).iter().map(threads).collect();
    let _ = (run.kill(), run.wait());
    // Four that draw; the others receive requests and read the scene.
    assert!(
        counts.iter().all(|&count| (4..10).contains(&count)),
        "{counts:?}"
    );
}

/// Kills a run with two workers, which have received a signal before, and waits for their ends.
fn kill_run(signal: Option<&str>) {
    let scenes = folder(&[("a.pov", &scene(SLOW)), ("b.pov", &scene(SLOW))]);
    let out = folder(&[]);
    let mut run = command(&[text(scenes.path()), "-o", text(out.path()), "--jobs", "2"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("povr starts");
    wait_until(|| support::children(run.id()).len() == 2);
    let processes = support::children(run.id());
    if let Some(signal) = signal {
        // Not while they are started.
        std::thread::sleep(Duration::from_millis(500));
        let sent = Command::new("kill").arg(signal).args(&processes).status();
        assert!(sent.expect("there is `kill`").success());
    }
    let _ = (run.kill(), run.wait());
    // A zombie waits for another parent, and has no memory.
    let is_running = |process: &String| {
        let status = fs::read_to_string(format!("/proc/{process}/status"));
        status.is_ok_and(|status| status.contains("VmRSS"))
    };
    wait_until(|| !processes.iter().any(is_running));
}

#[test]
fn no_process_outlives_a_run_that_is_killed() {
    kill_run(None);
}

#[cfg(target_os = "linux")]
#[test]
fn no_stopped_process_outlives_a_run_that_is_killed() {
    kill_run(Some("-STOP"));
}

#[test]
fn a_message_that_is_too_long_fails_its_scene_alone() {
    let long =
        "#declare S = \"aaaaaaaa\"; #for (I, 1, 20) #declare S = concat(S, S) #end\n#error S\n";
    let scenes = folder(&[("a_long.pov", &scene(long)), ("b_right.pov", &scene(""))]);
    let out = folder(&[]);
    let mut run = Command::new(support::renderer());
    run.args([
        "batch",
        text(scenes.path()),
        "-o",
        text(out.path()),
        "--json",
    ]);
    let ran = ran(run.args(["--size", "32x24", "--jobs", "1"]));
    assert_eq!(ran.drawn(), ["b_right"], "{}", ran.stderr);
    let why = ran.why("a_long.pov");
    let says = "a message of this scene cannot be passed on: it takes";
    assert!(
        why.contains(says) && why.ends_with("16 MB are the limit"),
        "{why}"
    );
}

#[test]
fn limits_hold_for_each_scene() {
    let scenes = folder(&[
        ("a_slow.pov", &scene(SLOW)),
        ("b_right.pov", &scene("")),
        ("c_large.pov", &scene("")),
        ("c_large.ini", "Width=9000\nHeight=9000\n"),
        ("d_right.pov", &scene("box { 1, 2 }\n")),
    ]);
    let out = folder(&[]);
    let mut run = Command::new(support::renderer());
    run.arg("batch")
        .args([text(scenes.path()), "-o", text(out.path()), "--json"])
        .args([
            "--timeout",
            "2s",
            "--max-memory",
            "150M",
            "-A",
            "+W32",
            "+H24",
        ]);
    // The size of the command line comes after that of the ini file.
    let sized = ran(run.args(["--only", "[abd]*"]));
    assert_eq!(sized.drawn(), ["b_right", "d_right"], "{}", sized.stderr);
    let why = sized.why("a_slow.pov");
    assert!(why.contains("it took longer than 2s, which"), "{why}");
    let mut run = Command::new(support::renderer());
    run.arg("batch")
        .args([text(scenes.path()), "-o", text(out.path()), "--json", "-A"])
        .args(["--max-memory", "150M", "--only", "c*"]);
    let why = ran(&mut run).why("c_large.pov");
    assert!(why.contains("more memory than the 150 MB that"), "{why}");
}

#[test]
fn a_sandbox_gives_the_same_pictures() {
    let scenes = folder(&[
        ("a/a.pov", &scene("#include \"a.inc\"\n")),
        ("a/a.inc", "box { 1, 2 }"),
        ("b/b.pov", &scene("")),
        ("b/b.ini", "Final_Frame=3\n"),
    ]);
    let [out, sandboxed] = [folder(&[]), folder(&[])];
    let frames = "+KFF3";
    assert_eq!(batch(scenes.path(), out.path(), &[frames]).code, Some(0));
    let ran = batch(scenes.path(), sandboxed.path(), &[frames, "--sandbox"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(pictures(sandboxed.path()), pictures(out.path()));
}
