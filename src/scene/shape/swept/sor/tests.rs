use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::tests::check;

const VASE: &str = "6, <0.3,-1.5>, <0.5,-1>, <1,-0.2>, <0.3,0.5>, <0.6,1>, <0.8,1.5>";

fn sor(text: &str) -> Sor {
    let mut args = TextArgs::new(text);
    let sor = Sor::read(&mut args).unwrap();
    assert!(args.is_done());
    sor
}

#[test]
fn a_vase_is_a_solid() {
    check::solid(&sor(VASE));
    check::solid(&sor("5, <-0, -2>, <0,-1>, <1,0>, <0,1>, <0,2>"));
    let open = sor(&format!("{VASE} open"));
    check::creased(&open);
    let down = Ray::new(DVec3::new(0.1, 5.0, 0.0), DVec3::NEG_Y);
    let mut roots = Vec::new();
    open.roots(&down, &mut roots);
    assert!(roots.len() == 2 && roots.iter().all(|root| !root.is_visible));
}

#[test]
fn the_curve_passes_through_its_points_with_their_slopes() {
    let vase = sor(VASE);
    let [first, second] = [&vase.profile.rings[0], &vase.profile.rings[1]];
    assert!((first.value(1.0) - 1.0).abs() < 1e-15);
    assert!((second.value(-1.0) - 1.0).abs() < 1e-15);
    // 2 r dr/dy at <1, -0.2>, from its neighbours.
    let slope = 2.0 * (0.3 - 0.5) / (0.5 - -1.0);
    assert!((first.slope(1.0) / 0.4 - slope).abs() < 1e-14);
    assert!((second.slope(-1.0) / 0.35 - slope).abs() < 1e-14);
}

#[test]
fn almost_level_rays_keep_both_sides() {
    let vase = sor(VASE);
    for climb in [0.0, 1e-16, 1e-12, 1e-8, 1e-4] {
        for height in [-0.2, 0.1, 0.5] {
            let ray = Ray::new(DVec3::new(-5.0, height, 0.1), DVec3::new(1.0, climb, 0.0));
            assert_eq!(
                vase.profile.crossings(&ray, false).len(),
                2,
                "{climb} {height}"
            );
        }
    }
}

#[test]
fn a_cylinder_keeps_its_depth_at_any_distance() {
    let cylinder = sor("4, <1,-2>, <1,-1>, <1,1>, <1,2>");
    for far in [3.0, 1e6, 1e12] {
        let ray = Ray::new(DVec3::new(0.6, 0.0, -far), DVec3::Z);
        let seen = cylinder.nearest(&ray, 0.0, f64::INFINITY).unwrap();
        assert!((seen.t - (far - 0.8)).abs() <= 4.0 * f64::EPSILON * far);
    }
}

#[test]
fn missing_points_negative_radii_and_falling_heights_are_errors() {
    for (text, expected) in [
        (
            "3, <0.5,-1.5>, <0.5,-1>, <1,0>",
            "surface of revolution must have at least four points",
        ),
        (
            "5, <.5,-1.5>, <.5,-1>, <-1,0>, <.5,1>, <.5,1.5>",
            "a point has a negative radius: <-1, 0>",
        ),
        (
            "5, <.5,-1.5>, <.5,-1>, <1,-1>, <.5,1>, <.5,1.5>",
            "the heights of a surface of revolution must rise from point to point",
        ),
        (
            "5, <.5,0>, <.5,-1>, <1,0>, <.5,1>, <.5,1.5>",
            "the heights of a surface of revolution must rise from point to point",
        ),
    ] {
        let error = Sor::read(&mut TextArgs::new(text)).unwrap_err();
        assert_eq!(error.message, expected);
    }
}

#[test]
fn v_counts_the_rings() {
    let vase = sor(VASE);
    let [u, v] = vase.uv(DVec3::new(0.0, -0.2, 1.0), 0).unwrap();
    assert!((u - 0.25).abs() < 1e-15 && (v - 1.0 / 3.0).abs() < 1e-15);
}

/// In POV-Ray 3.7 v is 0 at the rim of the lower cap and -1 at its centre, 1 and 2 on the upper cap.
#[test]
fn v_goes_on_over_the_caps() {
    let vase = sor("6, <0.1,-1.5>, <0.6,-1>, <1,-0.5>, <0.7,0.3>, <0.5,1>, <0.1,1.5>");
    let v = |x: f64, y: f64, face| vase.uv(DVec3::new(x, y, 0.0), face).unwrap()[1];
    assert_eq!((v(0.6, -1.0, BASE), v(0.0, -1.0, BASE)), (0.0, -1.0));
    assert_eq!((v(0.5, 1.0, APEX), v(0.0, 1.0, APEX)), (1.0, 2.0));
}

/// Hits of `trace` in POV-Ray 3.7 on nearly level rays: two of four have none there.
#[test]
fn almost_level_rays_hit_where_povray_finds_a_hit() {
    let mut glass = sor(
        "7, <0, 0>, <0.118143, 0>, <0.620253, 0.540084>, <0.210970, 0.827004>, <0.194093, 0.962025>, <0.286920, 1>, \
         <0.468354, 1.033755> open",
    );
    glass.use_povray_hits();
    let hit = |from: [f64; 3], dir: [f64; 3]| {
        let ray = Ray::new(DVec3::from(from), DVec3::from(dir).normalize());
        let root = glass.nearest(&ray, 0.0, f64::INFINITY)?;
        Some(ray.at(root.t))
    };
    let near = |point: Option<DVec3>, z: f64| (point.unwrap().z - z).abs() < 1e-9;
    assert!(near(
        hit([-0.25, 0.5, -5.0], [0.01, 0.002, 1.0]),
        -0.572_693_595_983_095_9
    ));
    assert!(near(
        hit([0.1, 0.3, -5.0], [0.01, 0.000_01, 1.0]),
        -0.463_400_340_956_664_7
    ));
    assert_eq!(hit([0.2, 0.69, -5.0], [-0.01, -0.0003, 1.0]), None);
    assert_eq!(hit([0.3, 0.88, -5.0], [0.0003, 0.0006, 1.0]), None);
}
