//! CSG: membranes, coincident faces, depth and number (items 18 to 28, 53).

use crate::case::{Asks, Case};
use crate::model::{
    Camera, GREEN, Model, Object, RED, Step, V, csg, cuboid, cylinder, plane, sphere, torus,
};
use std::fmt::Write as _;

/// A rotation written as a matrix, so that the scene has its exact numbers.
const TURN: [f64; 12] = [
    0.8, 0.36, 0.48, 0.0, 0.8, -0.6, -0.6, 0.48, 0.64, 0.0, 0.0, 0.0,
];

fn view() -> Camera {
    Camera::at([0.61, 0.47, -4.0], [0.0; 3], 0.75)
}

/// The same object along the axes and turned.
fn straight_and_turned(all: &mut Vec<Case>, item: u8, name: &str, object: Object) {
    let white = Model::flat(view(), vec![object.clone()]);
    all.push(Case::model(item, name, white));
    let turned = object.step(Step::Matrix(TURN));
    all.push(Case::model(
        item,
        format!("{name}, turned"),
        Model::flat(view(), vec![turned]),
    ));
}

pub(crate) fn add(all: &mut Vec<Case>) {
    let cube = || cuboid([-1.0; 3], [1.0; 3]).colored(RED);
    let cut = |from: f64, to: f64| cuboid([-0.5, -0.5, from], [0.5, 0.5, to]).colored(GREEN);
    for gap in [1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 1e-15] {
        straight_and_turned(
            all,
            18,
            &format!("membrane {gap:e} thick"),
            csg("difference", vec![cube(), cut(-1.0 + gap, 2.0)]),
        );
    }
    straight_and_turned(
        all,
        19,
        "front faces coincide",
        csg("difference", vec![cube(), cut(-1.0, 2.0)]),
    );
    straight_and_turned(
        all,
        20,
        "back faces coincide",
        csg("difference", vec![cube(), cut(-2.0, 1.0)]),
    );
    let twins: [(&str, Object); 4] = [
        ("sphere", sphere([0.0; 3], 1.0)),
        ("box", cuboid([-1.0; 3], [1.0; 3])),
        ("torus", torus(1.0, 0.3)),
        ("cylinder", cylinder([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], 0.7)),
    ];
    for (name, twin) in &twins {
        let pair = || vec![twin.clone(), twin.clone()];
        straight_and_turned(
            all,
            21,
            &format!("{name} and the same {name}"),
            csg("intersection", pair()),
        );
        straight_and_turned(
            all,
            22,
            &format!("{name} without the same {name}"),
            csg("difference", pair()),
        );
    }
    let upright = |radius: f64| cylinder([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], radius);
    straight_and_turned(
        all,
        23,
        "cylinders with the same caps",
        csg(
            "intersection",
            vec![upright(1.0).colored(RED), upright(0.5).colored(GREEN)],
        ),
    );
    straight_and_turned(
        all,
        23,
        "cylinder without one of the same caps",
        csg(
            "difference",
            vec![upright(1.0).colored(RED), upright(0.5).colored(GREEN)],
        ),
    );
    straight_and_turned(
        all,
        23,
        "box and half-space through its face",
        csg(
            "intersection",
            vec![cube(), plane([0.0, 0.0, -1.0], 1.0).colored(RED)],
        ),
    );
    joints(all);
    depth(all);
    clips(all);
}

/// Transparent bodies that touch are one body when merged.
fn joints(all: &mut Vec<Case>) {
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\ncamera { location <1.3, 1.1, -4> right 1.2*x up 0.9*y look_at 0 }\n\
        background { rgb 1 }\n#default { finish { ambient 0 diffuse 0 } pigment { rgbf <0.9, 0.8, 0.7, 0.5> } }\n";
    let same = |text: &str, like: &str| Asks::Same {
        text: format!("{head}{text} }}\n"),
        like: format!("{head}{like} }}\n"),
        within: 0.002,
    };
    let box_one = "box { <-1,-0.5,-0.5>, <1,0.5,0.5>";
    let boxes = "box { <-1,-0.5,-0.5>, <0,0.5,0.5> } box { <0,-0.5,-0.5>, <1,0.5,0.5> }";
    all.push(Case::new(
        24,
        "merge of two glass boxes that touch",
        same(&format!("merge {{ {boxes}"), box_one),
    ));
    all.push(Case::new(
        24,
        "merge of a glass sphere with itself",
        same("merge { sphere { 0, 1 } sphere { 0, 1 }", "sphere { 0, 1"),
    ));
    let turned = "rotate <20,30,0>";
    all.push(Case::new(
        24,
        "merge of two glass boxes that touch, turned",
        same(
            &format!("merge {{ {boxes} {turned}"),
            &format!("{box_one} {turned}"),
        ),
    ));
    all.push(Case::new(
        25,
        "merge of stacked glass cylinders",
        same(
            "merge { cylinder { -y, 0, 0.6 } cylinder { 0, y, 0.6 }",
            "cylinder { -y, y, 0.6",
        ),
    ));
    all.push(Case::new(
        25,
        "merge of stacked glass cylinders, turned",
        same(
            "merge { cylinder { -y, 0, 0.6 } cylinder { 0, y, 0.6 } rotate <30,0,20>",
            "cylinder { -y, y, 0.6 rotate <30,0,20>",
        ),
    ));
}

/// A plate with many holes, cut one after the other, and all in one step.
fn depth(all: &mut Vec<Case>) {
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\ncamera { location <0.31, 0.27, -4> right 1.2*x up 0.9*y look_at 0 }\n\
        #default { finish { ambient 1 diffuse 0 } pigment { rgb 1 } }\n";
    let side = |count: u32| f64::from(count).sqrt().ceil();
    let hole = |i: u32, count: u32| {
        let n = side(count);
        let (x, y) = (f64::from(i) % n, (f64::from(i) / n).floor());
        let position = |k: f64| -1.0 + (2.0 * k + 1.0) / n;
        let r = 0.6 / n;
        format!(
            "cylinder {{ <{}, {}, -1>, <{}, {}, 1>, {r} }}",
            position(x),
            position(y),
            position(x),
            position(y)
        )
    };
    for count in [100, 1024, 10_000, 100_000] {
        let mut flat = format!("{head}difference {{ box {{ <-1.1,-1.1,-0.1>, <1.1,1.1,0.1> }}\n");
        (0..count).for_each(|i| flat.push_str(&hole(i, count)));
        flat.push_str("}\n");
        let mut left = head.to_owned();
        (0..count).for_each(|_| left.push_str("difference { "));
        left.push_str("box { <-1.1,-1.1,-0.1>, <1.1,1.1,0.1> }");
        for i in 0..count {
            let _ = writeln!(left, "{} }}", hole(i, count));
        }
        let mut right = format!("{head}difference {{ box {{ <-1.1,-1.1,-0.1>, <1.1,1.1,0.1> }}\n");
        for i in 0..count - 1 {
            let _ = writeln!(right, "union {{ {}", hole(i, count));
        }
        right.push_str(&hole(count - 1, count));
        (0..count).for_each(|_| right.push('}'));
        let same = |text: String| Asks::Same {
            text,
            like: flat.clone(),
            within: 0.0,
        };
        let mut push = |item: u8, name: String, text: String| {
            let mut case = Case::new(item, name, same(text));
            if count >= 100_000 {
                case = case.without_pov_ray("it ends without a picture");
            }
            all.push(if count > 1024 { case.slow() } else { case });
        };
        push(26, format!("{count} differences in each other, left"), left);
        push(27, format!("{count} unions in each other, right"), right);
    }
    // There is no memory for a model of a thousand holes; this picture is known: the plate with one row of holes.
    let plate = |word: &'static str| {
        let mut parts = vec![cuboid([-1.1, -1.1, -0.1], [1.1, 1.1, 0.1])];
        for i in 0..8 {
            let x = -0.875 + 0.25 * f64::from(i);
            parts.push(cylinder([x, 0.0, -1.0], [x, 0.0, 1.0], 0.0625));
        }
        csg(word, parts)
    };
    let camera = Camera::at([0.31, 0.27, -4.0], [0.0; 3], 0.7);
    all.push(Case::model(
        26,
        "a plate with eight holes",
        Model::flat(camera, vec![plate("difference")]),
    ));
    crowd(all);
}

/// Many spheres cut by a box that contains all of them.
fn crowd(all: &mut Vec<Case>) {
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\ncamera { location <0.31, 0.27, -4> right 1.2*x up 0.9*y look_at 0 }\n\
        #default { finish { ambient 1 diffuse 0 } pigment { rgb 1 } }\n#declare R = seed(1);\n";
    for (count, is_slow) in [(1000, false), (100_000, true)] {
        let union = format!(
            "union {{ #for (I, 1, {count}) sphere {{ 2*<rand(R), rand(R), rand(R)> - 1, 0.004 }} #end }}"
        );
        let case = Case::new(
            28,
            format!("{count} spheres cut by a box around them"),
            Asks::Same {
                text: format!("{head}intersection {{ {union} box {{ -1.1, 1.1 }} }}\n"),
                like: format!("{head}{union}\n"),
                within: 0.0,
            },
        );
        all.push(if is_slow { case.slow() } else { case });
    }
}

fn clips(all: &mut Vec<Case>) {
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\ncamera { location <0.61, 0.47, -4> right 1.2*x up 0.9*y look_at 0 }\n\
        #default { finish { ambient 1 diffuse 0 } pigment { rgb 1 } }\n";
    let bodies: [(&str, &str); 4] = [
        ("sphere", "sphere { 0, 1"),
        ("box", "box { -1, 1"),
        ("torus", "torus { 1, 0.3"),
        ("cylinder", "cylinder { -y, y, 0.7"),
    ];
    let turns: [V; 2] = [[0.0; 3], [20.0, 30.0, 10.0]];
    for (name, body) in bodies {
        for turn in turns {
            let turn_text = format!("rotate <{}, {}, {}>", turn[0], turn[1], turn[2]);
            let text = format!("{head}{body} clipped_by {{ {body} }} }} {turn_text} }}\n");
            let like = format!("{head}{body} {turn_text} }}\n");
            let turned = if turn == [0.0; 3] { "" } else { ", turned" };
            all.push(Case::new(
                53,
                format!("{name} clipped by itself{turned}"),
                Asks::Same {
                    text,
                    like,
                    within: 0.0,
                },
            ));
        }
    }
    bounds(all);
}

/// A bounding object that is too small cuts off of a CSG object all that no ray through it can see. From a single solid
/// POV-Ray removes it (`Remove_Bounds`); of some its box stays, but not in scenes of fewer than three things.
fn bounds(all: &mut Vec<Case>) {
    let head = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#default { finish { ambient 1 diffuse 0 } pigment { rgb 1 } }\n\
        camera { orthographic location <0.01, 0.02, -4> direction z right 3*x up 2.25*y }\n";
    let everything = "box { -3, 3 }";
    let [alone, others] = ["", "sphere { 9*x, 1 }\nsphere { 9*y, 1 }\n"];
    for (name, others, body, bound, like) in [
        (
            "sphere",
            others,
            "sphere { 0, 1",
            "sphere { 0, 0.5 }",
            "box { <-0.5, -0.5, -3>, <0.5, 0.5, 3> }",
        ),
        (
            "box",
            others,
            "box { -1, 1",
            "box { <-0.3, -0.6, -1>, <0.6, 0.4, 2> }",
            "box { <-0.3, -0.6, -3>, <0.6, 0.4, 3> }",
        ),
        (
            "torus",
            others,
            "torus { 0.7, 0.3 rotate 90*x",
            "cylinder { -3*z, 3*z, 0.7 }",
            everything,
        ),
        (
            "difference",
            others,
            "difference { box { -1, 1 } sphere { -z, 0.5 }",
            "sphere { 0, 0.8 }",
            "cylinder { -3*z, 3*z, 0.8 }",
        ),
        (
            "intersection",
            others,
            "intersection { box { -1, 1 } sphere { -0.2*z, 1.2 }",
            "box { <-0.3, -0.6, -1>, <0.6, 0.4, 2> }",
            "box { <-0.3, -0.6, -3>, <0.6, 0.4, 3> }",
        ),
        (
            "sphere alone",
            alone,
            "sphere { 0, 1",
            "sphere { 0, 0.5 }",
            everything,
        ),
        (
            "box alone",
            alone,
            "box { -1, 1",
            "box { -0.5, 0.5 }",
            everything,
        ),
    ] {
        let text = format!("{head}{others}{body} bounded_by {{ {bound} }} }}\n");
        let like = format!("{head}{others}intersection {{ {body} }} {like} }}\n");
        let within = 0.0;
        all.push(Case::new(
            53,
            format!("{name} bounded by less"),
            Asks::Same { text, like, within },
        ));
    }
}
