//! Every picture of the next version of a scene is that of a fresh one, and little edits keep the world and the tiles.

use super::{Next, next};
use crate::base::math::sampling::random::Random;
use crate::base::options::{Antialias, Input, ReadOptions, RenderOptions, Sampling};
use crate::{CompiledScene, RenderSession};
use std::fmt::Write;

const HEAD: &str = "#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 4, -12> look_at 0 }
light_source { <4, 9, -8>, 1 }
#declare T = texture { pigment { rgb <0.2, 0.9, 0.3> } finish { reflection 0.2 } }
plane { y, -2 pigment { rgb 0.8 } }
";

fn render() -> RenderOptions {
    RenderOptions {
        threads: Some(1),
        ..RenderOptions::of_size(160, 120)
    }
}

fn input(text: &str) -> Input {
    Input::Text {
        name: "test.pov".to_owned(),
        text: text.as_bytes().to_vec(),
    }
}

fn compiled(text: &str, render: &RenderOptions) -> CompiledScene {
    let session = RenderSession::new(None);
    let options = (&ReadOptions::default(), render);
    let scene = session.compile_next(&mut None, &input(text), options, None, &|_| {});
    scene.unwrap_or_else(|failure| panic!("{failure:?}"))
}

fn pixels(scene: &CompiledScene, render: &RenderOptions) -> Vec<[u32; 4]> {
    let session = RenderSession::new(None);
    let drawn = scene.draw(&ReadOptions::default(), render, &|_| {}, &session);
    let film = drawn.unwrap_or_else(|failure| panic!("{failure:?}")).film;
    let bits = |pixel: &crate::base::film::Pixel| {
        let rgb = pixel.rgb;
        [rgb.r, rgb.g, rgb.b, pixel.transmit].map(f32::to_bits)
    };
    film.pixels.iter().map(bits).collect()
}

/// The number of tiles that are cached of a picture.
fn cached_tiles(scene: &CompiledScene, render: &RenderOptions) -> usize {
    let tiles = scene.pictures.of(&scene.world.camera, render);
    tiles.map_or(0, |tiles| tiles.count())
}

/// Draws a scene and then its next version, and compares the picture with that of a fresh scene. Returns the number of tiles
/// that stayed, if the world stayed; otherwise `None`.
fn reused_tiles(old: &str, new: &str, render: &RenderOptions) -> Option<usize> {
    let last = || {
        let last = compiled(old, render);
        let _ = pixels(&last, render);
        Some(last)
    };
    let (session, read, input) = (RenderSession::new(None), ReadOptions::default(), input(new));
    let options = (&read, render);
    let (scene, reused) = match next((&mut last(), None), &input, options, &|_| {}, &session) {
        Ok(Next::Compiled(scene)) => {
            let reused = cached_tiles(&scene, render);
            (*scene, Some(reused))
        }
        _ => {
            let scene = session.compile_next(&mut last(), &input, options, None, &|_| {});
            (scene.unwrap_or_else(|failure| panic!("{failure:?}")), None)
        }
    };
    assert!(
        pixels(&scene, render) == pixels(&compiled(new, render), render),
        "{new}"
    );
    reused
}

fn spheres(count: u32) -> String {
    let mut text = HEAD.to_owned();
    for at in 0..count {
        let (x, z) = (at % 40, at / 40);
        let texture = match at % 3 {
            0 => "pigment { rgb <1, 0.5, 0> } finish { phong 0.5 }",
            1 => "texture { T }",
            _ => "pigment { checker rgb 1, rgb x scale 0.1 }",
        };
        let (x, z) = (f64::from(x) / 4.0 - 5.0, f64::from(z) / 4.0);
        writeln!(text, "sphere {{ <{x}, 0, {z}>, 0.125 {texture} }}").unwrap();
    }
    text
}

/// The text with another one in the place of the one that occurs there for the n-th time.
fn replaced(text: &str, number: usize, old: &str, new: &str) -> String {
    let (at, _) = text.match_indices(old).nth(number).expect("it occurs");
    format!("{}{new}{}", &text[..at], &text[at + old.len()..])
}

/// The number of tiles of a picture.
const TILES: usize = 20;

#[test]
fn another_pigment_keeps_the_world_and_most_tiles() {
    let old = spheres(1500);
    let new = replaced(&old, 30, "rgb <1, 0.5, 0>", "rgb <0, 0.5, 1.25>");
    let reused = reused_tiles(&old, &new, &render()).expect("the world stays");
    assert!((TILES / 2..TILES).contains(&reused), "{reused}");
    let sampling = Sampling::PovRay(Antialias::default());
    let reused = reused_tiles(
        &old,
        &new,
        &RenderOptions {
            sampling,
            ..render()
        },
    );
    assert!(
        reused.is_some_and(|reused| (2..TILES / 2 + 4).contains(&reused)),
        "{reused:?}"
    );
}

#[test]
fn a_comment_keeps_scenes_of_large_and_shared_shapes() {
    let mut text = HEAD.to_owned() + "#declare Blob = blob { threshold 0.5\n";
    for at in 0..3000 {
        let (x, z) = (f64::from(at % 60) / 10.0, f64::from(at / 60) / 10.0);
        writeln!(text, "  sphere {{ <{x} - 3, 0.1, {z}>, 0.2, 1 }}").unwrap();
    }
    text += "}\n#declare Two = difference { object { Blob } box { 0, 2 } }\n";
    for at in 0..100 {
        let of = ["Blob scale 0.1", "Two scale 0.2"][at % 2];
        writeln!(text, "object {{ {of} translate <{}, 0.5, 2> }}", at / 10).unwrap();
    }
    text += "mesh { #for (I, 0, 4000) triangle { <I/400, 0, 0>, <I/400, 1, 0>, <I/400 + 1/400, 1, 0> } #end }\n";
    text += "light_source { <9, 9, -9>, 0.5 area_light x, y, 3, 3 adaptive 0 }\n";
    text += "height_field { function 9, 9 { x } smooth pigment { object { box { -1, 1 } } } translate <2, -1, 3> }\n";
    let new = replaced(&text, 0, "mesh", "// a mesh\nmesh");
    assert_eq!(reused_tiles(&text, &new, &render()), Some(TILES));
    let other = replaced(&text, 0, "1/400, 1, 0", "1/400, 1.5, 0");
    assert_eq!(reused_tiles(&text, &other, &render()), None);
    let other = replaced(&text, 0, "box { -1, 1 }", "sphere { 0, 1 }");
    assert!(reused_tiles(&text, &other, &render()).is_some_and(|reused| reused < TILES));
}

#[test]
fn textures_alone_may_change_to_keep_the_world() {
    let old = spheres(600);
    let check = |number: usize, from: &str, to: &str| {
        reused_tiles(&old, &replaced(&old, number, from, to), &render())
    };
    // Another finish, and a comment.
    assert!(check(100, "phong 0.5", "phong 0.75").is_some_and(|reused| reused > 0));
    assert!(check(7, "sphere", "// sphere\n  sphere").is_some_and(|reused| reused > 0));
    assert_eq!(check(0, "camera", "\n// camera\ncamera"), Some(TILES));
    // Another pattern: where one jumps, hits are rounded.
    assert!(check(100, "scale 0.1", "scale 0.2").is_some_and(|reused| reused > 0));
    assert_eq!(
        check(
            100,
            "pigment { checker rgb 1, rgb x scale 0.1 }",
            "pigment { rgb 1 }"
        ),
        None
    );
    // A shape, a transform, a flag, transparency, and one object more or less.
    assert_eq!(check(300, "0.125", "0.126"), None);
    assert_eq!(check(100, "phong 0.5 }", "phong 0.5 } rotate y"), None);
    assert_eq!(check(100, "phong 0.5 }", "phong 0.5 } no_shadow"), None);
    assert_eq!(check(100, "rgb <1, 0.5, 0>", "rgbt <1, 0.5, 0, 0.5>"), None);
    assert_eq!(check(100, "sphere", "sphere { 0, 0.1 } sphere"), None);
    // A finish that makes an interior.
    assert_eq!(check(100, "phong 0.5 }", "phong 0.5 ior 1.3 }"), None);
    // The light, the version and the settings.
    assert_eq!(check(0, "<4, 9, -8>", "<4, 9, -7>"), None);
    assert_eq!(check(0, "assumed_gamma 1", "assumed_gamma 2"), None);
    assert_eq!(
        check(0, "global_settings {", "global_settings { ambient_light 2"),
        None
    );
}

#[test]
fn the_camera_alone_may_change() {
    let old = spheres(600);
    let new = replaced(&old, 0, "<0, 4, -12>", "<1, 4, -12>");
    assert_eq!(reused_tiles(&old, &new, &render()), Some(0));
}

#[test]
fn glass_in_another_color_redraws_all_tiles() {
    let old = spheres(600)
        + "sphere { <0, 2, -2>, 1 pigment { rgbf <1, 0.8, 0.8, 0.9> } interior { ior 1.5 } }";
    let new = old.replace("<1, 0.8, 0.8, 0.9>", "<0.8, 1, 0.8, 0.8>");
    assert_eq!(reused_tiles(&old, &new, &render()), Some(0));
}

#[test]
fn parts_of_unions_get_other_textures() {
    let old = spheres(600);
    let (head, spheres) = old.split_once("rgb 0.8 } }\n").unwrap();
    let old =
        format!("{head}rgb 0.8 }} }}\nunion {{ {spheres} rotate 3*y finish {{ ambient 0.2 }} }}");
    let new = replaced(&old, 100, "rgb <1, 0.5, 0>", "rgb <0, 0.5, 1>");
    let reused = reused_tiles(&old, &new, &render());
    assert!(reused.is_some_and(|reused| reused > 0), "{reused:?}");
    assert_eq!(
        reused_tiles(&old, &old.replace("rotate 3", "rotate 4"), &render()),
        None
    );
}

#[test]
fn parts_of_long_unions_get_other_textures() {
    let old = spheres(6000);
    let (head, spheres) = old.split_once("rgb 0.8 } }\n").unwrap();
    let old = format!("{head}rgb 0.8 }} }}\nunion {{ {spheres} }}");
    let new = replaced(&old, 1000, "rgb <1, 0.5, 0>", "rgb <0, 0.5, 1>");
    let reused = reused_tiles(&old, &new, &render());
    assert!(reused.is_some_and(|reused| reused > 0), "{reused:?}");
}

#[test]
fn what_directives_change_is_read_again() {
    let head = format!(
        "{HEAD}#declare A = 0.5; #declare R = seed(4);
        #macro M(X) pigment {{ rgb <X, A, rand(R)> }} #end\n"
    );
    let mut old = head;
    for at in 0..300 {
        writeln!(
            old,
            "sphere {{ <{}, 0, 0>, 0.1 M({}) }}",
            at % 20 - 10,
            f64::from(at) / 300.0
        )
        .unwrap();
    }
    for at in 0..800 {
        writeln!(
            old,
            "sphere {{ <{}, {}, 0>, 0.1 texture {{ T }} }}",
            at % 20 - 10,
            at / 20 % 3
        )
        .unwrap();
    }
    old += "box { <-9, -1, 5>, <9, 1, 6> pigment { rgb <A, 0, rand(R)> } }\n";
    let check = |from: &str, to: &str| reused_tiles(&old, &replaced(&old, 0, from, to), &render());
    assert!(check("A = 0.5", "A = 0.75").is_some());
    assert!(check("seed(4)", "seed(5)").is_some());
    assert!(check("<X, A,", "<X, X,").is_some());
    assert!(check("rgb <0.2, 0.9, 0.3>", "rgb <0.9, 0.2, 0.3>").is_some());
    assert!(
        check(
            "#declare A",
            "#default { finish { ambient 0.5 } } #declare A"
        )
        .is_some()
    );
    assert_eq!(
        check("sphere {", "sphere { <0, rand(R), 0>, 1 } sphere {"),
        None
    );
    assert!(check("#declare A", "#default { pigment { rgbt 0.5 } } #declare A").is_some());
}

#[test]
fn included_files_are_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, included) = (
        folder.path().join("scene.pov"),
        folder.path().join("textures.inc"),
    );
    std::fs::write(
        &scene,
        spheres(600).replace("plane", "#include \"textures.inc\"\nplane"),
    )
    .unwrap();
    let (read, render) = (ReadOptions::default(), render());
    let read_scene = |last: &mut Option<CompiledScene>| {
        let (session, input) = (RenderSession::new(None), Input::File(scene.clone()));
        let scene = session.compile_next(last, &input, (&read, &render), None, &|_| {});
        scene.unwrap_or_else(|failure| panic!("{failure:?}"))
    };
    let mut last = None;
    for texture in [
        "pigment { rgb x }",
        "pigment { rgb y }",
        "pigment { rgb z } finish { phong 1 }",
    ] {
        std::fs::write(&included, format!("#declare T = texture {{ {texture} }}")).unwrap();
        let next = read_scene(&mut last);
        assert!(
            pixels(&next, &render) == pixels(&read_scene(&mut None), &render),
            "{texture}"
        );
        last = Some(next);
    }
}

#[test]
fn a_version_with_errors_leaves_the_last_one() {
    let old = spheres(600);
    let mut last = Some(compiled(&old, &render()));
    let session = RenderSession::new(None);
    let (read, render) = (ReadOptions::default(), render());
    let broken = input(&replaced(&old, 100, "phong 0.5 }", "phong 0.5"));
    let failed = session.compile_next(&mut last, &broken, (&read, &render), None, &|_| {});
    assert!(failed.is_err() && last.is_some());
}

/// A random little edit of a text.
fn edited(text: &str, random: &mut Random) -> String {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small numbers"
    )]
    let mut below = |count: usize| (random.uniform() * count as f64) as usize;
    let lines: Vec<&str> = text.lines().collect();
    let at = below(lines.len());
    let line = lines[at];
    let digits: Vec<_> = line.match_indices(|c: char| c.is_ascii_digit()).collect();
    let new = match below(8) {
        0 => String::new(),
        1 => format!("{line}\n{line}"),
        2 => line.replace("pigment {", "pigment { quick_color rgb 1"),
        3 => line.replace("rgb <1,", "rgb <0.25,"),
        4 => line.replace("texture { T }", "texture { T finish { ambient 0.4 } }"),
        5 => "#declare T = texture { pigment { rgb y } }".to_owned(),
        _ if digits.is_empty() => line.to_owned(),
        _ => {
            let (digit, old) = digits[below(digits.len())];
            let new = below(10).to_string();
            format!("{}{new}{}", &line[..digit], &line[digit + old.len()..])
        }
    };
    let around = [&lines[..at], &[new.as_str()], &lines[at + 1..]];
    around.concat().join("\n") + "\n"
}

#[test]
fn pictures_after_random_edits_are_those_of_fresh_scenes() {
    let mut random = Random::new(7);
    let sampling = Sampling::PovRay(Antialias::default());
    let render = RenderOptions {
        sampling,
        ..RenderOptions::of_size(96, 72)
    };
    let read = ReadOptions::default();
    let mut text = spheres(600);
    let mut last = Some(compiled(&text, &render));
    let mut reused = 0;
    for _ in 0..60 {
        let new = edited(&text, &mut random);
        let session = RenderSession::new(None);
        let next = session.compile_next(&mut last, &input(&new), (&read, &render), None, &|_| {});
        let Ok(next) = next else {
            continue;
        };
        reused += usize::from(cached_tiles(&next, &render) > 0);
        assert!(
            pixels(&next, &render) == pixels(&compiled(&new, &render), &render),
            "{new}"
        );
        (text, last) = (new, Some(next));
    }
    assert!((10..55).contains(&reused), "{reused}");
}
