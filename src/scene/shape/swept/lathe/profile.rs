//! Intersection of a line with a surface of revolution.
//!
//! Let `s` and `c` be the sine and cosine of a ray's elevation, `a` its distance from the axis, and `h` the horizontal
//! distance from its closest approach to the axis; `(h₀, y₀)` is its origin. The ray hits a point `(r, y)` of the curve
//! where `h = ±√(r² − a²)` and `F = c·(y − y₀) − s·(h − h₀) = 0`. Both halves of that are solved separately. The
//! polynomial of degree six that joins them has double roots for level rays, and loses the digits that this form keeps.
//! The curve is cut into arcs on which `r`, `y` and their slopes are monotone; there values and slopes of `F` are
//! bounded by those at the ends.
//!
//! Error bound: roots lie within 2 roundings of the problem's size from the surface for curves of lines
//! (`shape/roundings.rs`), and within 4 for other curves (`tests/stability`).

use super::climb::{ArcBounds4, ArcTest4, AxisRay, Half, SIDES, bisect};
use crate::base::math::conditioning::power_of_two;
use crate::base::math::roots::bracket::Roots;
use crate::base::math::roots::interval_roots::{
    End, Interval as Lengths, IntervalFunction, sign_changes,
};
use crate::base::math::simd::{SimdLevel, with_widest};
use crate::base::math::{Bounds, Ray};
use crate::scene::shape::swept::spline;
use crate::scene::shape::swept::spline::{Chain, Segment};
use crate::scene::shape::{Crossing, Crossings, Root};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// The curve, prepared for ray queries.
#[derive(Debug, PartialEq)]
pub(super) struct Profile {
    /// The segments of the curve, followed by those that close it.
    pub(super) segments: Chain,
    /// Number of segments of the curve, the visible ones.
    pub(super) visible_count: usize,
    /// The least distance of the curve from the axis.
    pub(super) inner: f64,
    arcs: Vec<MonotoneArc>,
    /// Bounds of the arcs in packets of four; the last packet is filled up with copies.
    arc_bounds: Vec<ArcBounds4>,
    /// True if each segment begins where the previous one ends, the first where the last does: only then a line crosses
    /// the whole an even number of times.
    is_closed: bool,
    /// The y coordinate of the centre of the bounding box.
    centre_y: f64,
    /// The bounds of the curve as it is computed.
    pub(super) hull: Bounds,
    /// The same with slack for rounding.
    pub(super) bounds: Bounds,
}

/// A part of a segment on which radius, height and their slopes are monotone and the radius keeps its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MonotoneArc {
    segment: usize,
    from: f64,
    to: f64,
    /// The points at which it begins and ends.
    ends: [DVec2; 2],
    /// Least and greatest radius and height of its points.
    extent: [DVec2; 2],
}

/// An interval of a line on which it may hit an arc.
#[derive(Clone, Copy)]
struct ArcInterval {
    arc: usize,
    /// For each end of the arc, true if it is at least as far from the axis as the line.
    is_outside: [bool; 2],
    /// Possible signs of `h`, positive and negative: both only where one end of the arc is nearer to the axis than the
    /// line.
    sides: [bool; 2],
    /// Distances along the line between which the interval lies.
    from: f64,
    to: f64,
}

/// The roots of a line to report: those between `from` and `to`, both excluded, up to the first visible one beyond
/// `enough`. Others before and after may be reported too.
#[derive(Clone, Copy, Debug)]
pub(super) struct RootQuery {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) enough: f64,
}

impl RootQuery {
    /// All roots of the line.
    pub(super) const EVERYWHERE: RootQuery = RootQuery {
        from: f64::NEG_INFINITY,
        to: f64::INFINITY,
        enough: f64::INFINITY,
    };
}

/// Adds the rings and the wall that close a curve with separate ends, at the least distance of the curve from the axis.
fn close(segments: &mut Vec<Segment>, inner: f64) {
    let (Some(first), Some(last)) = (segments.first(), segments.last()) else {
        return;
    };
    let (start, end) = (first.start, last.end);
    if spline::is_same(start, end) {
        let count = segments.len();
        segments[count - 1] = segments[count - 1].ending_at(start);
        return;
    }
    let wall = [DVec2::new(inner, end.y), DVec2::new(inner, start.y)];
    for (from, to) in [(end, wall[0]), (wall[0], wall[1]), (wall[1], start)] {
        if from != to {
            segments.push(Segment::line(from, to));
        }
    }
}

fn push_arcs(number: usize, segment: &Segment, arcs: &mut Vec<MonotoneArc>) {
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
        // A part on the axis has no surface.
        if ends[0].x == 0.0 && ends[1].x == 0.0 {
            continue;
        }
        let [low, high] = segment.box_of_part(pair[0], pair[1]);
        let nearest = low.x.max(-high.x).max(0.0);
        arcs.push(MonotoneArc {
            segment: number,
            from: pair[0],
            to: pair[1],
            ends,
            extent: [
                DVec2::new(nearest, low.y),
                DVec2::new(high.x.max(-low.x), high.y),
            ],
        });
    }
}

impl Profile {
    /// The profile of a curve of these segments, closed.
    pub(super) fn new(mut segments: Vec<Segment>) -> Self {
        let visible_count = segments.len();
        let low = segments
            .iter()
            .fold(DVec2::INFINITY, |low, s| low.min(s.low));
        let high = segments
            .iter()
            .fold(DVec2::NEG_INFINITY, |high, s| high.max(s.high));
        let inner = low.x.max(0.0);
        close(&mut segments, inner);
        let mut arcs = Vec::new();
        for (number, segment) in segments.iter().enumerate() {
            push_arcs(number, segment, &mut arcs);
        }
        let packets = arcs.chunks(4);
        let arc_bounds =
            packets.map(|packet| ArcBounds4::new(|lane| packet[lane.min(packet.len() - 1)].extent));
        let next = segments.iter().cycle().skip(1);
        let is_closed = segments.iter().zip(next).all(|(a, b)| a.end == b.start);
        let max_radius = high.x.max(-low.x);
        let hull = Bounds {
            min: DVec3::new(-max_radius, low.y, -max_radius),
            max: DVec3::new(max_radius, high.y, max_radius),
        };
        Profile {
            segments: Chain::new(segments),
            visible_count,
            inner,
            arc_bounds: arc_bounds.collect(),
            arcs,
            is_closed,
            centre_y: 0.5 * (low.y + high.y),
            hull,
            bounds: hull.with_slack(),
        }
    }

    /// The crossings of the line of a ray with the surface, in order, as far as `query` needs them.
    ///
    /// Intervals of the line are visited in order, and those after the root that is enough are not solved. For an
    /// interval before all requested roots the parity of its crossings is enough.
    pub(super) fn crossings(&self, ray: &Ray, query: RootQuery) -> Crossings {
        let query = if self.is_closed {
            query
        } else {
            RootQuery::EVERYWHERE
        };
        // From the point nearest to the centre, with a direction that can be squared.
        let dir_size = power_of_two(ray.dir.abs().max_element());
        let dir = ray.dir / dir_size;
        let centre = DVec3::new(0.0, self.centre_y, 0.0);
        let start = (centre - ray.origin).dot(dir) / dir.dot(dir);
        let near = Ray::new(ray.origin + start * dir, dir);
        if !near.origin.is_finite() {
            return Crossings::new();
        }
        let speed = dir.length();
        let axis_ray = AxisRay::new(&near);
        if axis_ray.axis_distance > self.bounds.max.x {
            return Crossings::new();
        }
        let param_at = |length: f64| (start + length / speed) / dir_size;
        let is_all = query.from == f64::NEG_INFINITY;
        let mut is_inside = false;
        let mut is_far = false;
        let mut intervals: SmallVec<[(f64, ArcInterval); 12]> = SmallVec::new();
        let keep = |interval: ArcInterval| {
            let (start_t, last) = (param_at(interval.from), param_at(interval.to));
            is_far |= !(start_t.is_finite() && last.is_finite());
            if last <= query.from && !is_all {
                is_inside ^= self.has_odd_crossings(&interval, &axis_ray);
            } else if start_t < query.to || is_far {
                intervals.push((start_t, interval));
            }
        };
        with_widest(
            #[inline(always)]
            |lanes| self.visit_intervals(lanes, &axis_ray, keep),
        );
        if is_far && !(is_all && query.enough == f64::INFINITY) {
            return self.crossings(ray, RootQuery::EVERYWHERE);
        }
        if query.enough < f64::INFINITY {
            intervals.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        }
        let mut end = query.to;
        let mut hits: SmallVec<[(f64, usize, bool); 8]> = SmallVec::new();
        for (start_t, interval) in &intervals {
            if *start_t > end {
                break;
            }
            let is_visible = self.arcs[interval.arc].segment < self.visible_count;
            self.intersect(interval, &axis_ray, |length, side| {
                let t = param_at(length);
                if is_visible && query.enough < t {
                    end = end.min(t);
                }
                hits.push((t, 2 * interval.arc + side, is_visible));
            });
        }
        hits.retain(|hit| hit.0.is_finite());
        hits.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut roots = Crossings::new();
        for (t, _, is_visible) in hits {
            // Roots before it may not have been solved.
            if t > end {
                break;
            }
            let crossing = if is_inside {
                Crossing::Leave
            } else {
                Crossing::Enter
            };
            is_inside = !is_inside;
            if t > query.from {
                roots.push(Root {
                    t,
                    crossing,
                    face: 0,
                    is_visible,
                });
            }
        }
        if is_inside && is_all && query.enough == f64::INFINITY {
            // Only if a root overflowed.
            roots.pop();
        }
        roots
    }

    /// Visits the intervals of a line on which it may hit an arc.
    #[inline(always)]
    fn visit_intervals(
        &self,
        lanes: SimdLevel,
        axis_ray: &AxisRay,
        mut visit: impl FnMut(ArcInterval),
    ) {
        for (arc_bounds, first) in self.arc_bounds.iter().zip((0..).step_by(4)) {
            let result = lanes.run(ArcTest4 {
                arc_bounds,
                axis_ray,
            });
            let mut hit_mask = result.hit_mask[0] | result.hit_mask[1];
            let remaining = self.arcs.len() - first;
            if remaining < 4 {
                hit_mask &= (1 << remaining) - 1;
            }
            while hit_mask != 0 {
                let lane = hit_mask.trailing_zeros() as usize;
                hit_mask &= hit_mask - 1;
                let sides = [
                    result.hit_mask[0] >> lane & 1 == 1,
                    result.hit_mask[1] >> lane & 1 == 1,
                ];
                let half_chords = [result.near[lane], result.far[lane]];
                self.visit_intervals_of_arc(first + lane, axis_ray, sides, half_chords, &mut visit);
            }
        }
    }

    /// The same for one arc that may be hit for the signs of `h` in `sides`; `half_chords` are `|h|` of the line at
    /// the arc's least and greatest radius.
    fn visit_intervals_of_arc(
        &self,
        number: usize,
        axis_ray: &AxisRay,
        sides: [bool; 2],
        half_chords: [f64; 2],
        visit: &mut impl FnMut(ArcInterval),
    ) {
        let arc = &self.arcs[number];
        let [first, last] = arc.ends;
        let is_outside = [
            first.x.abs() >= axis_ray.axis_distance,
            last.x.abs() >= axis_ray.axis_distance,
        ];
        if is_outside == [false; 2] {
            return;
        }
        let distances = |side: usize| axis_ray.distances(arc.extent, half_chords, SIDES[side]);
        let interval = |sides, along: Lengths| ArcInterval {
            arc: number,
            is_outside,
            sides,
            from: along.low,
            to: along.high,
        };
        match sides {
            [false, false] => {}
            [true, false] => visit(interval(sides, distances(0))),
            [false, true] => visit(interval(sides, distances(1))),
            [true, true] if is_outside == [true; 2] => {
                visit(interval([true, false], distances(0)));
                visit(interval([false, true], distances(1)));
            }
            [true, true] => {
                let (one, other) = (distances(0), distances(1));
                let both = Lengths {
                    low: one.low.min(other.low),
                    high: one.high.max(other.high),
                };
                visit(interval(sides, both));
            }
        }
    }

    /// True if the line crosses an arc an odd number of times on this interval.
    fn has_odd_crossings(&self, interval: &ArcInterval, axis_ray: &AxisRay) -> bool {
        let ends = self.arcs[interval.arc].ends;
        let is_below = |end: DVec2, side: f64| axis_ray.residual(end, side) < 0.0;
        match interval.is_outside {
            [true, true] => {
                let side = if interval.sides[0] {
                    SIDES[0]
                } else {
                    SIDES[1]
                };
                is_below(ends[0], side) != is_below(ends[1], side)
            }
            // Both halves have the same value where they join. A half that is skipped keeps its sign.
            [is_first, _] => {
                let own = ends[usize::from(!is_first)];
                is_below(own, SIDES[0]) != is_below(own, SIDES[1])
            }
        }
    }

    /// Visits the distances at which the line hits an arc, and the index of the sign of `h`.
    fn intersect(
        &self,
        interval: &ArcInterval,
        axis_ray: &AxisRay,
        mut visit: impl FnMut(f64, usize),
    ) {
        let arc = &self.arcs[interval.arc];
        let segment = &self.segments[arc.segment];
        let [starts_out, ends_out] = interval.is_outside;
        let (mut from, mut to) = (arc.from, arc.to);
        let radius = |x: f64| segment.at(x).x.abs();
        match (starts_out, ends_out) {
            (false, false) | (true, true) => {}
            (false, true) => from = bisect(&radius, axis_ray.axis_distance, from, to),
            (true, false) => to = bisect(&radius, axis_ray.axis_distance, to, from),
        }
        for (number, side) in SIDES.into_iter().enumerate() {
            if !interval.sides[number] {
                continue;
            }
            let half = Half {
                axis_ray,
                segment,
                side,
            };
            // The halves have the same value where they join, and an end of an arc has the value of its neighbour.
            let end = |x: f64, is_own: bool| {
                let at = half.at(x);
                let value = if is_own {
                    half.value(at)
                } else {
                    axis_ray.residual_at(at.point.y, 0.0)
                };
                End {
                    x,
                    at,
                    is_negative: value < 0.0,
                }
            };
            let mut params = Roots::new();
            let ends = [end(from, starts_out), end(to, ends_out)];
            sign_changes(&half, ends, &mut params);
            for x in params {
                visit(axis_ray.length(segment.at(x), side), number);
            }
        }
    }
}
