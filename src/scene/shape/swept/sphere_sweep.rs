//! `sphere_sweep { linear_spline | b_spline | cubic_spline  n, <centre>, radius, ... [tolerance x] }`: the space that a
//! sphere sweeps whose centre and radius follow a curve.
//!
//! At the parameter `x` of the curve a ray is in the sphere from `s₋(x)` to `s₊(x) = −b ± √d`, with `b(x)` the way of the
//! ray to the point nearest to the centre and `d(x)` the square of half the chord. Where `d ≥ 0` without a gap the ray is
//! in the sweep from the least `s₋` to the largest `s₊`, so enter and leave alternate by construction. The extremes lie
//! at the ends of the curve or where `d'² = 4·b'²·d`, of degree ten. POV-Ray solves the same equation.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface (`shape/roundings.rs`, and `tests/stability`,
//! item 51, for cubic curves).
//!
//! In a difference POV-Ray 3.7 shows walls inside the sweep where two pieces of a curve meet; here there are none.
//!
//! `tolerance`, by which POV-Ray drops hits near the start of a ray, is read and not needed.

mod part;
mod way;

use self::part::{B_SPLINE, CATMULL_ROM, Part};
use crate::base::accel::Bvh;
use crate::base::args::{Args, Parse, Word};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::{Geometry, Root, Start, first_visible, read, span};
use glam::{DVec3, DVec4};
use smallvec::SmallVec;
use std::sync::Arc;

/// Spheres of one sweep.
const MOST_SPHERES: f64 = 1e7;
/// Enter and leave of parts of the sweep on a ray, each with the number of the part.
type Spans = SmallVec<[[(f64, u32); 2]; 4]>;

/// A sweep. Copies share its parts.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereSweep(Arc<Sweep>);

#[derive(Clone, Debug)]
struct Sweep {
    parts: Vec<Part>,
    /// Over the boxes of the parts.
    tree: Bvh,
    bounds: Bounds,
}

impl PartialEq for Sweep {
    /// The tree follows from the parts.
    fn eq(&self, other: &Self) -> bool {
        self.parts == other.parts && self.bounds == other.bounds
    }
}

/// How the curve follows the spheres.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Linear,
    /// Near the spheres, smooth in its bends.
    B,
    /// Through all but the first and the last, which only bend it.
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
        let mut found = None;
        for (word, kind, least) in kinds {
            if args.accept(word)? {
                found = Some((word, kind, least));
            }
        }
        let Some((word, kind, least)) = found else {
            let what = "`linear_spline`, `b_spline` or `cubic_spline` in `sphere_sweep`";
            return Err(args.expected(what));
        };
        args.comma()?;
        let at = args.span();
        let count = read::number(args, "the number of spheres")?.trunc();
        if count < f64::from(least) || count > MOST_SPHERES {
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
        if args.accept(Word::Tolerance)? {
            read::number(args, "the tolerance of the sphere sweep")?;
        }
        Ok(SphereSweep(Arc::new(Sweep::new(kind, &spheres))))
    }

    /// The parts of a ray that are in the sweep, in order and apart from each other.
    fn spans(&self, ray: &Ray) -> Spans {
        let mut all = Spans::new();
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        self.0.tree.any(ray, from, to, |number| {
            self.0.parts[number as usize].spans(ray, number, &mut all);
            false
        });
        all.sort_unstable_by(|a, b| a[0].0.total_cmp(&b[0].0).then(a[0].1.cmp(&b[0].1)));
        let mut apart = Spans::new();
        for [enter, leave] in all {
            match apart.last_mut() {
                Some([_, last]) if enter.0 <= last.0 => {
                    if leave.0 > last.0 {
                        *last = leave;
                    }
                }
                _ => apart.push([enter, leave]),
            }
        }
        apart
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
                .map(|four| Part::of(&B_SPLINE, four))
                .collect(),
            Kind::Cubic => spheres
                .windows(4)
                .map(|four| Part::of(&CATMULL_ROM, four))
                .collect(),
        };
        let boxes: Vec<Bounds> = parts.iter().map(Part::bounds).collect();
        // POV-Ray's box, as far as it goes.
        let factor = if kind == Kind::Cubic { 2.0 } else { 1.0 };
        let of_spheres = spheres.iter().map(|sphere| {
            let radius = DVec3::splat(factor * sphere.w.abs());
            Bounds {
                min: sphere.truncate() - radius,
                max: sphere.truncate() + radius,
            }
        });
        let bounds = of_spheres.chain(boxes.iter().copied());
        let bounds = bounds.fold(Bounds::EMPTY, |sum, next| sum.union(&next));
        Sweep {
            tree: Bvh::build(&boxes),
            parts,
            bounds,
        }
    }
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
        let found = spans
            .iter()
            .filter_map(|[enter, leave]| span(*enter, *leave));
        found
            .into_iter()
            .find_map(|span| first_visible(&span, from, to))
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        let part = &self.0.parts[face as usize];
        let (x, _) = part.deepest(point);
        (point - part.centre) / part.size - part.at(x).truncate()
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.tree.around(point, |number| {
            self.0.parts[number as usize].deepest(point).1 < 0.0
        })
    }

    fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
