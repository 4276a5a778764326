//! Accuracy of the hits of `trace`: `inside` is tested a little before and a little beyond (item 51).
//!
//! The answer is the colour of the background: black if the error of every ray is within the documented bound of the
//! shape. Rays start 4 to 4·10⁹ units away; a rounding is that of all the numbers involved in a hit.

use crate::case::{Asks, Case};

/// A shape on which `trace` and `inside` must agree.
struct RootQuestion {
    name: &'static str,
    shape: &'static str,
    /// The point that rays aim at.
    aim: &'static str,
    /// The unit of the error.
    unit: &'static str,
    /// The direction in which it is measured: the normal, or the ray.
    direction: &'static str,
    /// The largest error allowed, a power of two.
    bound: f64,
    /// Number of distances, each a thousand times the one before.
    distances: u32,
}

const ROUNDING: &str = "pow(2, -52) * Reach";
const NORMAL: &str = "vnormalize(N)";

const ALL: &[RootQuestion] = &[
    RootQuestion {
        name: "letters",
        shape: "text { ttf \"timrom.ttf\" \"Sg&\" 0.5, 0 }",
        aim: "<0.2 + 1.2 * rand(R), 0.6 * rand(R), 0.5 * rand(R)>",
        unit: ROUNDING,
        direction: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    RootQuestion {
        // Of large fields: `inside` has a tolerance of 1e-6.
        name: "a blob",
        shape: "blob { threshold 4e11 sphere { <-0.4, 0, 0>, 1, 1e12 } sphere { <0.5, 0.2, 0>, 0.9, 8e11 } }",
        aim: "<1.2 * rand(R) - 0.6, 0.8 * rand(R) - 0.4, 0.8 * rand(R) - 0.4>",
        unit: ROUNDING,
        direction: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    RootQuestion {
        name: "a cubic sphere sweep",
        shape: "sphere_sweep { cubic_spline 5, <-2, 0, 0>, 0.3, <-1, 0, 0>, 0.3, <0, 0.5, 0.2>, 0.5, <1, 0, 0>, 0.2, <2, 0.4, 0>, 0.3 }",
        aim: "<1.8 * rand(R) - 0.9, 0.6 * rand(R) - 0.1, 0.4 * rand(R) - 0.2>",
        unit: ROUNDING,
        direction: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    RootQuestion {
        name: "a cubic lathe",
        shape: "lathe { cubic_spline 6, <0.2, -1.5>, <0.5, -1>, <0.4, -0.2>, <0.8, 0.8>, <0.5, 1.2>, <0.2, 1.4> }",
        aim: "<1.4 * rand(R) - 0.7, 1.6 * rand(R) - 0.8, 1.4 * rand(R) - 0.7>",
        unit: ROUNDING,
        direction: NORMAL,
        bound: 4.0,
        distances: 4,
    },
    RootQuestion {
        name: "a cubic prism",
        shape: "prism { cubic_spline -0.5, 0.5, 8, <-1, 1>, <0, -1>, <1, 0>, <0.7, 0.9>, <-0.3, 0.6>, <0, -1>, <1, 0>, <1, 1> }",
        aim: "<1.4 * rand(R) - 0.7, 0.8 * rand(R) - 0.4, 1.4 * rand(R) - 0.7>",
        unit: ROUNDING,
        direction: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    RootQuestion {
        name: "a height field",
        shape: "height_field { png \"plasma3.png\" scale <2, 1, 2> translate <-1, -0.5, -1> }",
        aim: "<1.8 * rand(R) - 0.9, 0.2 * rand(R) - 0.1, 1.8 * rand(R) - 0.9>",
        unit: ROUNDING,
        direction: NORMAL,
        bound: 2.0,
        distances: 4,
    },
    RootQuestion {
        name: "an isosurface, to its accuracy",
        shape: "isosurface { function { x*x + y*y*2 + z*z - 1 } contained_by { sphere { 0, 2 } } max_gradient 9 accuracy 0.001 }",
        aim: "<1.6 * rand(R) - 0.8, 1.2 * rand(R) - 0.6, 1.6 * rand(R) - 0.8>",
        unit: "0.001",
        direction: "D",
        bound: 1.0,
        distances: 1,
    },
    RootQuestion {
        name: "a quaternion fractal, to 1e-7",
        shape: "julia_fractal { <-0.083, 0, -0.83, -0.025> quaternion sqr max_iteration 8 precision 50 }",
        aim: "<1.6 * rand(R) - 0.8, 1.2 * rand(R) - 0.6, 1.6 * rand(R) - 0.8>",
        unit: "1e-7",
        direction: "D",
        bound: 1.0,
        distances: 1,
    },
    RootQuestion {
        name: "a hypercomplex fractal, to 1e-7",
        shape: "julia_fractal { <-0.083, 0, -0.83, -0.025> hypercomplex sqr max_iteration 8 precision 50 }",
        aim: "<1.6 * rand(R) - 0.8, 1.2 * rand(R) - 0.6, 1.6 * rand(R) - 0.8>",
        unit: "1e-7",
        direction: "D",
        bound: 1.0,
        distances: 1,
    },
];

/// Rays of each distance.
const RAYS: u32 = 200;

impl RootQuestion {
    fn text(&self) -> String {
        let RootQuestion {
            shape,
            aim,
            unit,
            direction,
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
             #declare By = K * {unit} * {direction};\n\
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
    for question in ALL {
        let asks = Asks::Even {
            text: question.text(),
            color: [0.0; 3],
            within: 0.0,
        };
        all.push(Case::new(51, format!("roots on {}", question.name), asks));
    }
}
