//! Single points of small scenes against POV-Ray 3.7.0.10, as it writes them with `+FN16 File_Gamma=1.0`.
//!
//! Each scene is the text that POV-Ray read, without the header that [`HEAD`] and [`view`] add. The picture has one
//! pixel, whose ray runs along z. The tests run the whole pipeline from text to light.

mod area;
mod blocks;
mod glass;
mod light;
mod mirrors;
mod settings;

use super::{Sample, Tracer};
use crate::base::color::Rgb;
use crate::base::options::{ReadOptions, RenderOptions};
use crate::base::source::Sources;
use crate::lang;
use crate::render::shade::Scratch;
use crate::world::{World, compile};

/// The text before each scene, besides the version of the test.
const HEAD: &str = "global_settings { assumed_gamma 1 }";
/// Two steps of the sixteen bits.
const TOLERANCE: f64 = 2.0 / 65_535.0;

/// A camera whose only ray starts at `<x, y, -5>` along z.
fn view(x: f64, y: f64) -> String {
    format!(
        "camera {{ orthographic location <{x}, {y}, -5> right <0.001, 0, 0> up <0, 0.001, 0> }}"
    )
}

/// The world of a scene's text.
fn world(text: &str, version: f64, has_alpha: bool) -> World {
    let options = RenderOptions {
        alpha: has_alpha,
        ..RenderOptions::default()
    };
    world_for(text, version, &options)
}

/// The same for pictures with these options.
fn world_for(text: &str, version: f64, options: &RenderOptions) -> World {
    let mut sources = Sources::new(Vec::new());
    let file = sources.add_text("test", format!("#version {version}; {HEAD} {text}"));
    let reading = lang::evaluate(file, &mut sources, &ReadOptions::default());
    let scene = reading
        .scene
        .unwrap_or_else(|| panic!("{text}\n{:?}", reading.findings));
    compile(scene, options)
}

/// The sample of the only ray of a scene.
fn sample(x: f64, y: f64, text: &str, has_alpha: bool, quality: u8, version: f64) -> Sample {
    let world = world(&(view(x, y) + text), version, has_alpha);
    Tracer::new(&world, quality).pixel(0.0, 0.0, 1, 1, &mut Scratch::default())
}

fn assert_close(text: &str, rgb: Rgb, expected: [f64; 3]) {
    let rgb = [rgb.r, rgb.g, rgb.b].map(|c| f64::from(c).clamp(0.0, 1.0));
    let is_close = rgb
        .iter()
        .zip(expected)
        .all(|(a, b)| (a - b).abs() <= TOLERANCE);
    assert!(
        is_close,
        "{text}\nfound {rgb:?}, POV-Ray has {expected:?} after {HEAD}"
    );
}

/// The scene seen from `<x, y, -5>` along z has this colour in POV-Ray.
fn shows(x: f64, y: f64, text: &str, expected: [f64; 3]) {
    assert_close(text, sample(x, y, text, false, 9, 3.7).rgb, expected);
}

/// The same with `#version 3.6;` before it.
fn shows_in_36(x: f64, y: f64, text: &str, expected: [f64; 3]) {
    assert_close(text, sample(x, y, text, false, 9, 3.6).rgb, expected);
}

/// The same with `#version 3.1;` before it.
fn shows_in_31(x: f64, y: f64, text: &str, expected: [f64; 3]) {
    assert_close(text, sample(x, y, text, false, 9, 3.1).rgb, expected);
}

/// The same with `+Q` and a quality.
fn shows_at_quality(quality: u8, text: &str, expected: [f64; 3]) {
    assert_close(
        text,
        sample(0.0, 0.0, text, false, quality, 3.7).rgb,
        expected,
    );
}

/// The same with `+UA`: red, green, blue, not multiplied by alpha, and alpha.
fn shows_with_alpha(version: f64, text: &str, expected: [f64; 4]) {
    let sample = sample(0.0, 0.0, text, true, 9, version);
    let alpha = f64::from(1.0 - sample.transmit);
    assert!(
        (alpha - expected[3]).abs() <= TOLERANCE,
        "{text}\nalpha is {alpha}"
    );
    let pure = if alpha > 0.0 { 1.0 / alpha } else { 0.0 };
    assert_close(
        text,
        sample.rgb * pure,
        [expected[0], expected[1], expected[2]],
    );
}

#[test]
fn a_thousand_panes_do_not_use_up_the_stack() {
    let pane = |i: u16| {
        format!(
            "plane {{ <0, 0, 1>, {i} pigment {{ rgbt 1 }} finish {{ ambient 0.001 diffuse 0 }} }}"
        )
    };
    let text: String = (0..1000).map(pane).collect();
    let seen = sample(0.0, 0.0, &text, false, 9, 3.7);
    assert_eq!((seen.rgb, seen.transmit), (Rgb::BLACK, 1.0));
}

#[test]
fn two_mirrors_end_at_the_trace_level() {
    let text = "global_settings { max_trace_level 5 }
        plane { <0, 0, -1>, 0 pigment { rgb 1 } finish { ambient 0.125 diffuse 0 reflection 1 } }
        plane { <0, 0, -1>, 6 pigment { rgb 1 } finish { ambient 0.125 diffuse 0 reflection 1 } }";
    // The camera stands between them, at z = -5.
    let seen = sample(0.0, 0.0, text, false, 9, 3.7);
    assert_eq!(seen.rgb, Rgb::splat(5.0 * 0.125));
}

#[test]
fn a_camera_without_a_ray_sees_nothing() {
    let world = world(
        "camera { direction 0 right 0 up 0 } background { rgb 1 }",
        3.7,
        false,
    );
    let seen = Tracer::new(&world, 9).pixel(0.0, 0.0, 1, 1, &mut Scratch::default());
    assert_eq!((seen.rgb, seen.transmit), (Rgb::BLACK, 1.0));
}
