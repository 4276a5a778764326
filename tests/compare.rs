//! `povr compare`: two pictures by `idiff`'s thresholds and exit codes; scenes beside POV-Ray; the report in a browser.

#![allow(
    clippy::print_stdout,
    reason = "what a test finds is read on the terminal"
)]

mod support;

use image::{DynamicImage, ImageBuffer, Rgb, RgbImage};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use support::browser::{WINDOWS, browser, expect, shown, write_probed};

const HEAD: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 50 }
light_source { <-4, 6, -3> rgb 1 LAMPS }
plane { y, -1 pigment { checker rgb 1, rgb 0.4 } }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }";

fn povr(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_povr"));
    command.current_dir(folder).arg("compare").args(arguments);
    command.output().expect("povr starts")
}

fn exit(folder: &Path, arguments: &[&str]) -> Option<i32> {
    povr(folder, arguments).status.code()
}

#[test]
fn two_pictures_have_the_exit_codes_of_idiff() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    let grey = RgbImage::from_pixel(20, 10, Rgb([100; 3]));
    let mut other = grey.clone();
    other.put_pixel(7, 3, Rgb([100, 151, 100]));
    grey.save(here.join("a.png")).expect("a picture");
    other.save(here.join("b.png")).expect("a picture");
    RgbImage::new(10, 20)
        .save(here.join("c.png"))
        .expect("a picture");
    fs::write(here.join("d.png"), "no picture").expect("a file");
    assert_eq!(exit(here, &["a.png", "a.png"]), Some(0));
    assert_eq!(exit(here, &["a.png", "b.png"]), Some(2));
    // One pixel of 200 is 0.5 percent; its difference is 0.2.
    assert_eq!(
        exit(here, &["a.png", "b.png", "--failpercent", "0.5"]),
        Some(1)
    );
    let both = [
        "a.png",
        "b.png",
        "--failpercent",
        "0.5",
        "--warnpercent=0.5",
    ];
    assert_eq!(exit(here, &both), Some(0));
    assert_eq!(
        exit(
            here,
            &["a.png", "b.png", "--fail", "51/255", "--warn", "0.21"]
        ),
        Some(0)
    );
    assert_eq!(
        exit(
            here,
            &["a.png", "b.png", "--fail", "50/255", "--warn", "0.21"]
        ),
        Some(2)
    );
    let hard = ["a.png", "b.png", "--failpercent", "50", "--hardfail", "0.1"];
    assert_eq!(exit(here, &hard), Some(2));
    assert_eq!(exit(here, &["a.png", "c.png"]), Some(3));
    assert_eq!(exit(here, &["a.png", "d.png"]), Some(4));
    assert_eq!(exit(here, &["a.png", "none.png"]), Some(4));
    let sheet = ["a.png", "b.png", "-o", "sheet.png"];
    assert_eq!(exit(here, &sheet), Some(2));
    assert!(
        image::open(here.join("sheet.png"))
            .expect("a picture")
            .width()
            > 60
    );
}

#[test]
fn pictures_of_unlike_kinds_are_compared() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    // Linear 0.21586 is stored as the byte 128 and the word 32896 in sRGB.
    let light = ImageBuffer::from_pixel(4, 4, Rgb([0.215_86_f32, 0.0, 1.0]));
    DynamicImage::from(light)
        .save(here.join("a.exr"))
        .expect("a picture");
    let bytes = RgbImage::from_pixel(4, 4, Rgb([128, 0, 255]));
    bytes.save(here.join("b.png")).expect("a picture");
    let words = ImageBuffer::from_pixel(4, 4, Rgb([32_896_u16, 0, 65_535]));
    DynamicImage::from(words)
        .save(here.join("c.png"))
        .expect("a picture");
    for pair in [["a.exr", "b.png"], ["b.png", "c.png"], ["a.exr", "a.exr"]] {
        assert_eq!(exit(here, &pair), Some(0), "{pair:?}");
    }
    let said = povr(here, &["a.exr", "c.png", "--json"]).stdout;
    let said = String::from_utf8_lossy(&said);
    let first: Value =
        serde_json::from_str(said.lines().next().unwrap_or_default()).expect("an object");
    assert_eq!(first["full"], 65535.0, "{said}");
    assert!(first["max"].as_f64().expect("a number") <= 2.0, "{said}");
}

/// A folder with a scene that is equal, one that is random (in pictures of more than 131,072 pixels), and one that neither
/// program can read.
fn scenes(folder: &Path) {
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a scene");
    write("equal.pov", &HEAD.replace("LAMPS", ""));
    let area_light = "area_light 2*x, 2*z, 5, 5 jitter adaptive 1";
    write("random.pov", &HEAD.replace("LAMPS", area_light));
    write("faulty.pov", "sphere { 0 1 ");
    fs::create_dir_all(folder.join("deep/include")).expect("a folder");
    write("deep/include/part.pov", "no scene of its own");
    write("deep/again.pov", &HEAD.replace("LAMPS", ""));
}

#[test]
fn scenes_are_compared_with_povray() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    scenes(here);
    let ended = povr(here, &[".", "--json", "--keep", "kept", "+W420", "+H315"]);
    let said = String::from_utf8_lossy(&ended.stdout).into_owned();
    let lines: Vec<Value> = said
        .lines()
        .map(|line| serde_json::from_str(line).expect("an object"))
        .collect();
    let actual: Vec<_> = lines[..4]
        .iter()
        .map(|line| {
            (
                line["name"].as_str().unwrap_or(""),
                line["status"].as_str().unwrap_or(""),
            )
        })
        .collect();
    assert_eq!(
        actual,
        [
            ("random", "warning"),
            ("deep/again", "pass"),
            ("equal", "pass"),
            ("faulty", "refused")
        ],
        "{said}"
    );
    assert_eq!(lines[0]["pixels"], 132_300);
    let why = lines[0]["why"].as_str().unwrap_or_default();
    assert!(why.starts_with("random: drawn again"), "{why}");
    assert_eq!(lines[4]["scenes"], 4);
    assert_eq!(ended.status.code(), Some(1));
    // Stored pictures are not drawn again; a scene that runs out of time stops nothing.
    let stored = fs::read_dir(here.join("kept")).expect("the folder").count();
    assert!(
        stored >= 2 * 4,
        "three pictures and one in another order: {stored}"
    );
    let hasty = povr(here, &[".", "--keep", "other", "--timeout", "1ms"]);
    let text = String::from_utf8_lossy(&hasty.stdout).into_owned();
    assert!(text.contains("4 scenes: 4 TIMEOUT"), "{text}");
    assert_eq!(hasty.status.code(), Some(4));
}

/// Uses the page, and writes its appearance and behaviour into attributes of the body.
const PROBE: &str = "
  const names = () => [...document.querySelectorAll('.wide tbody tr')].filter(row => !row.hidden).map(row => row.dataset.name).join();
  const wait = time => new Promise(done => setTimeout(done, time));
  const pointer = (target, kind, x) => target.dispatchEvent(new PointerEvent(kind, { bubbles: true, button: 0, clientX: x, clientY: 300 }));
  const set = (name, value, kind) => { const one = document.querySelector(name); one.value = value; one.dispatchEvent(new Event(kind)); };
  await Promise.all([...document.images].map(image => image.decode()));
  told.images = [...document.images].filter(image => image.naturalWidth > 0).length;
  told.tiles = [...document.querySelectorAll('.tiles tr')].map(row => row.dataset.name).join();
  told.painted = document.querySelectorAll('canvas.painted').length;
  document.querySelector('#grid').click();
  told.first = names();
  document.querySelector('th[data-key=name] button').click(); told.byName = names();
  set('#order', 'rms-', 'change'); told.byRms = names();
  set('#search', 'AGAIN', 'input'); told.searched = names();
  set('#search', '', 'input');
  document.querySelector('.chip.pass').click(); told.withoutPass = names();
  document.querySelector('.chip.pass').click();
  const boxes = [...document.querySelectorAll('tbody tr:not([hidden]) .pictures button, .name, td[data-label]')].map(one => one.getBoundingClientRect());
  told.overlaps = boxes.some((a, i) => boxes.slice(i + 1).some(b =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1));
  document.querySelector('[data-name=random] .pictures button').click();
  await wait(100);
  told.address = location.hash;
  const pane = document.querySelector('.window'), over = () => document.querySelector('.over').style.clipPath;
  told.slider = document.querySelectorAll('.stage canvas').length === 2 && over().includes('50%');
  const wide = pane.getBoundingClientRect();
  pointer(pane, 'pointerdown', wide.left + wide.width / 2); pointer(window, 'pointermove', wide.left + wide.width / 4); pointer(window, 'pointerup', 0);
  told.dragged = over().includes('25%') && document.querySelector('.line').style.left.startsWith('25');
  pane.dispatchEvent(new WheelEvent('wheel', { bubbles: true, cancelable: true, deltaY: -1, clientX: wide.left + 5, clientY: wide.top + 5 }));
  told.enlarged = new Set([...document.querySelectorAll('.stage canvas')].map(one => one.style.transform)).size === 1 && lens.factor > lens.fit;
  document.querySelector('[data-mode=difference]').click();
  told.marked = document.querySelectorAll('.stage .mark').length;
  const box = document.querySelector('dialog').getBoundingClientRect();
  told.fits = box.left >= 0 && box.right <= innerWidth + 1 && box.bottom <= innerHeight + 1;
  document.querySelector('[data-mode=beside]').click();
  told.beside = document.querySelectorAll('.stage figure').length;
  const key = name => document.querySelector('dialog').dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true }));
  key('4'); told.byKey = document.querySelectorAll('.stage .mark').length;
  key('ArrowRight'); await wait(100); told.next = document.querySelector('dialog h2').textContent;
";

#[test]
fn a_browser_shows_sorts_and_filters_the_report() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    scenes(here);
    // By stricter thresholds the random scene fails.
    let strict = [
        ".",
        "--html",
        "report.html",
        "--fail",
        "1e-6",
        "+W420",
        "+H315",
    ];
    assert_eq!(exit(here, &strict), Some(2));
    let Some(browser) = browser() else {
        println!("skipped: there is no Chromium; `tools/test` installs it");
        return;
    };
    let probed = here.join("probed.html");
    write_probed(&here.join("report.html"), &probed, PROBE);
    for window in WINDOWS {
        // A browser whose clock runs ahead of its decoding gives up early, or before it has painted.
        let mut dump = String::new();
        for _ in 0..8 {
            dump = shown(browser, &probed, window.0, window.1);
            let is_done = ["data-done=\"true\"", "data-painted=\"1\""];
            if is_done.iter().all(|fact| dump.contains(fact)) {
                break;
            }
        }
        assert!(dump.contains("<title>2 of 4 match · "), "{window:?}");
        let facts = [
            "data-images=\"9\"",
            "data-tiles=\"deep/again,equal\"",
            "data-painted=\"1\"",
            "data-first=\"random,deep/again,equal,faulty\"",
            "data-by-name=\"deep/again,equal,faulty,random\"",
            "data-by-rms=\"random,deep/again,equal,faulty\"",
            "data-searched=\"deep/again\"",
            "data-without-pass=\"random,faulty\"",
            "data-overlaps=\"false\"",
            "data-address=\"#random\"",
            "data-slider=\"true\"",
            "data-dragged=\"true\"",
            "data-enlarged=\"true\"",
            "data-marked=\"1\"",
            "data-fits=\"true\"",
            "data-beside=\"2\"",
            "data-by-key=\"1\"",
            "data-next=\"deep/again\"",
        ];
        expect(&dump, &facts, window);
    }
}
