//! Fast path for rays and a torus, generic over the number of lanes so that packets and single rays give the same bits.
//! Rays that take a rare branch, and spindles, are left to the robust path of [`super::torus`].
//!
//! A line is clipped to the slab and the annulus around the tube. On each remaining segment the quartic is split at its
//! inflections; on a piece of one curvature Newton's iteration from the concave side converges without ever passing a
//! root, so nothing needs to be bracketed. A quartic that is convex on all of the segment is split near its minimum: if
//! the value there is positive, and so is its tangent, there is no root.

use super::torus::{CLIP, REFINEMENT, Torus};
use crate::base::math::conditioning::is_comfortable_size;
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::scene::shape::packet::{
    NearestPacket, RootPacket, Vec3Lanes, add, dot, is_comfortable, sub,
};
use crate::scene::shape::packet::{scale, splat};
use crate::scene::shape::packet_search::{NearestQuery4, SpanResult4};
use crate::scene::shape::ray_packet::RayPacket;

/// Rays from farther away, in minor radii, are left to the robust path: up to there the rounding error is less than
/// what [`CLIP`] allows for.
const MAX_DISTANCE: f64 = (1u64 << 36) as f64;
/// Tori with a larger ratio of major to minor radius are left to it as well.
const MAX_RATIO: f64 = (1u64 << 24) as f64;
/// Rays whose squared component perpendicular to the axis is below this share are left to it.
const STEEPEST_SQUARE: f64 = 1.0 / (1u64 << 20) as f64;
/// A Newton step below this ends the iteration: the next step would be below the last digit.
const LAST_STEP: f64 = 1e-9;
/// Pairs of roots too close for this many steps are left to the robust path.
const MAX_STEPS: u32 = 32;

/// A segment that starts beyond this multiple of the nearest distance that counts is hit for certain.
const CLEARANCE: f64 = 32.0;

/// Intervals on which four lines may hit the tube: at most two per line.
struct Clipped<F> {
    start: [F; 2],
    end: [F; 2],
    /// Per interval, the bit mask of the lanes that have it.
    active: [u32; 2],
    unknown: u32,
}

/// Segments of four lines: `middle + x · half` for `-1 <= x <= 1`, about the centre and in units of the minor radius.
#[derive(Clone, Copy)]
struct Segments<F> {
    /// Midpoint and half length as parameters of the lines.
    middle: F,
    half: F,
    point: Vec3Lanes<F>,
    half_dir: Vec3Lanes<F>,
    /// The major radius.
    major: F,
}

/// Value and slope of polynomials at a point, with masks of their signs.
#[derive(Clone, Copy)]
struct Level<F: F64Lanes> {
    is_negative: u32,
    rises: u32,
    falls: u32,
    value: F,
    slope: F,
}

/// Four quartics by rising power, on segments whose ends lie outside.
struct Quartics<F: F64Lanes> {
    c: [F; 5],
    /// They are convex up to `low`, concave from there to `high`, and convex beyond it.
    low: F,
    high: F,
    at_low: Level<F>,
    at_high: Level<F>,
    /// Bit mask of the lanes that may have roots.
    active: u32,
    unknown: u32,
}

/// At most one root of each of four quartics.
struct QuarticRoots<F> {
    x: F,
    hit_mask: u32,
    unknown: u32,
}

/// Newton iteration for one root of each quartic.
struct NewtonSearch<F> {
    start: F,
    limit: F,
    /// 1 to the right, -1 to the left.
    heading: F,
    active: u32,
}

impl Torus {
    /// True if the fast path supports the radii of the torus.
    pub(crate) fn supports_packets(&self) -> bool {
        0.0 < self.minor
            && self.minor <= self.major
            && self.major < MAX_RATIO * self.minor
            && is_comfortable_size(self.major + self.minor)
    }

    /// Packet version of [`crate::scene::shape::Geometry::is_exiting`]: on the outer half the torus lies on one side of
    /// the tangent plane.
    #[inline(always)]
    pub(crate) fn is_exiting_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> F::Mask {
        let p = sub(rays.origin, splat(self.centre));
        let is_known = is_comfortable(dot(rays.dir, rays.dir), dot(p, p));
        let across_sq = p[0] * p[0] + p[2] * p[2];
        let is_outer = F::splat(self.major * self.major).le(across_sq);
        let is_known = is_known & is_outer;
        if self.supports_packets() {
            is_known
        } else {
            F::mask_from_bits(0)
        }
    }

    /// Roots of a ray packet.
    #[inline(always)]
    pub(crate) fn root_packet<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RootPacket<F> {
        let rays = self.about(rays);
        let clipped = self.clip_packet(&rays, 0b1111);
        self.all_roots(&rays, &clipped)
    }

    /// The span of each ray in the query's interval; lanes with two spans take the scalar path.
    pub(crate) fn spans(&self, query: &NearestQuery4) -> SpanResult4 {
        with_widest(|lanes| lanes.run(SpanKernel(self, query)))
    }

    /// Nearest roots of the active lanes, as [`RootPacket::nearest`]; with `ANY` the distance may be that of any point
    /// within the solid.
    #[inline(always)]
    pub(crate) fn nearest_packet<F: F64Lanes, const ANY: bool>(
        &self,
        rays: &RayPacket<F>,
        from: F,
        far: F,
        left: [u32; 2],
        active: u32,
    ) -> NearestPacket<F> {
        let rays = self.about(rays);
        let mut clipped = self.clip_packet(&rays, active);
        let mut straddling = left[0] | left[1];
        for part in 0..2 {
            let active = clipped.active[part];
            if active == 0 {
                continue;
            }
            let is_ahead = F::bitmask(from.le(clipped.start[part]));
            let is_behind = F::bitmask(clipped.end[part].le(from));
            straddling |= active & !is_ahead & !is_behind;
            if left == [0, 0] {
                let is_within = F::bitmask(clipped.start[part].le(far));
                clipped.active[part] = active & is_within & !is_behind;
            }
        }
        if straddling & (clipped.active[0] | clipped.active[1]) != 0 {
            return self.all_roots(&rays, &clipped).nearest(from, far, left);
        }
        let mut nearest = NearestPacket {
            t: F::splat(f64::INFINITY),
            exit_mask: 0,
            hit_mask: 0,
            unknown: clipped.unknown,
        };
        for part in 0..2 {
            let active = clipped.active[part] & !nearest.hit_mask & !nearest.unknown;
            if active == 0 {
                continue;
            }
            let (start, end) = (clipped.start[part], clipped.end[part]);
            let segments = self.segments(&rays, start, end);
            let quartics = segments.quartics(active);
            nearest.unknown |= quartics.unknown;
            let mut active = quartics.active;
            if ANY {
                // Inside at some point, with clearance at both ends.
                let is_clear = (from * F::splat(CLEARANCE)).lt(start) & end.lt(far);
                let inside = quartics.inside() & active & F::bitmask(is_clear);
                nearest.t = F::select(F::mask_from_bits(inside), segments.middle, nearest.t);
                nearest.hit_mask |= inside;
                active &= !inside;
            }
            if active == 0 {
                continue;
            }
            let first = quartics.first(active);
            let (x, refined) = segments.refined(first.x);
            let t = segments.middle + segments.half * x;
            nearest.unknown |= first.unknown | first.hit_mask & !refined;
            let is_within = from.lt(t) & t.le(far);
            let hits = first.hit_mask & refined & F::bitmask(is_within);
            nearest.t = F::select(F::mask_from_bits(hits), t, nearest.t);
            nearest.hit_mask |= hits;
        }
        nearest
    }

    /// The packet relative to the centre.
    #[inline(always)]
    fn about<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RayPacket<F> {
        RayPacket {
            origin: sub(rays.origin, splat(self.centre)),
            dir: rays.dir,
        }
    }

    /// Intervals of the lines between the planes and the cylinders around the tube.
    #[inline(always)]
    fn clip_packet<F: F64Lanes>(&self, rays: &RayPacket<F>, active: u32) -> Clipped<F> {
        let (origin, dir) = (rays.origin, rays.dir);
        let none = F::splat(0.0);
        let (dir_sq, origin_sq) = (dot(dir, dir), dot(origin, origin));
        let mut clipped = Clipped {
            start: [none; 2],
            end: [none; 2],
            active: [0; 2],
            unknown: 0,
        };
        let height = self.minor * CLIP;
        let rim = self.major + height;
        let across_sq = dir[0] * dir[0] + dir[2] * dir[2];
        let farthest = MAX_DISTANCE * self.minor;
        let is_known =
            is_comfortable(dir_sq, origin_sq) & origin_sq.lt(F::splat(farthest * farthest));
        clipped.unknown = active & !F::bitmask(is_known);
        // Relative to the point nearest to the centre.
        let nearest = -dot(origin, dir) / dir_sq;
        let p = add(origin, scale(dir, nearest));
        let is_near = dot(p, p).lt(F::splat(rim * rim + height * height));
        if F::bitmask(is_near) & active & !clipped.unknown == 0 {
            return clipped;
        }
        let is_flat = (dir_sq * F::splat(STEEPEST_SQUARE)).lt(across_sq);
        let inverse = F::splat(1.0) / across_sq;
        let axis = p[0] * dir[0] + p[2] * dir[2];
        let axis = -(axis * inverse);
        let (x, z) = (p[0] + axis * dir[0], p[2] + axis * dir[2]);
        let distance = (x * x + z * z).sqrt();
        let in_rim = within(rim, distance);
        let reach = (in_rim * inverse).sqrt();
        let rise = F::splat(1.0) / dir[1];
        let down = (F::splat(-height) - p[1]) * rise;
        let up = (F::splat(height) - p[1]) * rise;
        let is_slanted = down.eq(down) & up.eq(up);
        let first = down.lane_min(up).lane_max(axis - reach);
        let last = down.lane_max(up).lane_min(axis + reach);
        let is_hit = none.lt(in_rim) & first.lt(last);
        clipped.unknown |= active & F::bitmask(is_near) & !F::bitmask(is_flat & is_slanted);
        let active = active & F::bitmask(is_near & is_hit) & !clipped.unknown;
        // The hole splits the interval in two.
        let (mut part_end, mut part_start) = (last, last);
        let hole = self.major - height;
        if hole > 0.0 {
            let in_hole = within(hole, distance);
            let reach = (in_hole * inverse).sqrt();
            let is_in_hole = none.lt(in_hole);
            part_end = F::select(is_in_hole, (axis - reach).lane_min(last), last);
            part_start = F::select(is_in_hole, (axis + reach).lane_max(first), last);
        }
        clipped.active = [
            active & F::bitmask(first.lt(part_end)),
            active & F::bitmask(part_start.lt(last)),
        ];
        clipped.start = [nearest + first, nearest + part_start];
        clipped.end = [nearest + part_end, nearest + last];
        clipped
    }

    /// All roots on the segments.
    #[inline(always)]
    fn all_roots<F: F64Lanes>(&self, rays: &RayPacket<F>, clipped: &Clipped<F>) -> RootPacket<F> {
        let mut roots = RootPacket::none(clipped.unknown);
        for part in 0..2 {
            let active = clipped.active[part] & !roots.unknown;
            if active == 0 {
                continue;
            }
            let segments = self.segments(rays, clipped.start[part], clipped.end[part]);
            let quartics = segments.quartics(active);
            roots.unknown |= quartics.unknown;
            if quartics.active == 0 {
                continue;
            }
            let candidates = quartics.all();
            let mut last = F::splat(-1.0);
            for (slot, candidates) in candidates.into_iter().enumerate() {
                roots.unknown |= candidates.unknown;
                if candidates.hit_mask == 0 {
                    continue;
                }
                let (x, refined) = segments.refined(candidates.x);
                roots.unknown |= candidates.hit_mask & !refined;
                // In a pair closer than rounding the second root is clamped to the first.
                let x = x.lane_max(last);
                last = F::select(F::mask_from_bits(candidates.hit_mask), x, last);
                let index = 4 * part + slot;
                roots.t[index] = segments.middle + segments.half * x;
                roots.hit_masks[index] = candidates.hit_mask;
            }
        }
        roots
    }

    #[inline(always)]
    fn segments<F: F64Lanes>(&self, rays: &RayPacket<F>, from: F, to: F) -> Segments<F> {
        let middle = F::splat(0.5) * (from + to);
        let half = F::splat(0.5) * (to - from);
        let unit = 1.0 / self.minor;
        let point = add(rays.origin, scale(rays.dir, middle));
        Segments {
            middle,
            half,
            point: scale(point, F::splat(unit)),
            half_dir: scale(rays.dir, half * F::splat(unit)),
            major: F::splat(self.major / self.minor),
        }
    }
}

/// Kernel that finds the spans of rays in the tube.
struct SpanKernel<'a>(&'a Torus, &'a NearestQuery4);

impl SimdKernel for SpanKernel<'_> {
    type Output = SpanResult4;

    #[inline(always)]
    fn run<F: F64x4>(self) -> SpanResult4 {
        let SpanKernel(torus, query) = self;
        let rays = torus.about(&query.rays::<F>());
        let (low, high) = (F::from_array(&query.from), F::from_array(&query.far));
        let mut clipped = torus.clip_packet(&rays, query.active);
        for part in 0..2 {
            let is_within = low.le(clipped.end[part]) & clipped.start[part].le(high);
            clipped.active[part] &= F::bitmask(is_within);
        }
        torus.all_roots(&rays, &clipped).spans()
    }
}

impl<F: F64Lanes> Segments<F> {
    /// The quartics `((a + b) / 2R)² + b` (see [`super::torus`]), with the bounds of their roots.
    #[inline(always)]
    fn quartics(&self, active: u32) -> Quartics<F> {
        let (p, v) = (self.point, self.half_dir);
        let (one, two) = (F::splat(1.0), F::splat(2.0));
        let inverse = one / self.major;
        let half_inverse = F::splat(0.5) * inverse;
        let both = dot(p, p) - (self.major * self.major + one);
        let s = [
            both * half_inverse,
            dot(p, v) * inverse,
            dot(v, v) * half_inverse,
        ];
        let b = [(p[1] - one) * (p[1] + one), p[1] * v[1], v[1] * v[1]];
        let c = [
            s[0] * s[0] + b[0],
            two * (s[0] * s[1] + b[1]),
            s[1] * s[1] + two * s[0] * s[2] + b[2],
            two * s[1] * s[2],
            s[2] * s[2],
        ];
        Quartics::new(c, active)
    }

    /// Two Newton steps on the distance from the tube, and the mask of the lanes whose steps are small enough to be
    /// trusted.
    #[inline(always)]
    fn refined(&self, x: F) -> (F, u32) {
        let (x, is_small) = self.refine(x);
        let (x, is_smaller) = self.refine(x);
        (x, is_small & is_smaller)
    }

    #[inline(always)]
    fn refine(&self, x: F) -> (F, u32) {
        let p = add(self.point, scale(self.half_dir, x));
        let axis_distance = (p[0] * p[0] + p[2] * p[2]).sqrt();
        let across = axis_distance - self.major;
        let outward = p[0] * self.half_dir[0] + p[2] * self.half_dir[2];
        let outward = across * outward / axis_distance;
        let slope = outward + p[1] * self.half_dir[1];
        let from_middle = (across * across + p[1] * p[1]).sqrt();
        let distance = from_middle - F::splat(1.0);
        let step = distance * from_middle / slope;
        let is_small = step.abs().lt(F::splat(REFINEMENT));
        (x - step, F::bitmask(is_small))
    }
}

impl<F: F64Lanes> Quartics<F> {
    #[inline(always)]
    fn new(c: [F; 5], active: u32) -> Self {
        let (none, one) = (F::splat(0.0), F::splat(1.0));
        // As [`crate::base::math::roots::polynomial::is_quartic_positive`].
        let (even, odd) = (c[0] + c[2] + c[4], c[1] + c[3]);
        let inner_even = c[0] - c[4];
        let inner_odd = F::splat(0.5) * (c[1] - c[3]);
        let middle = c[0] - c[2] * F::splat(1.0 / 3.0) + c[4];
        let ends = odd.abs().lt(even);
        let inner = inner_odd.abs().lt(inner_even) & none.lt(middle);
        let unknown = active & !F::bitmask(ends);
        let active = active & F::bitmask(ends) & !F::bitmask(inner);
        let mut quartics = Quartics {
            c,
            low: one,
            high: one,
            at_low: Level::none(),
            at_high: Level::none(),
            active,
            unknown,
        };
        if active == 0 {
            return quartics;
        }
        // Half the second derivative.
        let three_c3 = F::splat(3.0) * c[3];
        let six_c4 = F::splat(6.0) * c[4];
        let mut bends = three_c3.abs().lt(c[2] + six_c4) & six_c4.lt(c[2]);
        let lowest = c[1] / c[2] * F::splat(-0.5);
        let lowest = clamp_to_segment(lowest);
        (quartics.low, quartics.high) = (lowest, lowest);
        if active & !F::bitmask(bends) != 0 {
            // Zeros of half the second derivative.
            let discriminant = three_c3 * three_c3 - F::splat(24.0) * c[2] * c[4];
            bends = bends | discriminant.le(none);
            let root = discriminant.sqrt();
            let is_right = three_c3.lt(none);
            let sum = F::select(is_right, three_c3 - root, three_c3 + root);
            let sum = sum * F::splat(-0.5);
            let (x, other) = (sum / six_c4, c[2] / sum);
            let (low, high) = (
                clamp_to_segment(x.lane_min(other)),
                clamp_to_segment(x.lane_max(other)),
            );
            quartics.low = F::select(bends, lowest, low);
            quartics.high = F::select(bends, lowest, high);
            quartics.at_high = quartics.level(quartics.high);
            quartics.at_low = quartics.level(quartics.low);
        } else {
            quartics.at_low = quartics.level(lowest);
            quartics.at_high = quartics.at_low;
        }
        // Convex quartics lie above their tangents.
        let at = &quartics.at_low;
        let drop = at.slope.abs() * (one + lowest.abs());
        let is_above = bends & drop.lt(at.value);
        quartics.active &= !F::bitmask(is_above);
        quartics
    }

    #[inline(always)]
    fn value_and_slope(&self, x: F) -> (F, F) {
        let c = &self.c;
        let (a, da) = (c[4] * x + c[3], c[4]);
        let (b, db) = (a * x + c[2], da * x + a);
        let (d, dd) = (b * x + c[1], db * x + b);
        (d * x + c[0], dd * x + d)
    }

    #[inline(always)]
    fn level(&self, x: F) -> Level<F> {
        let none = F::splat(0.0);
        let (value, slope) = self.value_and_slope(x);
        Level {
            is_negative: F::bitmask(value.lt(none)),
            rises: F::bitmask(none.lt(slope)),
            falls: F::bitmask(slope.lt(none)),
            value,
            slope,
        }
    }

    /// Bit mask of the quartics known to be negative somewhere.
    #[inline(always)]
    fn inside(&self) -> u32 {
        self.at_low.is_negative | self.at_high.is_negative
    }

    /// The first roots of the active quartics.
    #[inline(always)]
    fn first(&self, active: u32) -> QuarticRoots<F> {
        let (low, high) = (&self.at_low, &self.at_high);
        let tried = low.is_negative | low.rises;
        let mut candidates = self.enter_first(active & tried);
        let behind =
            active & !low.is_negative & !candidates.hit_mask & (high.is_negative | high.falls);
        if behind != 0 {
            let later = self.enter_last(behind);
            candidates.x = F::select(F::mask_from_bits(behind), later.x, candidates.x);
            candidates.hit_mask |= later.hit_mask;
            candidates.unknown |= later.unknown;
        }
        let sure = active & (low.is_negative | high.is_negative);
        candidates.unknown |= sure & !candidates.hit_mask;
        candidates
    }

    /// All roots: entering and leaving ones in turn.
    #[inline(always)]
    fn all(&self) -> [QuarticRoots<F>; 4] {
        let active = self.active;
        let (low, high) = (&self.at_low, &self.at_high);
        let one = F::splat(1.0);
        let mut first = self.enter_first(active & (low.is_negative | low.rises));
        let mut last = self.newton::<false>(&NewtonSearch {
            start: one,
            limit: self.high,
            heading: -one,
            active: active & (high.is_negative | high.falls),
        });
        // Between the two inflections a quartic that is negative at both may rise above zero.
        let both = low.is_negative & high.is_negative & low.rises & high.falls;
        let from_low = active & low.is_negative & (both | !high.is_negative);
        let from_above = first.hit_mask & !low.is_negative;
        let heading = F::select(F::mask_from_bits(from_low), one, -one);
        let mut second = self.newton::<false>(&NewtonSearch {
            start: self.low,
            limit: F::select(F::mask_from_bits(from_low), self.high, -one),
            heading,
            active: from_low | from_above,
        });
        let third_active = high.is_negative & (!low.is_negative | second.hit_mask)
            | high.falls & !high.is_negative;
        let mut third = self.enter_last(active & third_active);
        // Roots come in pairs.
        first.unknown |= active & low.is_negative & !first.hit_mask;
        last.unknown |= active & high.is_negative & !last.hit_mask;
        second.unknown |=
            (first.hit_mask ^ second.hit_mask) & active & !(low.is_negative & high.is_negative);
        third.unknown |=
            (last.hit_mask ^ third.hit_mask) & active & !(low.is_negative & high.is_negative);
        third.unknown |=
            (second.hit_mask ^ third.hit_mask) & active & low.is_negative & high.is_negative;
        [first, second, third, last]
    }

    /// The entering roots on the first convex piece.
    #[inline(always)]
    fn enter_first(&self, active: u32) -> QuarticRoots<F> {
        let one = F::splat(1.0);
        self.newton::<true>(&NewtonSearch {
            start: -one,
            limit: self.low,
            heading: one,
            active,
        })
    }

    /// The entering roots on the concave piece, or after it on the second convex piece.
    #[inline(always)]
    fn enter_last(&self, active: u32) -> QuarticRoots<F> {
        let one = F::splat(1.0);
        let bends_down = F::mask_from_bits(self.at_high.is_negative);
        self.newton::<true>(&NewtonSearch {
            start: self.high,
            limit: F::select(bends_down, self.low, one),
            heading: F::select(bends_down, -one, one),
            active,
        })
    }

    /// Newton iterations towards entering or leaving roots, from sides on which they cannot pass them.
    #[inline(always)]
    fn newton<const ENTERS: bool>(&self, search: &NewtonSearch<F>) -> QuarticRoots<F> {
        let mut x = search.start;
        let none = F::splat(0.0);
        let mut arrived = F::mask_from_bits(0);
        let mut walking = F::mask_from_bits(search.active);
        let mut left = search.active;
        for _ in 0..MAX_STEPS {
            if left == 0 {
                break;
            }
            let (value, slope) = self.value_and_slope(x);
            let (slope, side) = if ENTERS {
                (slope, search.heading)
            } else {
                (slope, -search.heading)
            };
            let height = value * side;
            let is_descending = if ENTERS {
                slope.lt(none)
            } else {
                none.lt(slope)
            };
            let next = x - value / slope;
            let is_within = ((next - search.limit) * search.heading).le(none);
            let moves = (none.lt(height) & is_descending) & is_within;
            let moves = walking & moves;
            let step = (next - x).abs();
            let is_last = moves & step.lt(F::splat(LAST_STEP));
            let has_arrived = walking & height.le(none);
            arrived = arrived | (has_arrived | is_last);
            x = F::select(moves, next, x);
            walking = moves & F::splat(LAST_STEP).le(step);
            left = F::bitmask(walking);
        }
        QuarticRoots {
            x,
            hit_mask: F::bitmask(arrived),
            unknown: left,
        }
    }
}

/// `radius² − distance²`.
#[inline(always)]
fn within<F: F64Lanes>(radius: f64, distance: F) -> F {
    let radius = F::splat(radius);
    (radius - distance) * (radius + distance)
}

/// Clamps a parameter to the segment.
#[inline(always)]
fn clamp_to_segment<F: F64Lanes>(x: F) -> F {
    let one = F::splat(1.0);
    x.lane_max(-one).lane_min(one)
}

impl<F: F64Lanes> Level<F> {
    /// The empty value, without lanes.
    #[inline(always)]
    fn none() -> Self {
        Level {
            is_negative: 0,
            rises: 0,
            falls: 0,
            value: F::splat(0.0),
            slope: F::splat(0.0),
        }
    }
}

#[cfg(test)]
mod tests;
