#[cfg(test)]
pub(crate) mod check;
#[cfg(test)]
pub(super) mod oracle;
#[cfg(test)]
pub(super) mod roundings;

use super::*;
use crate::base::args::text::TextArgs;
use crate::base::math::sampling::random::Random;
use crate::base::word::Class;

fn read(word: Word, text: &str) -> (Shape, TextArgs) {
    let mut args = TextArgs::new(text);
    let shape = Shape::read(word, &mut args).unwrap().unwrap();
    (shape, args)
}

#[test]
fn every_word_of_the_list_is_a_shape_of_the_grammar() {
    for word in Shape::WORDS {
        assert_eq!(word.class(), Class::Shape);
    }
}

#[test]
fn a_shape_reads_its_parameters_and_stops() {
    for (word, text) in [
        (Word::Sphere, "<1,2,3>, 4"),
        (Word::Sphere, "1 4"),
        (Word::Box, "-1, 1"),
        (Word::Cylinder, "<0,0,0>, <0,1,0>, 1"),
        (Word::Cylinder, "<0,0,0> <0,1,0> 1 open"),
        (Word::Cone, "<0,0,0>, 1, <0,1,0>, 0"),
        (Word::Cone, "<0,0,0> 1 <0,1,0> 0 open"),
        (Word::Torus, "1, .3"),
        (Word::Torus, "1 .3 sturm"),
        (Word::Plane, "<0,1,0>, -1"),
        (Word::Disc, "<0,0,0>, <0,1,0>, 1"),
        (Word::Disc, "<0,0,0> <0,1,0> 1 .5"),
        (Word::Triangle, "<0,0,0>, <0,1,0>, <1,0,0>"),
        (Word::Quadric, "<1,1,1>, <0,0,0>, <0,0,0>, -1"),
        (Word::Blob, "threshold .5 sphere { <0,0,0>, 1, 1 }"),
        (Word::Superellipsoid, "<.5, .5>"),
        (Word::Prism, "-1, 1, 4, <0,0>, <1,0>, <0,1>, <0,0>"),
        (
            Word::Prism,
            "conic_sweep 0 1 4 <0,0> <1,0> <0,1> <0,0> open",
        ),
        (Word::Lathe, "2, <.5,-1>, <1,0>"),
        (Word::Sor, "4, <1,-2>, <1,-1>, <1,1>, <1,2>"),
        (Word::Sor, "4 <1,-2> <1,-1> <1,1> <1,2> open"),
        (Word::Polygon, "4, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,0>"),
        (Word::Poly, "2, <1,0,0,0,1,0,0,1,0,-1>"),
        (Word::Ovus, "1, .5"),
        (
            Word::SmoothTriangle,
            "<0,0,0>, <0,0,1>, <0,1,0>, <0,0,1>, <1,0,0>, <0,0,1>",
        ),
    ] {
        let (shape, args) = read(word, text);
        assert_eq!(shape.word(), word);
        assert!(args.is_done(), "{text}");
        assert!(args.warnings().is_empty());
        assert!(!shape.bounds().is_empty());
        let (_, mut args) = read(word, &format!("{text} rotate"));
        assert!(args.accept(Word::Rotate).unwrap());
    }
}

#[test]
fn a_word_of_no_shape_reads_nothing() {
    assert!(Shape::read(Word::Union, &mut TextArgs::new("")).is_none());
}

#[test]
fn a_missing_parameter_is_an_error() {
    for word in Shape::WORDS {
        let result = Shape::read(*word, &mut TextArgs::new("<0,0,0>, <0,1,0>")).unwrap();
        let takes_vectors_only =
            matches!(word, Word::Box | Word::Superellipsoid | Word::JuliaFractal);
        assert_eq!(result.is_ok(), takes_vectors_only, "{word:?}");
    }
}

/// Shapes that rays leave for good.
const EXITED: [(Word, &str); 12] = [
    (Word::Sphere, "<1,2,3>, 4"),
    (Word::Box, "<-1,-2,0.3>, <1,0.5,0.4>"),
    (Word::Cylinder, "<0,-1,0.5>, <0.3,1,0>, 0.4"),
    (Word::Cone, "<0,0,0.1>, 1, <0.2,1,0>, 0.3"),
    (Word::Cone, "<0,0,0>, 0, <0,2,0>, 0.7"),
    (Word::Cone, "<0,0,0>, 1, <0,1,0>, -0.5"),
    (Word::Plane, "<0.3,1,0.2>, -1"),
    (Word::Torus, "1, .3"),
    (
        Word::Blob,
        "threshold .4 sphere { <0,0,0>, 1, 1 } sphere { <.5,.2,0>, 1, 1 }",
    ),
    (Word::Superellipsoid, "<.5, .3>"),
    (Word::Superellipsoid, "<2, 1.1>"),
    (
        Word::Blob,
        "threshold .5 sphere { <0,0,0>, 2, 1 } sphere { <0,2,0>, .3, 2 }",
    ),
];

#[test]
fn an_exited_convex_shape_is_not_entered_again() {
    let mut rng = Random::new(19);
    for (word, text) in EXITED {
        let (mut shape, _) = read(word, text);
        shape.prepare();
        let (mut left, mut roots) = (0, Vec::new());
        for _ in 0..2000 {
            let aim = rng.vector(1.0);
            let away = rng.vector(4.0);
            roots.clear();
            shape.roots(&Ray::new(aim + away, -away), &mut roots);
            for Root { t, face, .. } in roots.clone() {
                let point = (aim + away) - t * away;
                let out = Ray::new(point, rng.vector(1.0));
                if shape.normal(point, face).dot(out.dir) <= 0.0 || !shape.is_exiting(&out) {
                    continue;
                }
                left += 1;
                roots.clear();
                shape.roots(&out, &mut roots);
                let enters = |root: &Root| root.crossing == Crossing::Enter && root.t > 1e-9;
                assert!(!roots.iter().any(enters), "{word:?} {text}: {out:?}");
            }
        }
        let is_hourglass = text.ends_with("-0.5");
        assert_eq!(left > 200, !is_hourglass, "{word:?} {text}: {left}");
    }
}

#[test]
fn rays_between_rays_that_exit_do_so_too() {
    let mut rng = Random::new(23);
    let mut between = 0;
    for (word, text) in EXITED {
        let (mut shape, _) = read(word, text);
        shape.prepare();
        if !shape.exits_in_cones() {
            continue;
        }
        let mut roots = Vec::new();
        for _ in 0..2000 {
            let (aim, away) = (rng.vector(1.0), rng.vector(4.0));
            roots.clear();
            shape.roots(&Ray::new(aim + away, -away), &mut roots);
            let Some(&Root { t, face, .. }) = roots.first() else {
                continue;
            };
            let point = (aim + away) - t * away;
            let normal = shape.normal(point, face).normalize();
            let middle = rng.vector(1.0);
            let [across, up] = [rng.vector(0.7), rng.vector(0.7)];
            let corners = [across + up, across - up, up - across, -across - up];
            let exits = |offset: DVec3| {
                let dir = middle + offset;
                normal.dot(dir) > 1e-3 * dir.length() && shape.is_exiting(&Ray::new(point, dir))
            };
            if !corners.into_iter().all(exits) {
                continue;
            }
            let inner = rng.vector(1.0);
            let ray = Ray::new(point, middle + inner.x * across + inner.y * up);
            between += 1;
            roots.clear();
            shape.roots(&ray, &mut roots);
            let enters = |root: &Root| root.crossing == Crossing::Enter && root.t > 1e-9;
            assert!(!roots.iter().any(enters), "{word:?} {text}: {ray:?}");
        }
    }
    assert!(between > 1_000, "{between}");
    for (word, text) in [EXITED[8], EXITED[11], (Word::Superellipsoid, "<3, 1.1>")] {
        assert!(!read(word, text).0.exits_in_cones(), "{word:?} {text}");
    }
}
