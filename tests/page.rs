//! The pages of `povr curve`, `povr batch` and `povr sheet` in a browser: Debian's Chromium, headless.
//!
//! Without Chromium the test reports that and passes; `tools/test` installs it.

#![allow(
    clippy::print_stdout,
    reason = "what a test finds is read on the terminal; means have few digits"
)]

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;
use support::browser::{WINDOWS, browser, expect, shown, write_probed};

const TIME_LIMIT: Duration = Duration::from_secs(180);
const SCENE: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 angle 40 } light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb 0.3 } torus { 1, 0.2 rotate 60*x pigment { rgb <0.7, 0.4, 0.2> } }";

/// Writes the appearance of a curve into attributes of the body.
const CURVE: &str = "
  const images = [...document.images];
  told.images = images.length;
  told.loaded = images.filter(image => image.complete && image.naturalWidth === 64).length;
  const plots = [...document.querySelectorAll('.plot svg')].map(plot => plot.getBoundingClientRect());
  told.plots = plots.filter(plot => plot.width > 300 && plot.height > 100).length;
  told.stacked = innerWidth > 700 || plots.every((plot, at) => at === 0 || plot.top > plots[at - 1].bottom - 1);
  told.rows = document.querySelectorAll('tbody tr').length;
  const boxes = [...document.querySelectorAll('figure')].map(figure => figure.getBoundingClientRect());
  told.overlaps = boxes.some((a, i) => boxes.slice(i + 1).some(b =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1));
  // The dots of a plot are named by its measurements, and lie where these say: later dots of a line are slower.
  const dots = [...document.querySelector('.plot svg').querySelectorAll('circle.shot')];
  told.dots = dots.length;
  dots[0].dispatchEvent(new MouseEvent('click', { bubbles: true }));
  told.opened = document.querySelector('dialog').open && document.querySelector('dialog h2').textContent;
  told.shots = document.querySelectorAll('.stage img').length;
";

/// Uses a gallery, and writes what it sees into attributes of the body.
const GALLERY: &str = "
  const key = name => document.querySelector('dialog').dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true }));
  const heading = () => document.querySelector('dialog h2').textContent;
  told.heading = document.querySelector('h1').textContent;
  told.first = document.querySelector('figure').id;
  told.figures = document.querySelectorAll('figure').length;
  told.groups = document.querySelectorAll('section.group').length;
  document.querySelector('a.shot').click(); told.opened = heading(); told.address = location.hash;
  key('ArrowRight'); told.next = heading();
  key('ArrowLeft'); key('ArrowLeft'); told.back = heading();
  told.links = [...document.querySelectorAll('dialog footer a')].map(link => link.getAttribute('href')).join();
  told.text = document.querySelector('dialog footer').textContent.includes('object { Shape');
  const box = document.querySelector('dialog').getBoundingClientRect();
  told.fits = box.left >= 0 && box.right <= innerWidth + 1 && box.bottom <= innerHeight + 1;
  document.querySelector('dialog #close').click();
  told.closed = location.hash === '';
  const filter = document.querySelector('#filter'); filter.value = 'NONE'; filter.dispatchEvent(new Event('input'));
  told.shown = document.querySelector('#shown').textContent;
  filter.value = ''; filter.dispatchEvent(new Event('input'));
";

fn povr(here: &Path, arguments: &[&str]) {
    let mut command = Command::new(support::renderer());
    command.current_dir(here).args(arguments);
    support::run(&mut command, TIME_LIMIT).expect("povr starts");
}

#[test]
fn a_batch_shows_failures_first_and_its_pictures_one_by_one() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    fs::create_dir(here.join("in")).expect("a folder");
    for (name, text) in [("a", SCENE), ("b", SCENE), ("wrong", "sphere { <b>, 1 }")] {
        fs::write(here.join(format!("in/{name}.pov")), text).expect("a scene");
    }
    povr(
        here,
        &["batch", "in", "-o", "in/../out", "--sheet", "+W64", "+H48"],
    );
    let Some(browser) = browser() else {
        println!("skipped: there is no Chromium; `tools/test` installs it");
        return;
    };
    let probed = here.join("out/probed.html");
    write_probed(&here.join("out/index.html"), &probed, GALLERY);
    for window in WINDOWS {
        let dump = shown(browser, &probed, window.0, window.1);
        assert!(dump.contains("<title>2 pictures, 1 failed – povr batch</title>"));
        let facts = [
            "data-heading=\"2 pictures, 1 failed\"",
            "data-first=\"wrong\"",
            "data-opened=\"a  (1 of 2)\"",
            "data-address=\"#a\"",
            "data-next=\"b  (2 of 2)\"",
            "data-back=\"a  (1 of 2)\"",
            "data-links=\"a.png,../in/a.pov\"",
            "data-fits=\"true\"",
            "data-closed=\"true\"",
            "data-shown=\"0 of 3\"",
        ];
        expect(&dump, &facts, window);
    }
}

#[test]
fn a_sheet_is_in_groups_and_shows_the_text_of_a_scene() {
    let here = tempfile::tempdir().expect("a folder");
    let here = here.path();
    povr(here, &["sheet", "box", "--alone", "--size", "40x30"]);
    let Some(browser) = browser() else {
        println!("skipped: there is no Chromium; `tools/test` installs it");
        return;
    };
    let probed = here.join("probed.html");
    write_probed(&here.join("sheet/box/sheet.html"), &probed, GALLERY);
    for window in WINDOWS {
        let dump = shown(browser, &probed, window.0, window.1);
        assert!(dump.contains("<title>box: 39 pictures – povr sheet</title>"));
        let facts = [
            "data-first=\"overview\"",
            "data-figures=\"39\"",
            "data-groups=\"8\"",
            "data-next=\"none  (2 of 39)\"",
            "data-text=\"true\"",
            "data-fits=\"true\"",
            "data-shown=\"1 of 39\"",
        ];
        expect(&dump, &facts, window);
    }
}

#[test]
fn a_browser_shows_the_whole_page() {
    let here = tempfile::tempdir().expect("a folder");
    let scene = here.path().join("ring.pov");
    fs::write(&scene, SCENE).expect("a scene");
    let mut command = Command::new(support::renderer());
    command
        .current_dir(here.path())
        .args([
            "curve", "ring.pov", "+W64", "+H48", "--runs", "2", "--truth", "1", "--out", "out",
        ])
        .args(["--settings", "-A; --error 4; --error 2; +A0.1 +AM1 +R2 -J"]);
    let ended = support::run(&mut command, TIME_LIMIT).expect("povr starts");
    assert!(
        ended.status.is_some_and(|status| status.success()),
        "{}",
        ended.stderr
    );
    let out = here.path().join("out");
    for file in ["curve.csv", "curve.json", "curve.svg", "index.html"] {
        assert!(out.join(file).is_file(), "{file} is missing");
    }
    assert_eq!(
        fs::read_to_string(out.join("curve.csv"))
            .expect("a table")
            .lines()
            .count(),
        5
    );
    let plot = fs::read_to_string(out.join("curve.svg")).expect("a plot");
    assert!(plot.matches("<circle").count() >= 4, "the plot is empty");
    if cfg!(feature = "plot-png") {
        let plot = image::open(out.join("curve.png"))
            .expect("a picture")
            .to_rgb8();
        let ink = plot.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
        assert!(ink > 2000, "the plot is empty");
    }

    let Some(browser) = browser() else {
        println!("skipped: there is no Chromium; `tools/test` installs it");
        return;
    };
    let probed = out.join("probed.html");
    write_probed(&out.join("index.html"), &probed, CURVE);
    for window in WINDOWS {
        let dump = shown(browser, &probed, window.0, window.1);
        let facts = [
            "data-images=\"9\"",
            "data-loaded=\"9\"",
            "data-plots=\"3\"",
            "data-stacked=\"true\"",
            "data-rows=\"4\"",
            "data-overlaps=\"false\"",
            "data-dots=\"4\"",
            "data-opened=\"povr --error",
            "data-shots=\"2\"",
            "povr +A0.1 +AM1 +R2 -J",
        ];
        expect(&dump, &facts, window);
    }
}
