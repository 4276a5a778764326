//! Distance of computed roots from the surface, for all shapes, in roundings of the problem's size: `|O| + |t·D|`, by
//! coordinates, and the size of the shape. Rays come from 3 to 10⁹ times that size and from the surface; the distance
//! of the point from the surface is computed from the definition of the shape, in doubles too, so its own few roundings
//! are included.
//!
//! `oracle` and `tests/stability` test spheres, tori and quadrics in exact or extended arithmetic.

use crate::base::args::Word;
use crate::base::args::text::TextArgs;
use crate::base::math::Ray;
use crate::base::math::sampling::random::Random;
use crate::scene::shape::{Geometry, Shape};
use glam::{DVec2, DVec3};

/// Rays per distance.
const RAYS: usize = 2000;

/// The largest distance of a root from the surface, in roundings.
fn worst(word: Word, text: &str, off: impl Fn(DVec3, u32) -> f64) -> f64 {
    let shape = Shape::read(word, &mut TextArgs::new(text))
        .unwrap()
        .unwrap();
    let mut shape = shape;
    shape.prepare();
    let bounds = shape.bounds();
    let size = bounds
        .min
        .abs()
        .max(bounds.max.abs())
        .element_sum()
        .min(10.0);
    let mut rng = Random::new(31);
    let (mut worst, mut hits) = (0.0, 0);
    for distance in [3.0, 1e3, 1e6, 1e9] {
        for _ in 0..RAYS {
            let aim = bounds.centre() + rng.vector(0.5 * size);
            let aim = if aim.is_finite() {
                aim
            } else {
                rng.vector(3.0)
            };
            let away = rng.vector(1.0).normalize() * distance * size;
            let ray = Ray::new(aim + away, -away.normalize());
            let mut roots = Vec::new();
            shape.roots(&ray, &mut roots);
            for root in &roots {
                let reach = (ray.origin.abs() + root.t.abs() * ray.dir.abs()).element_sum() + size;
                let off = off(ray.at(root.t), root.face).abs();
                worst = f64::max(worst, off / (f64::EPSILON * reach));
            }
            hits += roots.len();
        }
    }
    assert!(hits > RAYS / 2, "{word:?}: only {hits} hits");
    worst
}

fn around_y(p: DVec3) -> DVec2 {
    DVec2::new(p.x.hypot(p.z), p.y)
}

/// Signed distance from a line through two points of the plane.
fn from_line(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    (b - a).normalize().perp_dot(p - a)
}

#[test]
fn roots_lie_within_their_error_bounds() {
    let measured = [
        (
            "box",
            2.0,
            worst(Word::Box, "<-1,-2,-0.5>, <1,0.3,2>", |p, _| {
                let (low, high) = (DVec3::new(-1.0, -2.0, -0.5), DVec3::new(1.0, 0.3, 2.0));
                (p - low).abs().min((p - high).abs()).min_element()
            }),
        ),
        (
            "plane",
            2.0,
            worst(Word::Plane, "<1,2,3>, 0.7", |p, _| {
                DVec3::new(1.0, 2.0, 3.0).normalize().dot(p) - 0.7
            }),
        ),
        (
            "disc",
            2.0,
            worst(Word::Disc, "<0.1,0.2,0.3>, <1,2,3>, 1.5, 0.2", |p, _| {
                let normal = DVec3::new(1.0, 2.0, 3.0).normalize();
                normal.dot(p - DVec3::new(0.1, 0.2, 0.3))
            }),
        ),
        (
            "triangle",
            2.0,
            worst(
                Word::Triangle,
                "<-2,-1,0.3>, <2,-1,0>, <0,2,-0.4>",
                |p, _| {
                    let (a, b, c) = (
                        DVec3::new(-2.0, -1.0, 0.3),
                        DVec3::new(2.0, -1.0, 0.0),
                        DVec3::new(0.0, 2.0, -0.4),
                    );
                    (b - a).cross(c - a).normalize().dot(p - a)
                },
            ),
        ),
        (
            "cylinder",
            2.0,
            worst(Word::Cylinder, "<0,-1,0>, <0,2,0>, 0.7", |p, _| {
                let p = around_y(p);
                let caps = (p.y + 1.0).abs().min((p.y - 2.0).abs());
                (p.x - 0.7).abs().min(caps)
            }),
        ),
        (
            "cone",
            2.0,
            worst(Word::Cone, "<0,-1,0>, 0.9, <0,2,0>, 0.2", |p, _| {
                let p = around_y(p);
                let caps = (p.y + 1.0).abs().min((p.y - 2.0).abs());
                let side = from_line(p, DVec2::new(0.9, -1.0), DVec2::new(0.2, 2.0));
                side.abs().min(caps)
            }),
        ),
        (
            "superellipsoid",
            2.0,
            worst(Word::Superellipsoid, "<0.4, 0.7>", |p, _| {
                let (p2, q2) = (2.0 / 0.4, 2.0 / 0.7);
                let flat = (p.x.abs().powf(p2) + p.y.abs().powf(p2)).powf(q2 / p2);
                (flat + p.z.abs().powf(q2)).powf(1.0 / q2) - 1.0
            }),
        ),
        (
            "ovus",
            2.0,
            worst(Word::Ovus, "1, 0.6", |p, _| {
                let (height, bow) = (2.0 * 0.6 - 1.0 - 0.5 * 0.36, 2.0);
                let middle = DVec2::new(-f64::sqrt(1.0 - height * height), height);
                let p = around_y(p);
                let bottom = p.length() - 1.0;
                let top = (p - DVec2::Y).length() - 0.6;
                let arc = (p - middle).length() - bow;
                bottom.abs().min(top.abs()).min(arc.abs())
            }),
        ),
        (
            "sor",
            2.0,
            worst(
                Word::Sor,
                "6, <0.5,-1>, <0.8,-0.5>, <0.6,0>, <0.9,0.5>, <0.5,1>, <0.3,1.5>",
                |p, face| match face {
                    1 => p.y + 0.5,
                    2 => p.y - 1.0,
                    _ => sor(around_y(p)),
                },
            ),
        ),
        (
            "lathe",
            2.0,
            worst(
                Word::Lathe,
                "linear_spline 4, <0.2,-1>, <1,0>, <0.5,1>, <0.1,1.5>",
                |p, _| {
                    let p = around_y(p);
                    let points = [(0.2, -1.0), (1.0, 0.0), (0.5, 1.0), (0.1, 1.5)].map(DVec2::from);
                    let lines = points
                        .windows(2)
                        .map(|pair| from_line(p, pair[0], pair[1]).abs());
                    let ends = [(p.y + 1.0).abs(), (p.y - 1.5).abs()];
                    // The pieces that close the open ends are not visible.
                    lines
                        .chain(ends)
                        .chain([(p.x - 0.2).abs(), (p.x - 0.1).abs()])
                        .fold(f64::INFINITY, f64::min)
                },
            ),
        ),
        (
            "prism",
            2.0,
            worst(
                Word::Prism,
                "-1, 1.5, 5, <-1,-1>, <1.2,-0.7>, <0.8,1>, <-0.9,0.8>, <-1,-1>",
                |p, _| {
                    let corners = [
                        (-1.0, -1.0),
                        (1.2, -0.7),
                        (0.8, 1.0),
                        (-0.9, 0.8),
                        (-1.0, -1.0),
                    ];
                    let corners = corners.map(DVec2::from);
                    let flat = DVec2::new(p.x, p.z);
                    let sides = corners
                        .windows(2)
                        .map(|pair| from_line(flat, pair[0], pair[1]).abs());
                    sides
                        .chain([(p.y + 1.0).abs(), (p.y - 1.5).abs()])
                        .fold(f64::INFINITY, f64::min)
                },
            ),
        ),
        (
            "polygon",
            2.0,
            worst(
                Word::Polygon,
                "5, <-1,-1,0>, <1,-1,1>, <1,1,1>, <-1,1,0>, <-1,-1,0>",
                |p, _| {
                    DVec3::new(-1.0, 0.0, 2.0)
                        .normalize()
                        .dot(p - DVec3::new(1.0, 0.0, 1.0))
                },
            ),
        ),
        (
            "blob",
            2.0,
            worst(
                Word::Blob,
                "threshold 0.4 sphere { <-0.4,0,0>, 1, 1 } sphere { <0.5,0.2,0>, 0.9, 0.8 }",
                |p, _| {
                    let parts = [
                        (DVec3::new(-0.4, 0.0, 0.0), 1.0, 1.0),
                        (DVec3::new(0.5, 0.2, 0.0), 0.9, 0.8),
                    ];
                    let (mut field, mut slope) = (-0.4, DVec3::ZERO);
                    for (centre, radius, strength) in parts {
                        let from = p - centre;
                        let left = 1.0 - from.length_squared() / (radius * radius);
                        if left > 0.0 {
                            field += strength * left * left;
                            slope += -4.0 * strength * left / (radius * radius) * from;
                        }
                    }
                    field / slope.length()
                },
            ),
        ),
        (
            "sphere sweep",
            2.0,
            worst(
                Word::SphereSweep,
                "linear_spline 2, <-1,0,0>, 0.5, <1,0.5,0.2>, 0.3",
                |p, _| {
                    let (a, axis) = (DVec3::new(-1.0, 0.0, 0.0), DVec3::new(2.0, 0.5, 0.2));
                    // The cone tangent to both spheres.
                    let length = axis.length();
                    let (along, sine) = ((p - a).dot(axis) / length, 0.2 / length);
                    let across = ((p - a) - along * axis / length).length();
                    let cosine = (1.0 - sine * sine).sqrt();
                    let param = ((along - across * sine / cosine) / length).clamp(0.0, 1.0);
                    (p - a - param * axis).length() - (0.5 - 0.2 * param)
                },
            ),
        ),
        (
            "quartic torus",
            2.0,
            worst(Word::Quartic, QUARTIC_TORUS, |p, _| {
                let flat = around_y(p);
                (flat - DVec2::X).length() - 0.25
            }),
        ),
    ];
    let too_far: Vec<_> = measured
        .iter()
        .filter(|(_, bound, worst)| worst > bound)
        .collect();
    assert!(too_far.is_empty(), "{too_far:.2?} of {measured:.2?}");
}

/// Radii 1 and 0.25.
const QUARTIC_TORUS: &str = "<1,0,0,0,2,0,0,2,0,-2.125,0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,1.875,0,0,0,0,1,0,-2.125,0,0.87890625>";

/// First-order distance in the half-plane from the side of the surface of revolution above.
fn sor(p: DVec2) -> f64 {
    let points = [
        (0.5, -1.0),
        (0.8, -0.5),
        (0.6, 0.0),
        (0.9, 0.5),
        (0.5, 1.0),
        (0.3, 1.5),
    ]
    .map(DVec2::from);
    let ring = points
        .windows(4)
        .find(|quad| p.y <= quad[2].y)
        .unwrap_or(&points[2..]);
    let slope = |before: DVec2, here: DVec2, after: DVec2| {
        2.0 * here.x * (after.x - before.x) / (after.y - before.y)
    };
    let width = ring[2].y - ring[1].y;
    let x = (p.y - ring[1].y) / width;
    let (a, b) = (ring[1].x * ring[1].x, ring[2].x * ring[2].x);
    let (s, e) = (
        slope(ring[0], ring[1], ring[2]) * width,
        slope(ring[1], ring[2], ring[3]) * width,
    );
    // Hermite's cubic.
    let (c2, c3) = (3.0 * (b - a) - 2.0 * s - e, 2.0 * (a - b) + s + e);
    let square = a + x * (s + x * (c2 + x * c3));
    let rise = (s + x * (2.0 * c2 + x * 3.0 * c3)) / width;
    (square - p.x * p.x) / (2.0 * p.x).hypot(rise)
}
