use super::*;
use crate::base::args::text::TextArgs;
use crate::base::math::sampling::random::Random;
use crate::scene::shape::Crossing;
use crate::scene::shape::tests::check;

fn blob(text: &str) -> Blob {
    let mut args = TextArgs::new(text);
    let blob = Blob::read(&mut args).unwrap();
    assert!(args.is_done());
    blob
}

const PAIR: &str =
    "threshold 0.5 sphere { <-0.5,0,0>, 1, 1 } sphere { <0.5,0.1,0>, 0.9, strength 1.2 }";
const MIXED: &str = "threshold .3 sphere { <-.5,0,0>, 1, 1 } cylinder { <-.5,-.3,.1>, <1,.5,.2>, .6, 1 }
    sphere { <.2,.4,0>, .7, -1.5 } sphere { <0,0,0>, 0.5, 1 scale <1,2,0.5> rotate <10,20,30> translate <.1,-.6,.3> }";

/// The blob of larger fields, for which POV-Ray's tolerance hardly matters.
fn steep(blob: &Blob) -> Blob {
    let factor = f64::from(1 << 20);
    let mut components = blob.0.components.clone();
    for component in &mut components {
        component.strength *= factor;
    }
    Blob::new(components, Vec::new(), factor * blob.threshold())
}

#[test]
fn spheres_and_cylinders_make_a_solid() {
    check::solid(&steep(&blob(PAIR)));
    check::solid(&steep(&blob(MIXED)));
}

#[test]
fn many_components_are_visited_through_the_bvh() {
    let mut text = String::from("threshold 0.4");
    for i in 0..20 {
        let angle = 0.7 * f64::from(i);
        let (sin, cos) = angle.sin_cos();
        text += &format!(
            " sphere {{ <{cos},{sin},{}>, 0.4, 0.8 }}",
            0.1 * f64::from(i)
        );
    }
    let whole = blob(&text);
    assert!(whole.0.bvh.is_some());
    check::solid(&steep(&whole));
}

#[test]
fn skipped_parts_of_a_line_have_no_roots() {
    let mut rng = Random::new(41);
    let (mut hits, mut departures) = (0, 0);
    for round in 0..60 {
        let mut text = String::from("threshold 0.5");
        for _ in 0..3 + round % 20 {
            let DVec3 { x, y, z } = rng.vector(1.0);
            let (radius, strength) = (0.1 + 0.6 * rng.uniform(), 0.2 + rng.uniform());
            text += &format!(" sphere {{ <{x},{y},{z}>, {radius}, {strength} }}");
        }
        if round % 3 == 1 {
            text += " sphere { <.1,.2,.3>, .5, -1 } cylinder { <0,0,0>, <1,.5,0>, .4, .7 }";
        }
        let blob = blob(&text);
        let mut roots = Vec::new();
        for _ in 0..1000 {
            let ray = Ray::new(rng.vector(3.0), rng.vector(1.0));
            roots.clear();
            blob.roots(&ray, &mut roots);
            let from = 4.0 * rng.uniform() - 2.0;
            let to = from + 4.0 * rng.uniform();
            let first = first_visible(&roots, from, to);
            assert_eq!(blob.nearest(&ray, from, to), first, "{text}: {ray:?}");
            let mut later = Vec::new();
            blob.roots_from(&ray, from, to, &mut later);
            let [expected, found] = [&roots, &later].map(|roots| {
                let beyond = roots.iter().filter(|root| root.t > from);
                let enough = beyond.clone().filter(|root| root.t <= to).count() + 1;
                beyond.take(enough).copied().collect::<Vec<_>>()
            });
            assert_eq!(found, expected, "{text}: {ray:?}");
            for root in &roots {
                hits += 1;
                let out = Ray::new(ray.at(root.t), rng.vector(1.0));
                let leaves = blob.normal(out.origin, 0).dot(out.dir) > 0.0;
                let Some(departure) = blob.departure(&out).filter(|_| leaves) else {
                    continue;
                };
                departures += 1;
                let mut all = Vec::new();
                blob.roots(&out, &mut all);
                let early = all.iter().find(|root| 1e-9 < root.t && root.t <= departure);
                assert_eq!(early, None, "{text}: {out:?}");
            }
        }
    }
    assert!(hits > 4_000 && departures > 1_000, "{hits} {departures}");
}

#[test]
fn one_sphere_is_a_sphere() {
    let one = blob("threshold 0.25 sphere { <0,0,0>, 2, 1 }");
    let ray = Ray::new(DVec3::new(0.0, 0.0, -5.0), DVec3::Z);
    let expected = 2.0 * 0.5_f64.sqrt();
    let root = one.nearest(&ray, 0.0, f64::INFINITY).unwrap();
    assert!((root.t - (5.0 - expected)).abs() < 4e-15);
    assert_eq!(blob("threshold .25 component 1, 2, <0,0,0>").0, one.0);
}

#[test]
fn a_threshold_at_the_strength_leaves_nothing_and_a_negative_one_all_but_the_holes() {
    let nothing = blob("sphere { <0,0,0>, 1, 1 }");
    let ray = Ray::new(DVec3::new(0.0, 0.0, -5.0), DVec3::Z);
    assert_eq!(nothing.nearest(&ray, 0.0, f64::INFINITY), None);
    let hole = blob("threshold -.25 sphere { <0,0,0>, 1, -1 }");
    let mut roots = Vec::new();
    assert_eq!(hole.roots(&ray, &mut roots), Start::Inside);
    let crossings: Vec<_> = roots.iter().map(|root| root.crossing).collect();
    assert_eq!(crossings, [Crossing::Leave, Crossing::Enter]);
    assert!(hole.contains(DVec3::X * 9.0) && !hole.contains(DVec3::ZERO));
    assert_eq!(hole.solid_bounds(), Bounds::EVERYTHING);
}

#[test]
fn a_threshold_of_zero_shows_the_whole_extent_of_the_field() {
    let all = blob("threshold 0 sphere { <0,0,0>, 1, 1 } sphere { <.5,0,0>, 1, 1 }");
    let ray = Ray::new(DVec3::new(-4.0, 0.3, 0.0), DVec3::X);
    let mut roots = Vec::new();
    all.roots(&ray, &mut roots);
    let edge = 0.91_f64.sqrt();
    assert_eq!(roots.len(), 2);
    assert!((roots[0].t - (4.0 - edge)).abs() < 1e-6);
    assert!((roots[1].t - (4.5 + edge)).abs() < 1e-6);
}

#[test]
fn degenerate_cylinders_empty_blobs_and_object_modifiers_are_errors() {
    for (text, expected) in [
        (
            "cylinder { <1,1,1>, <1,1,1>, 1, 1 }",
            "degenerate cylindrical component in blob",
        ),
        ("threshold 1", "need at least one component in a blob"),
        (
            "sphere { <0,0,0>, 1, 1 no_shadow }",
            "expected a transform, a texture or `}` in a component of a blob, found `no_shadow`",
        ),
    ] {
        let error = Blob::read(&mut TextArgs::new(text)).unwrap_err();
        assert_eq!(error.message, expected);
    }
}

#[test]
fn negative_radii_count_as_positive_and_zero_is_nothing() {
    assert_eq!(
        blob("threshold .5 sphere { <0,0,0>, -1, 1 }").bounds(),
        blob("threshold .5 sphere { <0,0,0>, 1, 1 }").bounds()
    );
    let nothing = blob("threshold .5 sphere { <0,0,0>, 0, 1 }");
    assert!(nothing.bounds().is_empty());
    let ray = Ray::new(DVec3::new(0.0, 0.0, -5.0), DVec3::Z);
    assert_eq!(nothing.nearest(&ray, 0.0, f64::INFINITY), None);
}

/// POV-Ray 3.7 blends like this: a negative field weighs as much as a positive one.
#[test]
fn textures_of_components_are_weighted_by_their_fields() {
    let pair = blob(
        "threshold 0.2 sphere { <-0.5,0,0>, 1, 1 pigment { rgb 1 } }
        sphere { <0.5,0,0>, 1, -0.5 } sphere { <5,0,0>, 1, 1 finish { phong 1 } }",
    );
    assert_eq!(pair.face_textures().len(), 2);
    let shares = pair.texture_weights(DVec3::ZERO, 0);
    let shares: Vec<_> = shares
        .iter()
        .map(|share| (share.texture, share.weight))
        .collect();
    let expected = [(0, 2.0 / 3.0), (TextureWeight::OF_THE_OBJECT, 1.0 / 3.0)];
    assert_eq!(shares, expected);
    assert!(blob(PAIR).texture_weights(DVec3::ZERO, 0).is_empty());
}

#[test]
fn transforms_of_a_component_move_the_textures_before_them() {
    let text = "sphere { <0,0,0>, 1, 1 translate <1,0,0> pigment { checker } scale 2 }";
    let moved = blob(text);
    let steps = |texture: &crate::scene::texture::Texture| {
        let modifiers = texture.layers()[0].pigment.modifiers.get();
        modifiers.map(|modifiers| modifiers.chain.steps().to_vec())
    };
    assert_eq!(
        steps(&moved.face_textures()[0].0),
        Some(vec![Step::Scale(DVec3::splat(2.0))])
    );
}
