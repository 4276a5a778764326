//! Lints: doubts about scenes that can be drawn, each raised by one scene and not by its neighbour.

use povr::base::options::{Event, Input, ReadOptions};
use povr::base::source::{Code, Message};
use std::sync::Mutex;
use std::time::{Duration, Instant};

const HEAD: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n";
const CAMERA: &str = "camera { location <0, 0, -5> look_at 0 }\n";
const LIGHT: &str = "light_source { <5, 5, -5>, rgb 1 }\n";
const SPHERE: &str = "sphere { 0, 1 pigment { rgb <1, 0.5, 0> } }\n";

/// The messages about a scene.
fn messages(scene: &str, options: &ReadOptions) -> Vec<Message> {
    let messages = Mutex::new(Vec::new());
    let input = Input::Text {
        name: "x.pov".to_owned(),
        text: scene.as_bytes().to_vec(),
    };
    let listen = |event: Event<'_>| {
        if let Event::Finding(message) = event {
            messages.lock().expect("one thread").push(message.clone());
        }
    };
    povr::check(&input, options, &listen).expect("the scene can be drawn");
    messages.into_inner().expect("one thread")
}

/// The lints of a scene with head, each as its line below the head and its name.
fn lints(scene: &str) -> Vec<String> {
    let options = ReadOptions {
        lints: true,
        ..ReadOptions::default()
    };
    let lint = |message: &Message| {
        let name = message.code.and_then(Code::lint_name).expect("a lint");
        let line = message.location.as_ref().map_or(0, |at| at.line - 2);
        assert!(
            !message.hints.is_empty() || name == "no-objects",
            "{message:?}"
        );
        format!("{line} {name}")
    };
    messages(&format!("{HEAD}{scene}"), &options)
        .iter()
        .map(lint)
        .collect()
}

#[test]
fn a_plain_scene_raises_none() {
    assert!(lints(&[CAMERA, LIGHT, SPHERE].concat()).is_empty());
}

#[test]
fn each_lint_has_its_scene() {
    let usual = [CAMERA, LIGHT].concat();
    let scene = |rest: &str| format!("{usual}{rest}");
    let behind = "camera { location <0, 0, -5> look_at <0, 0, -9> }\n";
    let inside = "camera { location <0, 0, -0.5> look_at <0, 0, 9> }\n";
    let above = "camera { location <0, 5, -1> look_at 0 }\n";
    let floor = "plane { y, 2 pigment { checker rgb 0 rgb 1 } }\n";
    let red = "box { -1, 1 pigment { rgb <1, 0, 0> } }\n";
    let green = "box { <-0.5, -1, -1>, <0.5, 1, 0> pigment { rgb <0, 1, 0> } }\n";
    let cases: [(&str, String, &[&str]); 16] = [
        ("no objects", CAMERA.to_owned(), &["0 no-objects"]),
        ("no camera", [LIGHT, SPHERE].concat(), &["0 no-camera"]),
        ("no light", [CAMERA, SPHERE].concat(), &["0 no-light"]),
        ("no pigment", scene("sphere { 0, 1 }\n"), &["3 no-pigment"]),
        (
            "a default",
            scene("#default { pigment { rgb 1 } }\nsphere { 0, 1 }\n"),
            &[],
        ),
        (
            "bytes",
            scene("sphere { 0, 1 pigment { rgb <255, 128, 0> } }"),
            &["3 byte-color"],
        ),
        ("bright", scene("sphere { 0, 1 pigment { rgb 7.5 } }"), &[]),
        (
            "a texture",
            scene(&format!(
                "#declare T = texture {{ pigment {{ rgb 1 }} }}\n{SPHERE}"
            )),
            &["3 unused-texture"],
        ),
        (
            "a macro",
            scene(&format!("#macro M(A) sphere {{ A, 1 }} #end\n{SPHERE}")),
            &["3 unused-macro"],
        ),
        (
            "behind",
            [behind, LIGHT, SPHERE].concat(),
            &["0 nothing-in-view"],
        ),
        (
            "inside",
            [
                inside,
                LIGHT,
                SPHERE,
                "box { 5, 6 pigment { rgb 1 } }\nbox { <-9, -9, 9>, 10 pigment { rgb 1 } }",
            ]
            .concat(),
            &["3 camera-inside"],
        ),
        (
            "a plane",
            [above, LIGHT, floor, SPHERE].concat(),
            &["3 hides-everything"],
        ),
        (
            "beside a plane",
            [
                CAMERA,
                LIGHT,
                &floor.replace("2 pigment", "-2 pigment"),
                SPHERE,
            ]
            .concat(),
            &[],
        ),
        (
            "coincident",
            scene(&[red, green].concat()),
            &["4 coincident-surfaces"],
        ),
        (
            "one colour",
            scene(&[red, &green.replace("<0, 1, 0>", "<1, 0, 0>")].concat()),
            &[],
        ),
        (
            "a light",
            scene(&format!("light_source {{ 0, rgb 1 }}\n{SPHERE}")),
            &["3 light-inside"],
        ),
    ];
    for (name, scene, expected) in cases {
        assert_eq!(lints(&scene), expected, "{name}: {scene}");
    }
    let clear = SPHERE.replace("<1, 0.5, 0>", "1 transmit 0.9");
    assert!(lints(&scene(&format!("light_source {{ 0, rgb 1 }}\n{clear}"))).is_empty());
    let open = "cylinder { -y, y, 2 open pigment { rgb 1 } }\n";
    assert!(lints(&scene(&format!("light_source {{ 0, rgb 1 }}\n{open}"))).is_empty());
}

/// This many small spheres on a square behind the scenes here, in statements of their own.
fn spheres(across: usize) -> String {
    format!(
        "#for (I, 1, {across}) #for (J, 1, {across}) sphere {{ <I - {across}/2, J - {across}/2, 9>, 0.3 pigment {{ rgb 1 }} }} #end #end\n"
    )
}

#[test]
fn the_view_of_a_large_scene_is_examined() {
    let many = spheres(40);
    let scene = |rest: &str| [LIGHT, &many, rest].concat();
    let camera = |location: &str| format!("camera {{ location {location} look_at 9*z }}\n");
    let seen = camera("-30*z");
    let cases = [
        ("all in view", scene(&seen), ""),
        (
            "another way",
            scene("camera { location -30*z look_at -90*z }\n"),
            "0 nothing-in-view",
        ),
        (
            "a wall",
            scene(&format!("{seen}plane {{ z, -20 pigment {{ rgb 1 }} }}\n")),
            "4 hides-everything",
        ),
        (
            "a shell",
            scene(&format!(
                "{seen}sphere {{ -30*z, 1 pigment {{ rgb 1 }} }}\n"
            )),
            "4 camera-inside",
        ),
        (
            "one box twice",
            scene(&format!(
                "{seen}box {{ -9, 1 pigment {{ rgb x }} }} box {{ -9, 1 pigment {{ rgb y }} }}\n"
            )),
            "4 coincident-surfaces",
        ),
        (
            "a light",
            scene(&format!(
                "{seen}light_source {{ <0, 0, 9>, rgb 1 }} sphere {{ 9*z, 2 pigment {{ rgb 1 }} }}\n"
            )),
            "4 light-inside",
        ),
        (
            "a light outside of a room",
            scene(&format!(
                "{seen}light_source {{ 99*y, rgb 1 }} box {{ -50, 50 pigment {{ rgb 1 }} inverse }}\n"
            )),
            "4 light-inside",
        ),
    ];
    for (name, scene, expected) in cases {
        assert_eq!(lints(&scene).join(", "), expected, "{name}");
    }
}

#[test]
fn a_large_scene_is_examined_in_little_time() {
    let started = Instant::now();
    let scene = [
        "camera { location -300*z look_at 9*z }\n",
        LIGHT,
        &spheres(316),
        "plane { z, -20 pigment { rgb 1 } }\n",
    ];
    assert_eq!(lints(&scene.concat()), ["4 hides-everything"]);
    // Each ray through each sphere, unoptimised, takes half an hour.
    assert!(started.elapsed() < Duration::from_secs(100));
}

#[test]
fn a_lint_is_switched_off_by_name_or_comment() {
    let bare = [CAMERA, LIGHT, "sphere { 0, 1 }\n"].concat();
    for comment in [
        "// povr: allow no-pigment\n",
        "// povr: allow no-light, no-pigment\n",
    ] {
        assert!(lints(&format!("{comment}{bare}")).is_empty(), "{comment}");
    }
    assert_eq!(
        lints(&format!("// povr: allow no-light\n{bare}")),
        ["4 no-pigment"]
    );
    let options = ReadOptions {
        lints: true,
        allowed_lints: vec!["no-pigment".to_owned()],
        ..ReadOptions::default()
    };
    assert!(messages(&bare, &options).is_empty());
}

#[test]
fn a_lint_is_named_in_every_form() {
    let options = ReadOptions {
        lints: true,
        ..ReadOptions::default()
    };
    let scene = [CAMERA, LIGHT, "sphere { 0, 1 }\n"].concat();
    let raised = messages(&scene, &options);
    let [message] = raised.as_slice() else {
        panic!("{raised:?}");
    };
    let text = "this object has no pigment, and is black [no-pigment]";
    assert!(message.excerpt.starts_with(&format!("warning: {text}\n")));
    assert!(
        message
            .short()
            .starts_with(&format!("x.pov:3:1: warning: {text} ("))
    );
    assert!(
        message
            .povray()
            .starts_with(&format!("File 'x.pov' line 3: Parse Warning: {text} ("))
    );
    assert!(
        messages(&scene, &ReadOptions::default()).is_empty(),
        "lints are asked for"
    );
}
