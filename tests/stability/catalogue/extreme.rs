//! Every primitive with numbers that mean nothing or next to nothing: it is refused in words, or it is drawn, and then
//! every pixel is a number (items 29 to 32).

use crate::case::{Asks, Case};

/// What takes the place of each number in turn.
const ODD: [&str; 11] = [
    "0", "-1", "1e-320", "-1e-300", "1e-30", "1e30", "1e308", "-1e308", "1e400", "(0/0)", "(1/0)",
];

/// Each primitive; a number in brackets is one of those that are replaced.
const PRIMITIVES: [(&str, &str); 27] = [
    ("sphere", "sphere { <[0],0,[0]>, [1] }"),
    ("box", "box { <[-1],[-1],-1>, <[1],[1],1> }"),
    ("cylinder", "cylinder { <0,[-1],0>, <[0],[1],0>, [0.5] }"),
    (
        "open cylinder",
        "cylinder { <0,[-1],0>, <[0],[1],0>, [0.5] open }",
    ),
    ("cone", "cone { <0,[-1],0>, [1], <[0],[1],0>, [0.2] }"),
    ("torus", "torus { [0.7], [0.25] }"),
    ("plane", "plane { <[0],[1],0>, [-0.5] }"),
    ("disc", "disc { <[0],0,0>, <[0],[0],[1]>, [1], [0.3] }"),
    (
        "triangle",
        "triangle { <[-1],[-1],0>, <[1],[-1],0>, <[0],[1],[0]> }",
    ),
    (
        "smooth triangle",
        "smooth_triangle { <[-1],-1,0>, <0,[0],[1]>, <[1],-1,0>, <[0],0,[1]>, <0,[1],0>, <0,0,[1]> }",
    ),
    (
        "polygon",
        "polygon { 5, <[-1],-1,0>, <[1],[-1],0>, <1,1,0>, <-1,1,0>, <[-1],-1,0> }",
    ),
    (
        "quadric",
        "quadric { <[1],[1],[1]>, <[0],0,0>, <[0],0,0>, [-1] }",
    ),
    (
        "cubic",
        "cubic { <[0],0,0,[1],0,0,0,0,0,0,0,0,0,[1],0,0,0,0,[0],[-1]> }",
    ),
    (
        "quartic",
        "quartic { <[1],0,0,0,[2],0,0,2,0,[-2.1],0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,[1.9],0,0,0,0,[1],0,-2.1,0,[0.9]> }",
    ),
    ("superellipsoid", "superellipsoid { <[0.3],[0.5]> }"),
    (
        "blob",
        "blob { threshold [0.6] sphere { <[0.4],0,0>, [1], [1] } cylinder { <[0],-1,0>, <0,[1],0>, [0.6], [1] } }",
    ),
    (
        "lathe",
        "lathe { linear_spline 4, <[0.2],[-1]>, <[1],0>, <[0.5],[1]>, <0,1> }",
    ),
    (
        "lathe of curves",
        "lathe { cubic_spline 6, <0,[-1.5]>, <[0.2],-1>, <[1],0>, <[0.5],[1]>, <[0.2],1.2>, <0,1.5> }",
    ),
    (
        "sor",
        "sor { 5, <[0],-1.5>, <[0.5],[-1]>, <[0.8],0>, <0.5,[1]>, <0,[1.5]> }",
    ),
    (
        "prism",
        "prism { linear_sweep linear_spline [-1], [1], 5, <[-1],-1>, <[1],[-1]>, <1,1>, <-1,1>, <[-1],-1> }",
    ),
    ("ovus", "ovus { [1], [0.6] }"),
    (
        "bicubic patch",
        "bicubic_patch { type 1 u_steps 2 v_steps 2 flatness [0] <[-1],-1,0>,<-0.3,[-1],0>,<0.3,-1,0>,<1,-1,[0]>,\
         <-1,-0.3,0>,<-0.3,-0.3,[1]>,<0.3,-0.3,1>,<1,-0.3,0>,<-1,0.3,0>,<-0.3,0.3,1>,<0.3,0.3,[1]>,<1,0.3,0>,\
         <-1,1,0>,<-0.3,1,0>,<0.3,[1],0>,<[1],1,0> }",
    ),
    (
        "sphere sweep",
        "sphere_sweep { linear_spline 3, <[-1],0,0>, [0.3], <0,[1],0>, [0.4], <[1],0,0>, [0.2] }",
    ),
    (
        "mesh2",
        "mesh2 { vertex_vectors { 3, <[-1],[-1],0>, <[1],-1,0>, <0,[1],[0]> } face_indices { 1, <0,1,2> } }",
    ),
    (
        "isosurface",
        "isosurface { function { x*x + y*y + z*z - [1] } contained_by { box { <[-2],-2,-2>, [2] } } threshold [0] accuracy [0.01] max_gradient [5] }",
    ),
    (
        "julia fractal",
        "julia_fractal { <[-0.08],[0],-0.8,-0.03> quaternion sqr max_iteration 5 precision [15] }",
    ),
    (
        "difference",
        "difference { box { <[-1],-1,-1>, [1] } sphere { <0,0,[-1]>, [0.8] } }",
    ),
];

/// Transforms of a sphere and a box.
const TRANSFORMS: [&str; 3] = [
    "scale <[1],[1],[1]>",
    "translate <[0],[0],[0]> rotate <[0],[10],0>",
    "matrix <[1],[0],0, 0,[1],[0], 0,0,[1], [0],0,0>",
];

const HEAD: &str = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n\
    camera { location <0.11, 0.13, -4> right 1.2*x up 0.9*y direction z }\nlight_source { <-4, 6, -8>, rgb 1 }\n\
    #default { pigment { checker rgb 1, rgbf <0.5, 0.5, 0.5, 0.5> } finish { phong 0.5 reflection 0.2 } }\n\
    plane { y, -2 }\n";

pub(crate) fn add(all: &mut Vec<Case>) {
    for (name, template) in PRIMITIVES {
        all.push(case(format!("{name} with odd numbers"), replaced(template)));
    }
    for template in TRANSFORMS {
        for body in ["sphere { 0, 1", "box { -1, 1", "torus { 1, 0.3"] {
            let texts = replaced(&format!("{body} {template} }}"));
            let word = template.split(' ').next().unwrap_or_default();
            let shape = body.split(' ').next().unwrap_or_default();
            all.push(case(format!("{shape} under odd {word}"), texts));
        }
    }
}

fn case(name: String, texts: Vec<String>) -> Case {
    Case::new(31, name, Asks::Sound(texts))
        .without_pov_ray("asked one by one where the catalogue names them")
}

/// A scene for each number in brackets and each that takes its place.
fn replaced(template: &str) -> Vec<String> {
    let parts: Vec<&str> = template.split(['[', ']']).collect();
    let mut texts = Vec::new();
    for place in (1..parts.len()).step_by(2) {
        for odd in ODD {
            let body: String = parts
                .iter()
                .enumerate()
                .map(|(number, part)| if number == place { odd } else { *part })
                .collect();
            texts.push(format!("{HEAD}{body}\n"));
        }
    }
    texts
}
