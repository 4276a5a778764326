//! `povr batch`: the pictures it draws and skips, and its recovery after kills and faulty scenes.

#![cfg(unix)]

mod disk;
#[path = "../support/mod.rs"]
mod support;
#[cfg(target_os = "linux")]
mod workers;

use proptest::prelude::{ProptestConfig, any};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Number of times a run is killed.
const KILLS: usize = 50;

const SCENES: usize = 200;

const HEAD: &str = "#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -7> look_at 0 angle 45 }
light_source { <-4, 6, -8>, rgb 1 }
";

const SPHERE: &str = "sphere { 0, 1.5 pigment { rgb <0.9, 0.5, 0.2> } finish { phong 0.5 } }\n";

/// A folder with these files, given as names and texts.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }
    folder
}

fn scene(more: &str) -> String {
    format!("// A small scene.\n{HEAD}{SPHERE}{more}")
}

/// The result of a run: its exit code, the lines of its log, and its standard error.
struct Ran {
    code: Option<i32>,
    log: Vec<Value>,
    stderr: String,
}

impl Ran {
    /// The status of each picture, by its scene's name.
    fn status(&self) -> BTreeMap<String, String> {
        let pictures = self.log.iter().filter(|line| line["type"] == "picture");
        let pair = |line: &Value| {
            let name = Path::new(line["scene"].as_str()?).file_stem()?;
            let status = line["status"].as_str()?.to_owned();
            Some((name.to_string_lossy().into_owned(), status))
        };
        pictures.filter_map(pair).collect()
    }

    /// The scenes that were drawn.
    fn drawn(&self) -> Vec<String> {
        let all = self.status().into_iter();
        all.filter(|(_, status)| status == "drawn")
            .map(|(name, _)| name)
            .collect()
    }

    fn why(&self, scene: &str) -> String {
        let is_it = |line: &&Value| line["scene"].as_str().is_some_and(|s| s.ends_with(scene));
        let line = self.log.iter().find(is_it).expect("a line for the scene");
        match line["why"].as_str() {
            Some(why) => why.to_owned(),
            None => line["errors"][0]["message"]
                .as_str()
                .unwrap_or_default()
                .to_owned(),
        }
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(support::renderer());
    command
        .arg("batch")
        .args(["--json", "--size", "32x24"])
        .args(arguments);
    command.stdin(Stdio::null()).env("HOME", "/nonexistent");
    command
}

fn ran(command: &mut Command) -> Ran {
    let output = command.output().expect("povr starts");
    let text = String::from_utf8_lossy(&output.stdout);
    Ran {
        code: output.status.code(),
        log: text
            .lines()
            .map(|line| serde_json::from_str(line).expect("a line of the log"))
            .collect(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a plain name")
}

fn batch(scenes: &Path, out: &Path, more: &[&str]) -> Ran {
    ran(&mut command(
        &[&[text(scenes), "-o", text(out)], more].concat(),
    ))
}

/// All files below a folder with their contents, by their paths there.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut contents = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if let Ok(bytes) = fs::read(&path) {
                let below = path.strip_prefix(folder).expect("it lies below");
                contents.insert(below.to_owned(), bytes);
            }
        }
    }
    contents
}

/// The pictures among files.
fn pictures(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = files(folder);
    files.retain(|path, _| !path.starts_with(".povr-batch"));
    files
}

/// Reproducible numbers from 0 to 1.
fn numbers(count: usize) -> Vec<f64> {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(ProptestConfig::default(), rng);
    let mut number = || {
        any::<u32>()
            .new_tree(&mut runner)
            .expect("a number")
            .current()
    };
    (0..count)
        .map(|_| f64::from(number()) / f64::from(u32::MAX))
        .collect()
}

/// Small scenes in ten folders, most of which take some hundredths of a second at most.
fn many_scenes(count: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let coordinates = numbers(3 * 4 * count);
    for (number, coordinates) in coordinates.chunks(12).enumerate() {
        let group = folder.path().join(format!("g{}", number % 10));
        fs::create_dir_all(&group).expect("a folder");
        let mut text = format!("// Scene {number} of many.\n{HEAD}#include \"colors.inc\"\n");
        for p in coordinates.chunks(3) {
            let (x, y, z) = (4.0 * p[0] - 2.0, 2.0 * p[1] - 1.0, 3.0 * p[2]);
            text += &format!(
                "sphere {{ <{x}, {y}, {z}>, 0.6 pigment {{ Red }} finish {{ reflection 0.2 }} }}\n"
            );
        }
        fs::write(group.join(format!("s{number:03}.pov")), text).expect("a scene");
    }
    folder
}

#[test]
fn a_run_killed_many_times_ends_with_the_files_of_an_uninterrupted_one() {
    let scenes = many_scenes(SCENES);
    let (whole, broken) = (folder(&[]), folder(&[]));
    let started = Instant::now();
    assert_eq!(batch(scenes.path(), whole.path(), &[]).code, Some(0));
    let took = started.elapsed();
    let expected = files(whole.path());
    assert_eq!(pictures(whole.path()).len(), SCENES);
    let mut before = BTreeMap::new();
    let mut moments = 0;
    for share in numbers(KILLS) {
        let mut run = command(&[text(scenes.path()), "-o", text(broken.path())])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("povr starts");
        // Together about as long as the whole run takes, in addition to the start-up time.
        let start = Duration::from_millis(10);
        std::thread::sleep(start + took.mul_f64(2.0 * share / KILLS as f64));
        run.kill().expect("it can be killed");
        let killed = run.wait().expect("it ends").code().is_none();
        moments += usize::from(killed);
        let now = pictures(broken.path());
        for (path, bytes) in &now {
            assert_eq!(
                expected.get(path),
                Some(bytes),
                "a half picture: {}",
                path.display()
            );
        }
        let lost = before.keys().find(|path| !now.contains_key(*path));
        assert_eq!(lost, None, "a picture was lost");
        before = now;
    }
    assert!(moments > KILLS / 2, "only {moments} runs were killed");
    let last = batch(scenes.path(), broken.path(), &[]);
    assert_eq!(last.code, Some(0));
    assert_eq!(files(broken.path()), expected);
    let again = batch(scenes.path(), broken.path(), &[]);
    assert!(again.status().values().all(|status| status == "up-to-date"));
    assert_eq!(files(broken.path()), expected);
}

#[test]
fn pictures_have_the_folder_tree_of_the_scenes() {
    let scenes = folder(&[
        ("a.pov", &scene("")),
        ("in/b.pov", &scene("")),
        ("in/deep/c.d.pov", &scene("")),
        ("old/e.pov", &scene("")),
        ("in/x_test.pov", &scene("")),
        ("in/part.inc", ""),
    ]);
    let out = folder(&[]);
    let ran = batch(
        scenes.path(),
        out.path(),
        &["--exclude", "old", "--exclude", "*_test.pov", "+FJ"],
    );
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let names: Vec<PathBuf> = pictures(out.path()).into_keys().collect();
    let expected = ["a.jpg", "in/b.jpg", "in/deep/c.d.jpg"];
    assert_eq!(names, expected.map(PathBuf::from));
    let pattern = scenes.path().join("in/**/*.pov");
    let second = folder(&[]);
    assert_eq!(
        batch(&pattern, second.path(), &["--only", "deep/*"]).code,
        Some(0)
    );
    let names: Vec<PathBuf> = pictures(second.path()).into_keys().collect();
    assert_eq!(names, [Path::new("deep/c.d.png")]);
}

#[test]
fn pictures_equal_those_of_single_runs_with_the_ini_files_beside_the_scenes() {
    let scenes = folder(&[
        ("a.pov", &scene("#include \"own.inc\"\n")),
        (
            "a.ini",
            "Width=20\nHeight=10\nLibrary_Path=lib\nAntialias=on\n",
        ),
        ("lib/own.inc", "box { <1, -1, -1>, 2 pigment { rgb 1 } }\n"),
        (
            "film.pov",
            &scene("sphere { clock*x, 1 pigment { rgb x } }\n"),
        ),
        (
            "film.ini",
            "Final_Frame=12\nInput_File_Name=film.pov\nOutput_File_Name=other\n",
        ),
    ]);
    let (out, single) = (folder(&[]), folder(&[]));
    let mut run = Command::new(support::renderer());
    run.args(["batch", text(scenes.path()), "-o", text(out.path()), "+Q9"]);
    assert_eq!(ran(&mut run).code, Some(0));
    for ini in ["a.ini", "film.ini"] {
        let mut run = Command::new(support::renderer());
        let stem = ini.trim_end_matches(".ini");
        run.current_dir(scenes.path())
            .args([ini, &format!("+I{stem}.pov"), "+Q9", "--quiet"]);
        run.arg(format!("+O{}/{stem}", single.path().display()));
        assert!(run.status().expect("povr starts").success());
    }
    let actual = pictures(out.path());
    assert_eq!(actual.len(), 13);
    assert!(actual.contains_key(Path::new("film07.png")));
    assert_eq!(actual, pictures(single.path()));
}

#[test]
fn up_to_date_pictures_are_detected_by_content() {
    let scenes = folder(&[
        ("a.pov", &scene("#include \"near.inc\"\n")),
        (
            "b.pov",
            &scene("#include \"colors.inc\"\nbox { 1, 2 pigment { Red } }\n"),
        ),
        ("c.pov", &scene("")),
        ("near.inc", "box { 1, 2 pigment { rgb 1 } }\n"),
    ]);
    let out = folder(&[]);
    let run = |more: &[&str]| batch(scenes.path(), out.path(), more);
    let drawn = |more: &[&str]| run(more).drawn();
    assert_eq!(drawn(&[]), ["a", "b", "c"]);
    assert!(drawn(&[]).is_empty());
    // The same text at another time.
    let path = |name: &str| scenes.path().join(name);
    fs::write(path("a.pov"), scene("#include \"near.inc\"\n")).unwrap();
    assert!(drawn(&[]).is_empty());
    fs::write(path("near.inc"), "box { 1, 2 pigment { rgb x } }\n").unwrap();
    assert_eq!(drawn(&[]), ["a"]);
    // A file that is searched before the one that was found.
    fs::write(path("colors.inc"), "#declare Red = rgb <0.5, 0, 0>;\n").unwrap();
    assert_eq!(drawn(&[]), ["b"]);
    fs::write(out.path().join("c.png"), "cut off").unwrap();
    assert_eq!(drawn(&[]), ["c"]);
    fs::remove_file(out.path().join("a.png")).unwrap();
    assert_eq!(drawn(&[]), ["a"]);
    assert_eq!(drawn(&["+Q5"]), ["a", "b", "c"]);
    assert!(drawn(&["+Q5", "--threads", "1", "--jobs", "3"]).is_empty());
    assert_eq!(drawn(&["+Q5", "--again"]), ["a", "b", "c"]);
    fs::write(path("c.ini"), "Antialias=on\n").unwrap();
    assert_eq!(drawn(&["+Q5"]), ["c"]);
    assert!(drawn(&["+Q5"]).is_empty());
}

#[test]
fn the_parts_cover_the_whole_and_follow_slurm() {
    let scenes = many_scenes(20);
    let (whole, parts) = (folder(&[]), folder(&[]));
    batch(scenes.path(), whole.path(), &[]);
    let mut count = 0;
    for part in ["1/3", "2/3"] {
        count += batch(scenes.path(), parts.path(), &["--shard", part])
            .drawn()
            .len();
    }
    let mut third = command(&[text(scenes.path()), "-o", text(parts.path())]);
    for (name, value) in [("ID", "8"), ("MIN", "4"), ("STEP", "2"), ("COUNT", "3")] {
        third.env(format!("SLURM_ARRAY_TASK_{name}"), value);
    }
    let third = ran(&mut third);
    assert!(third.stderr.contains("part 3 of 3"), "{}", third.stderr);
    assert_eq!(count + third.drawn().len(), 20);
    assert_eq!(pictures(parts.path()), pictures(whole.path()));
    // Pictures drawn by the parts are up to date for all.
    assert!(batch(scenes.path(), parts.path(), &[]).drawn().is_empty());
}

#[test]
fn two_runs_do_not_work_on_the_same_part() {
    let scenes = folder(&[(
        "a.pov",
        &scene("#declare I = 0; #while (I < 4000000) #declare I = I + 1; #end\n"),
    )]);
    let out = folder(&[]);
    let mut first = command(&[text(scenes.path()), "-o", text(out.path())])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("povr starts");
    let journal = out.path().join(".povr-batch/all/log");
    while !journal.exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let second = batch(scenes.path(), out.path(), &[]);
    let _ = (first.kill(), first.wait());
    assert_eq!(second.code, Some(2));
    assert!(
        second.stderr.contains("another `povr batch` is at work"),
        "{}",
        second.stderr
    );
    assert_eq!(
        batch(scenes.path(), out.path(), &["--timeout", "0.001"]).code,
        Some(1)
    );
}

/// Scenes that would exhaust the machine, never end, or are faulty, each followed by a correct one.
#[test]
fn a_bad_scene_ends_alone() {
    let endless = "#declare A = 1; #while (A > 0) #declare A = A + 1; #declare B = sin(A); #end\n";
    let huge =
        "#declare I = 0; #while (I < 200000000) sphere { I*x, 1 } #declare I = I + 1; #end\n";
    // Each ray becomes two at each of 200 surfaces.
    let mirrors = "global_settings { max_trace_level 200 adc_bailout 0 }
sphere { 0, 1 pigment { rgbt <1, 1, 1, 0.5> } finish { reflection 0.5 } interior { ior 1.5 } }
sphere { 0, 20 pigment { rgb 0.5 } finish { reflection 0.5 } }\n";
    let scenes = folder(&[
        ("a_missing.pov", &scene("#include \"nowhere.inc\"\n")),
        ("b_right.pov", &scene("")),
        ("c_endless.pov", &scene(endless)),
        ("d_right.pov", &scene("box { 1, 2 }\n")),
        ("e_mirrors.pov", &format!("// Mirrors.\n{HEAD}{mirrors}")),
        ("f_right.pov", &scene("box { 1, 3 }\n")),
        ("g_huge.pov", &scene(huge)),
        ("h_right.pov", &scene("box { 1, 4 }\n")),
        ("i_wrong.pov", "// Not a scene.\nsphere { 1 2 3 ]\n"),
        ("j_doubled.pov", &scene("#declare U = union { sphere { 0, 1 } sphere { x, 1 } }
#declare I = 0; #while (I < 40) #declare U = union { object { U } object { U translate y } } #declare I = I + 1; #end
object { U }\n")),
        ("k_stops.pov", &scene("#error \"not today\"\n")),
        ("l_right.pov", &scene("box { 1, 5 }\n")),
    ]);
    let out = folder(&[]);
    let ran = batch(
        scenes.path(),
        out.path(),
        &["--timeout", "4s", "--memory", "200M"],
    );
    assert_eq!(ran.code, Some(1));
    let right = ["b_right", "d_right", "f_right", "h_right", "l_right"];
    assert_eq!(ran.drawn(), right, "{}", ran.stderr);
    let names: Vec<PathBuf> = pictures(out.path()).into_keys().collect();
    assert_eq!(
        names,
        right.map(|name| PathBuf::from(format!("{name}.png")))
    );
    // A fast machine may use up the token limit of loops before the time limit.
    let endless = ran.why("c_endless.pov");
    assert!(
        endless.contains("do not come to an end") || endless.contains("it took longer than 4s"),
        "{endless}"
    );
    for (scene, expected) in [
        (
            "a_missing.pov",
            "cannot find the include file `nowhere.inc`",
        ),
        (
            "e_mirrors.pov",
            "it took longer than 4s, which `--timeout` allows",
        ),
        ("g_huge.pov", "this scene needs more memory than there is"),
        ("j_doubled.pov", "shapes"),
        ("k_stops.pov", "not today"),
    ] {
        assert!(
            ran.why(scene).contains(expected),
            "{scene}: {}",
            ran.why(scene)
        );
        assert!(ran.stderr.contains(scene), "{scene} is reported at the end");
    }
    // Failed scenes are tried again, drawn ones are not.
    let again = batch(
        scenes.path(),
        out.path(),
        &["--timeout", "1s", "--memory", "200M"],
    );
    assert_eq!((again.code, again.drawn().len()), (Some(1), 0));
}

#[test]
fn a_sheet_has_all_pictures_and_what_is_missing() {
    let scenes = folder(&[
        ("a b.pov", &scene("")),
        ("c.pov", &scene("")),
        ("wrong.pov", &scene("]\n")),
    ]);
    let out = folder(&[]);
    assert_eq!(batch(scenes.path(), out.path(), &["--sheet"]).code, Some(1));
    let page = fs::read_to_string(out.path().join("index.html")).expect("a page");
    assert!(page.contains("2 pictures, 1 failed"), "{page}");
    assert!(page.contains("src=\"a%20b.png\""), "{page}");
    assert_eq!(page.matches("<figure").count(), 3);
    let sheet = image::open(out.path().join("contact.png")).expect("a picture");
    assert_eq!(sheet.width(), 3 * 164 + 4);
    batch(scenes.path(), out.path(), &["--sheet"]);
    let again = fs::read_to_string(out.path().join("index.html")).expect("a page");
    assert!(again.contains("2 pictures, 1 failed"), "{again}");
    assert_eq!(again.matches("up to date").count(), 2);
}

#[test]
fn a_faulty_command_line_draws_nothing() {
    let scenes = folder(&[("a.pov", &scene(""))]);
    let out = folder(&[]);
    for (arguments, expected) in [
        (vec!["batch"], "no folder is named"),
        (vec!["batch", text(scenes.path())], "Name one with `-o`."),
        (
            vec!["batch", "/none.pov", "-o", "x"],
            "cannot find the scene `/none.pov`",
        ),
        (
            vec![
                "batch",
                text(scenes.path()),
                "-o",
                text(out.path()),
                "--shard",
                "3/2",
            ],
            "2/8",
        ),
        (
            vec!["batch", text(scenes.path()), "-o", text(out.path()), "+Zz"],
            "unknown switch `+Zz`",
        ),
        (
            vec![
                "batch",
                text(scenes.path()),
                "-o",
                text(out.path()),
                "--exclude",
                "a.pov",
            ],
            "no scene",
        ),
    ] {
        let mut run = Command::new(support::renderer());
        let ran = ran(run.args(&arguments));
        assert_eq!(ran.code, Some(2), "{arguments:?}");
        assert!(
            ran.stderr.contains(expected),
            "{arguments:?}: {}",
            ran.stderr
        );
    }
    assert!(files(out.path()).is_empty());
}
