use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::tests::check;

const POINTS: &str = "<0,0,2>, <1,0,0>, <2,0,0>, <3,0,-2>, <0,1,0>, <1,1,0>, <2,1,0>, <3,1,0>,
    <0,2,0>, <1,2,0>, <2,2,0>, <3,2,0>, <0,3,2>, <1,3,0>, <2,3,0>, <3,3,-2>";

fn patch(words: &str) -> BicubicPatch {
    let mut args = TextArgs::new(&format!("{words} {POINTS}"));
    let mut patch = BicubicPatch::read(&mut args).unwrap();
    assert!(args.is_done());
    patch.prepare();
    patch
}

#[test]
fn it_is_a_patch() {
    check::patch(&patch("type 0 u_steps 3 v_steps 3"));
}

#[test]
fn each_step_doubles_the_parts_of_its_direction() {
    let count = |words| patch(words).tessellation().triangles.len();
    assert_eq!(count("type 1"), 2);
    assert_eq!(count("type 1 u_steps 3 v_steps 2"), 64);
    assert_eq!(count("type 1 u_steps 3 v_steps 3 flatness 100"), 2);
    let some = count("type 1 u_steps 4 v_steps 4 flatness 0.05");
    assert!(2 < some && some < 512, "{some}");
    assert_eq!(count("1, 2, 2"), 32);
}

#[test]
fn the_vertices_lie_on_the_surface() {
    let patch = patch("type 1 u_steps 2 v_steps 3");
    for vertex in &patch.tessellation().vertices {
        let (u, v) = (bernstein(vertex.params.x), bernstein(vertex.params.y));
        let mut point = DVec3::ZERO;
        for (row, u) in patch.net.points.iter().zip(u) {
            for (net, v) in row.iter().zip(v) {
                point += u * v * *net;
            }
        }
        assert!((point - vertex.point).length() < 1e-14);
    }
}

#[test]
fn texture_coordinates_run_along_v_first() {
    let patch = patch("type 1 u_steps 3 v_steps 3");
    let hit = patch.nearest(&Ray::new(DVec3::new(2.0, 1.0, -9.0), DVec3::Z), 0.0, 99.0);
    let hit = hit.unwrap();
    let uv = patch
        .uv(DVec3::new(2.0, 1.0, hit.t - 9.0), hit.face)
        .unwrap();
    assert!((uv[0] - 2.0 / 3.0).abs() < 1e-9 && (uv[1] - 1.0 / 3.0).abs() < 1e-9);
}

#[test]
fn errors_are_reported() {
    let fault = |text: &str| {
        BicubicPatch::read(&mut TextArgs::new(text))
            .unwrap_err()
            .message
    };
    assert_eq!(
        fault("u_steps 3 <0,0,0>"),
        "expected `type` 0 or 1 in `bicubic_patch`, found `<`"
    );
    assert_eq!(
        fault("type 1 u_steps 12 v_steps 12 <0,0,0>"),
        "`u_steps` and `v_steps` are 20 at most together"
    );
    assert_eq!(
        fault("type 1 u_steps -1"),
        "a bicubic patch has 0 to 20 steps, found -1"
    );
}
