//! Files that scenes write, and disks and folders that take no more.

use super::{batch, command, folder, pictures, ran, scene, support, text};
use std::fs;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn failures_are_reported_though_the_log_cannot_be_written() {
    let scenes = folder(&[("a.pov", &scene("#include \"nowhere.inc\"\n"))]);
    let out = folder(&[]);
    fs::create_dir_all(out.path().join(".povr-batch/all/log.part")).expect("a folder");
    let ran = batch(scenes.path(), out.path(), &[]);
    assert_ne!(ran.code, Some(0));
    for says in ["cannot find the include file", "1 failed", "cannot write"] {
        assert!(ran.stderr.contains(says), "{says}: {}", ran.stderr);
    }
}

/// Scenes that write files of the same name would disturb each other.
#[test]
fn scenes_that_write_files_are_drawn_alone() {
    let writing = |number: usize| {
        scene(&format!(
            "#fopen Out \"note.txt\" write #write (Out, {number}) #fclose Out
#declare I = 0; #while (I < 20000) #declare I = I + 1; #end
#fopen In \"note.txt\" read #read (In, Seen) #fclose In
#if (Seen != {number}) #error \"another scene has written here\" #end\n"
        ))
    };
    let texts: Vec<(String, String)> = (0..12)
        .map(|number| (format!("s{number}.pov"), writing(number)))
        .collect();
    let files: Vec<(&str, &str)> = texts
        .iter()
        .map(|(n, t)| (n.as_str(), t.as_str()))
        .collect();
    let (scenes, out, here) = (folder(&files), folder(&[]), folder(&[]));
    let mut run = command(&[text(scenes.path()), "-o", text(out.path()), "--jobs", "6"]);
    let ran = ran(run.current_dir(here.path()));
    assert_eq!(
        (ran.code, ran.drawn().len()),
        (Some(0), 12),
        "{}",
        ran.stderr
    );
}

/// Frames that pass files on to each other are drawn in their order, and not in parts.
#[test]
fn frames_that_pass_files_on_are_drawn_in_order() {
    let counting = scene(
        "#declare N = 0;
#if (file_exists(\"count.txt\")) #fopen In \"count.txt\" read #read (In, N) #fclose In #end
#if (N != frame_number - 1) #error concat(\"it is \", str(N, 0, 0)) #end
#fopen Out \"count.txt\" write #write (Out, N + 1) #fclose Out\n",
    );
    let scenes = folder(&[
        ("a.pov", &counting),
        ("a.ini", "Final_Frame=9\n"),
        ("b.pov", &scene("")),
    ]);
    let (out, part) = (folder(&[]), folder(&[]));
    let run = |out: &Path, more: &[&str]| {
        let mut run = command(&[&[text(scenes.path()), "-o", text(out)], more].concat());
        let here = folder(&[]);
        ran(run.current_dir(here.path()))
    };
    let whole = run(out.path(), &["--jobs", "4"]);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    assert_eq!(pictures(out.path()).len(), 10);
    let of_two = run(part.path(), &["--shard", "1/2"]);
    assert_eq!(of_two.code, Some(1));
    assert!(
        of_two.why("a.pov").contains("without `--shard`"),
        "{}",
        of_two.stderr
    );
}

#[test]
fn a_full_disk_ends_scenes_and_leaves_the_rest() {
    let files: Vec<(String, String)> = (0..6)
        .map(|number| (format!("s{number}.pov"), scene("")))
        .collect();
    let files: Vec<(&str, &str)> = files
        .iter()
        .map(|(n, t)| (n.as_str(), t.as_str()))
        .collect();
    let (scenes, disk) = (folder(&files), folder(&[]));
    // A limit on the size of a file; root can mount a disk of that size instead, which is closer to a full disk.
    let mounted = Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=96k", "tmpfs", text(disk.path())])
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    let switches = ["+FB", "--size", "120x100"];
    let arguments = [
        &[text(scenes.path()), "-o", text(disk.path())],
        &switches[..],
    ]
    .concat();
    let ended = if mounted {
        let ended = ran(&mut command(&arguments));
        let left = pictures(disk.path());
        let unmounted = Command::new("umount").arg(disk.path()).status();
        assert!(unmounted.is_ok_and(|status| status.success()));
        let bytes = left.values().map(Vec::len).max().unwrap_or_default();
        assert!(
            left.values().all(|picture| picture.len() == bytes),
            "a half picture"
        );
        assert_eq!(left.len(), ended.drawn().len());
        assert!(
            (1..6).contains(&left.len()),
            "{}: {}",
            left.len(),
            ended.stderr
        );
        ended
    } else {
        let povr = support::renderer().into_string().expect("a plain name");
        let line = format!(
            "trap '' XFSZ; ulimit -f 16; exec {povr} batch --json {}",
            arguments.join(" ")
        );
        ran(Command::new("sh").args(["-c", &line]))
    };
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    let has_hint = ended.stderr.contains("hint: Make room and run it again");
    assert!(has_hint, "{}", ended.stderr);
}

#[test]
fn a_folder_that_cannot_be_written_to_ends_its_scenes() {
    let scenes = folder(&[
        ("a.pov", &scene("")),
        ("in/b.pov", &scene("")),
        ("locked/c.pov", &scene("")),
    ]);
    let out = folder(&[("in", "a file where a folder is to be")]);
    let locked = out.path().join("locked");
    fs::create_dir(&locked).unwrap();
    let open = |path: &Path, mode: u32| {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    };
    open(scenes.path(), 0o755);
    open(out.path(), 0o777);
    open(&locked, 0o555);
    let mut run = command(&[text(scenes.path()), "-o", text(out.path())]);
    // No permission keeps root out.
    if Command::new("id")
        .arg("-u")
        .output()
        .is_ok_and(|id| id.stdout == b"0\n")
    {
        run.uid(65534);
    }
    let ran = ran(run.current_dir("/"));
    open(&locked, 0o755);
    assert_eq!(
        (ran.code, ran.drawn()),
        (Some(1), vec!["a".to_owned()]),
        "{}",
        ran.stderr
    );
    assert!(
        ran.why("in/b.pov").contains("cannot make"),
        "{}",
        ran.why("in/b.pov")
    );
    assert!(
        ran.why("locked/c.pov").contains("cannot write"),
        "{}",
        ran.why("locked/c.pov")
    );
    assert!(
        ran.stderr.contains("hint: It is not open to you"),
        "{}",
        ran.stderr
    );
}
