use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::tests::check;

fn sweep(text: &str) -> SphereSweep {
    let mut args = TextArgs::new(text);
    let sweep = SphereSweep::read(&mut args).unwrap();
    assert!(args.is_done());
    sweep
}

const BENT: &str =
    "6, <-2,0,0>, 0.5, <-1,1,0>, 0.4, <0,-1,0.5>, 0.6, <1,1,-0.5>, 0.2, <2,0,0>, 0.5, <2,1,2>, 0.3";

#[test]
fn sweeps_are_solids() {
    for kind in ["linear_spline", "b_spline", "cubic_spline"] {
        check::solid(&sweep(&format!("{kind} {BENT}")));
    }
}

#[test]
fn a_linear_sweep_of_equal_radii_is_a_capsule() {
    let capsule = sweep("linear_spline 2, <-1,0,0>, 0.5, <1,0,0>, 0.5");
    let mut rng = check::Random::new(3);
    for _ in 0..2000 {
        let ray = rng.ray_near(&capsule.bounds());
        let mut roots = Vec::new();
        capsule.roots(&ray, &mut roots);
        for root in &roots {
            let p = ray.at(root.t);
            let axis = DVec3::new(p.x.clamp(-1.0, 1.0), 0.0, 0.0);
            assert!(
                ((p - axis).length() - 0.5).abs() < 1e-12,
                "{ray:?} {root:?}"
            );
        }
    }
}

#[test]
fn a_planar_sweep_is_hit_at_right_angles() {
    // Entry and exit distances have their extremes at the same parameters.
    let flat = sweep("cubic_spline 4, <-2,0,0>, 0.5, <-1,0,0>, 0.5, <1,0,0>, 0.5, <2,0,0>, 0.5");
    for y in [0.0, 0.3, 0.49] {
        let ray = Ray::new(DVec3::new(0.2, y, -5.0), DVec3::Z);
        let mut roots = Vec::new();
        flat.roots(&ray, &mut roots);
        let half = (0.25 - y * y).sqrt();
        assert_eq!(roots.len(), 2);
        assert!((roots[0].t - (5.0 - half)).abs() < 1e-12);
        assert!((roots[1].t - (5.0 + half)).abs() < 1e-12);
    }
}

#[test]
fn missing_spheres_are_an_error() {
    let fault = |text: &str| {
        SphereSweep::read(&mut TextArgs::new(text))
            .unwrap_err()
            .message
    };
    assert_eq!(
        fault("b_spline 3, <0,0,0>, 1"),
        "a `b_spline` needs at least 4 spheres, found 3"
    );
    assert_eq!(
        fault("natural_spline 3"),
        "expected `linear_spline`, `b_spline` or `cubic_spline` in `sphere_sweep`, found `natural_spline`"
    );
}
