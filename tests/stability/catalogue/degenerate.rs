//! Meaningless numbers, bodies without volume, odd cameras, mirrors (items 29 to 35, 42).

use crate::case::{Asks, Case};
use crate::model::{Camera, Model, RED, csg, cuboid, sphere, torus};

pub(super) const HEAD: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 1000 }\n\
    #default { pigment { rgb 1 } finish { ambient 1 diffuse 0 } }\n";
pub(super) const CAMERA: &str =
    "camera { location <0.11, 0.13, -4> right 1.2*x up 0.9*y direction z }\n";

pub(super) fn same(item: u8, name: &str, text: &str, like: &str) -> Case {
    Case::new(
        item,
        name,
        Asks::Same {
            text: format!("{HEAD}{CAMERA}{text}\n"),
            like: format!("{HEAD}{CAMERA}{like}\n"),
            within: 0.0,
        },
    )
}

fn refused(item: u8, name: &str, text: &str, says: &'static str) -> Case {
    Case::new(
        item,
        name,
        Asks::Refused {
            text: format!("{HEAD}{CAMERA}{text}\n"),
            says,
        },
    )
}

const SPHERE: &str = "sphere { 0, 1 }";
pub(super) const NOTHING: &str = "";

pub(crate) fn add(all: &mut Vec<Case>) {
    all.push(same(
        29,
        "scale <1,0,1>",
        "sphere { 0, 1 scale <1,0,1> }",
        SPHERE,
    ));
    all.push(same(29, "scale 0", "sphere { 0, 1 scale 0 }", SPHERE));
    all.push(same(
        29,
        "a matrix with a column of zeros",
        "sphere { 0, 1 matrix <1,0,0, 1,0,0, 0,0,1, 0,0,0> }",
        "sphere { 0, 1 matrix <1,0,0, 1,1,0, 0,0,1, 0,0,0> }",
    ));
    all.push(refused(
        29,
        "a singular matrix",
        "sphere { 0, 1 matrix <1,1,0, 1,1,0, 0,0,1, 0,0,0> }",
        "singular",
    ));
    for (name, radius) in [
        ("1/0", "1/0"),
        ("0/0", "0/0"),
        ("1e400", "1e400"),
        ("sqrt(-1)", "sqrt(-1)"),
        ("ln(0)", "ln(0)"),
        ("pow(0,-1)", "pow(0,-1)"),
    ] {
        let case = refused(
            30,
            &format!("a radius of {name}"),
            &format!("sphere {{ 0, {radius} }}"),
            "error",
        );
        all.push(case.without_pov_ray("it warns, or refuses too, and draws nothing"));
    }
    all.push(same(
        30,
        "a radius of acos(2)",
        "sphere { 0, acos(2) }",
        NOTHING,
    ));
    for (name, text) in [
        ("sphere", "sphere { 0, 0 }"),
        ("cylinder", "cylinder { -y, y, 0 }"),
        ("cone", "cone { -y, 0, y, 0 }"),
        ("torus", "torus { 1, 0 rotate 90*x }"),
        ("torus of negative", "torus { 1, -.3 rotate 90*x }"),
        ("disc", "disc { 0, z, 0 }"),
        ("blob", "blob { threshold 0.5 sphere { 0, 0, 1 } }"),
    ] {
        all.push(same(31, &format!("{name} radius zero"), text, NOTHING));
    }
    all.push(same(31, "sphere of radius -1", "sphere { 0, -1 }", SPHERE));
    all.push(refused(
        31,
        "cylinder of no length",
        "cylinder { 0, 0, 1 }",
        "degenerate c",
    ));
    all.push(refused(
        31,
        "cone of no length",
        "cone { 0, 1, 0, 2 }",
        "degenerate c",
    ));
    let flat = Model::flat(
        Camera::at([0.6, 0.4, -4.0], [0.0; 3], 0.8),
        vec![cuboid([-1.0, -1.0, -1e-12], [1.0, 1.0, 1e-12])],
    );
    all.push(Case::model(32, "box 2e-12 thick", flat));
    all.push(same(
        32,
        "box of no thickness",
        "box { <-1,-1,0>, <1,1,0> }",
        "box { <-1,-1,-1e-9>, <1,1,1e-9> }",
    ));
    all.push(same(
        32,
        "triangle of no area",
        "triangle { -x, x, 0 }",
        NOTHING,
    ));
    all.push(same(
        32,
        "triangle with two corners alike",
        "triangle { -x, -x, y }",
        NOTHING,
    ));
    all.push(refused(
        32,
        "plane without a normal",
        "plane { 0, 1 }",
        "normal",
    ));
    all.push(same(
        33,
        "intersection of what is apart",
        "intersection { sphere { -5*x, 1 } sphere { 5*x, 1 } }",
        NOTHING,
    ));
    all.push(same(
        33,
        "difference of one",
        "difference { sphere { 0, 1 } }",
        SPHERE,
    ));
    all.push(same(
        33,
        "intersection of one",
        "intersection { sphere { 0, 1 } }",
        SPHERE,
    ));
    all.push(same(
        33,
        "union of none",
        "union { pigment { rgb 1 } }",
        NOTHING,
    ));
    inside(all);
    let camera = |text: &str| format!("{HEAD}camera {{ {text} }}\nsphere {{ 0, 1 }}\n");
    let bad = |name: &str, text: &str, says: &'static str| {
        Case::new(
            35,
            name,
            Asks::Refused {
                text: camera(text),
                says,
            },
        )
    };
    all.push(bad(
        "look_at = location",
        "location -4*z look_at -4*z",
        "look_at",
    ));
    all.push(bad(
        "angle 180",
        "location -4*z angle 180 look_at 0",
        "angle",
    ));
    views(all);
    mirrors(all);
}

/// Degenerate and mirrored cameras, as POV-Ray interprets them.
fn views(all: &mut Vec<Case>) {
    let scene = "sphere { 0, 1 } box { <-2, -2, 3>, <0.5, 0.3, 4> pigment { rgb <1, 0, 0> } }\n";
    let camera = |text: &str| format!("{HEAD}camera {{ {text} }}\n{scene}");
    let ahead = "location -4*z right 1.33*x up y direction z";
    for (name, text, like) in [
        ("sky along the view", "location -4*z sky z look_at 0", ahead),
        ("no sky", "location -4*z sky 0 look_at 0", ahead),
        (
            "look_at straight down",
            "location 4*y look_at 0",
            "location 4*y right 1.33*x up z direction -y",
        ),
        (
            "no width",
            "location -4*z right 0 look_at 0",
            "location -4*z right 1e-12*x up y direction z",
        ),
        (
            "no height",
            "location -4*z up 0 look_at 0",
            // POV-Ray takes such a camera as rotated.
            "location -4*z right -1.33*x up 1e-12*y direction z",
        ),
    ] {
        all.push(Case::new(
            35,
            name,
            Asks::Same {
                text: camera(text),
                like: camera(like),
                within: 0.0,
            },
        ));
    }
    for (name, text) in [
        ("no direction", "location -4*z direction 0 look_at 0"),
        (
            "up along the view",
            "location -4*z direction y up y right x",
        ),
    ] {
        let like = format!("{HEAD}camera {{ {ahead} }}\n");
        all.push(Case::new(
            35,
            name,
            Asks::Same {
                text: camera(text),
                like,
                within: 0.0,
            },
        ));
    }
}

fn inside(all: &mut Vec<Case>) {
    let camera = |z: f64| Camera::ahead([0.01, 0.02, z], 1.3);
    let bodies = [
        ("sphere", sphere([0.0; 3], 1.0)),
        ("box", cuboid([-1.0; 3], [1.0; 3])),
        (
            "torus",
            torus(1.0, 0.5)
                .rotate([90.0, 0.0, 0.0])
                .translate([1.0, 0.0, 0.0]),
        ),
        (
            "difference",
            csg(
                "difference",
                vec![
                    cuboid([-1.0; 3], [1.0; 3]),
                    sphere([0.0, 0.0, 0.8], 0.5).colored(RED),
                ],
            ),
        ),
    ];
    for (name, body) in bodies {
        all.push(Case::model(
            34,
            format!("camera inside a {name}"),
            Model::flat(camera(0.0), vec![body.clone()]),
        ));
    }
    let on = Camera {
        location: [0.0, 0.0, -1.0],
        ..camera(0.0)
    };
    all.push(Case::model(
        34,
        "camera on a sphere, looking in",
        Model::flat(on, vec![sphere([0.0; 3], 1.0)]),
    ));
    all.push(Case::model(
        34,
        "camera on a box, looking in",
        Model::flat(on, vec![cuboid([-1.0; 3], [1.0; 3])]),
    ));
}

fn mirrors(all: &mut Vec<Case>) {
    let finish = "pigment { rgb 1 } finish { ambient 0.0005 diffuse 0 reflection 1 }";
    let text = format!(
        "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level 1000 adc_bailout 0 }}\n\
         camera {{ location <0.01, 0.02, 0> right 0.12*x up 0.09*y direction z }}\n\
         plane {{ z, 1 {finish} }} plane {{ -z, 1 {finish} }}\n"
    );
    // 256 generations of rays, the limit.
    all.push(Case::new(
        42,
        "two facing mirrors, max_trace_level 1000",
        Asks::Even {
            text,
            color: [0.128; 3],
            within: 0.001,
        },
    ));
}
