//! `prism { [spline] [sweep] height 1, height 2, number of points, <x, z>, ... [open] }`: an outline in the xz plane,
//! translated along y (`linear_sweep`) or scaled in proportion to y (`conic_sweep`).
//!
//! A ray that is not parallel to y projects to a line in the plane of the outline; for a conic sweep to the line
//! `(origin × dir) · (X, 1, Z) = 0` in the plane `y = 1`. Its crossings with the outline, in order along the ray, bound
//! intervals inside, by the even-odd rule, which are clipped to the slab between the heights: enter and leave alternate
//! by construction. Error bound: roots lie within 2 roundings of the problem's size from the surface
//! (`shape/roundings.rs`); no line slips through a corner (`spline`).

use super::rounded::{Edge, RoundedSweep};
use super::spline::{self, Chain, Kind, Line, Segment};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray, Step};
use crate::base::source::Diagnostic;
use crate::scene::shape::solid::axial::{APEX, BASE, SIDE, Slab};
use crate::scene::shape::{
    FlatFace, Geometry, INSIDE_TOLERANCE, Root, Rounded, Start, Steps, read,
};
use glam::{DAffine3, DVec2, DVec3};
use smallvec::SmallVec;
use std::sync::Arc;

/// A swept outline. Face 0 is the side, 1 the cap at the lower height, 2 the cap at the upper one.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    outline: Arc<Chain>,
    sweep: Sweep,
    low: f64,
    high: f64,
    is_open: bool,
    side: Side,
}

/// The direction of the normals of the sides, which tells outside from inside for `interior_texture`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// Out of the outline.
    Outward,
    /// To the right of the outline's direction, seen from above with z up: from version 3.8 on.
    Right,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sweep {
    Linear,
    Conic,
}

impl Prism {
    /// The straight segments of the outline.
    pub(super) fn edges(&self) -> impl Iterator<Item = Edge> {
        self.outline.iter().filter_map(Segment::edge)
    }

    /// Reads the sweep, the spline, the heights, the points and `open`.
    ///
    /// # Errors
    /// Malformed or non-finite parameters, too few points, an outline of curves that is not closed.
    pub fn read(args: &mut dyn Args) -> Parse<Self> {
        let (mut kind, mut sweep) = (Kind::Linear, Sweep::Linear);
        loop {
            if let Some(named) = Kind::accept(args)? {
                kind = named;
            } else if args.accept(Word::LinearSweep)? {
                sweep = Sweep::Linear;
            } else if args.accept(Word::ConicSweep)? {
                sweep = Sweep::Conic;
            } else {
                break;
            }
        }
        let height = read::number(args, "a height of the prism")?;
        let other = read::number(args, "a height of the prism")?;
        args.comma()?;
        let at = args.span();
        let points = spline::read_points(args, "prism")?;
        let at = at.to(args.last_span());
        let outline = outline(kind, &points).map_err(|fault| {
            let name = kind.name();
            Box::new(Diagnostic::error(
                at,
                match fault {
                    Fault::MissingPoints(least) => {
                        format!("prism with {name} splines must have at least {least} points")
                    }
                    Fault::IncompleteSegment => {
                        "prism with bezier splines must have four points for each segment".into()
                    }
                    Fault::NotClosed => format!("prism with {name} splines is not closed"),
                },
            ))
        })?;
        match outline.repair {
            Repair::None => {}
            Repair::Closed => args.warn(Diagnostic::warning(
                at,
                "linear prism not closed; it is closed by one more edge",
            )),
            Repair::Dropped => {
                args.warn(Diagnostic::warning(at, "prism not closed; it is not drawn"))
            }
        }
        let is_open = args.accept(Word::Open)?;
        Ok(Prism {
            outline: Arc::new(Chain::new(outline.segments)),
            sweep,
            low: height.min(other),
            high: height.max(other),
            is_open,
            side: if args.is_for_3_8() {
                Side::Right
            } else {
                Side::Outward
            },
        })
    }

    /// Visits the inside spans of the line of a ray in order, until `visit` returns true.
    #[inline(always)]
    fn spans(&self, lanes: SimdLevel, ray: &Ray, mut visit: impl FnMut([Root; 2]) -> bool) {
        let Some(slab) = Slab::between(ray, self.low, self.high) else {
            return;
        };
        let mut crossings = match self.sweep {
            Sweep::Linear => self.linear_crossings(lanes, ray),
            Sweep::Conic => self.conic_crossings(lanes, ray),
        };
        crossings.sort_unstable_by(f64::total_cmp);
        for side in crossings.chunks_exact(2) {
            let span = slab.clip(side[0], side[1], self.is_open);
            if span.is_some_and(&mut visit) {
                return;
            }
        }
    }

    /// Crossings of the line with the side of an infinite prism.
    #[inline(always)]
    fn linear_crossings(&self, lanes: SimdLevel, ray: &Ray) -> SmallVec<[f64; 8]> {
        let (origin, dir) = (flat(ray.origin), flat(ray.dir));
        let mut crossings = SmallVec::new();
        let speed_sq = dir.dot(dir);
        if dir.x == 0.0 && self.ends_at(origin.x) {
            return crossings;
        }
        if speed_sq == 0.0 {
            return constant_crossings(self.outline.contains(origin));
        }
        // Relative to the point nearest to the axis, so that a far origin costs no digits.
        let ahead = -origin.dot(dir) / speed_sq;
        let near = origin + ahead * dir;
        let line = Line::through(near, dir.perp());
        self.outline.line_crossings(lanes, line, |number, x| {
            let point = self.outline[number].at(x);
            crossings.push(ahead + (point - near).dot(dir) / speed_sq);
        });
        crossings
    }

    /// True at the least and the largest x of the outline: rays there, across x, miss a prism (docs/povray-shapes.md,
    /// section 5.3).
    #[cold]
    fn ends_at(&self, x: f64) -> bool {
        self.outline.x_range().contains(&x)
    }

    /// Crossings of the line with the side of an infinite double cone.
    #[inline(always)]
    fn conic_crossings(&self, lanes: SimdLevel, ray: &Ray) -> SmallVec<[f64; 8]> {
        let mut crossings = SmallVec::new();
        let dir = ray.dir;
        let ahead = -ray.origin.dot(dir) / dir.dot(dir);
        let near = ray.origin + ahead * dir;
        let plane = near.cross(dir);
        if plane == DVec3::ZERO {
            // Through the apex.
            return constant_crossings(self.outline.contains(flat(dir) / dir.y));
        }
        let line = Line {
            normal: flat(plane),
            from: DVec2::ZERO,
            offset: plane.y,
        };
        self.outline.line_crossings(lanes, line, |number, x| {
            let point = self.outline[number].at(x);
            let rate = flat(dir) - dir.y * point;
            let gap = near.y * point - flat(near);
            let axis = usize::from(rate.y.abs() > rate.x.abs());
            let t = gap[axis] / rate[axis];
            if t.is_finite() {
                crossings.push(ahead + t);
            }
        });
        // At the height of the apex the line is outside: the outline has shrunk to a point there.
        let apex = if dir.y == 0.0 {
            f64::INFINITY
        } else {
            -ray.origin.y / dir.y
        };
        let before = crossings.iter().filter(|t| **t < apex).count();
        if (crossings.len() - before) % 2 == 1 {
            crossings.push(f64::INFINITY);
        }
        if before % 2 == 1 {
            crossings.push(f64::NEG_INFINITY);
        }
        crossings
    }

    /// The outward normal of the side nearest to a point.
    fn side_normal(&self, point: DVec3, toward: Side) -> DVec3 {
        let scale = match self.sweep {
            Sweep::Linear => 1.0,
            Sweep::Conic => point.y,
        };
        let across = flat(point) / scale;
        let Some((number, x)) = spline::nearest(&self.outline, across) else {
            return DVec3::X;
        };
        let segment = &self.outline[number];
        let on_curve = segment.at(x);
        let left = segment.tangent(x).perp();
        let outward = self.outline.outward(on_curve, left);
        let normal = match toward {
            Side::Right if outward.dot(left) > 0.0 => -outward,
            Side::Right | Side::Outward => outward,
        };
        match self.sweep {
            Sweep::Linear => DVec3::new(normal.x, 0.0, normal.y),
            Sweep::Conic => DVec3::new(normal.x, -normal.dot(on_curve), normal.y) * scale.signum(),
        }
    }

    /// The bounds of the curves as they are computed.
    fn hull(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for segment in self.outline.iter() {
            for corner in [segment.low, segment.high] {
                for height in [self.low, self.high] {
                    let scale = match self.sweep {
                        Sweep::Linear => 1.0,
                        Sweep::Conic => height,
                    };
                    let point = DVec3::new(corner.x * scale, height, corner.y * scale);
                    bounds = bounds.with_point(point);
                }
            }
        }
        bounds
    }
}

/// Crossings of a line that is inside everywhere, or nowhere.
fn constant_crossings(is_inside: bool) -> SmallVec<[f64; 8]> {
    let mut crossings = SmallVec::new();
    if is_inside {
        crossings.extend([f64::NEG_INFINITY, f64::INFINITY]);
    }
    crossings
}

/// Projects a point or direction to the plane of the outline.
fn flat(v: DVec3) -> DVec2 {
    DVec2::new(v.x, v.z)
}

enum Fault {
    MissingPoints(usize),
    IncompleteSegment,
    NotClosed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Repair {
    None,
    Closed,
    Dropped,
}

struct Outline {
    segments: Vec<Segment>,
    repair: Repair,
}

/// Splits an outline into closed parts: each begins where the one before has returned to its first point. Leftover
/// points that make no part are ignored, as in POV-Ray.
fn outline(kind: Kind, points: &[DVec2]) -> Result<Outline, Fault> {
    let least = match kind {
        Kind::Linear => 3,
        Kind::Quadratic => 5,
        Kind::Cubic => 6,
        Kind::Bezier => 0,
    };
    if points.len() < least {
        return Err(Fault::MissingPoints(least));
    }
    if kind == Kind::Bezier {
        return bezier_outline(points);
    }
    let (before, after) = kind.extra();
    let mut outline = Outline {
        segments: Vec::new(),
        repair: Repair::None,
    };
    let mut rest = points;
    while rest.len() > before + 1 {
        let first = rest[before];
        let back = rest[before + 1..].iter().position(|p| is_back(*p, first));
        let Some(back) = back.map(|steps| before + 1 + steps) else {
            if kind != Kind::Linear {
                return Err(Fault::NotClosed);
            }
            let mut closed = rest.to_vec();
            closed.push(first);
            outline.repair = Repair::Closed;
            outline.segments.extend(kind.segments(&closed));
            break;
        };
        if back + after >= rest.len() {
            return Err(Fault::NotClosed);
        }
        let (part, next) = rest.split_at(back + after + 1);
        let mut segments = kind.segments(part);
        if let Some(last) = segments.pop() {
            segments.push(last.ending_at(first));
        }
        outline.segments.extend(segments);
        rest = next;
    }
    Ok(outline)
}

fn is_back(point: DVec2, first: DVec2) -> bool {
    spline::is_same(point, first)
}

fn bezier_outline(points: &[DVec2]) -> Result<Outline, Fault> {
    if !points.len().is_multiple_of(4) {
        return Err(Fault::IncompleteSegment);
    }
    let mut outline = Outline {
        segments: Kind::Bezier.segments(points),
        repair: Repair::None,
    };
    let mut first: Option<DVec2> = None;
    let count = outline.segments.len();
    for i in 0..count {
        let begin = *first.get_or_insert(outline.segments[i].start);
        let end = outline.segments[i].end;
        let next = outline.segments.get(i + 1).map(|next| next.start);
        if is_back(end, begin) {
            outline.segments[i] = outline.segments[i].ending_at(begin);
            first = None;
        } else if next.is_some_and(|next| is_back(end, next)) {
            let next = next.unwrap_or(end);
            outline.segments[i] = outline.segments[i].ending_at(next);
        } else {
            outline.segments.clear();
            outline.repair = Repair::Dropped;
            return Ok(outline);
        }
    }
    if first.is_some() {
        outline.segments.clear();
        outline.repair = Repair::Dropped;
    }
    Ok(outline)
}

impl Geometry for Prism {
    /// A cap.
    fn flat_face(&self, face: u32) -> Option<FlatFace> {
        let is_low = face == 1;
        (face != SIDE).then_some(FlatFace {
            axis: 1,
            coordinate: if is_low { self.low } else { self.high },
            is_low,
            is_closed: is_low,
        })
    }

    fn roots(&self, ray: &Ray, roots: &mut Vec<Root>) -> Start {
        with_widest(
            #[inline(always)]
            |lanes| {
                self.spans(lanes, ray, |span| {
                    roots.extend_from_slice(&span);
                    false
                });
            },
        );
        Start::Outside
    }

    fn nearest(&self, ray: &Ray, from: f64, to: f64) -> Option<Root> {
        let mut first = None;
        let is_in_range = |root: &Root| root.is_visible && from < root.t && root.t < to;
        with_widest(
            #[inline(always)]
            |lanes| {
                self.spans(lanes, ray, |span| {
                    first = span.into_iter().find(is_in_range);
                    first.is_some()
                });
            },
        );
        first
    }

    fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        match face {
            BASE => DVec3::NEG_Y,
            APEX => DVec3::Y,
            _ => self.side_normal(point, Side::Outward),
        }
    }

    fn shading_normal(&self, point: DVec3, face: u32) -> Option<DVec3> {
        match (face, self.side) {
            (BASE, Side::Outward) => Some(DVec3::Y),
            (SIDE, Side::Right) => Some(self.side_normal(point, Side::Right)),
            _ => None,
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        let scale = match self.sweep {
            Sweep::Linear => 1.0,
            Sweep::Conic if point.y.abs() < INSIDE_TOLERANCE => return false,
            Sweep::Conic => point.y,
        };
        self.low <= point.y
            && point.y < self.high
            && spline::contains_as_povray(&self.outline, flat(point) / scale)
    }

    fn bounds(&self) -> Bounds {
        if self.outline.is_empty() {
            return Bounds::EMPTY;
        }
        // Points of the curves are rounded.
        self.hull().with_slack()
    }

    fn rounded(&self, steps: &Steps<'_>) -> Option<Rounded> {
        (self.sweep == Sweep::Linear)
            .then(|| Rounded::of_sweep(RoundedSweep::Prism(self.clone()), steps))
    }

    fn decides_ties(&self) -> bool {
        self.sweep == Sweep::Linear && !self.is_open
    }

    fn povray_box(&self) -> Option<(Bounds, DAffine3)> {
        (!self.outline.is_empty()).then(|| (self.hull(), DAffine3::IDENTITY))
    }

    fn absorb(&mut self, _: &Step) -> bool {
        false
    }

    fn takes_sturm(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
