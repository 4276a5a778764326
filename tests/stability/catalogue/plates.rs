//! Thin plates and shells, lights on surfaces and inside of solids (items 36 to 41).

use crate::case::{Asks, Case};
use crate::model::{Camera, Model, RED, cuboid, n, sphere};

const HEAD: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 20 }\n";
const DOWN: &str = "camera { location <0.03, 3, 0.02> direction -y right x up 0.75*z }\n";
const FLOOR: &str =
    "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 brilliance 0 } }\n";
const LIGHT: &str = "light_source { <1, 20, 2>, rgb 1 }\n";

fn even(text: String, level: f32) -> Asks {
    Asks::Even {
        text,
        color: [level; 3],
        within: 0.005,
    }
}

pub(crate) fn add(all: &mut Vec<Case>) {
    for gap in [1e-2, 1e-3, 9e-5, 1e-5, 1e-7, 1e-9] {
        let g = n(gap);
        let top = n(gap + 0.5);
        // Camera and light rays pass through the plate.
        let clear = format!(
            "{HEAD}{DOWN}{LIGHT}{FLOOR}box {{ <-9, {g}, -9>, <9, {top}, 9> pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 }} }}\n"
        );
        all.push(Case::new(
            37,
            format!("clear plate {gap:e} above a floor"),
            even(clear, 1.0),
        ));
        let thin = n(2.0 * gap);
        let opaque = format!(
            "{HEAD}{DOWN}{LIGHT}{FLOOR}box {{ <-9, {g}, -9>, <9, {thin}, 9> pigment {{ rgb 1 }} no_image }}\n"
        );
        all.push(Case::new(
            38,
            format!("opaque plate {gap:e} above a floor"),
            even(opaque, 0.0),
        ));
    }
    for thickness in [1e-2, 2e-4, 9e-5, 1e-5, 1e-7, 1e-9] {
        let t = n(thickness);
        let bright = "background { rgb 1 }\n#default { pigment { rgbf <1, 1, 1, 0.5> } finish { ambient 0 diffuse 0 } }\n";
        let slab = format!("{HEAD}{DOWN}{bright}box {{ <-9, 0, -9>, <9, {t}, 9> }}\n");
        all.push(Case::new(
            39,
            format!("slab {thickness:e} thick"),
            even(slab, 0.25),
        ));
        let ahead = "camera { location <0.013, 0.017, -3> direction z right 0.5*x up 0.375*y }\n";
        let inner = n(1.0 - thickness);
        let shell = format!(
            "{HEAD}{ahead}{bright}difference {{ sphere {{ 0, 1 }} sphere {{ 0, {inner} }} }}\n"
        );
        all.push(Case::new(
            39,
            format!("shell {thickness:e} thick"),
            even(shell, 0.0625),
        ));
    }
    for thickness in [1e-5, 1e-7, 1e-9] {
        let inner = n(1.0 - thickness);
        let scene = "camera { location <0.013, 0.017, -3> direction z right 0.8*x up 0.6*y }\nbackground { rgb 1 }\n\
            plane { z, 5 pigment { checker rgb 1, rgb 0 scale 0.7 } finish { ambient 1 diffuse 0 } }\n";
        let shell = format!(
            "difference {{ sphere {{ 0, 1 }} sphere {{ 0, {inner} }} pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 }} interior {{ ior 1.5 }} }}\n"
        );
        let case = Case::new(
            40,
            format!("glass shell {thickness:e} thick against none"),
            Asks::Same {
                text: format!("{HEAD}{scene}{shell}"),
                like: format!("{HEAD}{scene}"),
                within: 0.02,
            },
        );
        all.push(if thickness > 2e-6 {
            case.allowing(4, "at the rim light is bent by the square root of the thickness: a few edges of the pattern move")
        } else {
            case.allowing(1, "at the rim light is bent by the square root of the thickness")
        });
    }
    lights(all);
    critical(all);
}

fn lights(all: &mut Vec<Case>) {
    let camera = Camera::at([0.0, 1.0, -4.0], [0.0; 3], 0.8);
    let box_around = |half: f64| cuboid([-half; 3], [half; 3]);
    let inside = Model::lit(
        camera,
        [0.1, 0.05, 0.0],
        vec![
            box_around(0.5).colored(RED),
            cuboid([-3.0, -2.0, -3.0], [3.0, -1.0, 3.0]),
        ],
    );
    all.push(Case::model(36, "light inside an opaque box", inside));
    let at_camera = Model::lit(
        camera,
        camera.location,
        vec![
            sphere([0.0; 3], 1.0).colored(RED),
            cuboid([-9.0, -9.0, 3.0], [9.0, 9.0, 4.0]),
        ],
    );
    all.push(Case::model(36, "light at the camera", at_camera));
    for distance in [1e7, 1e9, 1e12] {
        let scene = vec![
            sphere([0.0; 3], 1.0).colored(RED),
            cuboid([-3.0, -2.0, -3.0], [3.0, -1.0, 3.0]),
        ];
        let far = Model::lit(camera, [0.5 * distance, distance, -0.25 * distance], scene);
        all.push(Case::model(36, format!("light at {distance:e}"), far));
    }
    let floor = "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 brilliance 0 } }\n";
    let on = format!(
        "{HEAD}{DOWN}light_source {{ <0, 1, 0>, rgb 1 }}\nsphere {{ <0, 2, 0>, 1 pigment {{ rgb 1 }} no_image }}\n{floor}"
    );
    all.push(Case::new(
        36,
        "light on the bottom of a sphere above the floor",
        even(on, 1.0),
    ));
}

/// Views from inside glass near the critical angle: the picture must not jump there.
fn critical(all: &mut Vec<Case>) {
    let view = |off: f64| {
        let angle = (1.0 / 1.5f64).asin() + off;
        let (sine, cosine) = angle.sin_cos();
        let (right, up) = (n(1e-13), n(0.75e-13));
        format!(
            "{HEAD}camera {{ location <0, -0.5, 0> direction <{}, {}, 0> right {right}*z up {up}*<{}, {}, 0> }}\nbackground {{ rgb 1 }}\n\
             box {{ <-9, -1, -9>, <9, 0, 9> pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 reflection {{ 0, 1 fresnel }} conserve_energy }} interior {{ ior 1.5 }} hollow }}\n",
            n(sine),
            n(cosine),
            n(-cosine),
            n(sine)
        )
    };
    for off in [-1e-12, -1e-15, 0.0, 1e-15, 1e-12] {
        all.push(Case::new(
            41,
            format!("critical angle and {off:e}"),
            Asks::Same {
                text: view(off),
                like: view(1e-9),
                within: 0.002,
            },
        ));
    }
}
