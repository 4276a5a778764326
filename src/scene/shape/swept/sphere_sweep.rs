//! `sphere_sweep { linear_spline | b_spline | cubic_spline  n, <centre>, radius, ... [tolerance x] }`: the volume swept
//! by a sphere whose centre and radius follow a curve.
//!
//! At the curve parameter `x` a ray is inside the sphere from `s₋(x)` to `s₊(x) = −b ± √d`, with `−b(x)` the distance
//! along the ray to the point nearest to the centre and `d(x)` the square of half the chord. Over an interval of `x`
//! with `d ≥ 0` the ray is in the sweep from the least `s₋` to the largest `s₊`, so enter and leave alternate by
//! construction. The extremes lie at the ends of the interval or where `d'² = 4·b'²·d`, of degree ten. POV-Ray solves
//! the same equation.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface (`shape/roundings.rs`, and
//! `tests/stability`, item 51, for cubic curves).
//!
//! In a difference POV-Ray 3.7 shows walls inside the sweep where two segments of the curve join; here there are none. Its
//! inside test is followed: see [`Part::contains`].
//!
//! Hits up to `tolerance` from the start of a ray do not count, as in POV-Ray.

use self::segment::{B_SPLINE, CATMULL_ROM, Part};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word, trailing_comma};
use crate::base::math::{Bounds, Ray, Step, Transform};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Geometry, Root, SpanEnd, Start, first_visible, read, span};
use glam::{DVec3, DVec4};
use smallvec::SmallVec;
use std::sync::Arc;

/// Maximum number of spheres of a sweep.
const MAX_SPHERES: f64 = 1e7;
/// Spans of a ray inside parts of the sweep, each end with the index of its part.
type Spans = SmallVec<[[SpanEnd; 2]; 4]>;

/// A sphere sweep. Copies share its parts.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereSweep(Arc<Sweep>);

#[derive(Clone, Debug)]
struct Sweep {
    parts: Vec<Part>,
    /// The spheres as POV-Ray bounds them, with twice the radius along a cubic curve.
    around: Box<[DVec4]>,
    /// BVH over the boxes of the parts.
    tree: Bvh,
    bounds: Bounds,
    /// Hits up to this distance are ignored, in units of the scene whatever the transforms; 0 unless it is written.
    tolerance: f64,
}

impl PartialEq for Sweep {
    /// The BVH follows from the parts.
    fn eq(&self, other: &Self) -> bool {
        self.parts == other.parts
            && self.bounds == other.bounds
            && self.tolerance == other.tolerance
    }
}

/// Interpolation of the curve between the spheres.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Linear,
    /// Approximates the spheres with continuous curvature.
    B,
    /// Interpolates all but the first and the last sphere, which only shape the ends.
    Cubic,
}

impl SphereSweep {
    /// Reads the kind of the curve and its spheres.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, an unknown kind, or too few spheres for it.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let kinds = [
            (Word::LinearSpline, Kind::Linear, 2),
            (Word::BSpline, Kind::B, 4),
            (Word::CubicSpline, Kind::Cubic, 4),
        ];
        let mut matched = None;
        for (word, kind, least) in kinds {
            if args.accept(word)? {
                matched = Some((word, kind, least));
            }
        }
        let Some((word, kind, least)) = matched else {
            let what = "`linear_spline`, `b_spline` or `cubic_spline` in `sphere_sweep`";
            return Err(args.expected(what));
        };
        args.comma()?;
        let at = args.span();
        let count = read::number(args, "the number of spheres")?.trunc();
        if count < f64::from(least) || count > MAX_SPHERES {
            let message = format!("a `{word}` needs at least {least} spheres, found {count}");
            return Err(Box::new(Diagnostic::error(
                at.to(args.last_span()),
                message,
            )));
        }
        let mut spheres = Vec::new();
        while (spheres.len() as f64) < count {
            let number = spheres.len() + 1;
            let centre = read::vector(args, &format!("centre {number} of the sphere sweep"))?;
            let radius = read::number(args, &format!("radius {number} of the sphere sweep"))?;
            spheres.push(centre.extend(radius));
        }
        trailing_comma(args)?;
        let mut sweep = Sweep::new(kind, &spheres);
        if args.accept(Word::Tolerance)? {
            sweep.tolerance = read::number(args, "the tolerance of the sphere sweep")?;
        }
        Ok(SphereSweep(Arc::new(sweep)))
    }

    /// Hits up to this distance are ignored, in units of the scene.
    pub(crate) fn tolerance(&self) -> f64 {
        self.0.tolerance
    }

    /// Disjoint spans of a ray inside the sweep, in order.
    fn spans(&self, ray: &Ray) -> Spans {
        let mut all = Spans::new();
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        self.0.tree.any(ray, from, to, |number| {
            self.0.parts[number as usize].spans(ray, number, &mut all);
            false
        });
        all.sort_unstable_by(|a, b| a[0].t.total_cmp(&b[0].t).then(a[0].face.cmp(&b[0].face)));
        let mut disjoint = Spans::new();
        for [enter, leave] in all {
            match disjoint.last_mut() {
                Some([_, last]) if enter.t <= last.t => {
                    if leave.t > last.t {
                        *last = leave;
                    }
                }
                _ => disjoint.push([enter, leave]),
            }
        }
        disjoint
    }
}

impl Sweep {
    fn new(kind: Kind, spheres: &[DVec4]) -> Self {
        let parts: Vec<Part> = match kind {
            Kind::Linear => spheres
                .windows(2)
                .map(|pair| Part::new(&[pair[0], pair[1] - pair[0]]))
                .collect(),
            Kind::B => spheres
                .windows(4)
                .map(|quad| Part::of(&B_SPLINE, quad))
                .collect(),
            Kind::Cubic => spheres
                .windows(4)
                .map(|quad| Part::of(&CATMULL_ROM, quad))
                .collect(),
        };
        let boxes: Vec<Bounds> = parts.iter().map(Part::bounds).collect();
        // Includes POV-Ray's box.
        let factor = if kind == Kind::Cubic { 2.0 } else { 1.0 };
        let widened = |sphere: &DVec4| sphere.truncate().extend(factor * sphere.w.abs());
        let around: Box<[DVec4]> = spheres.iter().map(widened).collect();
        let of_spheres = around.iter().map(|sphere| around_sphere(*sphere));
        let bounds = of_spheres.chain(boxes.iter().copied());
        let bounds = bounds.fold(Bounds::EMPTY, |sum, next| sum.union(&next));
        Sweep {
            tree: Bvh::build(&boxes),
            parts,
            around,
            bounds,
            tolerance: 0.0,
        }
    }
}

fn around_sphere(sphere: DVec4) -> Bounds {
    let (centre, radius) = (sphere.truncate(), DVec3::splat(sphere.w));
    Bounds::new(centre - radius, centre + radius)
}

impl Geometry for SphereSweep {
    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        for [enter, leave] in self.spans(ray) {
            roots.extend(span(enter, leave).into_iter().flatten());
        }
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let spans = self.spans(ray);
        let roots = spans
            .iter()
            .filter_map(|[enter, leave]| span(*enter, *leave));
        roots
            .into_iter()
            .find_map(|span| first_visible(&span, from, to))
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let part = &self.0.parts[face as usize];
        let x = part.deepest(point);
        (point - part.centre) / part.size - part.at(x).truncate()
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.tree.visit_containing(point, |number| {
            self.0.parts[number as usize].contains(point)
        })
    }

    fn may_miss_roots(&self) -> bool {
        self.0.parts.iter().any(Part::may_miss_points)
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    /// Moves the spheres themselves, up to the first uneven scaling or matrix (measured).
    fn povray_box_after(&self, steps: &[Step]) -> Option<(Bounds, usize)> {
        let moves_spheres = |step: &&Step| match step {
            Step::Translate(_) | Step::Rotate(_) => true,
            Step::Scale(by) => by.x == by.y && by.y == by.z,
            Step::General(_) => false,
        };
        let count = steps.iter().take_while(moves_spheres).count();
        let to_world = Transform::from_steps(&steps[..count]).world_from_object;
        let size: f64 = steps[..count].iter().fold(1.0, |size, step| match step {
            Step::Scale(by) => size * by.x.abs(),
            _ => size,
        });
        let moved = self.0.around.iter().map(|sphere| {
            let centre = to_world.transform_point3(sphere.truncate());
            around_sphere(centre.extend(size * sphere.w))
        });
        let bounds = moved.fold(Bounds::EMPTY, |sum, next| sum.union(&next));
        Some((bounds, count))
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

mod path;
mod segment;
#[cfg(test)]
mod tests;
