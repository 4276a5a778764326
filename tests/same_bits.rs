//! The same picture, bit for bit, for any number of threads and for any part of it.

use povr::base::film::Film;
use povr::base::options::{
    Adaptive, Antialias, Input, Method, Picture, ReadOptions, RenderOptions, Sampling,
};
use std::time::Duration;

/// A scene with mirrors, glass, shadows, patterns and solids.
const SCENE: &str = "#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
light_source { <5, 3, -2>, rgb <0.3, 0.2, 0.4> }
plane { y, -1 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } finish { reflection 0.2 } }
sphere { <0.3, 0.4, -2>, 0.008 pigment { rgb 1 } finish { ambient 3 } }
sphere { <-1.2, 0, 0>, 1 pigment { rgbf <0.9, 0.95, 1, 0.9> } interior { ior 1.5 } }
difference {
  box { -0.8, 0.8 }
  cylinder { -2*z, 2*z, 0.5 }
  torus { 0.8, 0.2 rotate 90*x }
  rotate <20, 30, 0> translate 1.2*x
  pigment { rgb <0.8, 0.5, 0.2> } finish { phong 0.8 reflection 0.1 }
}
#declare Part = union { #for (I, 1, 20) sphere { <cos(I), 0.1 * I, sin(I)>, 0.2 } #end }
#for (I, 1, 600)
  object { Part pigment { rgb <0.2, 0.6, 0.3> } scale 0.1 rotate I * y translate <sin(9 * I) * 3, -0.9, 2 * cos(7 * I)> }
#end";

const CONVERGING: Sampling = Sampling::Adaptive(Adaptive {
    error: 2.0,
    time: None,
});

const WIDTH: u32 = 101;
const HEIGHT: u32 = 75;

fn options() -> RenderOptions {
    let (columns, rows) = (0..WIDTH, 0..HEIGHT);
    RenderOptions {
        width: WIDTH,
        height: HEIGHT,
        columns,
        rows,
        ..RenderOptions::default()
    }
}

fn drawn(scene: &str, options: &RenderOptions) -> Film {
    picture(scene, options).film
}

fn picture(scene: &str, options: &RenderOptions) -> Picture {
    let input = Input::Text {
        name: "same_bits.pov".to_owned(),
        text: scene.into(),
    };
    let read = ReadOptions {
        width: WIDTH,
        height: HEIGHT,
        ..ReadOptions::default()
    };
    povr::draw(&input, &read, options, &|_| {}).expect("the scene is right")
}

#[test]
fn any_number_of_threads_draws_the_same_picture() {
    for sampling in [Sampling::Centres, CONVERGING] {
        let with = |threads| {
            drawn(
                SCENE,
                &RenderOptions {
                    threads: Some(threads),
                    sampling,
                    ..options()
                },
            )
        };
        let one = with(1);
        assert_eq!(one, with(2), "{sampling:?}");
        assert_eq!(one, with(7), "{sampling:?}");
    }
}

#[test]
fn antialiased_pictures_take_the_same_rays_with_any_number_of_threads() {
    let of_38 = SCENE.replace("3.7", "3.8");
    for (method, scene) in [
        (Method::One, SCENE),
        (Method::Two, SCENE),
        (Method::Three, &of_38),
    ] {
        let with = |threads| {
            let sampling = Sampling::PovRay(Antialias {
                method,
                ..Antialias::default()
            });
            let options = RenderOptions {
                threads: Some(threads),
                sampling,
                ..options()
            };
            let Picture {
                film, statistics, ..
            } = picture(scene, &options);
            (film, statistics.rays)
        };
        let one = with(1);
        assert_eq!(one, with(2), "{method:?}");
        assert_eq!(one, with(7), "{method:?}");
    }
}

/// Shadow rays of an area light that hit opaque cones and a pane of glass in any order.
const PANE: &str = include_str!("../pov_scenes/light/area_behind_glass.pov");

/// Area lights that ground fog attenuates behind panes.
const FOG: &str = include_str!("../pov_scenes/atmosphere/ground_fog_area_light.pov");

#[test]
fn opaque_shadows_behind_glass_do_not_depend_on_the_pixels_before() {
    strips_are_those_of_the_whole(PANE);
}

#[test]
fn fog_before_area_lights_does_not_depend_on_the_pixels_before() {
    strips_are_those_of_the_whole(FOG);
}

fn strips_are_those_of_the_whole(scene: &str) {
    let whole = drawn(scene, &options());
    for first in (0..HEIGHT).step_by(5) {
        let rows = first..(first + 5).min(HEIGHT);
        let strip = RenderOptions {
            rows: rows.clone(),
            threads: Some(1),
            ..options()
        };
        let film = drawn(scene, &strip);
        let pixels = (rows.start * WIDTH) as usize..(rows.end * WIDTH) as usize;
        assert_eq!(
            film.pixels[pixels.clone()],
            whole.pixels[pixels],
            "rows {rows:?}"
        );
    }
}

#[test]
fn a_part_is_drawn_as_in_the_whole_picture() {
    let povray = |method| {
        Sampling::PovRay(Antialias {
            method,
            threshold: 0.1,
            ..Antialias::default()
        })
    };
    for sampling in [
        Sampling::Centres,
        povray(Method::One),
        povray(Method::Two),
        CONVERGING,
    ] {
        let whole = drawn(
            SCENE,
            &RenderOptions {
                sampling,
                ..options()
            },
        );
        let part = RenderOptions {
            columns: 13..70,
            rows: 5..64,
            sampling,
            ..options()
        };
        let film = drawn(SCENE, &part);
        for y in part.rows.clone() {
            for x in part.columns.clone() {
                let at = (y * WIDTH + x) as usize;
                assert_eq!(
                    film.pixels[at], whole.pixels[at],
                    "at {x}, {y} with {sampling:?}"
                );
            }
        }
    }
}

/// Jittered area lights, grain, and randomly sampled fog.
const CHANCE: &str = "#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 area_light 3*x, 3*z, 4, 4 adaptive 1 jitter }
plane { y, -1 pigment { rgb 0.8 } finish { crand 0.2 } }
sphere { <-1, 0, 0>, 1 pigment { rgbt <0.9, 0.6, 0.5, 0.5> } finish { reflection 0.3 } }
sphere { <1, 0, 0>, 1 hollow pigment { rgbt 1 } interior { media { method 1 intervals 2 emission 0.4 } } }";

#[test]
fn random_numbers_are_the_same_for_any_number_of_threads_and_any_part() {
    for sampling in [Sampling::Centres, Sampling::PovRay(Antialias::default())] {
        let with = |threads, options| {
            let options = RenderOptions {
                threads: Some(threads),
                sampling,
                ..options
            };
            drawn(CHANCE, &options)
        };
        let whole = with(1, options());
        assert_eq!(whole, with(5, options()), "{sampling:?}");
        let part = RenderOptions {
            columns: 40..70,
            rows: 35..64,
            ..options()
        };
        let film = with(3, part.clone());
        for y in part.rows.clone() {
            for x in part.columns.clone() {
                let at = (y * WIDTH + x) as usize;
                assert_eq!(film.pixels[at], whole.pixels[at], "at {x}, {y}");
            }
        }
    }
}

#[test]
fn random_numbers_of_large_pictures_are_the_same_for_any_number_of_threads_and_any_part() {
    let large = RenderOptions {
        width: 512,
        height: 257,
        columns: 0..512,
        rows: 100..164,
        ..options()
    };
    assert!(!large.uses_sequential_random());
    let with = |threads, options| {
        let threads = Some(threads);
        drawn(CHANCE, &RenderOptions { threads, ..options })
    };
    let whole = with(1, large.clone());
    assert_eq!(whole, with(5, large.clone()));
    let (columns, rows) = (200..270, 110..140);
    let part = with(
        3,
        RenderOptions {
            columns,
            rows,
            ..large
        },
    );
    for y in 110..140 {
        for x in 200..270 {
            let at = y * 512 + x;
            assert_eq!(part.pixels[at], whole.pixels[at], "at {x}, {y}");
        }
    }
}

/// A closed interior lit by diffuse interreflection, with radiosity samples taken during the render as well.
const INTERIOR: &str = "#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 30 error_bound 0.6 minimum_reuse 0.004 ALWAYS } }
camera { location <0, 3, -7> look_at <0, 1.5, 0> angle 60 }
light_source { <1.5, 4.5, -1.5>, rgb 0.8 }
box { <-4, 0, -8>, <4, 5, 4> inverse pigment { checker rgb <0.9, 0.3, 0.2> rgb 0.9 } finish { diffuse 0.7 } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.2, 0.8, 0.3> } finish { diffuse 0.4, 0.4 } }
cylinder { <1.5, 0, 1>, <1.5, 2, 1>, 0.8 pigment { rgb <0.3, 0.4, 1> } finish { reflection 0.3 } }";

#[test]
fn any_number_of_threads_gathers_the_same_light() {
    let antialias = Sampling::PovRay(Antialias::default());
    for (scene, sampling) in [
        (INTERIOR.replace("ALWAYS", ""), Sampling::Centres),
        (
            INTERIOR.replace("ALWAYS", "always_sample on"),
            Sampling::Centres,
        ),
        (INTERIOR.replace("ALWAYS", "always_sample on"), antialias),
        (INTERIOR.replace("ALWAYS", ""), CONVERGING),
    ] {
        let with = |threads| {
            let options = RenderOptions {
                threads: Some(threads),
                sampling,
                ..options()
            };
            drawn(&scene, &options)
        };
        let one = with(1);
        assert_eq!(one, with(2), "{sampling:?}");
        assert_eq!(one, with(5), "{sampling:?}");
    }
}

/// A glass sphere with a caustic on the floor and in the box around it.
const CAUSTIC: &str = "#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.1 media 20 } }
camera { location <0, 4, -6> look_at <0, 0.4, 0> }
light_source { <3, 8, -2>, 1 }
plane { y, 0 pigment { rgb 1 } }
box { <-3, 0.01, -2>, <3, 3, 2> hollow pigment { rgbt 1 } photons { pass_through refraction on }
  interior { media { scattering { 1, 0.05 } } } }
sphere { <0, 1.2, 0>, 1 pigment { rgbf <1, 0.8, 0.7, 0.9> } finish { reflection 0.1 } interior { ior 1.5 }
  photons { target refraction on reflection on } }";

#[test]
fn any_number_of_threads_sees_the_same_photons() {
    let with = |threads| {
        let options = RenderOptions {
            threads: Some(threads),
            ..options()
        };
        drawn(CAUSTIC, &options)
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(5));
}

/// Scales every length of the scene by a power of two.
fn scaled(factor: f64) -> String {
    format!(
        "#version 3.7;
        global_settings {{ assumed_gamma 1 }}
        #declare S = {factor};
        camera {{ location <0, 2, -6>*S direction z*S right 1.33*x*S up y*S look_at 0 }}
        light_source {{ <-4, 6, -8>*S, rgb 1 }}
        sphere {{ <-1.2, 0, 0>*S, S pigment {{ rgbf <0.9, 0.95, 1, 0.9> }} interior {{ ior 1.5 }} }}
        difference {{
          box {{ -0.8*S, 0.8*S }}
          cylinder {{ -2*z*S, 2*z*S, 0.5*S }}
          torus {{ 0.8*S, 0.2*S rotate 90*x }}
          rotate <20, 30, 0> translate 1.2*x*S
          pigment {{ rgb <0.8, 0.5, 0.2> }} finish {{ phong 0.8 reflection 0.3 }}
        }}
        box {{ <-3, -1.2, -3>*S, <3, -1, 3>*S pigment {{ checker rgb 1, rgb 0.4 scale S }} }}"
    )
}

#[test]
fn a_scene_scaled_by_a_power_of_two_keeps_its_picture() {
    let expected = drawn(&scaled(1.0), &options());
    for power in [-40, -13, 13, 40] {
        let film = drawn(&scaled(2f64.powi(power)), &options());
        let differ = expected
            .pixels
            .iter()
            .zip(&film.pixels)
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(differ, 0, "{differ} pixels differ at scale 2^{power}");
    }
}

#[test]
fn a_picture_without_time_is_still_complete() {
    let in_time = |milliseconds| RenderOptions {
        sampling: Sampling::Adaptive(Adaptive {
            error: 0.5,
            time: Some(Duration::from_millis(milliseconds)),
        }),
        ..options()
    };
    let none = drawn(SCENE, &in_time(0));
    let coarse = RenderOptions {
        sampling: Sampling::Adaptive(Adaptive {
            error: 16.0,
            time: None,
        }),
        ..options()
    };
    assert_eq!(none, drawn(SCENE, &coarse), "the first drawing is finished");
    let long = drawn(SCENE, &in_time(600_000));
    let fine = RenderOptions {
        sampling: Sampling::Adaptive(Adaptive {
            error: 0.5,
            time: None,
        }),
        ..options()
    };
    let fine = drawn(SCENE, &fine);
    let squares: f32 = long
        .pixels
        .iter()
        .zip(&fine.pixels)
        .map(|(a, b)| (a.rgb.g - b.rgb.g).powi(2))
        .sum();
    let apart = (squares / fine.pixels.len() as f32).sqrt();
    // Each is within half a step of 1/255 of the truth.
    assert!(
        apart < 1.0 / 255.0,
        "with all the time the error holds: {apart}"
    );
}

#[test]
fn with_clean_cuts_a_flush_cutter_cuts_like_a_protruding_one() {
    let clean = RenderOptions {
        has_clean_cuts: true,
        ..options()
    };
    let transform = ["", "rotate <10, 20, 30>", "scale <1, .7, 1.3>"];
    let of_boxes = [
        "box { -1, 1 } box { <-.5, -.5, -.5>, <.5, TOP, .5> }",
        "box { -1, 1 } box { <-.5, -TOP, -.5>, <.5, TOP, .5> }",
        "box { -1, 1 } box { <-.5, -.5, -.5>, <0, TOP, .5> } box { <0, -.5, -.5>, <.5, TOP, .5> }",
        "intersection { plane { y, 1 } box { -1, <1, 2, 1> } } box { <-.5, -.5, -.5>, <.5, TOP, .5> }",
    ];
    let all = of_boxes
        .iter()
        .flat_map(|parts| transform.map(|transform| (parts, transform)));
    for (parts, transform) in all {
        let with = |top: &str| {
            let scene = "#version 3.7; global_settings { assumed_gamma 1 }
                camera { location <1.5, 3, -5> look_at 0 angle 40 }
                light_source { <4, 6, -6>, 1 } background { rgb <.2, .3, .5> }
                difference { PARTS pigment { rgb <1, .5, .2> } PLACE }";
            let parts = parts.replace("TOP", top);
            drawn(
                &scene.replace("PARTS", &parts).replace("PLACE", transform),
                &clean,
            )
        };
        // Every pixel of the pit and its shadows.
        assert_eq!(with("1"), with("1.5"), "{parts} {transform}");
    }
}
