//! Rays and a torus, four at once or one: written once, so that all find the same to the bit. Rays that take one of the
//! rarer turns, and spindles, are left to the careful way of [`super::torus`].
//!
//! A line is clipped to the slab and the annulus around the tube. On each stretch that is left the quartic is parted
//! where it begins to bend the other way; a polynomial that bends one way is met by Newton's iteration from the side on
//! which it bends away without ever passing a root, so nothing need be bracketed. Of a quartic that bends up all along
//! the parting is near the lowest point: where that lies above zero, and so does its tangent, nothing is met.

use super::torus::{CLIP, REFINEMENT, Torus};
use crate::base::math::conditioning::is_comfortable_size;
use crate::base::math::simd::F64Lanes;
use crate::scene::shape::packet::{
    NearestPacket, RayPacket, RootPacket, Vec3Lanes, add, dot, is_comfortable, sub,
};
use crate::scene::shape::packet::{scale, splat};

/// Rays from farther away, in minor radii, are left to the careful way: what is rounded there is less than what
/// [`CLIP`] allows for.
const FARTHEST: f64 = (1u64 << 36) as f64;
/// Tori with a major radius beyond so many minor ones are left to it as well.
const THINNEST: f64 = (1u64 << 24) as f64;
/// Rays that go across the axis by less than this share, squared, are left to it.
const STEEPEST_SQUARE: f64 = 1.0 / (1u64 << 20) as f64;
/// A Newton step below this ends the iteration: the step after it would be below the last digit.
const LAST_STEP: f64 = 1e-9;
/// Roots so close to each other that this is not enough are left to the careful way.
const MAX_STEPS: u32 = 32;

/// What lies so many times as far as nothing counts is met for certain.
const ROOM: f64 = 32.0;

/// Where four lines may meet the tube: on two stretches at most.
struct Clipped<F> {
    start: [F; 2],
    end: [F; 2],
    /// Which lines have each stretch, one bit each.
    asked: [u32; 2],
    unknown: u32,
}

/// Stretches of four lines: `middle + x · half` for `-1 <= x <= 1`, about the centre and in units of the minor radius.
#[derive(Clone, Copy)]
struct Stretches<F> {
    /// Parameters of the lines.
    middle: F,
    half: F,
    place: Vec3Lanes<F>,
    way: Vec3Lanes<F>,
    /// The major radius.
    major: F,
}

/// A polynomial's value and slope.
#[derive(Clone, Copy)]
struct Level<F: F64Lanes> {
    is_negative: u32,
    rises: u32,
    falls: u32,
    value: F,
    slope: F,
}

/// Four quartics by rising power, on stretches the ends of which lie outside.
struct Quartics<F: F64Lanes> {
    c: [F; 5],
    /// They bend up as far as `low`, down from there to `high`, and up behind it.
    low: F,
    high: F,
    at_low: Level<F>,
    at_high: Level<F>,
    /// Those that may have roots.
    asked: u32,
    unknown: u32,
}

/// Roots of four quartics, one at most each.
struct Places<F> {
    x: F,
    found: u32,
    unknown: u32,
}

/// A search for one root of each quartic.
struct Quest<F> {
    start: F,
    limit: F,
    /// One to the right, less one to the left.
    heading: F,
    asked: u32,
}

impl Torus {
    /// Whether [`Torus::roots_of_four`] knows anything.
    pub(crate) fn has_four(&self) -> bool {
        0.0 < self.minor
            && self.minor <= self.major
            && self.major < THINNEST * self.minor
            && is_comfortable_size(self.major + self.minor)
    }

    /// Which of four rays that go out from the surface have left the torus for good: there it lies on one side of the
    /// tangent plane.
    #[inline(always)]
    pub(crate) fn four_left_behind<F: F64Lanes>(&self, rays: &RayPacket<F>) -> F::Mask {
        let p = sub(rays.origin, splat(self.centre));
        let is_known = is_comfortable(dot(rays.dir, rays.dir), dot(p, p));
        let across_sq = p[0] * p[0] + p[2] * p[2];
        let is_outer = F::splat(self.major * self.major).le(across_sq);
        let is_known = is_known & is_outer;
        if self.has_four() {
            is_known
        } else {
            F::mask_from_bits(0)
        }
    }

    /// The roots of four rays.
    #[inline(always)]
    pub(crate) fn roots_of_four<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RootPacket<F> {
        let rays = self.about(rays);
        let clipped = self.clip_four(&rays, 0b1111);
        self.all_roots(&rays, &clipped)
    }

    /// The first roots of those of four rays that are `there`; as [`RootPacket::nearest`], but if `any` will do the
    /// distance is that of some place within the solid.
    #[inline(always)]
    pub(crate) fn nearest_of_four<F: F64Lanes, const ANY: bool>(
        &self,
        rays: &RayPacket<F>,
        (from, far): (F, F),
        left: [u32; 2],
        there: u32,
    ) -> NearestPacket<F> {
        let rays = self.about(rays);
        let mut clipped = self.clip_four(&rays, there);
        let mut begun = left[0] | left[1];
        for part in 0..2 {
            let asked = clipped.asked[part];
            if asked == 0 {
                continue;
            }
            let is_ahead = F::bitmask(from.le(clipped.start[part]));
            let is_over = F::bitmask(clipped.end[part].le(from));
            begun |= asked & !is_ahead & !is_over;
            if left == [0, 0] {
                let is_within = F::bitmask(clipped.start[part].le(far));
                clipped.asked[part] = asked & is_within & !is_over;
            }
        }
        if begun & (clipped.asked[0] | clipped.asked[1]) != 0 {
            return self.all_roots(&rays, &clipped).nearest(from, far, left);
        }
        let mut nearest = NearestPacket {
            t: F::splat(f64::INFINITY),
            leaves: 0,
            met: 0,
            unknown: clipped.unknown,
        };
        for part in 0..2 {
            let asked = clipped.asked[part] & !nearest.met & !nearest.unknown;
            if asked == 0 {
                continue;
            }
            let (start, end) = (clipped.start[part], clipped.end[part]);
            let stretches = self.stretches(&rays, start, end);
            let quartics = stretches.quartics(asked);
            nearest.unknown |= quartics.unknown;
            let mut asked = quartics.asked;
            if ANY {
                // Somewhere inside, with room to both ends.
                let is_clear = (from * F::splat(ROOM)).lt(start) & end.lt(far);
                let inside = quartics.inside() & asked & F::bitmask(is_clear);
                nearest.t = F::select(F::mask_from_bits(inside), stretches.middle, nearest.t);
                nearest.met |= inside;
                asked &= !inside;
            }
            if asked == 0 {
                continue;
            }
            let first = quartics.first(asked);
            let (x, refined) = stretches.refined(first.x);
            let t = stretches.middle + stretches.half * x;
            nearest.unknown |= first.unknown | first.found & !refined;
            let is_within = from.lt(t) & t.le(far);
            let met = first.found & refined & F::bitmask(is_within);
            nearest.t = F::select(F::mask_from_bits(met), t, nearest.t);
            nearest.met |= met;
        }
        nearest
    }

    /// The rays about the centre.
    #[inline(always)]
    fn about<F: F64Lanes>(&self, rays: &RayPacket<F>) -> RayPacket<F> {
        RayPacket {
            origin: sub(rays.origin, splat(self.centre)),
            dir: rays.dir,
        }
    }

    /// Where lines run between the planes and the cylinders around the tube.
    #[inline(always)]
    fn clip_four<F: F64Lanes>(&self, rays: &RayPacket<F>, there: u32) -> Clipped<F> {
        let (origin, dir) = (rays.origin, rays.dir);
        let none = F::splat(0.0);
        let (dir_sq, origin_sq) = (dot(dir, dir), dot(origin, origin));
        let mut clipped = Clipped {
            start: [none; 2],
            end: [none; 2],
            asked: [0; 2],
            unknown: 0,
        };
        let height = self.minor * CLIP;
        let rim = self.major + height;
        let across_sq = dir[0] * dir[0] + dir[2] * dir[2];
        let farthest = FARTHEST * self.minor;
        let is_known =
            is_comfortable(dir_sq, origin_sq) & origin_sq.lt(F::splat(farthest * farthest));
        clipped.unknown = there & !F::bitmask(is_known);
        // From the point nearest to the centre on.
        let nearest = -dot(origin, dir) / dir_sq;
        let p = add(origin, scale(dir, nearest));
        let is_near = dot(p, p).lt(F::splat(rim * rim + height * height));
        if F::bitmask(is_near) & there & !clipped.unknown == 0 {
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
        let is_met = none.lt(in_rim) & first.lt(last);
        clipped.unknown |= there & F::bitmask(is_near) & !F::bitmask(is_flat & is_slanted);
        let asked = there & F::bitmask(is_near & is_met) & !clipped.unknown;
        // The hole parts the stretch in two.
        let (mut part_end, mut part_start) = (last, last);
        let hole = self.major - height;
        if hole > 0.0 {
            let in_hole = within(hole, distance);
            let reach = (in_hole * inverse).sqrt();
            let is_in_hole = none.lt(in_hole);
            part_end = F::select(is_in_hole, (axis - reach).lane_min(last), last);
            part_start = F::select(is_in_hole, (axis + reach).lane_max(first), last);
        }
        clipped.asked = [
            asked & F::bitmask(first.lt(part_end)),
            asked & F::bitmask(part_start.lt(last)),
        ];
        clipped.start = [nearest + first, nearest + part_start];
        clipped.end = [nearest + part_end, nearest + last];
        clipped
    }

    /// All roots on the stretches.
    #[inline(always)]
    fn all_roots<F: F64Lanes>(&self, rays: &RayPacket<F>, clipped: &Clipped<F>) -> RootPacket<F> {
        let mut roots = RootPacket::none(clipped.unknown);
        for part in 0..2 {
            let asked = clipped.asked[part] & !roots.unknown;
            if asked == 0 {
                continue;
            }
            let stretches = self.stretches(rays, clipped.start[part], clipped.end[part]);
            let quartics = stretches.quartics(asked);
            roots.unknown |= quartics.unknown;
            if quartics.asked == 0 {
                continue;
            }
            let places = quartics.all();
            let mut last = F::splat(-1.0);
            for (place, places) in places.into_iter().enumerate() {
                roots.unknown |= places.unknown;
                if places.found == 0 {
                    continue;
                }
                let (x, refined) = stretches.refined(places.x);
                roots.unknown |= places.found & !refined;
                // Of a pair that is closer than can be told the second is drawn to the first.
                let x = x.lane_max(last);
                last = F::select(F::mask_from_bits(places.found), x, last);
                let at = 4 * part + place;
                roots.t[at] = stretches.middle + stretches.half * x;
                roots.met[at] = places.found;
            }
        }
        roots
    }

    #[inline(always)]
    fn stretches<F: F64Lanes>(&self, rays: &RayPacket<F>, from: F, to: F) -> Stretches<F> {
        let middle = F::splat(0.5) * (from + to);
        let half = F::splat(0.5) * (to - from);
        let unit = 1.0 / self.minor;
        let place = add(rays.origin, scale(rays.dir, middle));
        Stretches {
            middle,
            half,
            place: scale(place, F::splat(unit)),
            way: scale(rays.dir, half * F::splat(unit)),
            major: F::splat(self.major / self.minor),
        }
    }
}

impl<F: F64Lanes> Stretches<F> {
    /// The quartics `((a + b) / 2R)² + b` (see [`super::torus`]), and what is known of their roots.
    #[inline(always)]
    fn quartics(&self, asked: u32) -> Quartics<F> {
        let (p, v) = (self.place, self.way);
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
        Quartics::new(c, asked)
    }

    /// One Newton step on the distance from the tube, and which of them are small enough to be trusted.
    #[inline(always)]
    fn refined(&self, x: F) -> (F, u32) {
        let (x, is_small) = self.refine(x);
        let (x, is_smaller) = self.refine(x);
        (x, is_small & is_smaller)
    }

    #[inline(always)]
    fn refine(&self, x: F) -> (F, u32) {
        let p = add(self.place, scale(self.way, x));
        let axis_distance = (p[0] * p[0] + p[2] * p[2]).sqrt();
        let across = axis_distance - self.major;
        let outward = p[0] * self.way[0] + p[2] * self.way[2];
        let outward = across * outward / axis_distance;
        let slope = outward + p[1] * self.way[1];
        let from_middle = (across * across + p[1] * p[1]).sqrt();
        let distance = from_middle - F::splat(1.0);
        let step = distance * from_middle / slope;
        let is_small = step.abs().lt(F::splat(REFINEMENT));
        (x - step, F::bitmask(is_small))
    }
}

impl<F: F64Lanes> Quartics<F> {
    #[inline(always)]
    fn new(c: [F; 5], asked: u32) -> Self {
        let (none, one) = (F::splat(0.0), F::splat(1.0));
        // As [`crate::base::math::roots::polynomial::is_quartic_positive`].
        let (even, odd) = (c[0] + c[2] + c[4], c[1] + c[3]);
        let inner_even = c[0] - c[4];
        let inner_odd = F::splat(0.5) * (c[1] - c[3]);
        let middle = c[0] - c[2] * F::splat(1.0 / 3.0) + c[4];
        let ends = odd.abs().lt(even);
        let inner = inner_odd.abs().lt(inner_even) & none.lt(middle);
        let unknown = asked & !F::bitmask(ends);
        let asked = asked & F::bitmask(ends) & !F::bitmask(inner);
        let mut quartics = Quartics {
            c,
            low: one,
            high: one,
            at_low: Level::none(),
            at_high: Level::none(),
            asked,
            unknown,
        };
        if asked == 0 {
            return quartics;
        }
        // Half the second derivative.
        let three_c3 = F::splat(3.0) * c[3];
        let six_c4 = F::splat(6.0) * c[4];
        let mut bends = three_c3.abs().lt(c[2] + six_c4) & six_c4.lt(c[2]);
        let lowest = c[1] / c[2] * F::splat(-0.5);
        let lowest = on_stretch(lowest);
        (quartics.low, quartics.high) = (lowest, lowest);
        if asked & !F::bitmask(bends) != 0 {
            // Where half the second derivative is zero.
            let discriminant = three_c3 * three_c3 - F::splat(24.0) * c[2] * c[4];
            bends = bends | discriminant.le(none);
            let root = discriminant.sqrt();
            let is_right = three_c3.lt(none);
            let sum = F::select(is_right, three_c3 - root, three_c3 + root);
            let sum = sum * F::splat(-0.5);
            let (x, other) = (sum / six_c4, c[2] / sum);
            let (low, high) = (on_stretch(x.lane_min(other)), on_stretch(x.lane_max(other)));
            quartics.low = F::select(bends, lowest, low);
            quartics.high = F::select(bends, lowest, high);
            quartics.at_high = quartics.level(quartics.high);
            quartics.at_low = quartics.level(quartics.low);
        } else {
            quartics.at_low = quartics.level(lowest);
            quartics.at_high = quartics.at_low;
        }
        // Above their tangents all along.
        let at = &quartics.at_low;
        let drop = at.slope.abs() * (one + lowest.abs());
        let is_above = bends & drop.lt(at.value);
        quartics.asked &= !F::bitmask(is_above);
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

    /// Those that are known to be below zero somewhere.
    #[inline(always)]
    fn inside(&self) -> u32 {
        self.at_low.is_negative | self.at_high.is_negative
    }

    /// The first roots of some of them.
    #[inline(always)]
    fn first(&self, asked: u32) -> Places<F> {
        let (low, high) = (&self.at_low, &self.at_high);
        let tried = low.is_negative | low.rises;
        let mut places = self.enter_first(asked & tried);
        let behind = asked & !low.is_negative & !places.found & (high.is_negative | high.falls);
        if behind != 0 {
            let later = self.enter_last(behind);
            places.x = F::select(F::mask_from_bits(behind), later.x, places.x);
            places.found |= later.found;
            places.unknown |= later.unknown;
        }
        let sure = asked & (low.is_negative | high.is_negative);
        places.unknown |= sure & !places.found;
        places
    }

    /// All roots: in turn those that enter and those that leave.
    #[inline(always)]
    fn all(&self) -> [Places<F>; 4] {
        let asked = self.asked;
        let (low, high) = (&self.at_low, &self.at_high);
        let one = F::splat(1.0);
        let mut first = self.enter_first(asked & (low.is_negative | low.rises));
        let mut last = self.walk::<false>(&Quest {
            start: one,
            limit: self.high,
            heading: -one,
            asked: asked & (high.is_negative | high.falls),
        });
        // Between the two turns, if it is below zero at both, it may rise above.
        let both = low.is_negative & high.is_negative & low.rises & high.falls;
        let from_low = asked & low.is_negative & (both | !high.is_negative);
        let from_above = first.found & !low.is_negative;
        let heading = F::select(F::mask_from_bits(from_low), one, -one);
        let mut second = self.walk::<false>(&Quest {
            start: self.low,
            limit: F::select(F::mask_from_bits(from_low), self.high, -one),
            heading,
            asked: from_low | from_above,
        });
        let third_asked =
            high.is_negative & (!low.is_negative | second.found) | high.falls & !high.is_negative;
        let mut third = self.enter_last(asked & third_asked);
        // Each of a pair is there, or neither.
        first.unknown |= asked & low.is_negative & !first.found;
        last.unknown |= asked & high.is_negative & !last.found;
        second.unknown |=
            (first.found ^ second.found) & asked & !(low.is_negative & high.is_negative);
        third.unknown |= (last.found ^ third.found) & asked & !(low.is_negative & high.is_negative);
        third.unknown |= (second.found ^ third.found) & asked & low.is_negative & high.is_negative;
        [first, second, third, last]
    }

    /// The roots that enter where the quartics bend up first.
    #[inline(always)]
    fn enter_first(&self, asked: u32) -> Places<F> {
        let one = F::splat(1.0);
        self.walk::<true>(&Quest {
            start: -one,
            limit: self.low,
            heading: one,
            asked,
        })
    }

    /// The roots that enter where they bend down, or behind that where they bend up again.
    #[inline(always)]
    fn enter_last(&self, asked: u32) -> Places<F> {
        let one = F::splat(1.0);
        let bends_down = F::mask_from_bits(self.at_high.is_negative);
        self.walk::<true>(&Quest {
            start: self.high,
            limit: F::select(bends_down, self.low, one),
            heading: F::select(bends_down, -one, one),
            asked,
        })
    }

    /// Newton's iterations towards roots that enter or leave, from sides on which they cannot pass them.
    #[inline(always)]
    fn walk<const ENTERS: bool>(&self, quest: &Quest<F>) -> Places<F> {
        let mut x = quest.start;
        let none = F::splat(0.0);
        let mut found = F::mask_from_bits(0);
        let mut walking = F::mask_from_bits(quest.asked);
        let mut left = quest.asked;
        for _ in 0..MAX_STEPS {
            if left == 0 {
                break;
            }
            let (value, slope) = self.value_and_slope(x);
            let (slope, side) = if ENTERS {
                (slope, quest.heading)
            } else {
                (slope, -quest.heading)
            };
            let height = value * side;
            let is_on_its_way = if ENTERS {
                slope.lt(none)
            } else {
                none.lt(slope)
            };
            let next = x - value / slope;
            let is_within = ((next - quest.limit) * quest.heading).le(none);
            let moves = (none.lt(height) & is_on_its_way) & is_within;
            let moves = walking & moves;
            let step = (next - x).abs();
            let is_last = moves & step.lt(F::splat(LAST_STEP));
            let has_arrived = walking & height.le(none);
            found = found | (has_arrived | is_last);
            x = F::select(moves, next, x);
            walking = moves & F::splat(LAST_STEP).le(step);
            left = F::bitmask(walking);
        }
        Places {
            x,
            found: F::bitmask(found),
            unknown: left,
        }
    }
}

/// The difference of the squares of a radius and of distances.
#[inline(always)]
fn within<F: F64Lanes>(radius: f64, distance: F) -> F {
    let radius = F::splat(radius);
    (radius - distance) * (radius + distance)
}

/// The nearest place of a stretch.
#[inline(always)]
fn on_stretch<F: F64Lanes>(x: F) -> F {
    let one = F::splat(1.0);
    x.lane_max(-one).lane_min(one)
}

impl<F: F64Lanes> Level<F> {
    /// Of nobody.
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
mod tests {
    use super::*;
    use crate::base::math::Ray;
    use crate::base::math::sampling::random::Random;
    use crate::scene::shape::Geometry;
    use glam::DVec3;

    /// Rays at a torus: through its tube for the most part, from near and far.
    fn rays(torus: &Torus, rng: &mut Random) -> Vec<Ray> {
        let size = torus.major + torus.minor;
        let ray = |number: usize| {
            let origin = rng.vector(1.0) * size * [2.0, 5.0, 100.0, 1e5][number % 4];
            let (around, across) = (rng.vector(1.0), rng.vector(1.2 * torus.minor));
            let on_circle = DVec3::new(around.x, 0.0, around.z).normalize() * torus.major;
            let aim = if number.is_multiple_of(3) {
                around * size
            } else {
                on_circle + across
            };
            Ray::new(origin, (aim - origin).normalize())
        };
        (0..20_000).map(ray).collect()
    }

    #[test]
    fn the_quick_way_finds_what_the_careful_way_finds() {
        let mut rng = Random::new(41);
        for (major, minor) in [(1.0, 0.3), (1.0, 1.0), (2.0, 0.01), (1.0, 1e-5)] {
            let torus = Torus {
                centre: DVec3::ZERO,
                major,
                minor,
            };
            let (mut unknown, mut crossed, mut twice) = (0, 0, 0);
            for ray in rays(&torus, &mut rng) {
                let careful = torus.careful_crossings(&ray);
                let Some(quick) = torus.quick_crossings(&ray) else {
                    unknown += 1;
                    continue;
                };
                assert_eq!(quick.len(), careful.len(), "{torus:?} {ray:?}");
                for (quick, careful) in quick.iter().zip(&careful) {
                    assert_eq!(quick.crossing, careful.crossing);
                    // Grazing rays: where the surface is nearly along them little is known of the place.
                    let off = (quick.t - careful.t).abs();
                    assert!(off < 1e-6 * (1.0 + careful.t.abs()), "{ray:?} {off:e}");
                }
                let nearest = torus.nearest(&ray, 0.0, f64::INFINITY);
                let first = quick.iter().find(|root| root.t > 0.0).copied();
                assert_eq!(nearest, first, "{torus:?} {ray:?}");
                crossed += usize::from(!quick.is_empty());
                twice += usize::from(quick.len() == 4);
            }
            assert!(unknown < 20 && crossed > 4000, "{unknown} {crossed}");
            assert!(twice > 20 || minor < 0.01, "{twice}");
        }
    }

    #[test]
    fn from_the_outer_half_outward_nothing_is_met() {
        let torus = Torus {
            centre: DVec3::new(0.5, -1.0, 2.0),
            major: 1.0,
            minor: 0.4,
        };
        let mut rng = Random::new(42);
        let (mut left, mut met) = (0, 0);
        for _ in 0..20_000 {
            let outward = rng.vector(1.0).normalize();
            let around = rng.vector(1.0);
            let around = DVec3::new(around.x, 0.0, around.z).normalize();
            let outward = around * outward.x + DVec3::Y * outward.y;
            let outward = outward.normalize();
            let point = torus.centre + torus.major * around + torus.minor * outward;
            let dir = rng.vector(1.0).normalize();
            let dir = if dir.dot(outward) > 0.0 { dir } else { -dir };
            let ray = Ray::new(point, dir);
            let nearest = torus.nearest(&ray, 1e-9, f64::INFINITY);
            if torus.is_exiting(&ray) {
                left += 1;
                assert!(nearest.is_none_or(|root| root.t < 1e-6), "{ray:?}");
            } else {
                met += usize::from(nearest.is_some());
            }
        }
        assert!(left > 8000 && met > 1000, "{left} {met}");
    }
}
