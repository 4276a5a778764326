//! How far from a surface `trace` finds it: `inside` tells, a little before and a little beyond (item 51).
//!
//! The answer is the colour behind everything: black if no ray was answered worse than the docs of the shape say. Rays come
//! from 4 to 4·10⁹ units away; a rounding is that of all the numbers that meet at a hit.

use crate::case::{Asks, Case};

/// What `trace` and `inside` must agree on.
struct Asked {
    name: &'static str,
    shape: &'static str,
    /// Where rays are aimed at.
    aim: &'static str,
    /// In which length the distance counts.
    unit: &'static str,
    /// Along what it is measured: the normal, or the ray.
    way: &'static str,
    /// The most that is right, a power of two.
    bound: f64,
    /// Distances of a thousand times each other.
    distances: u32,
}

const ROUNDING: &str = "pow(2, -52) * Reach";
const NORMAL: &str = "vnormalize(N)";

const ALL: &[Asked] = &[
    Asked {
        name: "letters",
        shape: "text { ttf \"timrom.ttf\" \"Sg&\" 0.5, 0 }",
        aim: "<0.2 + 1.2 * rand(R), 0.6 * rand(R), 0.5 * rand(R)>",
        unit: ROUNDING,
        way: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    Asked {
        name: "a blob",
        shape: "blob { threshold 0.4 sphere { <-0.4, 0, 0>, 1, 1 } sphere { <0.5, 0.2, 0>, 0.9, 0.8 } }",
        aim: "<1.2 * rand(R) - 0.6, 0.8 * rand(R) - 0.4, 0.8 * rand(R) - 0.4>",
        unit: ROUNDING,
        way: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    Asked {
        name: "a cubic sphere sweep",
        shape: "sphere_sweep { cubic_spline 5, <-2, 0, 0>, 0.3, <-1, 0, 0>, 0.3, <0, 0.5, 0.2>, 0.5, <1, 0, 0>, 0.2, <2, 0.4, 0>, 0.3 }",
        aim: "<1.8 * rand(R) - 0.9, 0.6 * rand(R) - 0.1, 0.4 * rand(R) - 0.2>",
        unit: ROUNDING,
        way: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    Asked {
        name: "a cubic lathe",
        shape: "lathe { cubic_spline 6, <0.2, -1.5>, <0.5, -1>, <0.4, -0.2>, <0.8, 0.8>, <0.5, 1.2>, <0.2, 1.4> }",
        aim: "<1.4 * rand(R) - 0.7, 1.6 * rand(R) - 0.8, 1.4 * rand(R) - 0.7>",
        unit: ROUNDING,
        way: NORMAL,
        bound: 4.0,
        distances: 4,
    },
    Asked {
        name: "a cubic prism",
        shape: "prism { cubic_spline -0.5, 0.5, 8, <-1, 1>, <0, -1>, <1, 0>, <0.7, 0.9>, <-0.3, 0.6>, <0, -1>, <1, 0>, <1, 1> }",
        aim: "<1.4 * rand(R) - 0.7, 0.8 * rand(R) - 0.4, 1.4 * rand(R) - 0.7>",
        unit: ROUNDING,
        way: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    Asked {
        name: "a height field",
        shape: "height_field { png \"plasma3.png\" scale <2, 1, 2> translate <-1, -0.5, -1> }",
        aim: "<1.8 * rand(R) - 0.9, 0.2 * rand(R) - 0.1, 1.8 * rand(R) - 0.9>",
        unit: ROUNDING,
        way: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    Asked {
        name: "an isosurface, to its accuracy",
        shape: "isosurface { function { x*x + y*y*2 + z*z - 1 } contained_by { sphere { 0, 2 } } max_gradient 9 accuracy 0.001 }",
        aim: "<1.6 * rand(R) - 0.8, 1.2 * rand(R) - 0.6, 1.6 * rand(R) - 0.8>",
        unit: "0.001",
        way: "D",
        bound: 1.0,
        distances: 1,
    },
    Asked {
        name: "a quaternion fractal, to 1e-8",
        shape: "julia_fractal { <-0.083, 0, -0.83, -0.025> quaternion sqr max_iteration 8 precision 50 }",
        aim: "<1.6 * rand(R) - 0.8, 1.2 * rand(R) - 0.6, 1.6 * rand(R) - 0.8>",
        unit: "1e-8",
        way: "D",
        bound: 1.0,
        distances: 1,
    },
    Asked {
        name: "a hypercomplex fractal, to 1e-8",
        shape: "julia_fractal { <-0.083, 0, -0.83, -0.025> hypercomplex sqr max_iteration 8 precision 50 }",
        aim: "<1.6 * rand(R) - 0.8, 1.2 * rand(R) - 0.6, 1.6 * rand(R) - 0.8>",
        unit: "1e-8",
        way: "D",
        bound: 1.0,
        distances: 1,
    },
];

/// Rays of each distance.
const RAYS: u32 = 200;

impl Asked {
    fn text(&self) -> String {
        let Asked {
            shape,
            aim,
            unit,
            way,
            bound,
            distances,
            ..
        } = self;
        format!(
            "#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\n\
             #declare R = seed(7);\n#declare Shape = {shape}\n#declare Wrong = 0;\n#declare Hits = 0;\n\
             #for (Far, 1, {distances})\n #declare Away = 4 * pow(1000, Far - 1);\n #for (I, 1, {RAYS})\n\
             #declare Aim = {aim};\n\
             #declare D = vnormalize(<rand(R) - 0.5, rand(R) - 0.5, rand(R) - 0.5>);\n\
             #declare O = Aim - Away * D;\n #declare N = <0, 0, 0>;\n #declare P = trace(Shape, O, D, N);\n\
             #if (vlength(N) > 0)\n #if (abs(vdot(vnormalize(N), D)) > 0.05)\n  #declare Hits = Hits + 1;\n\
             #declare Reach = abs(O.x) + abs(O.y) + abs(O.z) + vlength(P - O) * (abs(D.x) + abs(D.y) + abs(D.z)) + 2;\n\
             #declare K = 0.25;\n #declare Found = 0;\n\
             #while (K <= {bound} & !Found)\n\
             #declare By = K * {unit} * {way};\n\
             #if (inside(Shape, P - By) != inside(Shape, P + By)) #declare Found = 1; #end\n\
             #declare K = 2 * K;\n #end\n\
             #if (!Found) #declare Wrong = Wrong + 1; #end\n #end #end #end #end\n\
             #if (Hits < {}) #declare Wrong = 1; #end\n\
             background {{ rgb (Wrong > 0) }}\ncamera {{ location 0 }}\n",
            RAYS / 4
        )
    }
}

pub(crate) fn add(all: &mut Vec<Case>) {
    for asked in ALL {
        let asks = Asks::Even {
            text: asked.text(),
            color: [0.0; 3],
            within: 0.0,
        };
        all.push(Case::new(51, format!("roots on {}", asked.name), asks));
    }
}
