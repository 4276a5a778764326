//! `povr live` over HTTP: what a page asks for, and a server among clients that are slow, wrong or do nothing.

#![cfg(unix)]

mod support;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use support::running::{Running, TIME_LIMIT};

const SCENE: &str = "#version 3.7; global_settings { assumed_gamma 1 }
#declare Size = 1; // live: 0.5..2
camera { location <0, 2, -6> look_at 0 angle 40 } // the camera
light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, Size pigment { rgb <1, clock, 0> } }
";

/// A running `povr live` with the address of its page.
struct Live {
    _running: Running,
    address: String,
    token: String,
}

impl Live {
    fn start(folder: &Path, arguments: &[&str]) -> Live {
        let drawing = ["live", "s.pov", "+W160", "+H120", "+A0.3"];
        let running = Running::start(folder, &[&drawing, arguments].concat());
        let lines = running.until("http://");
        let said = lines.last().and_then(|line| line.split_once("http://"));
        let (address, token) = said
            .and_then(|(_, said)| said.split_once('/'))
            .expect("an address with a path");
        Live {
            address: address.to_owned(),
            token: token.trim_end_matches('/').to_owned(),
            _running: running,
        }
    }

    /// The status and the body of the response to a request.
    fn answer(&self, method: &str, path: &str, body: &str) -> (u16, Vec<u8>) {
        let (address, token, length) = (&self.address, &self.token, body.len());
        let mut stream = TcpStream::connect(address).expect("the server is there");
        stream.set_read_timeout(Some(TIME_LIMIT)).expect("a limit");
        write!(
            stream,
            "{method} /{token}/{path} HTTP/1.1\r\nHost: {address}\r\nContent-Length: {length}\r\n\r\n{body}"
        )
        .expect("it is asked");
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("it answers");
        let mut parts = bytes.splitn(2, |&byte| byte == b' ');
        let status = parts
            .nth(1)
            .and_then(|rest| rest.get(..3))
            .expect("a status");
        let status = String::from_utf8_lossy(status).parse().expect("a number");
        let end = bytes.windows(4).position(|window| window == b"\r\n\r\n");
        (status, bytes[end.expect("a head") + 4..].to_vec())
    }

    /// Asks for a change; returns the status and the reason of a refusal.
    fn change(&self, change: &Value) -> (u16, String) {
        let (status, body) = self.answer("POST", "change", &change.to_string());
        (status, String::from_utf8_lossy(&body).into_owned())
    }

    fn changes(&self, change: &Value) {
        assert_eq!(self.change(change), (204, String::new()), "{change}");
    }

    /// The states from the current one on, before which something is done.
    fn events(&self, act: impl FnOnce()) -> impl Iterator<Item = Value> {
        let (address, token) = (&self.address, &self.token);
        let mut stream = TcpStream::connect(address).expect("the server is there");
        stream.set_read_timeout(Some(TIME_LIMIT)).expect("a limit");
        write!(
            stream,
            "GET /{token}/events HTTP/1.1\r\nHost: {address}\r\n\r\n"
        )
        .expect("it is asked");
        act();
        BufReader::new(stream).lines().filter_map(|line| {
            let line = line.expect("an event");
            let event = line.strip_prefix("data: ")?;
            Some(serde_json::from_str(event).expect("a state"))
        })
    }

    /// The first state that passes a test.
    fn state(&self, is_wanted: impl Fn(&Value) -> bool) -> Value {
        let (address, token) = (&self.address, &self.token);
        let mut stream = TcpStream::connect(address).expect("the server is there");
        stream.set_read_timeout(Some(TIME_LIMIT)).expect("a limit");
        write!(
            stream,
            "GET /{token}/events HTTP/1.1\r\nHost: {address}\r\n\r\n"
        )
        .expect("it is asked");
        let start = Instant::now();
        for line in BufReader::new(stream).lines() {
            let line = line.expect("an event");
            let Some(event) = line.strip_prefix("data: ") else {
                continue;
            };
            let state: Value = serde_json::from_str(event).expect("a state");
            if is_wanted(&state) {
                return state;
            }
            assert!(start.elapsed() < TIME_LIMIT, "{state}");
        }
        panic!("the stream has ended");
    }

    /// The state with the next whole picture, that of a change.
    fn picture_after(&self, change: &Value) -> (Value, Vec<u8>) {
        let before = self.whole();
        self.changes(change);
        let state = self.state(|state| is_whole(state) && state["history"] != before["history"]);
        (state, self.answer("GET", "picture.png", "").1)
    }

    fn whole(&self) -> Value {
        self.state(is_whole)
    }
}

fn is_whole(state: &Value) -> bool {
    state["width"] == 160 && state["is_preview"] == false && state["errors"] == ""
}

fn write(folder: &Path, text: &str) {
    fs::write(folder.join("s.pov"), text).expect("a file");
}

fn text(folder: &Path) -> String {
    fs::read_to_string(folder.join("s.pov")).expect("a file")
}

/// The change of the number with the first slider of a state.
fn size(state: &Value, value: &str) -> Value {
    let (text, control) = (&state["text"], &state["controls"][0]);
    json!({ "value": { "text": text, "start": control["start"], "end": control["end"], "value": value } })
}

/// The picture that `povr` draws of a text.
fn drawn(text: &str, options: &[&str]) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), text);
    let status = Command::new(env!("CARGO_BIN_EXE_povr"))
        .current_dir(folder.path())
        .args(["s.pov", "+W160", "+H120", "+A0.3", "-o", "s.png"])
        .args(options)
        .stderr(Stdio::null())
        .status();
    assert!(status.expect("povr runs").success());
    fs::read(folder.path().join("s.png")).expect("a picture")
}

#[test]
fn a_moved_camera_draws_the_picture_of_its_statement() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let live = Live::start(here, &[]);
    let first = live.whole();
    assert!(live.answer("GET", "picture.png", "").1 == drawn(SCENE, &[]));
    assert_eq!(first["is_moved"], false);
    for movement in [
        json!({ "orbit": [0.1, -0.05] }),
        json!({ "pan": [0.05, 0.1] }),
        json!({ "zoom": 1.3 }),
        json!({ "roll": 0.03 }),
        json!({ "walk": [0.1, 0.0, 0.1] }),
    ] {
        let (state, picture) = live.picture_after(&json!({ "move": movement }));
        let camera = state["camera"].as_str().expect("a statement");
        let own = "camera { location <0, 2, -6> look_at 0 angle 40 }";
        assert!(
            picture == drawn(&SCENE.replace(own, camera), &[]),
            "{movement}"
        );
    }
    // It replaces its own statement, and nothing else.
    let moved = live.whole();
    let camera = moved["camera"].as_str().expect("a statement");
    live.changes(&json!("write_camera"));
    let written = text(here);
    let (before, after) = SCENE.split_once("camera {").expect("a camera");
    let after = after.split_once('}').expect("its end").1;
    assert_eq!(written, format!("{before}{camera}{after}"));
    let own = live.state(|state| is_whole(state) && state["is_moved"] == false);
    assert_eq!(own["camera"], moved["camera"]);
    // A camera that is changed in the file replaces one that has been moved.
    live.changes(&json!({ "move": { "orbit": [0.1, 0.1] } }));
    live.state(|state| is_whole(state) && state["is_moved"] == true);
    write(here, SCENE);
    let again = live.state(|state| is_whole(state) && state["camera"] == first["camera"]);
    assert_eq!(again["is_moved"], false);
}

#[test]
fn numbers_are_changed_and_written() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let live = Live::start(here, &[]);
    let state = live.whole();
    let control = &state["controls"][0];
    assert_eq!(control["name"], "Size");
    let (state, picture) = live.picture_after(&size(&state, "1.5"));
    let changed = SCENE.replace("Size = 1;", "Size = 1.5;");
    assert!(picture == drawn(&changed, &[]));
    assert_eq!(state["values"], json!([[control["start"], "1.5"]]));
    assert_eq!(text(here), SCENE);
    live.changes(&json!("write_values"));
    assert_eq!(text(here), changed);
    live.state(|state| is_whole(state) && state["values"] == json!([]));
    let (_, picture) = live.picture_after(&json!({ "clock": 0.5 }));
    assert!(picture == drawn(&changed, &["+K0.5"]));
    // A range without a number of the text is refused.
    for (start, end, value) in [
        (0, 4, "1"),
        (50, 51, "1"),
        (9, 12, "1; #fopen F \"x\" write"),
        (9, 999, "1"),
    ] {
        let text = live.whole()["text"].clone();
        let change =
            json!({ "value": { "text": text, "start": start, "end": end, "value": value } });
        assert_eq!(live.change(&change).0, 409, "{change}");
    }
    // So is a number of another text.
    let state = live.whole();
    live.changes(&size(&state, "1"));
    write(here, &format!("// {changed}"));
    let newer = live.state(|newer| newer["text"] != state["text"]);
    assert_eq!(newer["values"], json!([]));
    assert_eq!(live.change(&size(&state, "1")).0, 409);
    for wrong in [
        json!(1),
        json!({ "other": 1 }),
        json!({ "move": { "orbit": [1] } }),
    ] {
        assert_eq!(live.change(&wrong).0, 400, "{wrong}");
    }
}

#[test]
fn a_file_that_has_changed_is_not_overwritten() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let live = Live::start(here, &[]);
    live.whole();
    live.changes(&json!({ "move": { "zoom": 2.0 } }));
    let newer = format!("{SCENE}// newer\n");
    // The server may see the new file first, and then it writes into that.
    write(here, &newer);
    let (status, _) = live.change(&json!("write_camera"));
    assert!(status == 409 || status == 204);
    assert!(text(here).ends_with("// newer\n"));
}

#[test]
fn a_pixel_is_reported_on() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let live = Live::start(here, &[]);
    live.whole();
    live.changes(&json!({ "pick": [0.5, 0.5] }));
    let state = live.state(|state| state["picked"] != Value::Null);
    let picked = &state["picked"];
    assert_eq!(
        (&picked["column"], &picked["row"]),
        (&json!(80), &json!(60))
    );
    let surface = &picked["surface"];
    let (file, line) = (&surface["object"]["file"], &surface["object"]["line"]);
    assert_eq!((file, line), (&json!("s.pov"), &json!(5)));
    let distance = surface["distance"].as_f64().expect("a distance");
    assert!((distance - (40f64.sqrt() - 1.0)).abs() < 1e-3, "{distance}");
    assert!(picked["rays"]["camera"].as_u64().expect("a count") > 0);
    live.changes(&json!({ "pick": [0.01, 0.01] }));
    let state = live.state(|state| state["picked"]["column"] == 1);
    assert_eq!(state["picked"]["surface"], Value::Null);
}

#[test]
fn a_scene_answers_to_the_cursor() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    let scene = "#ifndef (live_cursor_x) #declare live_cursor_x = 0; #end\n";
    let scene = format!("{scene}{SCENE}").replace("sphere { 0,", "sphere { live_cursor_x*x,");
    write(here, &scene);
    let live = Live::start(here, &[]);
    let (_, picture) = live.picture_after(&json!({ "cursor": [0.75, 0.0, 1] }));
    assert!(picture == drawn(&scene, &["Declare=live_cursor_x=0.75"]));
    assert_eq!(live.whole()["has_cursor"], true);
}

#[test]
fn a_camera_is_written_among_numbers_that_are_not() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    // The byte-order mark of an editor stays, and no offset counts it.
    let scene = SCENE.replace("look_at 0", "look_at <0, 0, 0>");
    write(here, &format!("\u{feff}{scene}"));
    let live = Live::start(here, &[]);
    let first = live.whole();
    let (state, _) = live.picture_after(&size(&first, "1.23456789"));
    assert_eq!(state["values"][0][1], "1.23456789");
    let (moved, picture) = live.picture_after(&json!({ "move": { "orbit": [0.1, 0.1] } }));
    let camera = moved["camera"].as_str().expect("a statement");
    live.changes(&json!("write_camera"));
    let (before, after) = scene.split_once("camera {").expect("a camera");
    let after = after.split_once('}').expect("its end").1;
    let written = format!("{before}{camera}{after}");
    assert_eq!(text(here), format!("\u{feff}{written}"));
    // The number is still another one, and is written by itself.
    let state = live.state(|state| is_whole(state) && state["is_moved"] == false);
    assert_eq!(state["values"], moved["values"]);
    assert!(live.answer("GET", "picture.png", "").1 == picture);
    live.changes(&json!("write_values"));
    let written = written.replace("Size = 1;", "Size = 1.23456789;");
    assert_eq!(text(here), format!("\u{feff}{written}"));
    // Its own statement is known at once.
    live.changes(&json!({ "move": { "orbit": [0.1, 0.0] } }));
    live.state(|state| {
        is_whole(state) && state["is_moved"] == true && state["values"] == json!([])
    });
    live.changes(&json!("write_camera"));
    let again = text(here);
    assert_eq!(again.matches("camera {").count(), 1);
    assert!(again.starts_with('\u{feff}') && again.ends_with(after));
}

#[test]
fn a_moved_camera_stays_when_the_objects_change() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    // Without `look_at` it turns around the object in the centre.
    let own = "camera { location <0, 2, -6> look_at 0 angle 40 }";
    write(
        here,
        &SCENE.replace(own, "camera { location <0, 0.5, -6> direction z }"),
    );
    let live = Live::start(here, &[]);
    live.whole();
    let (moved, _) = live.picture_after(&json!({ "move": { "orbit": [0.1, 0.1] } }));
    let (state, _) = live.picture_after(&size(&moved, "1.5"));
    let state =
        live.state(|now| is_whole(now) && now["number"].as_u64() >= state["number"].as_u64());
    assert_eq!(
        (&state["is_moved"], &state["camera"]),
        (&json!(true), &moved["camera"])
    );
}

/// A scene of many spheres, of which one has another colour.
fn spheres(special: u32, color: &str) -> String {
    let mut text = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 8, -12> look_at 0 angle 60 }
light_source { <4, 9, -8>, 1 }
plane { y, -2 pigment { rgb 0.8 } }
"
    .to_owned();
    for at in 0..2000_u32 {
        let (x, z) = (at % 40, at / 40);
        let color = if at == special { color } else { "<0, 1, 0>" };
        text += &format!(
            "sphere {{ <{}, 0, {}>, 0.12 pigment {{ rgb {color} }} }}\n",
            f64::from(x) / 4.0 - 5.0,
            f64::from(z) / 4.0 - 6.0
        );
    }
    text
}

/// The pixels before encoding are the same, but not those of the file.
#[test]
fn another_gamma_is_no_patch() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), SCENE);
    let live = Live::start(folder.path(), &["-A"]);
    let before = live.whole();
    let text = SCENE.replace("assumed_gamma 1", "assumed_gamma 2.2");
    let events = live.events(|| {
        write(folder.path(), &text);
    });
    for state in events {
        assert_eq!(state["patch"], Value::Null);
        if is_whole(&state) && state["picture"] != before["picture"] {
            break;
        }
    }
    assert_eq!(
        live.answer("GET", "picture.png", "").1,
        drawn(&text, &["-A"])
    );
}

#[test]
fn a_little_edit_comes_as_a_patch() {
    let folder = tempfile::tempdir().expect("a folder");
    let first = spheres(930, "<0, 1, 0>");
    write(folder.path(), &first);
    let live = Live::start(folder.path(), &[]);
    let before = live.whole();
    let mut png = live.answer("GET", "picture.png", "").1;
    assert_eq!(png, drawn(&first, &[]));
    let mut number = before["picture"].clone();
    let decoded = |png: &[u8]| image::load_from_memory(png).expect("a picture").to_rgb8();
    let mut patches = 0;
    for edit in 0..8 {
        let text = spheres(930, &format!("<1, {}, 0>", f64::from(edit) / 10.0));
        let path = folder.path().join("s.pov");
        let events = live.events(|| {
            // Written in place, and in one step.
            match edit % 2 {
                0 => {
                    write(folder.path(), &text);
                }
                _ => {
                    fs::write(folder.path().join("draft"), &text).expect("a file");
                    fs::rename(folder.path().join("draft"), &path).expect("a file");
                }
            }
        });
        let mut patched = None;
        for state in events {
            if let Some(patch) = state["patch"].as_object() {
                assert_eq!((&patch["over"], &state["picture"]), (&number, &number));
                let bytes = STANDARD.decode(patch["png"].as_str().expect("a text"));
                let position =
                    ["column", "row"].map(|side| patch[side].as_i64().expect("a number"));
                let mut picture = decoded(&png);
                let part = decoded(&bytes.expect("base64"));
                assert!(4 * part.width() * part.height() < picture.width() * picture.height());
                image::imageops::replace(&mut picture, &part, position[0], position[1]);
                patched = Some((patch["number"].clone(), picture));
            } else if is_whole(&state) && state["picture"] != number {
                number = state["picture"].clone();
                break;
            }
        }
        png = live.answer("GET", "picture.png", "").1;
        assert_eq!(png, drawn(&text, &[]));
        // The state with the patch may be over before it is seen.
        if let Some((patched, picture)) = patched {
            patches += 1;
            assert_eq!(patched, number);
            assert!(picture == decoded(&png));
        }
    }
    assert!(patches > 0);
}

#[test]
fn a_click_does_not_leave_a_preview() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    let many = "#for (I, 0, 12) torus { 1 + I/4, 0.03 pigment { rgb 1 } finish { reflection 0.5 } } #end\n";
    write(here, &format!("{SCENE}{many}"));
    let live = Live::start(here, &["+W480", "+H360"]);
    let is_final = |state: &Value| state["width"] == 480 && state["is_preview"] == false;
    let first = live.state(is_final);
    live.changes(&json!({ "move": { "orbit": [0.2, 0.0] } }));
    live.state(|state| state["is_preview"] == true && state["picture"] != first["picture"]);
    live.changes(&json!("reset_camera"));
    live.changes(&json!({ "pick": [0.5, 0.5] }));
    let last = live.state(|state| is_final(state) && state["picked"] != Value::Null);
    assert_eq!(last["camera"], first["camera"]);
}

#[test]
fn only_the_picture_of_the_file_is_stored() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    fs::write(here.join("o.ini"), "Output_File_Name=o.png\n").expect("a file");
    let live = Live::start(here, &["o.ini", "+K0.25"]);
    let own = drawn(SCENE, &["+K0.25"]);
    let stored = || fs::read(here.join("o.png")).unwrap_or_default();
    let start = Instant::now();
    while stored() != own {
        assert!(start.elapsed() < TIME_LIMIT);
        std::thread::sleep(Duration::from_millis(20));
    }
    let state = live.whole();
    assert_eq!(
        (&state["own_clock"], &state["clock"]),
        (&json!(0.25), &Value::Null)
    );
    for change in [
        json!({ "clock": 0.75 }),
        size(&state, "0.8"),
        json!({ "move": { "zoom": 2.0 } }),
    ] {
        let (_, picture) = live.picture_after(&change);
        assert!(picture != own, "{change}");
    }
    // The last one is ready to be stored before the next is begun.
    live.picture_after(&json!({ "move": { "zoom": 1.1 } }));
    assert!(stored() == own);
}

#[test]
fn scenes_of_the_folder_are_opened() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let other = SCENE.replace("Size = 1", "Size = 0.7");
    fs::write(here.join("t.pov"), &other).expect("a file");
    let live = Live::start(here, &[]);
    live.whole();
    live.changes(&json!({ "move": { "zoom": 1.5 } }));
    live.changes(&json!({ "open": "t.pov" }));
    let state = live.state(|state| is_whole(state) && state["scene"] == "t.pov");
    assert_eq!(state["is_moved"], false);
    assert!(live.answer("GET", "picture.png", "").1 == drawn(&other, &[]));
    live.changes(&size(&state, "1.5"));
    live.changes(&json!("write_values"));
    let written = fs::read_to_string(here.join("t.pov")).expect("a file");
    assert_eq!(written, SCENE.replace("Size = 1", "Size = 1.5"));
    assert_eq!(text(here), SCENE);
    for name in ["../s.pov", "u.pov", ""] {
        assert_eq!(live.change(&json!({ "open": name })).0, 409, "{name}");
    }
}

#[test]
fn views_stand_beside_the_picture() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let live = Live::start(here, &[]);
    let whole = live.whole();
    assert_eq!(whole["statistics"]["plan"]["primitives"]["sphere"], 1);
    for kind in ["rays", "time", "error"] {
        live.changes(&json!({ "overlay": kind }));
        let state = live.state(|state| state["overlaid"][1]["kind"] == kind);
        assert_eq!(state["picture"], whole["picture"], "only the view is drawn");
        let scale = &state["overlaid"][1]["scale"];
        let [brightest, largest] =
            ["brightest", "largest"].map(|name| scale[name].as_f64().expect("a number"));
        assert!(0.0 < brightest && brightest <= largest, "{kind}: {scale}");
        let (_, png) = live.answer("GET", "overlay.png", "");
        let view = image::load_from_memory(&png).expect("a picture").to_rgb8();
        assert_eq!(view.dimensions(), (160, 120));
        // The sphere in the middle costs more than the background in the corner. A single pixel's time may hold an
        // interruption; half of the pixels do not. Green grows along the scale.
        let cost_from = |x: u32, y: u32| {
            let pixels = (0..225).map(|at| view.get_pixel(x + at % 15, y + at / 15).0[1]);
            let mut greens: Vec<u8> = pixels.collect();
            greens.sort_unstable();
            greens[112]
        };
        assert!(
            kind == "error" || cost_from(73, 53) > cost_from(0, 0),
            "{kind}"
        );
    }
    live.changes(&json!({ "move": { "zoom": 1.5 } }));
    live.state(|state| state["overlaid"][1]["kind"] == "error" && state["is_moved"] == true);
    live.changes(&json!({ "overlay": null }));
    let last = live.state(|state| state["overlay"] == Value::Null);
    assert_eq!(last["overlaid"], Value::Null);
}

#[test]
fn scenes_of_strangers_are_not_written() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    for option in ["--sandbox", "--no-write"] {
        let live = Live::start(here, &[option]);
        let state = live.whole();
        live.picture_after(&json!({ "move": { "zoom": 2.0 } }));
        live.changes(&size(&state, "1.5"));
        for change in ["write_camera", "write_values"] {
            let (status, reason) = live.change(&json!(change));
            assert_eq!(status, 409);
            assert!(reason.contains("--no-write"), "{reason}");
        }
        assert_eq!(text(here), SCENE);
    }
}

/// A server with many clients that do nothing or read nothing goes on with the others.
#[test]
fn clients_that_are_slow_or_wrong_do_not_stop_the_server() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    write(here, SCENE);
    let live = Live::start(here, &[]);
    live.picture_after(&json!({ "move": { "zoom": 1.1 } }));
    let (address, token) = (&live.address, &live.token);
    let idle: Vec<TcpStream> = (0..200)
        .map(|_| TcpStream::connect(address).expect("a connection"))
        .collect();
    let requests = [
        format!("GET /{token}/picture.png HTTP/1.1\r\nHost: evil.example\r\n\r\n"),
        format!(
            "POST /{token}/change HTTP/1.1\r\nHost: {address}\r\nOrigin: http://evil.example\r\nContent-Length: 14\r\n\r\n\"write_camera\""
        ),
        format!("GET /{token}/events HTTP/1.1\r\nHost: {address}\r\n"),
        format!(
            "POST /{token}/change HTTP/1.1\r\nHost: {address}\r\nContent-Length: 999\r\n\r\n{{"
        ),
        format!(
            "POST /{token}/change HTTP/1.1\r\nHost: {address}\r\nContent-Length: 99999999999\r\n\r\n"
        ),
        "\0\r\n\r\n".to_owned(),
        format!("GET /{token}/events HTTP/1.1\r\nHost: {address}\r\n\r\n"),
    ];
    let others: Vec<TcpStream> = requests
        .iter()
        .flat_map(|request| std::iter::repeat_n(request, 10))
        .map(|request| {
            let mut stream = TcpStream::connect(address).expect("a connection");
            stream.write_all(request.as_bytes()).expect("it is sent");
            stream
        })
        .collect();
    let start = Instant::now();
    let (_, picture) = live.picture_after(&json!({ "move": { "zoom": 1.1 } }));
    assert!(!picture.is_empty());
    assert!(start.elapsed() < Duration::from_secs(40));
    assert_eq!(text(here), SCENE);
    drop((idle, others));
}
