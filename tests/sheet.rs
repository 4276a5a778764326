//! `povr sheet`: the whole set of files for a shape, every shape under all transforms, and a user's shape, each as
//! POV-Ray draws it.

use povr::app::compare as process;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// POV-Ray draws some hundred small pictures.
const TIME_LIMIT: Duration = Duration::from_secs(600);

/// A folder under `target/`, made if it is missing.
fn scratch() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sheet");
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Makes a sheet in an empty folder; its output is the message if that fails.
fn sheet(folder: &str, arguments: &[&str]) -> PathBuf {
    let folder = scratch().join(folder);
    let _ = fs::remove_dir_all(&folder);
    let mut command = Command::new(env!("CARGO_BIN_EXE_povr"));
    command.arg("sheet").args(arguments).arg("-o").arg(&folder);
    let ended = process::run(&mut command, TIME_LIMIT).expect("povr starts");
    let is_right = ended.status.is_some_and(|status| status.success());
    assert!(is_right, "{}", ended.stderr);
    folder
}

fn files(folder: &Path, ending: &str) -> usize {
    let entries = fs::read_dir(folder).expect("the folder of the shape");
    entries
        .filter_map(Result::ok)
        .filter(|entry| {
            entry
                .path()
                .extension()
                .is_some_and(|actual| actual == ending)
        })
        .count()
}

#[test]
fn a_shape_has_a_scene_and_a_picture_for_each_transform() {
    let folder = sheet("torus", &["torus", "--size", "64x48"]).join("torus");
    // The transforms, the overview, and the contact sheet.
    assert_eq!(files(&folder, "pov"), 38 + 1);
    assert_eq!(files(&folder, "png"), 38 + 1 + 1);
    let page = fs::read_to_string(folder.join("sheet.html")).expect("a page");
    assert_eq!(page.matches("data:image/png;base64,").count(), 38 + 1);
    assert!(page.contains("pictures agree with POV-Ray's"));
    assert!(!page.contains("src=\"sheet"));
}

#[test]
fn every_shape_agrees_with_pov_ray_under_all_transforms() {
    let folder = sheet("all", &["all", "--overview", "--size", "120x90"]);
    assert!(folder.join("index.html").is_file());
    assert!(folder.join("difference/sheet.png").is_file());
}

#[test]
fn a_users_object_comes_from_a_file() {
    let own = scratch().join("own.inc");
    let text = "#declare Pin = union { sphere { y, 0.4 } cone { -y, 0, y, 0.3 } }\n";
    fs::write(&own, text).expect("a file");
    let path = own.display().to_string();
    let arguments = [&path, "--object", "Pin", "--overview", "--size", "64x48"];
    let folder = sheet("own", &arguments).join("own");
    assert!(folder.join("own.inc").is_file());
    assert_eq!(files(&folder, "pov"), 1);
}

#[test]
fn an_unknown_shape_is_refused_with_the_known_ones() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_povr"));
    command.args(["sheet", "bagel", "-o", "nowhere"]);
    let ended = process::run(&mut command, TIME_LIMIT).expect("povr starts");
    assert_eq!(ended.status.and_then(|status| status.code()), Some(2));
    assert!(
        ended
            .stderr
            .contains("`bagel` is neither a shape nor a file")
    );
    assert!(ended.stderr.contains("superellipsoid"));
}
