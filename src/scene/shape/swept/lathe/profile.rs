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

use super::climb::{Climb, FourAndClimb, FourReaches, Half, SIDES, bisect};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::roots::interval_roots::{
    Interval as Lengths, IntervalFunction, sign_changes,
};
use crate::base::math::roots::polynomial::Roots;
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use crate::scene::shape::swept::spline;
use crate::scene::shape::swept::spline::{Chain, Segment};
use crate::scene::shape::{Crossing, Crossings, Root};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// The curve, and all that rays need of it.
#[derive(Debug, PartialEq)]
pub(super) struct Profile {
    /// The curve, and behind it what closes it.
    pub(super) segments: Chain,
    /// How many of them are the curve.
    pub(super) seen: usize,
    arcs: Vec<Bow>,
    /// The reaches of the arcs by four; behind the last it stands again.
    reaches: Vec<FourReaches>,
    /// Whether each segment begins where the one before ends, the first where the last does: only then a line crosses the
    /// whole an even number of times.
    is_closed: bool,
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
    /// The least radius and height of its points, and the most.
    reach: [DVec2; 2],
}

/// A part of a line on which it may meet an arc.
#[derive(Clone, Copy)]
struct Pass {
    arc: usize,
    /// Whether the ends of the arc are as far from the axis as the line.
    is_out: [bool; 2],
    /// Whether `h` may be positive, and whether it may be negative: both only where one end of the arc is nearer to the
    /// axis than the line.
    sides: [bool; 2],
    /// The lengths along the line between which it lies.
    from: f64,
    to: f64,
}

/// The roots of a line that are asked for: those between `from` and `to`, both excluded, up to the first visible one
/// beyond `enough`. Others before and behind may come with them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) enough: f64,
}

impl Asked {
    /// All of them.
    pub(super) const EVERYWHERE: Asked = Asked {
        from: f64::NEG_INFINITY,
        to: f64::INFINITY,
        enough: f64::INFINITY,
    };
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
    for pair in stops.windows(2) {
        let ends = [segment.at(pair[0]), segment.at(pair[1])];
        // What lies on the axis has no surface.
        if ends[0].x == 0.0 && ends[1].x == 0.0 {
            continue;
        }
        let [low, high] = segment.box_of_part(pair[0], pair[1]);
        let nearest = low.x.max(-high.x).max(0.0);
        arcs.push(Bow {
            segment: number,
            from: pair[0],
            to: pair[1],
            ends,
            reach: [
                DVec2::new(nearest, low.y),
                DVec2::new(high.x.max(-low.x), high.y),
            ],
        });
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
        let fours = arcs.chunks(4);
        let reaches = fours.map(|of| FourReaches::new(|lane| of[lane.min(of.len() - 1)].reach));
        let next = segments.iter().cycle().skip(1);
        let is_closed = segments.iter().zip(next).all(|(a, b)| a.end == b.start);
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
            reaches: reaches.collect(),
            arcs,
            is_closed,
            middle: 0.5 * (low.y + high.y),
            bounds,
        }
    }

    /// Where the line of a ray crosses the surface, in order, as far as is asked for.
    ///
    /// Parts of the line are gone through in order, and what lies behind the root that is enough is not solved. Of a part
    /// that lies before all that is asked for it is enough to know whether the line crosses it an odd number of times.
    pub(super) fn crossings(&self, ray: &Ray, asked: Asked) -> Crossings {
        let asked = if self.is_closed {
            asked
        } else {
            Asked::EVERYWHERE
        };
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
        if climb.aside > self.bounds.max.x {
            return Crossings::new();
        }
        let place = |length: f64| (start + length / speed) / dir_size;
        let is_all = asked.from == f64::NEG_INFINITY;
        let mut is_inside = false;
        let mut is_far = false;
        let mut passes: SmallVec<[(f64, Pass); 12]> = SmallVec::new();
        let note = |pass: Pass| {
            let (first, last) = (place(pass.from), place(pass.to));
            is_far |= !(first.is_finite() && last.is_finite());
            if last <= asked.from && !is_all {
                is_inside ^= self.is_crossed_oddly(&pass, &climb);
            } else if first < asked.to || is_far {
                passes.push((first, pass));
            }
        };
        with_widest(
            #[inline(always)]
            |lanes| self.passes(lanes, &climb, note),
        );
        if is_far && !(is_all && asked.enough == f64::INFINITY) {
            return self.crossings(ray, Asked::EVERYWHERE);
        }
        if asked.enough < f64::INFINITY {
            passes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        }
        let mut end = asked.to;
        let mut found: SmallVec<[(f64, usize, bool); 8]> = SmallVec::new();
        for (first, pass) in &passes {
            if *first > end {
                break;
            }
            let is_seen = self.arcs[pass.arc].segment < self.seen;
            self.meet(pass, &climb, |length, side| {
                let t = place(length);
                if is_seen && asked.enough < t {
                    end = end.min(t);
                }
                found.push((t, 2 * pass.arc + side, is_seen));
            });
        }
        found.retain(|place| place.0.is_finite());
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut roots = Crossings::new();
        for (t, _, is_visible) in found {
            // Before it others may lie that have not been solved.
            if t > end {
                break;
            }
            let crossing = if is_inside {
                Crossing::Leave
            } else {
                Crossing::Enter
            };
            is_inside = !is_inside;
            if t > asked.from {
                roots.push(Root {
                    t,
                    crossing,
                    face: 0,
                    is_visible,
                });
            }
        }
        if is_inside && is_all && asked.enough == f64::INFINITY {
            // Only beyond all numbers.
            roots.pop();
        }
        roots
    }

    /// Visits the parts of a line on which it may meet an arc.
    #[inline(always)]
    fn passes(&self, lanes: SimdLevel, climb: &Climb, mut visit: impl FnMut(Pass)) {
        for (reaches, first) in self.reaches.iter().zip((0..).step_by(4)) {
            let found = lanes.run(FourAndClimb { reaches, climb });
            let mut met = found.met[0] | found.met[1];
            let here = self.arcs.len() - first;
            if here < 4 {
                met &= (1 << here) - 1;
            }
            while met != 0 {
                let lane = met.trailing_zeros() as usize;
                met &= met - 1;
                let sides = [found.met[0] >> lane & 1 == 1, found.met[1] >> lane & 1 == 1];
                let near_and_far = [found.near[lane], found.far[lane]];
                self.passes_of(first + lane, climb, (sides, near_and_far), &mut visit);
            }
        }
    }

    /// The same for an arc that may be met where `h` has these signs; `near_and_far` are how far from the place nearest
    /// to the axis the line reaches the least of its radii, and the most.
    fn passes_of(
        &self,
        number: usize,
        climb: &Climb,
        (sides, near_and_far): ([bool; 2], [f64; 2]),
        visit: &mut impl FnMut(Pass),
    ) {
        let arc = &self.arcs[number];
        let [first, last] = arc.ends;
        let is_out = [first.x.abs() >= climb.aside, last.x.abs() >= climb.aside];
        if is_out == [false; 2] {
            return;
        }
        let lengths = |side: usize| climb.lengths(arc.reach, near_and_far, SIDES[side]);
        let pass = |sides, along: Lengths| Pass {
            arc: number,
            is_out,
            sides,
            from: along.low,
            to: along.high,
        };
        match sides {
            [false, false] => {}
            [true, false] => visit(pass(sides, lengths(0))),
            [false, true] => visit(pass(sides, lengths(1))),
            [true, true] if is_out == [true; 2] => {
                visit(pass([true, false], lengths(0)));
                visit(pass([false, true], lengths(1)));
            }
            [true, true] => {
                let (one, other) = (lengths(0), lengths(1));
                let both = Lengths {
                    low: one.low.min(other.low),
                    high: one.high.max(other.high),
                };
                visit(pass(sides, both));
            }
        }
    }

    /// Whether the line meets an arc an odd number of times there.
    fn is_crossed_oddly(&self, pass: &Pass, climb: &Climb) -> bool {
        let ends = self.arcs[pass.arc].ends;
        let is_below = |end: DVec2, side: f64| climb.excess(end, side) < 0.0;
        match pass.is_out {
            [true, true] => {
                let side = if pass.sides[0] { SIDES[0] } else { SIDES[1] };
                is_below(ends[0], side) != is_below(ends[1], side)
            }
            // Both halves have one value where they meet. A half that is passed by keeps its sign.
            [is_first, _] => {
                let own = ends[usize::from(!is_first)];
                is_below(own, SIDES[0]) != is_below(own, SIDES[1])
            }
        }
    }

    /// Visits the lengths at which the line meets an arc, and for which sign of `h`.
    fn meet(&self, pass: &Pass, climb: &Climb, mut visit: impl FnMut(f64, usize)) {
        let arc = &self.arcs[pass.arc];
        let segment = &self.segments[arc.segment];
        let [starts_out, ends_out] = pass.is_out;
        let (mut from, mut to) = (arc.from, arc.to);
        let radius = |x: f64| segment.at(x).x.abs();
        match (starts_out, ends_out) {
            (false, false) | (true, true) => {}
            (false, true) => from = bisect(&radius, climb.aside, from, to),
            (true, false) => to = bisect(&radius, climb.aside, to, from),
        }
        for (number, side) in SIDES.into_iter().enumerate() {
            if !pass.sides[number] {
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
            let mut places = Roots::new();
            sign_changes(&half, end(from, starts_out), end(to, ends_out), &mut places);
            for x in places {
                visit(climb.length(segment.at(x), side), number);
            }
        }
    }
}
