use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::tests::check;

fn lathe(text: &str) -> Lathe {
    let mut args = TextArgs::new(text);
    let lathe = Lathe::read(&mut args).unwrap();
    assert!(args.is_done());
    lathe
}

const RING: &str =
    "bezier_spline 8, <1,-1>, <1.6,-1>, <2,-0.5>, <2,0>, <2,0>, <2,0.8>, <1,0.5>, <1,-1>";

#[test]
fn curves_from_axis_to_axis_are_solids() {
    for text in [
        "4, <0,-1>, <1,-1>, <0.5,1>, <0,1>",
        "linear_spline 3, <0,-1>, <1,0>, <0,1>",
        "quadratic_spline 5, <0,-2>, <0,-1>, <1,-0.4>, <0.5,0.5>, <0,1>",
        "cubic_spline 6, <0.5,-1.5>, <0,-1>, <1,-0.4>, <0.5,0.5>, <0,1>, <-1,1>",
    ] {
        check::creased(&lathe(text));
    }
    check::solid(&lathe(RING));
}

#[test]
fn curves_with_open_ends_are_closed_invisibly() {
    for text in [
        "3, <0.5,-1>, <1,0>, <0.7,1>",
        "cubic_spline 5, <0.5,-1.5>, <0.5,-1>, <1,0>, <0.6,1>, <0.5,1.5>",
    ] {
        check::creased(&lathe(text));
    }
}

#[test]
fn contains_agrees_with_pov_ray() {
    let points = [
        (0.5, -0.8),
        (0.5, -5.0),
        (0.5, 0.5),
        (0.2, 0.5),
        (0.2, -0.5),
        (0.6, 0.9),
        (0.6, -0.9),
        (0.6, -0.5),
    ];
    for (text, expected) in [
        ("2, <0,-1>, <1,0>", [0, 0, 0, 0, 1, 0, 0, 0]),
        ("3, <0.5,-1>, <1,0>, <0.7,1>", [1, 0, 1, 0, 0, 1, 0, 1]),
        ("4, <0,-1>, <1,-1>, <1,1>, <0,1>", [1, 0, 1, 1, 1, 1, 1, 1]),
        ("3, <0,-1>, <1,0>, <0.3,1>", [0, 0, 1, 1, 1, 0, 0, 0]),
        ("2, <0.5,-1>, <0.5,1>", [1, 0, 1, 0, 0, 0, 0, 0]),
    ] {
        let solid = lathe(text);
        let inside = points.map(|(r, y)| u8::from(solid.contains(DVec3::new(r, y, 0.0))));
        assert_eq!(inside, expected, "{text}");
    }
}

#[test]
fn level_and_almost_level_rays_keep_both_sides() {
    let ring = lathe(RING);
    for climb in [0.0, 1e-16, 1e-12, 1e-8, 1e-4] {
        let ray = Ray::new(DVec3::new(-5.0, 0.01, 0.0), DVec3::new(1.0, climb, 0.0));
        assert_eq!(
            ring.0.crossings(&ray, RootQuery::EVERYWHERE).len(),
            4,
            "{climb}"
        );
    }
}

#[test]
fn upright_and_almost_upright_rays_keep_both_ends() {
    let ring = lathe(RING);
    for lean in [0.0, 1e-16, 1e-12, 1e-8, 1e-4] {
        let ray = Ray::new(DVec3::new(1.5, 5.0, 0.2), DVec3::new(lean, -1.0, 0.0));
        assert_eq!(
            ring.0.crossings(&ray, RootQuery::EVERYWHERE).len(),
            2,
            "{lean}"
        );
    }
}

#[test]
fn a_straight_curve_is_a_cylinder_to_rounding_at_any_distance() {
    let cylinder = lathe("2, <1,-1>, <1,1>");
    for far in [3.0, 1e6, 1e12] {
        let ray = Ray::new(DVec3::new(0.6, 0.0, -far), DVec3::Z);
        let seen = cylinder.nearest(&ray, 0.0, f64::INFINITY).unwrap();
        assert!((seen.t - (far - 0.8)).abs() <= 4.0 * f64::EPSILON * far);
    }
}

#[test]
fn missing_points_and_points_beyond_the_axis_are_errors() {
    for (text, expected) in [
        (
            "1, <0.5,-1>",
            "lathe with linear splines must have at least 2 points",
        ),
        (
            "bezier_spline 3, <0,0>, <1,0>, <1,1>",
            "lathe with bezier splines must have four points for each segment",
        ),
        (
            "3, <0.5,-1>, <-1,0>, <0.5,1>",
            "a point of the lathe lies beyond its axis: <-1, 0>",
        ),
    ] {
        let error = Lathe::read(&mut TextArgs::new(text)).unwrap_err();
        assert_eq!(error.message, expected);
    }
}

#[test]
fn u_turns_from_x_to_z_and_v_follows_the_curve() {
    let cone = lathe("3, <0,-1>, <1,0>, <0,1>");
    assert_eq!(cone.uv(DVec3::new(0.0, 0.0, 1.0), 0), Some([0.25, 0.5]));
    let [_, v] = cone.uv(DVec3::new(-0.5, 0.5, 0.0), 0).unwrap();
    assert!((v - 0.75).abs() < 1e-12);
}

#[test]
fn partial_queries_agree_with_all_roots() {
    let open = "cubic_spline 7, <1,-2>, <0.5,-1>, <1,0>, <0.3,0.4>, <0.9,0.8>, <0.6,1>, <0.5,2>";
    let gap =
        "bezier_spline 8, <0,-1>, <1,-1>, <1.5,-0.5>, <1,0>, <1,0.1>, <0.4,0.3>, <2,1>, <0,1>";
    for text in [RING, open, gap, "3, <0.5,-1>, <1,0>, <0.7,1>"] {
        let solid = lathe(text);
        let mut rng = check::Random::new(5);
        let mut hits = 0;
        for _ in 0..2000 {
            let ray = rng.ray_near(&solid.bounds());
            let mut all = Vec::new();
            solid.roots(&ray, &mut all);
            let ends = all.iter().map(|root| root.t);
            let params: Vec<f64> = ends.chain([f64::NEG_INFINITY, -0.5, 0.0, 1.0]).collect();
            for &from in &params {
                for to in [f64::INFINITY, from + 0.7] {
                    let expected = first_visible(&all, from, to);
                    assert_eq!(solid.nearest(&ray, from, to), expected, "{text} {ray:?}");
                    hits += usize::from(expected.is_some());
                }
                let mut result = Vec::new();
                let enough = from + 0.3;
                solid.roots_from(&ray, from, enough, &mut result);
                let first = all
                    .iter()
                    .position(|root| root.is_visible && root.t > enough);
                let wanted = &all[..first.map_or(all.len(), |first| first + 1)];
                for root in wanted.iter().filter(|root| root.t > from) {
                    assert!(result.contains(root), "{text} {ray:?} {root:?}");
                }
                let known = |root: &Root| root.t <= from || all.contains(root);
                assert!(result.iter().all(known));
            }
        }
        assert!(hits > 1000);
    }
}
