//! `povr watch`: real changes of real files, the output, and the page.

#![cfg(unix)]

mod support;

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use support::running::Running;

const SCENE: &str = "#version 3.7; global_settings { assumed_gamma 1 }
#include \"look.inc\"
camera { location <0, 2, -6> look_at 0 angle 40 } light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 1 pigment { Look } }";

/// A running `povr watch`.
struct Watching(Running);

impl Watching {
    fn start(folder: &Path, arguments: &[&str]) -> Watching {
        let drawing = ["watch", "s.pov", "-o", "s.png", "+W64", "+H48"];
        Watching(Running::start(folder, &[&drawing, arguments].concat()))
    }

    fn until(&self, text: &str) -> Vec<String> {
        self.0.until(text)
    }

    /// Waits for a drawing; returns the colour in the middle.
    fn drawn(&self, folder: &Path) -> [u8; 3] {
        self.until("povr: drawn in ");
        let picture = image::open(folder.join("s.png"))
            .expect("a picture")
            .to_rgb8();
        picture.get_pixel(32, 24).0
    }
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).expect("a file");
}

/// Replaces a file by a new one, as many editors do.
fn replace(folder: &Path, name: &str, text: &str) {
    write(folder, "new~", text);
    fs::rename(folder.join("new~"), folder.join(name)).expect("it is replaced");
}

fn look(color: &str) -> String {
    format!("#declare Look = pigment {{ rgb {color} }}")
}

/// Another picture would tell the page that such a file has appeared.
#[test]
fn files_that_a_sandbox_hides_are_not_watched() {
    let all = tempfile::tempdir().expect("a folder");
    let [here, other] = ["here", "other"].map(|name| all.path().join(name));
    for folder in [&here, &other] {
        fs::create_dir(folder).expect("a folder");
    }
    let tests =
        "#if (file_exists(\"../other/secret\") | file_exists(\"none\")) #error \"seen\" #end";
    write(&here, "s.pov", &format!("{SCENE}\n{tests}"));
    write(&here, "look.inc", &look("<1, 0, 0>"));
    let watching = Watching::start(&here, &["--sandbox"]);
    watching.drawn(&here);
    write(&other, "secret", "");
    // Twice the time after which files are looked at where the system sends no notifications.
    std::thread::sleep(Duration::from_secs(1));
    assert!(watching.0.is_silent());
    write(&here, "none", "");
    watching.until("none` has changed");
    watching.until("seen");
}

#[test]
fn every_change_of_every_file_is_drawn() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, "s.pov", SCENE);
    write(here, "look.inc", &look("<1, 0, 0>"));
    let watching = Watching::start(here, &[]);
    let [r, g, b] = watching.drawn(here);
    assert!(r > 100 && g == 0 && b == 0);
    // Written in place, and replaced.
    write(here, "look.inc", &look("<0, 1, 0>"));
    let [r, g, _] = watching.drawn(here);
    assert!(g > 100 && r == 0);
    replace(here, "look.inc", &look("<0, 0, 1>"));
    let [r, _, b] = watching.drawn(here);
    assert!(b > 100 && r == 0);
    replace(
        here,
        "s.pov",
        &SCENE.replace("sphere { 0, 1", "box { -9, 9"),
    );
    watching.until("povr: `s.pov` has changed");
    watching.until("povr: drawn in ");
    // An error is printed as it is, and the picture stays.
    let before = fs::read(here.join("s.png")).expect("a picture");
    write(here, "look.inc", &look("<0, 0, 1>").replace("rgb", "rbg"));
    let said = watching
        .until("povr: render failed; keeping the last picture")
        .join("\n");
    assert!(
        said.contains("File 'look.inc' line 1: Parse Error: "),
        "{said}"
    );
    assert!(said.contains("rbg"), "{said}");
    assert!(fs::read(here.join("s.png")).expect("a picture") == before);
    // A missing file is watched for.
    fs::remove_file(here.join("look.inc")).expect("it is there");
    watching.until("povr: render failed");
    write(here, "look.inc", &look("<1, 1, 0>"));
    let [r, g, b] = watching.drawn(here);
    assert!(r > 20 && g > 20 && b == 0);
}

#[test]
fn a_file_that_shadows_another_is_detected() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    fs::create_dir(here.join("library")).expect("a folder");
    write(here, "s.pov", SCENE);
    write(here, "library/look.inc", &look("<1, 0, 0>"));
    let watching = Watching::start(here, &["+Llibrary"]);
    assert!(watching.drawn(here)[0] > 100);
    // The folder of the scene comes first in the search.
    write(here, "look.inc", &look("<0, 1, 0>"));
    let [r, g, _] = watching.drawn(here);
    assert!(g > 100 && r == 0);
    // Changes of files that the scene does not use have no effect.
    write(here, "other.inc", "");
    std::thread::sleep(Duration::from_millis(1200));
    assert!(watching.0.is_silent());
}

#[test]
fn a_change_ends_a_drawing_in_progress() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    let slow = SCENE.replace(
        "rgb 1 }",
        "rgb 1 area_light 3*x, 3*z, 65, 65 jitter adaptive 6 }",
    );
    write(here, "s.pov", &slow);
    write(here, "look.inc", &look("<1, 0, 0>"));
    let watching = Watching::start(here, &["+W800", "+H600", "+A0.0", "+R9"]);
    std::thread::sleep(Duration::from_millis(1500));
    write(
        here,
        "s.pov",
        &SCENE.replace("camera", "#warning \"anew\" camera"),
    );
    let start = Instant::now();
    watching.until("povr: `s.pov` has changed");
    watching.until("anew");
    assert!(
        start.elapsed() < Duration::from_secs(10),
        "the slow drawing goes on"
    );
}

/// Address and token of a page that a program has announced.
fn address_of(said: &str) -> (String, String) {
    let address = said.split("http://").nth(1).expect("an address");
    let (address, token) = address.split_once('/').expect("a path");
    (address.to_owned(), token.trim_end_matches('/').to_owned())
}

/// The response of the page server to a request.
fn fetched(address: &str, path: &str, host: &str) -> (String, Vec<u8>) {
    let mut stream = TcpStream::connect(address).expect("the page is there");
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n").expect("it is asked");
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).expect("it answers");
    let end = bytes
        .windows(4)
        .position(|window| window == b"\r\n\r\n")
        .expect("a head");
    let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
    (head, bytes[end + 4..].to_vec())
}

#[test]
fn the_page_shows_the_last_good_picture_and_what_is_wrong() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, "s.pov", SCENE);
    write(here, "look.inc", &look("<1, 0, 0>"));
    let watching = Watching::start(here, &["--serve"]);
    let said = watching.until("povr: http://127.0.0.1:").join("\n");
    let (address, token) = address_of(&said);
    let path = |name: &str| format!("/{token}/{name}");
    watching.drawn(here);
    let (head, page) = fetched(&address, &path(""), &address);
    assert!(head.starts_with("HTTP/1.1 200 OK"), "{head}");
    assert!(String::from_utf8_lossy(&page).contains("<title>povr</title>"));
    let (_, png) = fetched(&address, &path("picture.png?1"), &address);
    let picture = image::load_from_memory(&png).expect("a picture");
    assert_eq!(
        picture.to_rgb8(),
        image::open(here.join("s.png"))
            .expect("a picture")
            .to_rgb8()
    );
    // A page of another host name that resolves to this address is rejected.
    let (head, _) = fetched(&address, &path("picture.png"), "evil.example:80");
    assert!(head.starts_with("HTTP/1.1 403"), "{head}");
    for unknown in ["/", "/picture.png", "/../s.pov", &path("../s.pov")] {
        let (head, _) = fetched(&address, unknown, &address);
        assert!(head.starts_with("HTTP/1.1 404"), "{unknown}: {head}");
    }
    // The event stream reports the error; the picture is still served.
    let mut stream = TcpStream::connect(&address).expect("the page is there");
    let events = path("events");
    write!(stream, "GET {events} HTTP/1.1\r\nHost: {address}\r\n\r\n").expect("it is asked");
    write(here, "look.inc", "#declare Look = ");
    let mut events = BufReader::new(stream).lines().map_while(Result::ok);
    let error = events
        .find(|line| line.contains("which is a camera"))
        .expect("the error is told");
    assert!(
        error.starts_with("data: {") && error.contains("\"width\":64"),
        "{error}"
    );
    assert_eq!(fetched(&address, &path("picture.png"), &address).1, png);
    let warning = format!("{}#warning \"a doubt\"\n", look("<1, 0, 0>"));
    write(here, "look.inc", &warning);
    let doubt = events
        .find(|line| line.contains("a doubt"))
        .expect("the warning is told");
    assert!(
        doubt.contains("\"errors\":\"\"") && doubt.contains("\"warnings\":\"warning: a doubt"),
        "{doubt}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_scene_that_brings_its_process_down_does_not_end_the_watch() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, "s.pov", SCENE);
    write(here, "look.inc", &look("<1, 0, 0>"));
    let watching = Watching::start(here, &["+A0.0", "+R9"]);
    watching.drawn(here);
    // An idle worker is replaced.
    for worker in support::children(watching.0.child.id()) {
        let killed = Command::new("kill").args(["-KILL", &worker]).status();
        assert!(killed.expect("there is `kill`").success());
    }
    std::thread::sleep(Duration::from_millis(300));
    write(here, "look.inc", &look("<0, 0, 1>"));
    assert!(watching.drawn(here)[2] > 100);
    let slow = "media { scattering { 1, 1 } intervals 1000 samples 1000 }";
    let slow = format!("#declare Look = pigment {{ rgb 1 }} {slow}");
    write(here, "look.inc", &slow);
    watching.until("has changed");
    std::thread::sleep(Duration::from_millis(500));
    for worker in support::children(watching.0.child.id()) {
        let killed = Command::new("kill").args(["-ABRT", &worker]).status();
        assert!(killed.expect("there is `kill`").success());
    }
    watching.until("povr: its process ended (signal: 6 (SIGABRT)");
    watching.until("keeping the last picture");
    write(here, "look.inc", &look("<0, 1, 0>"));
    let [r, g, _] = watching.drawn(here);
    assert!(r == 0 && g > 100);
}
