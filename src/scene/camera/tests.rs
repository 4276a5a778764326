//! Cameras compared with POV-Ray's images, and error messages.

use super::*;
use crate::base::args::text::TextArgs;

fn camera(text: &str, version: f64) -> Camera {
    let mut args = TextArgs::new(text).at_version(version);
    let camera = Camera::read(&mut args, &Camera::default()).unwrap();
    assert!(args.is_done());
    camera
}

fn error(text: &str) -> String {
    let read = Camera::read(&mut TextArgs::new(text), &Camera::default());
    read.expect_err("the text is faulty").message
}

/// Hit points of the rays of a 5 by 1 image with the plane z = 0: their x.
fn columns(camera: &Camera) -> Vec<f64> {
    let ray = |x: u8| camera.primary_ray(f64::from(x), 0.0, 5, 1);
    let hit_x = |ray: Ray| ray.origin.x - ray.origin.z / ray.dir.z * ray.dir.x;
    (0..5)
        .map(|x| hit_x(ray(x).expect("it has a direction")))
        .collect()
}

/// Compares with the hit points of POV-Ray 3.7, measured from a 16-bit image of a plane `z, 0` with a gradient over 100
/// units.
fn check(text: &str, version: f64, expected: [f64; 5]) {
    for (actual, expected) in columns(&camera(text, version)).iter().zip(expected) {
        assert!(
            (actual - expected).abs() < 0.002,
            "{text}: {actual}, not {expected}"
        );
    }
}

#[test]
fn right_sets_the_width_of_the_image() {
    check(
        "{ location <0,0,-5> }",
        3.7,
        [-2.66, -1.33, 0.0, 1.33, 2.66],
    );
}

#[test]
fn an_orthographic_view_is_scaled_by_the_distance_of_look_at() {
    let text = "{ orthographic location <1,0,-5> look_at <1,0,0> }";
    check(text, 3.7, [-1.659, -0.33, 1.0, 2.329, 3.66]);
}

#[test]
fn an_orthographic_view_with_right_is_not_scaled() {
    let text = "{ orthographic location <1,0,-5> look_at <1,0,0> right <2,0,0> }";
    check(text, 3.7, [0.201, 0.6, 1.0, 1.4, 1.8]);
}

#[test]
fn an_orthographic_view_with_angle_is_scaled() {
    let text = "{ orthographic location <1,0,-5> look_at <1,0,0> angle 40 }";
    check(text, 3.7, [-0.455, 0.272, 1.0, 1.728, 2.456]);
}

#[test]
fn the_order_of_parameters_does_not_matter() {
    let text = "{ location <1,0,-5> angle 60 right <2,0,0> look_at <2,0,0> }";
    check(text, 3.7, [-0.199, 0.852, 2.0, 3.259, 4.646]);
}

#[test]
fn transforms_come_after_look_at() {
    let text = "{ location <1,0,-5> right <2,0,0> angle 60 rotate <0,20,0> look_at <2,0,0> }";
    check(text, 3.7, [-0.195, 0.896, 2.296, 4.151, 6.732]);
}

#[test]
fn before_version_3_5_parameters_take_effect_in_order() {
    let angle = "{ location <1,0,-5> angle 60 right <2,0,0> look_at <2,0,0> }";
    check(angle, 3.1, [-1.171, 0.312, 2.0, 3.941, 6.194]);
    let turn = "{ location <1,0,-5> right <2,0,0> angle 60 rotate <0,20,0> look_at <2,0,0> }";
    check(turn, 3.1, [-0.417, 0.655, 2.0, 3.736, 6.063]);
    let early = "{ orthographic location <1,0,-5> look_at <1,0,0> }";
    check(early, 3.1, [0.468, 0.735, 1.0, 1.266, 1.531]);
    let late = "{ location <1,0,-5> look_at <1,0,0> orthographic }";
    check(late, 3.1, [-1.659, -0.33, 1.0, 2.329, 3.66]);
    let moved = "{ location <1,0,-5> look_at <2,0,0> orthographic translate <3,0,0> }";
    check(moved, 3.1, [2.233, 3.617, 5.0, 6.384, 7.766]);
    let unopened = "{ orthographic angle 40 location <1,0,-5> look_at <1,0,0> }";
    check(unopened, 3.1, [0.468, 0.735, 1.0, 1.266, 1.531]);
}

#[test]
fn a_mirrored_right_stays_mirrored() {
    let text = "{ location <0,0,-5> right <-1,0,0> look_at 0 }";
    check(text, 3.7, [2.0, 1.0, 0.0, -1.0, -2.0]);
}

#[test]
fn a_named_camera_takes_transforms_only() {
    let known = camera("{ location <0,0,-5> }", 3.7);
    let mut args = TextArgs::new("{ C translate <1,0,0> }").with("C", known.clone());
    let moved = Camera::read(&mut args, &Camera::default()).unwrap();
    assert_eq!(moved.location(), DVec3::new(1.0, 0.0, -5.0));
    let mut args = TextArgs::new("{ C angle 30 }").with("C", known);
    let error = Camera::read(&mut args, &Camera::default()).expect_err("no room for `angle`");
    assert_eq!(
        error.message,
        "expected a transform or `}` after the name of a camera, found `angle`"
    );
}

#[test]
fn looking_along_sky_is_a_warning() {
    let mut args = TextArgs::new("{ location <0,-5,0> look_at 0 }");
    let camera = Camera::read(&mut args, &Camera::default()).unwrap();
    assert_eq!(
        args.warnings(),
        ["the camera looks along `sky`; it keeps its `right`"]
    );
    assert_eq!(camera.frame.right, DVec3::new(1.33, 0.0, 0.0));
}

#[test]
fn a_camera_without_direction_sees_nothing() {
    let camera = camera("{ direction 0 right 0 up 0 }", 3.7);
    assert!(camera.primary_ray(0.0, 0.0, 1, 1).is_none());
}

#[test]
fn rays_of_many_points_are_those_of_each() {
    let points: Vec<(f64, f64)> = (0..50)
        .map(|at| (f64::from(at % 7) + 0.25, f64::from(at / 7) - 0.3))
        .collect();
    for text in [
        "{ orthographic location <1, 2, -5> look_at <0.5, 0, 1> angle 40 }",
        "{ orthographic location <0, 0, -5> look_at 0 normal { bumps 0.3 } }",
        "{ location <1, 2, -5> look_at <0.5, 0, 1> }",
        "{ fisheye location <1, 2, -5> angle 60 }",
        "{ orthographic direction 0 }",
    ] {
        let camera = camera(text, 3.7);
        let mut rays = Vec::new();
        camera.add_primary_rays(&points, (9, 8), &mut rays);
        let each = points
            .iter()
            .map_while(|&(x, y)| camera.primary_ray(x, y, 9, 8));
        assert_eq!(rays, each.collect::<Vec<_>>(), "{text}");
    }
}

#[test]
fn faults_are_reported() {
    assert_eq!(
        error("{ angle 180 }"),
        "`angle` must be less than 180 degrees, but it is 180"
    );
    assert_eq!(
        error("{ angle -10 }"),
        "`angle` must not be negative, but it is -10"
    );
    assert_eq!(
        error("{ look_at 0 }"),
        "`look_at` is the same point as `location`"
    );
    assert_eq!(
        error("{ cylinder 5 }"),
        "`cylinder` cameras have the types 1 to 4, not 5"
    );
    assert_eq!(
        error("{ location 0 orthographic }"),
        "`orthographic` must come first in `camera`"
    );
}

#[test]
fn points_of_a_ray_project_to_its_pixel() {
    for text in [
        "{ location <1, 2, -5> look_at <0.5, 0, 1> angle 50 right <1.5, 0.2, 0> }",
        "{ orthographic location <1, 2, -5> look_at <0.5, 0, 1> angle 40 }",
    ] {
        let camera = camera(text, 3.7);
        for (x, y) in [(0.0, 0.0), (17.3, 4.8), (-3.0, 40.0)] {
            let ray = camera.primary_ray(x, y, 40, 30).expect("a ray");
            let seen = camera.project(ray.origin + 7.0 * ray.dir, 40, 30);
            let (u, v) = seen.expect("it lies before the camera");
            assert!((u - x).hypot(v - y) < 1e-9, "{text}: {u} {v}, not {x} {y}");
            assert_eq!(camera.project(ray.origin - ray.dir, 40, 30), None);
        }
    }
    let bent = camera("{ fisheye location <0, 0, -5> angle 120 }", 3.7);
    assert_eq!(bent.project(DVec3::ZERO, 40, 30), None);
}

/// POV-Ray 3.7 evaluates the bumps of each projection in that projection's own coordinates.
#[test]
fn bumps_use_the_coordinates_of_the_projection() {
    let check = |text: &str, x: f64, y: f64| {
        let point = camera(text, 3.7).bump_point(Screen { u: -0.25, v: 0.125 });
        assert!(
            (point - DVec2::new(x, y)).length() < 1e-12,
            "{text}: {point}"
        );
    };
    check("{ perspective }", -0.25, 0.125);
    check("{ orthographic }", -0.25, 0.125);
    let shape = "up <0, 2, 0> right <4, 0, 0> angle 90";
    let quarter = 0.5 * PI;
    check(
        &format!("{{ ultra_wide_angle {shape} }}"),
        -0.25 * quarter,
        0.0625 * quarter,
    );
    check("{ panoramic }", 0.75 * PI, 0.125 * PI);
    check("{ spherical }", -0.5 * PI, 0.125 * PI);
    check(&format!("{{ cylinder 1 {shape} }}"), -0.25 * quarter, 0.25);
    check(&format!("{{ cylinder 2 {shape} }}"), -1.0, 0.125 * quarter);
    let away = 2.0_f64.hypot(0.5);
    let turn = PI - (0.5 / away).asin();
    check(
        &format!("{{ fisheye {shape} }}"),
        turn,
        0.5 * away * quarter,
    );
}
