//! What an object keeps after compile: its inverse matrix or less, never the forward one.

use povr::compile::{Leaf, compile};
use povr::options::{ReadOptions, RenderOptions};
use povr::shape::Shape;
use povr::source::Sources;

/// The bytes of a matrix of three rows and four columns.
const MATRIX: usize = 12 * size_of::<f64>();

/// The primitives of a scene as they are kept for tracing.
fn leaves(scene: &str) -> Vec<Leaf> {
    let mut sources = Sources::new(Vec::new());
    let file = sources.add_text("memory.pov", scene);
    let reading = povr::lang::evaluate(file, &mut sources, &ReadOptions::default());
    let scene = reading
        .scene
        .unwrap_or_else(|| panic!("{:?}", reading.findings));
    compile(scene, &RenderOptions::default()).leaves().to_vec()
}

/// The one primitive of a scene.
fn leaf(scene: &str) -> Leaf {
    let leaves = leaves(scene);
    assert_eq!(leaves.len(), 1, "{scene}");
    leaves[0].clone()
}

#[test]
fn an_object_that_can_take_its_transforms_in_keeps_no_matrix() {
    for scene in [
        "sphere { <1, 2, 3>, 1 translate x rotate 30*z scale 2 translate -y }",
        "box { -1, 1 translate x scale <1, 2, 3> translate -y }",
        "cylinder { -y, y, 1 translate x rotate 30*z scale 2 }",
        "cone { -y, 1, y, 0.5 rotate 30*z translate x }",
        "plane { y, -1 rotate 30*z translate x scale <1, 2, 3> }",
        "torus { 1, 0.25 translate x scale 2 }",
        "disc { 0, y, 1 rotate 30*z translate x }",
        "triangle { 0, x, y matrix <1, 0.5, 0, 0, 1, 0, 0, 0, 1, 1, 2, 3> }",
        "union { sphere { 0, 1 translate x } rotate 30*z }",
    ] {
        assert!(leaf(scene).object_from_world.is_none(), "{scene}");
    }
}

#[test]
fn an_object_that_cannot_keeps_one_inverse_matrix() {
    for scene in [
        "sphere { 0, 1 scale <1, 2, 1> rotate 30*z }",
        "box { -1, 1 rotate 30*z translate x }",
        "torus { 1, 0.25 rotate 30*z translate x scale 3 }",
        "cylinder { -y, y, 1 matrix <1, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0> }",
    ] {
        let leaf = leaf(scene);
        let inverse = leaf.object_from_world.as_ref().expect("a matrix is needed");
        assert!(inverse.is_finite(), "{scene}");
        assert_eq!(leaf.bytes(), size_of::<Leaf>() + MATRIX, "{scene}");
    }
}

#[test]
fn the_matrix_kept_is_the_inverse() {
    let leaf = leaf("box { -1, 1 rotate 90*z translate <5, 0, 0> }");
    let inverse = leaf
        .object_from_world
        .expect("a rotated box needs a matrix");
    // The world's <5, 1, 0> is the box's <1, 0, 0>.
    let point = inverse.transform_point3(glam::DVec3::new(5.0, 1.0, 0.0));
    assert!((point - glam::DVec3::X).length() < 1e-15, "{point}");
}

#[test]
fn a_primitive_takes_no_more_than_its_numbers() {
    // The largest shape is a smooth triangle: three points and three normals.
    assert!(size_of::<Shape>() <= 18 * size_of::<f64>() + 8);
    assert!(size_of::<Leaf>() <= size_of::<Shape>() + 2 * size_of::<usize>());
}

#[test]
fn objects_with_the_same_texture_share_one_surface() {
    let scene = "union { sphere { 0, 1 } sphere { x, 1 } sphere { 2*x, 1 } pigment { rgb 1 } }";
    assert!(leaves(scene).iter().all(|leaf| leaf.surface == 0));
}
