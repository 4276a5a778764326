use super::*;
use crate::base::args::text::TextArgs;
use crate::base::math::sampling::random::Random;
use crate::scene::shape::tests::check;

#[test]
fn rounded_boxes_are_solids() {
    for (e, n) in [(1.0, 1.0), (0.5, 0.7), (0.9, 0.8)] {
        check::solid(&Superellipsoid::new(e, n));
    }
    for (e, n) in [(1.5, 0.3), (2.0, 2.0), (0.1, 1.9), (0.02, 0.02)] {
        check::creased(&Superellipsoid::new(e, n));
    }
}

#[test]
fn stars_are_solids() {
    for (e, n) in [(3.0, 3.0), (3.0, 0.5), (0.5, 4.0), (2.5, 1.0)] {
        check::creased(&Superellipsoid::new(e, n));
    }
}

#[test]
fn with_both_one_it_is_a_sphere() {
    let ray = Ray::new(DVec3::new(0.3, 0.4, -1e6), DVec3::Z);
    let roots = Superellipsoid::new(1.0, 1.0).crossings(&ray, RootRange::ALL);
    assert_eq!(roots.len(), 2);
    assert!((roots[0].t - (1e6 - 0.75_f64.sqrt())).abs() < 2e-10);
    assert!((roots[1].t - (1e6 + 0.75_f64.sqrt())).abs() < 2e-10);
}

#[test]
fn exponents_near_zero_make_a_box() {
    for e in [0.0, 1e-9, 1e-3] {
        let ray = Ray::new(DVec3::new(-3.0, 0.9, 0.9), DVec3::X);
        let roots = Superellipsoid::new(e, e).crossings(&ray, RootRange::ALL);
        assert!((roots[0].t - 2.0).abs() < 1e-3 && (roots[1].t - 4.0).abs() < 1e-3);
    }
}

#[test]
fn a_ray_past_the_hollow_side_of_a_star_passes_two_arms() {
    let star = Superellipsoid::new(4.0, 1.0);
    let ray = Ray::new(DVec3::new(-2.0, 0.1, 0.0), DVec3::X);
    assert_eq!(star.crossings(&ray, RootRange::ALL).len(), 2);
    let across = Ray::new(DVec3::new(-0.5, 1.3, 0.0), DVec3::new(1.0, -1.0, 0.0));
    assert_eq!(star.crossings(&across, RootRange::ALL).len(), 4);
}

#[test]
fn exponents_below_zero_make_open_surfaces() {
    let mut args = TextArgs::new("<-1, 1>");
    let open = Superellipsoid::read(&mut args).unwrap();
    assert_eq!(args.warnings().len(), 1);
    // The norm is 1 where |z| is, next to both planes of symmetry; in between it is 1 within the box.
    let ray = Ray::new(DVec3::new(0.7, 0.7, -3.0), DVec3::Z);
    let roots = open.crossings(&ray, RootRange::ALL);
    let z = (1.0 - 0.245_f64).sqrt();
    assert!((roots[0].t - (3.0 - z)).abs() < 1e-12 && roots[0].is_visible);
    assert!((roots[1].t - (3.0 + z)).abs() < 1e-12 && roots[1].is_visible);
    // Along the plane y = 0 it is |z|, so that only the box ends what is inside.
    let along = Ray::new(DVec3::new(-3.0, 0.0, 0.5), DVec3::X);
    let roots = open.crossings(&along, RootRange::ALL);
    assert_eq!(roots.len(), 2);
    assert!(roots.iter().all(|root| !root.is_visible));
    let none = Superellipsoid::new(1.0, -0.5);
    assert!(
        none.crossings(&ray, RootRange::ALL)
            .iter()
            .all(|root| !root.is_visible)
    );
    let zero = Superellipsoid::read(&mut TextArgs::new("<-0.0, 1>")).unwrap();
    assert_eq!(zero, Superellipsoid::new(0.0, 1.0));
}

/// Crossings of a line with the surface, in full precision alone.
fn exact_roots(shape: &Superellipsoid, ray: &Ray) -> Vec<f64> {
    let Some((from, to)) = clip(ray, 1.0) else {
        return Vec::new();
    };
    let middle = 0.5 * (from + to);
    let ray = Ray::new(ray.at(middle), ray.dir);
    let (from, to) = (from - middle, to - middle);
    let mut stops: Vec<f64> = (0..3).map(|i| -ray.origin[i] / ray.dir[i]).collect();
    stops.retain(|t| from < *t && *t < to);
    stops.push(to);
    stops.sort_by(f64::total_cmp);
    let along = Along { shape, ray };
    let (mut params, mut start) = (Roots::new(), (from, false));
    for stop in stops {
        let end = (stop, stop < to && along.value(stop) < 0.0);
        sign_changes(&along, [start, end].map(exact::end), &mut params);
        start = end;
    }
    params.iter().map(|t| t + middle).collect()
}

#[test]
fn rough_powers_lose_no_root_and_no_digit() {
    let mut rng = Random::new(23);
    for (e, n) in [
        (0.3, 0.25),
        (0.5, 1.0),
        (1.0, 2.0),
        (2.0, 0.3),
        (0.1, 1.7),
        (0.3, 3.0),
        (3.0, 0.5),
        (3.0, 3.0),
        (1.5, 4.0),
        (0.01, 30.0),
    ] {
        let shape = Superellipsoid::new(e, n);
        let mut count = 0;
        for _ in 0..1000 {
            let away = rng.vector(3.0);
            let ray = Ray::new(rng.vector(1.0) + away, -away);
            let roots = shape.crossings(&ray, RootRange::ALL);
            let exact = exact_roots(&shape, &ray);
            count += roots.len();
            if roots.len() == exact.len() {
                for (root, t) in roots.iter().zip(&exact) {
                    let size = (1.0 - shape.size(ray.at(root.t).abs())).abs();
                    let is_near = (root.t - t).abs() < 1e-9 || size < 4e-15;
                    assert!(is_near, "<{e}, {n}> {ray:?}: {} {t}", root.t);
                }
            } else {
                // Only for a grazing line may the two disagree.
                let own: Vec<f64> = roots.iter().map(|root| root.t).collect();
                let more = if own.len() > exact.len() { own } else { exact };
                let is_close = |pair: &[f64]| pair[1] - pair[0] < 1e-6;
                let is_touch = more.windows(2).any(is_close);
                assert!(is_touch, "<{e}, {n}> {ray:?}: {more:?}");
            }
        }
        assert!(count > 200, "<{e}, {n}>: {count}");
    }
}
