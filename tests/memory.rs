//! Memory of lowered objects: the inverse matrix or less, never the forward one.

use povr::base::options::{ReadOptions, RenderOptions};
use povr::base::source::Sources;
use povr::scene::shape::Shape;
use povr::world::{Leaf, World, compile};

/// The bytes of a matrix of three rows and four columns.
const MATRIX: usize = 12 * size_of::<f64>();

/// A scene lowered for ray queries.
fn world(scene: &str) -> World {
    let mut sources = Sources::new(Vec::new());
    let file = sources.add_text("memory.pov", scene);
    let reading = povr::lang::evaluate(file, &mut sources, &ReadOptions::default());
    let scene = reading
        .scene
        .unwrap_or_else(|| panic!("{:?}", reading.findings));
    compile(scene, &RenderOptions::default())
}

/// The primitives of a lowered scene.
fn leaves(scene: &str) -> Vec<Leaf> {
    world(scene).leaves().to_vec()
}

/// The only primitive of a scene.
fn leaf(scene: &str) -> Leaf {
    let leaves = leaves(scene);
    assert_eq!(leaves.len(), 1, "{scene}");
    leaves[0].clone()
}

#[test]
fn an_object_that_absorbs_its_transforms_stores_no_matrix() {
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
fn any_other_object_stores_one_inverse_matrix() {
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
fn the_stored_matrix_is_the_inverse() {
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

/// A hundred spheres, and a thousand copies of them.
const COPIES: &str = "#declare Part = union { #for (I, 1, 100) sphere { I * x, 1 } #end }
#for (I, 1, 1000) object { Part rotate I * y translate I * z } #end";

#[test]
fn copies_of_a_large_union_share_its_parts() {
    let world = world(COPIES);
    let plan = world.plan();
    assert_eq!(world.leaves().len(), 0);
    assert_eq!(world.primitive_count(), 100_000);
    assert_eq!((plan.shared, plan.instances), (1, 1000));
    assert_eq!(plan.primitives.get("sphere"), Some(&100));
    // The inverse matrix, the shared model, and the start of its numbers.
    assert_eq!(plan.instance_bytes, MATRIX + 2 * size_of::<usize>());
    assert_eq!(plan.surfaces, 1);
}

#[test]
fn copies_of_copies_share_at_each_level() {
    let doubled = "#declare U = union { #for (I, 1, 100) sphere { I * x, 0.1 } #end }
        #for (I, 1, 24) #declare U = union { object { U } object { U translate I * z } } #end
        object { U }";
    let world = world(doubled);
    let plan = world.plan();
    assert_eq!(world.primitive_count(), 100 << 24);
    assert!(plan.instances < 100, "{}", plan.instances);
    let spheres = plan.primitives["sphere"];
    assert!(spheres < 20_000, "{spheres}");
}

#[test]
fn a_small_number_of_copies_is_flattened() {
    let world = world(&COPIES.replace("1000", "10"));
    assert_eq!(world.leaves().len(), 1000);
    assert_eq!(world.plan().instances, 0);
}

#[test]
#[cfg(target_pointer_width = "64")]
fn a_surface_is_small() {
    assert!(size_of::<povr::world::Surface>() <= 112);
    assert!(size_of::<Leaf>() <= 112);
}
