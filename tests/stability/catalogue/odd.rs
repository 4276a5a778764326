//! Numbers that mean nothing, bodies without room, odd cameras, mirrors, and the other shapes (items 29 to 35, 42,
//! 50 to 52).

use crate::case::{Asks, Case};
use crate::model::{Camera, Kind, Model, Object, RED, csg, cuboid, n, sphere, torus};
use std::fmt::Write as _;

const HEAD: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 1000 }\n\
    #default { pigment { rgb 1 } finish { ambient 1 diffuse 0 } }\n";
const CAMERA: &str = "camera { location <0.11, 0.13, -4> right 1.2*x up 0.9*y direction z }\n";

fn same(item: u8, name: &str, text: &str, like: &str) -> Case {
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

const BALL: &str = "sphere { 0, 1 }";
const NOTHING: &str = "";

pub(crate) fn add(all: &mut Vec<Case>) {
    all.push(same(
        29,
        "scale <1,0,1>",
        "sphere { 0, 1 scale <1,0,1> }",
        BALL,
    ));
    all.push(same(29, "scale 0", "sphere { 0, 1 scale 0 }", BALL));
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
    all.push(same(31, "sphere of radius -1", "sphere { 0, -1 }", BALL));
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
        BALL,
    ));
    all.push(same(
        33,
        "intersection of one",
        "intersection { sphere { 0, 1 } }",
        BALL,
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
    mirrors(all);
    polynomials(all);
    others(all);
    meshes(all);
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
    // 256 generations of rays, as the limit has it.
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

/// The torus of radii 1 and 0.25 as a quartic.
fn ring(factor: f64) -> Object {
    let (major_sq, minor_sq) = (1.0, 0.0625);
    let k = major_sq - minor_sq;
    let mut c = [0.0; 35];
    let at = |x: usize, y: usize, z: usize| {
        let mut number = 0;
        for i in (0..=4).rev() {
            for j in (0..=4 - i).rev() {
                for l in (0..=4 - i - j).rev() {
                    if (i, j, l) == (x, y, z) {
                        return number;
                    }
                    number += 1;
                }
            }
        }
        number
    };
    for (x, y, z, value) in [
        (4, 0, 0, 1.0),
        (0, 4, 0, 1.0),
        (0, 0, 4, 1.0),
        (2, 2, 0, 2.0),
        (2, 0, 2, 2.0),
        (0, 2, 2, 2.0),
        (2, 0, 0, 2.0 * k - 4.0 * major_sq),
        (0, 0, 2, 2.0 * k - 4.0 * major_sq),
        (0, 2, 0, 2.0 * k),
        (0, 0, 0, k * k),
    ] {
        c[at(x, y, z)] = value * factor;
    }
    Object::new(Kind::Quartic(Box::new(c)))
}

fn polynomials(all: &mut Vec<Case>) {
    let camera = Camera::at([0.3, 2.0, -3.5], [0.0; 3], 0.75);
    for factor in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
        all.push(Case::model(
            50,
            format!("quartic torus, coefficients times {factor:e}"),
            Model::flat(camera, vec![ring(factor)]),
        ));
    }
    for by in [1e4, 1e6] {
        let mut far = camera;
        far.location[0] += by;
        let model = Model::flat(far, vec![ring(1.0).translate([by, 0.0, 0.0])]);
        all.push(Case::model(
            50,
            format!("quartic torus at {by:e}"),
            model.with_margin(1e-5),
        ));
    }
    for (name, by) in [("1e-6", 1e-6), ("1e6", 1e6)] {
        let model = Model::flat(camera, vec![ring(1.0)]).scaled(by);
        all.push(Case::model(
            50,
            format!("quartic torus scaled by {name}"),
            model,
        ));
    }
}

fn others(all: &mut Vec<Case>) {
    let camera = Camera::at([1.3, 1.1, -4.0], [0.0; 3], 0.8);
    for power in [2, 4, 8] {
        let body = Object::new(Kind::Superellipsoid(power));
        all.push(Case::model(
            51,
            format!("superellipsoid of e = 2/{power}"),
            Model::lit(camera, [3.0, 4.0, -5.0], vec![body]),
        ));
    }
    all.push(
        same(
            51,
            "superellipsoid of e = 0.01 against a box",
            "superellipsoid { <0.01, 0.01> }",
            "box { -1, 1 }",
        )
        .allowing(
            0,
            "no pixel's centre lies within the 0.0035 that its edges are rounded off",
        ),
    );
    for off in [1e-4, 1e-8, 1e-12] {
        let width = 3.0 * f64::sqrt(0.5 * off);
        let mut camera = Camera::ahead([0.0, 0.0, -1.5], width);
        camera.location[0] = 0.01 * width;
        let model = Model::flat(camera, vec![Object::new(Kind::Blob(1.0 - off))]);
        all.push(Case::model(
            51,
            format!("blob whose threshold is {off:e} below its strength"),
            model.with_margin(1e-3),
        ));
    }
    all.push(same(
        51,
        "blob whose threshold is above its strength",
        "blob { threshold 1.000000000001 sphere { 0, 1, 1 } }",
        NOTHING,
    ));
    all.push(same(
        51,
        "lathe with two points alike",
        "lathe { linear_spline 5 <0,-1>, <1,-1>, <1,-1>, <0.5,1>, <0,1> }",
        "lathe { linear_spline 4 <0,-1>, <1,-1>, <0.5,1>, <0,1> }",
    ));
}

/// A square of triangles, some of them a millionth wide or without area, with rays exactly through their edges.
fn meshes(all: &mut Vec<Case>) {
    let mut mesh = "mesh {\n".to_owned();
    let mut quad = |x0: f64, x1: f64, y0: f64, y1: f64| {
        let (a, b, c, d) = ((x0, y0), (x1, y0), (x1, y1), (x0, y1));
        for corners in [[a, b, c], [a, c, d], [a, c, c]] {
            let list = corners.map(|(x, y)| format!("<{}, {}, 0>", n(x), n(y)));
            let _ = writeln!(mesh, "triangle {{ {} }}", list.join(", "));
        }
    };
    for i in 0..8 {
        for j in 0..8 {
            let (x, y) = (-1.0 + 0.25 * f64::from(i), -1.0 + 0.25 * f64::from(j));
            quad(x, x + 1e-6, y, y + 0.25);
            quad(x + 1e-6, x + 0.25, y, y + 0.25);
        }
    }
    mesh.push_str("}\n");
    // Centres of pixels lie on the lines at multiples of 1/8 and 1/32, edges and corners of the triangles among them.
    let camera =
        "camera { orthographic location <0.03125, 0.03125, -4> direction z right 3*x up 2.25*y }\n";
    all.push(Case::new(
        52,
        "square of slivers, rays through their edges",
        Asks::Same {
            text: format!("{HEAD}{camera}{mesh}"),
            like: format!("{HEAD}{camera}box {{ <-1,-1,0>, <1,1,0> }}\n"),
            within: 0.0,
        },
    ));
    all.push(Case::new(
        52,
        "square of slivers, turned",
        Asks::Same {
            text: format!("{HEAD}{CAMERA}object {{ {mesh} rotate <20,30,10> }}\n"),
            like: format!("{HEAD}{CAMERA}box {{ <-1,-1,0>, <1,1,0> rotate <20,30,10> }}\n"),
            within: 0.0,
        },
    ));
}
