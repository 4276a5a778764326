//! Polynomials, superellipsoid, blob, lathe, and patches at their limits (items 50 to 52).

use super::degenerate::{CAMERA, HEAD, NOTHING, same};
use crate::case::{Asks, Case};
use crate::model::{Camera, Kind, Model, Object, n};
use std::fmt::Write as _;

pub(crate) fn add(all: &mut Vec<Case>) {
    polynomials(all);
    others(all);
    meshes(all);
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
    // Rays at every other corner of the 249 by 249 squares of the picture, and half a square aside.
    let down = "camera { orthographic location <124/249, 2, 124/249> direction -y right 48*2/249*x up 36*2/249*z }\n";
    for (name, shift) in [
        ("corners", "1/249"),
        ("diagonals", "0.5/249"),
        ("edges", "<1, 0, 0.5>/249"),
    ] {
        all.push(Case::new(
            52,
            format!("height field, rays through its {name}"),
            Asks::Even {
                text: format!(
                    "{HEAD}{down}height_field {{ png \"Mount1.png\" scale <1, 0.1, 1> translate {shift}*<1, 0, 1> }}\n"
                ),
                color: [1.0; 3],
                within: 0.0,
            },
        ));
    }
}
