//! The shapes of the sheets: one object each that fits into two units about the origin and has a different view from
//! every side.

/// A shape by name, and its object in the scene language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sample {
    /// The keyword.
    pub(super) name: &'static str,
    /// The object, without texture.
    pub(super) text: &'static str,
}

const fn sample(name: &'static str, text: &'static str) -> Sample {
    Sample { name, text }
}

/// Every primitive and every CSG combination. Infinite ones are clipped.
pub(super) const SHAPES: &[Sample] = &[
    sample("sphere", "sphere { 0, 1 }"),
    sample("box", "box { <-1, -0.7, -0.4>, <1, 0.7, 0.4> }"),
    sample("cylinder", "cylinder { <0, -1, 0>, <0, 1, 0>, 0.6 }"),
    sample("cone", "cone { <0, -1, 0>, 0.9, <0, 1, 0>, 0.2 }"),
    sample("torus", "torus { 0.8, 0.3 }"),
    sample(
        "plane",
        "plane { <0.2, 1, 0.1>, 0 clipped_by { box { -1, 1 } } }",
    ),
    sample("disc", "disc { 0, <0.2, 1, 0.1>, 1, 0.4 }"),
    sample(
        "triangle",
        "triangle { <-1, -0.8, 0>, <1, -0.6, 0.2>, <-0.2, 1, -0.2> }",
    ),
    sample(
        "smooth_triangle",
        "smooth_triangle {
  <-1, -0.8, 0>, <-0.3, -0.3, -1>, <1, -0.6, 0.2>, <0.4, -0.2, -1>, <-0.2, 1, -0.2>, <0, 0.5, -1>
}",
    ),
    sample(
        "quadric",
        "quadric { <1, 0.6, 2>, <0.4, 0, 0>, <0, 0.2, 0>, -0.6 }",
    ),
    sample(
        "blob",
        "blob {
  threshold 0.5
  sphere { <-0.4, 0, 0>, 0.9, 1 }
  cylinder { <0.3, -0.6, 0>, <0.3, 0.6, 0>, 0.6, 1 }
}",
    ),
    sample("superellipsoid", "superellipsoid { <0.5, 0.3> }"),
    sample(
        "prism",
        "prism { linear_spline -0.6, 0.6, 4, <-1, -0.8>, <1, -0.5>, <0, 1>, <-1, -0.8> }",
    ),
    sample(
        "lathe",
        "lathe { linear_spline 5, <0, -1>, <0.8, -0.6>, <0.4, 0.2>, <0.6, 0.8>, <0, 1> }",
    ),
    sample(
        "poly",
        "poly { 2, <1, 0.8, 0, 0, 1, 0, 0, 2, 0, -0.7> }",
    ),
    sample(
        "polynomial",
        "polynomial { 2, xyz(2,0,0): 1, xyz(1,1,0): 0.8, xyz(0,2,0): 1, xyz(0,0,2): 2, xyz(0,0,0): -0.7 }",
    ),
    sample(
        "cubic",
        "cubic {
  <1, 0, 0, 0, 0, 0, 0, 0, 0, -0.6, 0, 0, 0, 0, 0, -1, 0, 0.4, 0, 0>
  clipped_by { box { -1, 1 } }
}",
    ),
    sample(
        "quartic",
        "quartic {
  <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, -0.6>
}",
    ),
    sample(
        "sor",
        "sor { 6, <0.3, -1.3>, <0.5, -1>, <0.9, -0.2>, <0.4, 0.6>, <0.5, 1>, <0.4, 1.2> }",
    ),
    sample(
        "polygon",
        "polygon { 5, <-1, -0.8, 0>, <1, -0.8, 0>, <0.8, 0.6, 0>, <-0.2, 1, 0>, <-1, -0.8, 0> }",
    ),
    sample("ovus", "ovus { 0.8, 0.5 }"),
    sample("lemon", "lemon { -0.9*y, 0.2, 0.9*y, 0.1, 1.5 }"),
    sample(
        "mesh",
        "mesh {
  triangle { <-1, -0.6, -0.5>, <1, -0.6, -0.5>, <0, 1, 0> }
  triangle { <1, -0.6, -0.5>, <0, -0.6, 0.9>, <0, 1, 0> }
  triangle { <0, -0.6, 0.9>, <-1, -0.6, -0.5>, <0, 1, 0> }
  triangle { <-1, -0.6, -0.5>, <1, -0.6, -0.5>, <0, -0.6, 0.9> }
}",
    ),
    sample(
        "mesh2",
        "mesh2 {
  vertex_vectors { 4, <-1, -0.6, -0.5>, <1, -0.6, -0.5>, <0, 1, 0>, <0, -0.6, 0.9> }
  face_indices { 4, <0, 1, 2>, <1, 3, 2>, <3, 0, 2>, <0, 1, 3> }
}",
    ),
    sample(
        "height_field",
        "height_field { pgm \"heights.pgm\" translate <-0.5, -0.3, -0.5> scale <2, 1.5, 1.6> }",
    ),
    sample(
        "bicubic_patch",
        "bicubic_patch {
  type 1 u_steps 3 v_steps 3
  <-1, -1, 0>, <-0.3, -1, -0.8>, <0.3, -1, 0.8>, <1, -1, 0>,
  <-1, -0.3, 0>, <-0.3, -0.3, 0>, <0.3, -0.3, -0.6>, <1, -0.3, 0>,
  <-1, 0.3, -0.4>, <-0.3, 0.3, 0>, <0.3, 0.3, 0>, <1, 0.3, 0.4>,
  <-1, 1, 0>, <-0.3, 1, 0.8>, <0.3, 1, 0>, <1, 0.6, 0>
}",
    ),
    sample(
        "text",
        "text { internal 1 \"R\" 0.3, 0 translate <-0.35, -0.35, -0.15> scale 2 }",
    ),
    sample(
        "julia_fractal",
        "julia_fractal { <-0.083, 0, -0.83, -0.025> quaternion sqr max_iteration 8 precision 15 scale 0.8 }",
    ),
    sample(
        "sphere_sweep",
        "sphere_sweep {
  b_spline 5, <-2, 0, 0>, 0.3, <-1, 0.8, 0>, 0.4, <0, -1, 0.4>, 0.3, <1, 0.8, -0.4>, 0.4, <2, 0, 0>, 0.2
}",
    ),
    sample(
        "isosurface",
        "isosurface {
  function { sqrt(x*x + y*y + z*z) - 0.8 + 0.1 * sin(8 * y) }
  max_gradient 2 accuracy 0.0005
}",
    ),
    sample(
        "parametric",
        "parametric {
  function { u * v } function { u * u - v * v } function { u + 0.3 * v }
  <-0.9, -0.9>, <0.9, 0.9>
  contained_by { box { -1.2, 1.2 } }
  max_gradient 2.5 accuracy 0.004
}",
    ),
    sample(
        "union",
        "union { box { <-1, -0.7, -0.5>, <0.2, 0.3, 0.5> } sphere { <0.4, 0.3, 0>, 0.6 } }",
    ),
    sample(
        "merge",
        "merge { box { <-1, -0.7, -0.5>, <0.2, 0.3, 0.5> } sphere { <0.4, 0.3, 0>, 0.6 } }",
    ),
    sample(
        "intersection",
        "intersection { box { <-0.9, -0.7, -0.6>, <0.7, 0.8, 0.6> } sphere { <0.1, 0, 0>, 0.95 } }",
    ),
    sample(
        "difference",
        "difference { box { <-1, -0.7, -0.6>, <0.9, 0.7, 0.6> } sphere { <0.6, 0.4, -0.4>, 0.7 } }",
    ),
];

/// The heights of the height field, in a file beside the scenes.
pub(super) const HEIGHTS: (&str, &str) = (
    "heights.pgm",
    "P2
8 8
255
70 80 90 95 90 80 75 70
75 99 130 140 120 95 85 75
80 125 180 190 150 100 90 90
85 120 160 170 130 90 110 110
80 100 115 110 95 100 140 120
75 85 90 80 90 130 170 130
70 75 70 70 90 140 150 110
60 65 60 65 80 100 110 95
",
);
