//! The page of `povr curve` in a browser: Debian's Chromium, headless.
//!
//! Without Chromium the test reports that and passes; `tools/test` installs it.

#![allow(
    clippy::print_stdout,
    reason = "what a test finds is read on the terminal; means have few digits"
)]

mod support;

use std::fs;
use std::process::Command;
use std::time::Duration;
use support::browser::{browser, shown};

const TIME_LIMIT: Duration = Duration::from_secs(180);
const SCENE: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 angle 40 } light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb 0.3 } torus { 1, 0.2 rotate 60*x pigment { rgb <0.7, 0.4, 0.2> } }";

/// Appended to a copy of the page: writes its appearance into attributes of the body, which a dump of the document
/// shows.
const PROBE: &str = "<script>addEventListener('load', () => {
  const told = document.body.dataset, images = [...document.images];
  told.images = images.length;
  told.loaded = images.filter(image => image.complete && image.naturalWidth === 64).length;
  told.overflow = document.documentElement.scrollWidth > innerWidth;
  const plot = document.querySelector('.plot svg').getBoundingClientRect();
  told.plot = plot.width > 300 && plot.height > 100;
  told.marks = document.querySelectorAll('.plot svg circle').length;
  told.rows = document.querySelectorAll('tbody tr').length;
  const boxes = [...document.querySelectorAll('figure')].map(figure => figure.getBoundingClientRect());
  told.overlaps = boxes.some((a, i) => boxes.slice(i + 1).some(b =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1));
  told.elsewhere = performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length;
});</script>";

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
    let page = fs::read_to_string(out.join("index.html")).expect("a page");
    let probed = out.join("probed.html");
    fs::write(&probed, page.replace("</body>", &format!("{PROBE}</body>"))).expect("a page");
    for width in [1400, 500] {
        let dump = shown(browser, &probed, width);
        for fact in [
            "data-images=\"9\"",
            "data-loaded=\"9\"",
            "data-overflow=\"false\"",
            "data-plot=\"true\"",
            "data-rows=\"4\"",
            "data-overlaps=\"false\"",
            "data-elsewhere=\"0\"",
            "povr +A0.1 +AM1 +R2 -J",
        ] {
            assert!(
                dump.contains(fact),
                "{fact} at {width}: {}",
                &dump[dump.find("<body").unwrap_or(0)..]
                    .chars()
                    .take(600)
                    .collect::<String>()
            );
        }
    }
}
