use super::*;
use crate::base::args::text::TextArgs;
use crate::scene::shape::tests::check;
use crate::scene::shape::{Quadric, Spindle, Torus};

fn poly(order: usize, terms: &[([usize; 3], f64)]) -> Poly {
    let mut c = Vec::new();
    for i in (0..=order).rev() {
        for j in (0..=order - i).rev() {
            for k in (0..=order - i - j).rev() {
                let term = terms.iter().find(|term| term.0 == [i, j, k]);
                c.push(term.map_or(0.0, |term| term.1));
            }
        }
    }
    Poly(Arc::new(Polynomial::new(order, c)))
}

fn text_of(shape: &Poly) -> String {
    let list: Vec<String> = shape.0.c.iter().map(f64::to_string).collect();
    list.join(",")
}

/// `(x² + y² + z² + R² − r²)² − 4R²(x² + z²)`.
fn torus(major: f64, minor: f64) -> Poly {
    let k = major * major - minor * minor;
    let across = 2.0 * k - 4.0 * major * major;
    poly(
        4,
        &[
            ([4, 0, 0], 1.0),
            ([0, 4, 0], 1.0),
            ([0, 0, 4], 1.0),
            ([2, 2, 0], 2.0),
            ([2, 0, 2], 2.0),
            ([0, 2, 2], 2.0),
            ([2, 0, 0], across),
            ([0, 2, 0], 2.0 * k),
            ([0, 0, 2], across),
            ([0, 0, 0], k * k),
        ],
    )
}

#[test]
fn coefficients_are_ordered_by_falling_powers() {
    let names: Vec<usize> = powers_of(2).map(|powers| powers.iter().sum()).collect();
    assert_eq!(names, [2, 2, 2, 1, 2, 2, 1, 2, 1, 0]);
    let mut args = TextArgs::new("2, <1,0,0,0,1,0,0,1,0,-1> sturm");
    let sphere = Poly::read(&mut args).unwrap();
    let p = DVec3::new(0.5, 2.0, -3.0);
    assert_eq!(sphere.0.value(p), p.length_squared() - 1.0);
    assert_eq!(sphere.0.gradient(p), 2.0 * p);
}

/// The surface of larger values, for which POV-Ray's tolerance hardly matters.
fn steep(shape: &Poly) -> Poly {
    let c = shape.0.c.iter().map(|c| f64::from(1 << 20) * c).collect();
    Poly(Arc::new(Polynomial::new(shape.0.order, c)))
}

#[test]
fn surfaces_with_and_without_bounds_have_roots_in_order() {
    check::half_space(&steep(&torus(1.0, 0.4)));
    check::half_space(&steep(&poly(
        3,
        &[([3, 0, 0], 1.0), ([0, 1, 0], -1.0), ([0, 0, 2], 0.5)],
    )));
    check::half_space(&steep(&poly(
        5,
        &[
            ([5, 0, 0], 1.0),
            ([0, 4, 0], 1.0),
            ([0, 0, 5], -1.0),
            ([0, 0, 0], -0.5),
        ],
    )));
    check::half_space(&steep(&poly(
        8,
        &[
            ([8, 0, 0], 1.0),
            ([0, 8, 0], 1.0),
            ([0, 0, 8], 1.0),
            ([0, 0, 0], -1.0),
        ],
    )));
    check::half_space(&steep(&poly(2, &[([0, 0, 1], 1.0), ([0, 0, 0], -0.5)])));
}

#[test]
fn the_quartic_of_a_torus_has_the_roots_of_a_torus() {
    let (quartic, ring) = (
        torus(1.0, 0.3),
        Torus {
            centre: DVec3::ZERO,
            major: 1.0,
            minor: 0.3,
            spindle: Spindle::default(),
        },
    );
    let mut rng = check::Random::new(41);
    let mut hits = 0;
    for i in 0..3000 {
        let far = [3.0, 1e3, 1e6][i % 3];
        let aim = rng.vector(1.2);
        let away = rng.vector(1.0).normalize();
        let ray = Ray::new(aim + away * far, -away);
        let (mut a, mut b) = (Vec::new(), Vec::new());
        assert_eq!(quartic.roots(&ray, &mut a), Start::Outside);
        ring.roots(&ray, &mut b);
        hits += b.len();
        // Rounding of the coefficients may lose or create a grazing pair.
        let is_grazing = |roots: &[Root]| roots.windows(2).any(|p| p[1].t - p[0].t < 1e-4);
        if is_grazing(&a) || is_grazing(&b) {
            continue;
        }
        assert_eq!(a.len(), b.len(), "{ray:?}: {a:?} {b:?}");
        for (a, b) in a.iter().zip(&b) {
            assert!(
                (a.t - b.t).abs() < 1e-9 + 4.0 * f64::EPSILON * far,
                "{ray:?}: {a:?} {b:?}"
            );
            assert_eq!(a.crossing, b.crossing);
        }
    }
    assert!(hits > 1000);
}

#[test]
fn order_two_is_a_quadric() {
    let mut args = TextArgs::new("<1,2,-0.5>, <0.3,-0.2,0.4>, <-2,1,0.5>, -1");
    let quadric = Quadric::read(&mut args).unwrap();
    let same = poly(
        2,
        &[
            ([2, 0, 0], 1.0),
            ([0, 2, 0], 2.0),
            ([0, 0, 2], -0.5),
            ([1, 1, 0], 0.3),
            ([1, 0, 1], -0.2),
            ([0, 1, 1], 0.4),
            ([1, 0, 0], -2.0),
            ([0, 1, 0], 1.0),
            ([0, 0, 1], 0.5),
            ([0, 0, 0], -1.0),
        ],
    );
    let mut rng = check::Random::new(42);
    for _ in 0..2000 {
        let ray = Ray::new(rng.vector(5.0), rng.vector(1.0));
        let (mut a, mut b) = (Vec::new(), Vec::new());
        assert_eq!(same.roots(&ray, &mut a), quadric.roots(&ray, &mut b));
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(&b) {
            assert!(
                (a.t - b.t).abs() < 1e-10 * b.t.abs().max(1.0),
                "{ray:?}: {a:?} {b:?}"
            );
        }
    }
}

#[test]
fn the_largest_order_is_read_and_drawn() {
    let even = poly(
        34,
        &[
            ([34, 0, 0], 1.0),
            ([0, 34, 0], 1.0),
            ([0, 0, 34], 1.0),
            ([0, 0, 0], -1.0),
        ],
    );
    let ray = Ray::new(DVec3::new(-4.0, 0.3, 0.2), DVec3::X);
    let (start, roots) = even.0.crossings(&ray);
    assert_eq!(start, Start::Outside);
    assert!((roots[0].t - 3.0).abs() < 1e-12 && (roots[1].t - 5.0).abs() < 1e-12);
    let odd = poly(35, &[([35, 0, 0], 1.0), ([0, 0, 0], -1.0)]);
    let text = format!("35, <{}>", text_of(&odd));
    let read = Poly::read(&mut TextArgs::new(&text)).unwrap();
    let (start, roots) = read.0.crossings(&ray);
    assert_eq!(start, Start::Inside);
    assert!(roots.len() == 1 && (roots[0].t - 5.0).abs() < 1e-12);
}

#[test]
fn orders_and_counts_out_of_range_are_errors() {
    for (text, expected) in [
        (
            "1, <1,0,0,0>",
            "the order of a poly is between 2 and 35, found 1",
        ),
        (
            "36, <1,0,0,0>",
            "the order of a poly is between 2 and 35, found 36",
        ),
        (
            "2, <1,0,0,0,1,0,0,1,0>",
            "expected 10 coefficients between `<` and `>`, found `>`",
        ),
        (
            "2, <1,0,0,0,1,0,0,1,0,-1,3>",
            "expected `>` after 10 coefficients, found `,`",
        ),
    ] {
        assert_eq!(
            Poly::read(&mut TextArgs::new(text)).unwrap_err().message,
            expected
        );
    }
    assert!(Poly::read_cubic(&mut TextArgs::new("1")).is_err());
}

#[test]
fn nothing_but_zeros_is_solid_and_has_no_surface() {
    let zero = poly(4, &[]);
    let (start, roots) = zero.0.crossings(&Ray::new(DVec3::ZERO, DVec3::X));
    assert!(start == Start::Inside && roots.is_empty());
}

#[test]
fn roots_one_size_from_the_foot_of_the_perpendicular_are_not_lost() {
    let squares = |order, rest: f64| {
        poly(
            order,
            &[
                ([2, 0, 0], 1.0),
                ([0, 2, 0], 1.0),
                ([0, 0, 2], 1.0),
                ([0, 0, 0], rest),
            ],
        )
    };
    for sphere in [
        squares(2, -1.0),
        squares(3, -1.0),
        squares(4, -1.0),
        squares(2, -4.0),
        squares(7, -4.0),
    ] {
        let radius = sphere.0.size;
        for dir in [DVec3::Z, -DVec3::Z, 2.0 * DVec3::X, DVec3::NEG_Y] {
            let (start, roots) = sphere.0.crossings(&Ray::new(-4.0 * dir.normalize(), dir));
            let expected = [4.0 - radius, 4.0 + radius].map(|t| t / dir.length());
            assert_eq!(start, Start::Outside);
            assert_eq!(
                roots.iter().map(|root| root.t).collect::<Vec<_>>(),
                expected
            );
        }
        // The complement of the sphere.
        let hole = Poly(Arc::new(Polynomial::new(
            sphere.0.order,
            sphere.0.c.iter().map(|c| -c).collect(),
        )));
        let (start, roots) = hole.0.crossings(&Ray::new(-4.0 * DVec3::Z, DVec3::Z));
        assert_eq!((start, roots.len()), (Start::Inside, 2));
    }
}

#[test]
fn a_plane_one_size_away_is_hit_exactly() {
    for (slope, rest) in [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)] {
        let plane = poly(2, &[([0, 0, 1], slope), ([0, 0, 0], rest)]);
        let (_, roots) = plane
            .0
            .crossings(&Ray::new(DVec3::new(0.0, 0.0, -4.0), DVec3::Z));
        assert_eq!(roots.len(), 1);
        assert_eq!(roots[0].t, 4.0 - rest / slope, "{slope} {rest}");
    }
}
