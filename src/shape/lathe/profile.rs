//! Where a line crosses a surface of revolution.
//!
//! With `τ` the length along a ray, `s` and `c` the sine and cosine of its climb, `a` its distance from the axis and `h`
//! how far it is from where it is nearest to the axis, a point `(r, y)` of the curve is met where `h = ±√(r² − a²)` and
//! `F = c·(y − y₀) − s·(h − h₀) = 0`. Both halves of that are solved by themselves. The polynomial of degree six that
//! joins them has double roots for level rays, and so loses what this keeps. The curve is cut into arcs on which
//! `r`, `y` and their slopes are monotone; there values and slopes of `F` are bounded by those at the ends.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface where the curve is of lines
//! (`shape/roundings.rs`), and within 4 on other curves (`tests/stability`, item 51).

use crate::math::conditioning::power_of_two;
use crate::math::enclosed::{self, Enclosed, sign_changes};
use crate::math::polynomial::Places;
use crate::math::{Bounds, Ray};
use crate::shape::spline::{self, Chain, Segment};
use crate::shape::{Crossing, Crossings, Root};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::ops::Range;

/// More roundings than it takes to find how far a point of the curve lies from a line.
const ROUNDINGS: f64 = 16.0;

/// The curve, and all that rays need of it.
#[derive(Debug, PartialEq)]
pub(super) struct Profile {
    /// The curve, and behind it what closes it.
    pub(super) segments: Chain,
    /// How many of them are the curve.
    pub(super) seen: usize,
    arcs: Vec<Bow>,
    groups: Vec<Group>,
    /// The middle of the box around the solid.
    middle: f64,
    pub(super) bounds: Bounds,
}

/// A stretch of a segment on which radius, height and their slopes are monotone and the radius keeps its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bow {
    segment: usize,
    from: f64,
    to: f64,
    /// The points at which it begins and ends.
    ends: [DVec2; 2],
}

/// So many arcs that follow one another are passed by together.
const TOGETHER: usize = 6;

/// Arcs that follow one another.
#[derive(Clone, Debug, PartialEq)]
struct Group {
    arcs: Range<usize>,
    /// The least radius and height, and the most.
    ends: [DVec2; 2],
}

/// A ray about the axis.
struct Climb {
    /// The distance of the line from the axis.
    aside: f64,
    /// `h` at the origin of the ray.
    ahead: f64,
    /// The height of that origin.
    height: f64,
    sine: f64,
    cosine: f64,
}

/// `F` along an arc, for `h` positive or negative.
struct Half<'a> {
    climb: &'a Climb,
    segment: &'a Segment,
    side: f64,
}

/// Adds the rings and the wall that close a curve whose ends are apart, at the distance to which it comes to the axis.
fn close(segments: &mut Vec<Segment>, inner: f64) {
    let (Some(first), Some(last)) = (segments.first(), segments.last()) else {
        return;
    };
    let (start, end) = (first.start, last.end);
    if spline::is_same(start, end) {
        let seen = segments.len();
        segments[seen - 1] = segments[seen - 1].ending_at(start);
        return;
    }
    let wall = [DVec2::new(inner, end.y), DVec2::new(inner, start.y)];
    for (from, to) in [(end, wall[0]), (wall[0], wall[1]), (wall[1], start)] {
        if from != to {
            segments.push(Segment::line(from, to));
        }
    }
}

fn push_arcs(number: usize, segment: &Segment, arcs: &mut Vec<Bow>) {
    let mut stops: SmallVec<[f64; 12]> = SmallVec::new();
    stops.extend([-1.0, 1.0]);
    for axis in 0..2 {
        stops.extend(segment.turns(axis));
        stops.extend(segment.bend(axis));
    }
    stops.extend(segment.zeros(0));
    stops.sort_unstable_by(f64::total_cmp);
    stops.dedup();
    arcs.extend(stops.windows(2).map(|pair| Bow {
        segment: number,
        from: pair[0],
        to: pair[1],
        ends: [segment.at(pair[0]), segment.at(pair[1])],
    }));
}

impl Group {
    /// The arcs from this one on.
    fn new(arcs: &[Bow], start: usize) -> Self {
        let end = arcs.len().min(start + TOGETHER);
        let ends = arcs[start..end].iter().flat_map(|arc| arc.ends);
        let ends = ends.map(|end| DVec2::new(end.x.abs(), end.y));
        Group {
            arcs: start..end,
            ends: [
                ends.clone().fold(DVec2::INFINITY, DVec2::min),
                ends.fold(DVec2::NEG_INFINITY, DVec2::max),
            ],
        }
    }
}

impl Climb {
    fn new(ray: &Ray) -> Self {
        let (origin, dir) = (flat(ray.origin), flat(ray.dir));
        let speed = ray.dir.length();
        let along = if dir == DVec2::ZERO {
            origin.try_normalize().unwrap_or(DVec2::X)
        } else {
            dir / dir.length()
        };
        Climb {
            aside: along.perp_dot(origin).abs(),
            ahead: along.dot(origin),
            height: ray.origin.y,
            sine: ray.dir.y / speed,
            cosine: dir.length() / speed,
        }
    }

    /// How far from the place nearest to the axis the line has the distance `radius` from it; zero if it never has.
    fn reach(&self, radius: f64) -> f64 {
        let radius = radius.abs();
        ((radius - self.aside) * (radius + self.aside))
            .max(0.0)
            .sqrt()
    }

    /// For both sides of `h`, whether the line surely passes an arc with these ends by: by more than any rounding its
    /// points lie above or below it. `near` and `far` are how far from the place nearest to the axis the line reaches
    /// their radius.
    fn passes_by(&self, [a, b]: [DVec2; 2]) -> [bool; 2] {
        let [near, far] = [a, b].map(|end| self.reach(end.x));
        let (low, high) = (a.y.min(b.y), a.y.max(b.y));
        let rise = [low, high].map(|y| self.cosine * (y - self.height));
        let size = self.cosine * (low.abs().max(high.abs()) + self.height.abs())
            + self.sine.abs() * (near.max(far) + self.ahead.abs());
        let care = ROUNDINGS * f64::EPSILON * size;
        [1.0, -1.0].map(|side| {
            let way = [near, far].map(|reach| self.sine * (side * reach - self.ahead));
            rise[0] - way[0].max(way[1]) > care || rise[1] - way[0].min(way[1]) < -care
        })
    }

    fn excess(&self, point: DVec2, side: f64) -> f64 {
        self.cosine * (point.y - self.height)
            - self.sine * (side * self.reach(point.x) - self.ahead)
    }

    /// The length along the ray to a point of it.
    fn length(&self, point: DVec2, side: f64) -> f64 {
        if self.sine.abs() > self.cosine {
            (point.y - self.height) / self.sine
        } else {
            (side * self.reach(point.x) - self.ahead) / self.cosine
        }
    }
}

impl Enclosed for Half<'_> {
    fn value(&self, x: f64) -> f64 {
        self.climb.excess(self.segment.at(x), self.side)
    }

    fn slope(&self, x: f64) -> f64 {
        let (point, slope) = (self.segment.at(x), self.segment.slope(x));
        let outward = slope.x * point.x / self.climb.reach(point.x);
        self.climb.cosine * slope.y - self.climb.sine * self.side * outward
    }

    fn values(&self, from: f64, to: f64) -> enclosed::Range {
        let (a, b) = (self.segment.at(from), self.segment.at(to));
        let climb = self.climb;
        let factor = climb.sine * self.side;
        let rise = enclosed::Range::new(climb.cosine * a.y, climb.cosine * b.y);
        let way = enclosed::Range::new(factor * climb.reach(a.x), factor * climb.reach(b.x));
        let rest = climb.sine * climb.ahead - climb.cosine * climb.height;
        enclosed::Range {
            low: rise.low - way.high + rest,
            high: rise.high - way.low + rest,
        }
    }

    fn slopes(&self, from: f64, to: f64) -> enclosed::Range {
        let climb = self.climb;
        let (a, b) = (self.segment.slope(from), self.segment.slope(to));
        let rise = enclosed::Range::new(climb.cosine * a.y, climb.cosine * b.y);
        let factor = climb.sine * self.side;
        let narrowing = |x: f64| {
            let radius = self.segment.at(x).x;
            radius / climb.reach(radius)
        };
        let (near, far) = (narrowing(from), narrowing(to));
        let mut way = enclosed::Range::new(0.0, 0.0);
        if factor != 0.0 {
            let products = [a.x * near, a.x * far, b.x * near, b.x * far].map(|p| factor * p);
            if products.iter().any(|p| p.is_nan()) {
                return enclosed::Range::new(f64::NEG_INFINITY, f64::INFINITY);
            }
            way.low = products.iter().copied().fold(f64::INFINITY, f64::min);
            way.high = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        }
        enclosed::Range {
            low: rise.low - way.high,
            high: rise.high - way.low,
        }
    }
}

impl Profile {
    /// The curve of these segments, closed.
    pub(super) fn new(mut segments: Vec<Segment>) -> Self {
        let seen = segments.len();
        let low = segments
            .iter()
            .fold(DVec2::INFINITY, |low, s| low.min(s.low));
        let high = segments
            .iter()
            .fold(DVec2::NEG_INFINITY, |high, s| high.max(s.high));
        close(&mut segments, low.x.max(0.0));
        let mut arcs = Vec::new();
        for (number, segment) in segments.iter().enumerate() {
            push_arcs(number, segment, &mut arcs);
        }
        let starts = (0..arcs.len()).step_by(TOGETHER);
        let groups = starts.map(|start| Group::new(&arcs, start)).collect();
        let rim = high.x.max(-low.x);
        let slack = 8.0 * f64::EPSILON * rim.max(low.y.abs()).max(high.y.abs());
        let reach = rim + slack;
        let bounds = Bounds {
            min: DVec3::new(-reach, low.y - slack, -reach),
            max: DVec3::new(reach, high.y + slack, reach),
        };
        Profile {
            segments: Chain::new(segments),
            seen,
            arcs,
            groups,
            middle: 0.5 * (low.y + high.y),
            bounds,
        }
    }

    /// Where the line of a ray crosses the surface, in order.
    pub(super) fn crossings(&self, ray: &Ray) -> Crossings {
        // From the place nearest to the middle, with a direction that can be squared.
        let dir_size = power_of_two(ray.dir.abs().max_element());
        let dir = ray.dir / dir_size;
        let about = DVec3::new(0.0, self.middle, 0.0);
        let start = (about - ray.origin).dot(dir) / dir.dot(dir);
        let near = Ray::new(ray.origin + start * dir, dir);
        if !near.origin.is_finite() {
            return Crossings::new();
        }
        let speed = dir.length();
        let climb = Climb::new(&near);
        let mut found: SmallVec<[(f64, bool); 8]> = SmallVec::new();
        if climb.aside > self.bounds.max.x {
            return Crossings::new();
        }
        for group in &self.groups {
            if group.ends[1].x < climb.aside || climb.passes_by(group.ends) == [true; 2] {
                continue;
            }
            for arc in &self.arcs[group.arcs.clone()] {
                self.meet(arc, &climb, |length| {
                    let is_seen = arc.segment < self.seen;
                    found.push(((start + length / speed) / dir_size, is_seen));
                });
            }
        }
        found.retain(|place| place.0.is_finite());
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut roots = Crossings::new();
        let mut is_inside = false;
        for (t, is_visible) in found {
            roots.push(Root {
                t,
                crossing: if is_inside {
                    Crossing::Leave
                } else {
                    Crossing::Enter
                },
                face: 0,
                is_visible,
            });
            is_inside = !is_inside;
        }
        if is_inside {
            // Only beyond all numbers.
            roots.pop();
        }
        roots
    }

    /// Visits the lengths at which the line meets an arc, at whose ends it is so far from the place nearest to the axis.
    fn meet(&self, arc: &Bow, climb: &Climb, mut visit: impl FnMut(f64)) {
        let [starts_out, ends_out] = arc.ends.map(|end| end.x.abs() >= climb.aside);
        if !(starts_out || ends_out) {
            return;
        }
        let passes_by = climb.passes_by(arc.ends);
        if passes_by == [true; 2] {
            return;
        }
        let segment = &self.segments[arc.segment];
        let (mut from, mut to) = (arc.from, arc.to);
        let radius = |x: f64| segment.at(x).x.abs();
        match (starts_out, ends_out) {
            (false, false) | (true, true) => {}
            (false, true) => from = bisect(&radius, climb.aside, from, to),
            (true, false) => to = bisect(&radius, climb.aside, to, from),
        }
        if radius(from) == 0.0 && radius(to) == 0.0 {
            return;
        }
        for (side, passes_by) in [1.0, -1.0].into_iter().zip(passes_by) {
            if passes_by {
                continue;
            }
            let half = Half {
                climb,
                segment,
                side,
            };
            // Where the halves meet they have one value, and an end of an arc has the value of its neighbour.
            let end = |x: f64, is_own: bool| {
                let value = if is_own {
                    half.value(x)
                } else {
                    climb.cosine * (segment.at(x).y - climb.height) + climb.sine * climb.ahead
                };
                (x, value < 0.0)
            };
            let mut places = Places::new();
            sign_changes(&half, end(from, starts_out), end(to, ends_out), &mut places);
            for x in places {
                visit(climb.length(segment.at(x), side));
            }
        }
    }
}

/// Where a monotone radius reaches `level`, from a place below it to one that is not; on the far side of it.
fn bisect(radius: &impl Fn(f64) -> f64, level: f64, mut below: f64, mut above: f64) -> f64 {
    let excess = |x: f64| radius(x) - level;
    let mut ends = [excess(below), excess(above)];
    let mut is_slow = false;
    loop {
        let middle = 0.5 * (below + above);
        if middle == below || middle == above {
            return above;
        }
        // Where the chord is at the level, and a little farther from the end that is nearer to it, so that both ends close
        // in; the middle after a step that gained too little.
        let along = ends[0] / (ends[0] - ends[1]);
        let beside = 4.0 * f64::EPSILON * below.abs().max(above.abs());
        let place = below + along * (above - below);
        let nudge = beside.copysign(above - below);
        let place = if along < 0.5 {
            place + nudge
        } else {
            place - nudge
        };
        let is_between = (below - place) * (place - above) > 0.0;
        let x = if is_between && !is_slow {
            place
        } else {
            middle
        };
        let width = (above - below).abs();
        let value = excess(x);
        if value < 0.0 {
            (below, ends[0]) = (x, value);
        } else {
            (above, ends[1]) = (x, value);
        }
        is_slow = !is_slow && (above - below).abs() > 0.25 * width;
    }
}

/// The part of a point or direction across the axis.
pub(super) fn flat(v: DVec3) -> DVec2 {
    DVec2::new(v.x, v.z)
}
