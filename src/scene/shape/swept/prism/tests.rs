use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::SurfaceSide;
use crate::scene::shape::tests::check;

fn prism(text: &str) -> Prism {
    let mut args = TextArgs::new(text);
    let prism = Prism::read(&mut args).unwrap();
    assert!(args.is_done() && args.warnings().is_empty());
    prism
}

const L: &str = "7, <0,0>, <2,0>, <2,1>, <1,1>, <1,2>, <0,2>, <0,0>";
const HOLE: &str =
    "10, <-2,-2>, <2,-2>, <2,2>, <-2,2>, <-2,-2>, <-1,-1>, <1,-1>, <1,1>, <-1,1>, <-1,-1>";
const EGG: &str =
    "cubic_spline -1, 0.5, 7, <1,-1>, <0,1>, <-1.2,0>, <0,-1>, <1.5,0.1>, <0,1>, <-1,-1>";
const LEAF: &str =
    "bezier_spline 0, 1, 8, <-1,0>, <-1,1>, <1,1>, <1,0>, <1,0>, <1,-0.3>, <-1,-1>, <-1,0>";

fn roots(prism: &Prism, ray: &Ray) -> Vec<Root> {
    let mut roots = Vec::new();
    prism.roots(ray, &mut roots);
    roots
}

#[test]
fn the_lower_cap_belongs_to_the_inside_and_the_upper_does_not() {
    let prism = prism(&format!("-1, 1, {L}"));
    let on = |face: u32| {
        let face = prism.flat_face(face)?;
        Some((face.coordinate, face.side(std::cmp::Ordering::Equal)))
    };
    assert_eq!(on(0), None);
    assert_eq!(on(1), Some((-1.0, SurfaceSide::Inside)));
    assert_eq!(on(2), Some((1.0, SurfaceSide::Outside)));
}

#[test]
fn straight_and_curved_outlines_are_solids() {
    for text in [
        &format!("-1, 1, {L}"),
        &format!("1, -0.5, {HOLE}"),
        &format!("linear_sweep linear_spline 0, 1, {L} open"),
        "quadratic_spline 0, 1, 6, <1,-1>, <-1,-1>, <1,-1>, <1,1>, <-1,1>, <-1,-1>",
        EGG,
        LEAF,
    ] {
        check::creased(&prism(text));
    }
    check::solid(&prism(EGG));
}

#[test]
fn conic_sweeps_are_solids() {
    for text in [
        &format!("conic_sweep 0.2, 1, {L}"),
        &format!("conic_sweep -1, 1, {HOLE}"),
        &format!("conic_sweep -1, -0.3, {HOLE} open"),
        &format!("conic_sweep {}", EGG.replace("-1, 0.5, 7", "0.3, 1.5, 7")),
    ] {
        check::creased(&prism(text));
    }
}

#[test]
fn an_upright_ray_hits_the_caps() {
    let solid = prism(&format!("-1, 1, {HOLE}"));
    let down = |x: f64| Ray::new(DVec3::new(x, 5.0, 0.0), DVec3::NEG_Y);
    let depths: Vec<f64> = roots(&solid, &down(1.5)).iter().map(|r| r.t).collect();
    assert_eq!(depths, [4.0, 6.0]);
    assert!(roots(&solid, &down(0.5)).is_empty());
}

#[test]
fn a_cone_through_its_apex_has_one_span_on_each_side() {
    let cone = prism("conic_sweep -1, 1, 5, <-1,-1>, <1,-1>, <1,1>, <-1,1>, <-1,-1>");
    let ray = Ray::new(DVec3::new(-3.0, 0.5, 0.0), DVec3::X);
    let depths: Vec<f64> = roots(&cone, &ray).iter().map(|r| r.t).collect();
    assert_eq!(depths, [2.5, 3.5]);
    let through = Ray::new(DVec3::new(0.0, 3.0, 0.0), DVec3::NEG_Y);
    let depths: Vec<f64> = roots(&cone, &through).iter().map(|r| r.t).collect();
    assert_eq!(depths, [2.0, 4.0]);
    // Parallel to an edge: that crossing lies at infinity.
    let along = Ray::new(DVec3::new(0.5, 0.0, 0.0), DVec3::new(1.0, 1.0, 0.0));
    let depths: Vec<f64> = roots(&cone, &along).iter().map(|r| r.t).collect();
    assert_eq!(depths, [-1.0, -0.25]);
}

#[test]
fn a_linear_outline_that_is_open_is_closed_with_a_warning() {
    let mut args = TextArgs::new("-1, 1, 4, <-1,-1>, <1,-1>, <1,1>, <-1,1>");
    let closed = Prism::read(&mut args).unwrap();
    assert_eq!(
        args.warnings(),
        ["linear prism not closed; it is closed by one more edge"]
    );
    assert!(closed.contains(DVec3::ZERO));
}

#[test]
fn curves_that_are_not_closed_are_errors_or_nothing() {
    for (text, expected) in [
        (
            "quadratic_spline -1, 1, 5, <0,0>, <1,0>, <1,1>, <0,1>, <0,.1>",
            "prism with quadratic splines is not closed",
        ),
        (
            "cubic_spline -1, 1, 5, <0,0>, <1,0>, <1,1>, <0,1>, <1,0>",
            "prism with cubic splines must have at least 6 points",
        ),
        (
            "bezier_spline -1, 1, 3, <0,0>, <1,0>, <1,1>",
            "prism with bezier splines must have four points for each segment",
        ),
        (
            "-1, 1, 2, <0,0>, <1,0>",
            "prism with linear splines must have at least 3 points",
        ),
    ] {
        let error = Prism::read(&mut TextArgs::new(text)).unwrap_err();
        assert_eq!(error.message, expected);
    }
    let mut args = TextArgs::new("bezier_spline -1, 1, 4, <-1,0>, <-1,1>, <1,1>, <1,0>");
    assert!(Prism::read(&mut args).unwrap().bounds().is_empty());
    assert_eq!(args.warnings(), ["prism not closed; it is not drawn"]);
}

#[test]
fn without_height_it_is_a_flat_piece() {
    let flat = prism("1, 1, 5, <-1,-1>, <1,-1>, <1,1>, <-1,1>, <-1,-1>");
    let ray = Ray::new(DVec3::new(0.2, 4.0, 0.0), DVec3::NEG_Y);
    let depths: Vec<f64> = roots(&flat, &ray).iter().map(|r| r.t).collect();
    assert_eq!(depths, [3.0, 3.0]);
}
