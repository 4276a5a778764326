//! Ten-digit search for roots of a superellipsoid, and for proof that there is none.
//!
//! A claim that there is no root keeps [`SLACK`] away from zero; closer calls are decided by the exact norm. A root
//! ends with a Newton step from the exact norm, so that its error is that of the exact norm, too.

use super::exact::{Along, end};
use super::norms::{TINY, derivatives, norm, norm_and_derivatives};
use super::{Crossings, RootRange, Superellipsoid, alternating, root};
use crate::base::math::Ray;
use crate::base::math::powers::POWER_ERROR;
use crate::base::math::roots::bracket::Roots;
use crate::base::math::roots::interval_roots::{
    Interval, IntervalFunction, monotone_root, sign_changes,
};
use crate::base::math::simd::vec3::{abs, add, dot, scale};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::scene::shape::ray_packet::RayPacket;
use glam::DVec3;

/// Upper bound of the relative error of a rough norm and of a rough slope, for powers within [`POWERS`].
pub(super) const SLACK: f64 = 100.0 * POWER_ERROR;
/// Powers for which the errors are known: beyond, one of the terms dominates, or the norm has no bound.
const POWERS: std::ops::Range<f64> = 1.0 / 16.0..256.0;
/// A Newton step shorter than this, relative to the ends, ends the rough part.
pub(super) const LAST_ROUGH_STEP: f64 = 1e-7;
/// And the exact part: the slope is right to as many digits as the previous step has left of the root.
const LAST_STEP: f64 = 1e-9;
/// Roots that need more steps are so close that full precision is needed.
pub(super) const MAX_STEPS: u32 = 24;
/// More exact steps than a rough root needs.
const MAX_EXACT_STEPS: u32 = 4;
/// Pieces that need more bisections are searched in full precision.
const MAX_HALVINGS: u32 = 24;

/// The norm along a ray, to ten digits.
pub(super) struct Rough<'s> {
    pub(super) shape: &'s Superellipsoid,
    pub(super) ray: Ray,
}

/// Result of the search for where a convex norm falls below 1.
#[derive(Clone, Copy)]
pub(super) enum Estimate {
    /// Certainly nowhere.
    None,
    /// Very near this `t`, with this slope.
    Near(f64, f64),
    /// Undecided at this precision.
    Unclear,
}

impl Superellipsoid {
    /// True if the powers are neither too large nor too small for ten digits.
    pub(super) fn has_rough(&self) -> bool {
        POWERS.contains(&self.across) && POWERS.contains(&self.along)
    }

    /// Excess of the norm over 1 at points of rays, and its slopes along them.
    #[inline(always)]
    pub(super) fn rough_at<F: F64Lanes>(&self, rays: &RayPacket<F>, t: F) -> (F, F) {
        let p = add(rays.origin, scale(rays.dir, t));
        let [x, y, z] = abs(p);
        let (ring, [of_x, of_y]) = norm_and_derivatives(x, y, self.across);
        let (size, [of_ring, of_z]) = norm_and_derivatives(ring, z, self.along);
        let gradient = [of_ring * of_x, of_ring * of_y, of_z];
        let growth = [
            rays.dir[0].xor_sign(p[0]),
            rays.dir[1].xor_sign(p[1]),
            rays.dir[2].xor_sign(p[2]),
        ];
        (size - F::splat(1.0), dot(gradient, growth))
    }
}

impl<'s> Rough<'s> {
    /// `None` for powers that are too large or too small.
    pub(super) fn new(shape: &'s Superellipsoid, ray: &Ray) -> Option<Self> {
        shape.has_rough().then_some(Rough { shape, ray: *ray })
    }

    /// Excess of the norm over 1, and its slope along the ray.
    pub(super) fn at(&self, t: f64) -> (f64, f64) {
        self.shape.rough_at(&RayPacket::of(&self.ray), t)
    }

    /// The root of the exact norm near `t`, where the slope is known to ten digits. `None` if it is not that near.
    pub(super) fn sharpened(&self, mut t: f64, slope: f64, scale: f64) -> Option<f64> {
        let along = Along {
            shape: self.shape,
            ray: self.ray,
        };
        for _ in 0..MAX_EXACT_STEPS {
            let next = t - along.value(t) / slope;
            let step = (next - t).abs();
            t = next;
            if step <= LAST_STEP * scale {
                return Some(t);
            }
        }
        None
    }

    /// The single root of a monotone piece.
    fn root(&self, along: &Along, ends: [f64; 2], is_rising: bool) -> f64 {
        let [mut low, mut high] = ends;
        let scale = low.abs().max(high.abs());
        let mut t = 0.5 * (low + high);
        for _ in 0..MAX_STEPS {
            let (value, slope) = self.at(t);
            if (value < 0.0) == is_rising {
                low = t;
            } else {
                high = t;
            }
            let next = t - value / slope;
            let is_between = low <= next && next <= high;
            if is_between && (next - t).abs() <= LAST_ROUGH_STEP * scale {
                match self.sharpened(next, slope, scale) {
                    Some(t) if ends[0] <= t && t <= ends[1] => return t,
                    _ => break,
                }
            }
            t = if is_between { next } else { 0.5 * (low + high) };
        }
        monotone_root(along, ends, is_rising)
    }
}

/// The norm on the pieces of a ray on which no coordinate changes sign.
pub(super) struct Pieces<'s> {
    rough: Rough<'s>,
    exact: &'s Along<'s>,
    range: RootRange,
}

/// Bounds of the norm on a piece.
struct Bounded {
    /// Excess of the norm over 1.
    values: Interval,
    slopes: Interval,
    /// Excess in the middle.
    value: f64,
}

impl<'s> Pieces<'s> {
    pub(super) fn new(rough: Rough<'s>, exact: &'s Along<'s>, range: RootRange) -> Self {
        Pieces {
            rough,
            exact,
            range,
        }
    }

    /// Appends the needed roots between stops among which no coordinate changes its sign; the first and the last stop
    /// are outside.
    pub(super) fn all_roots(&self, stops: &[f64], roots: &mut Crossings) {
        let count = stops.len() - 1;
        let is_above = self.rough.is_above(stops);
        let is_empty = |piece: usize| is_above >> piece & 1 == 1;
        // Side on which the next piece starts, if known.
        let mut side = Some(false);
        for piece in 0..count {
            let [from, to] = [stops[piece], stops[piece + 1]];
            if is_empty(piece) {
                side = Some(false);
                continue;
            }
            if self.range.is_before(to) {
                side = None;
                continue;
            }
            let starts_inside = side.unwrap_or_else(|| self.is_inside(from));
            let ends_inside = piece + 1 < count && !is_empty(piece + 1) && self.is_inside(to);
            if self.roots([(from, starts_inside), (to, ends_inside)], roots) {
                return;
            }
            side = Some(ends_inside);
        }
    }

    /// True if the norm is below 1 at `t`.
    fn is_inside(&self, t: f64) -> bool {
        self.is_below(self.rough.at(t).0, t)
    }

    /// The same, given the rough value.
    fn is_below(&self, rough: f64, t: f64) -> bool {
        if rough.abs() > SLACK {
            rough < 0.0
        } else {
            self.exact.value(t) < 0.0
        }
    }

    /// As [`sign_changes`] of the exact norm, up to the first root beyond which none is needed. Returns true if that
    /// root was reached.
    fn roots(&self, ends: [(f64, bool); 2], roots: &mut Crossings) -> bool {
        let [from, to] = ends.map(|(t, _)| t);
        if self.is_monotone(from, to) {
            return ends[0].1 != ends[1].1 && self.push_root(ends, roots);
        }
        self.search(ends, MAX_HALVINGS, roots)
    }

    /// True if the magnitudes of all coordinates grow, or all shrink. False near the axis, where a slope may be NaN.
    fn is_monotone(&self, from: f64, to: f64) -> bool {
        let Ray { dir, .. } = self.rough.ray;
        let growth = self.rough.ray.at(0.5 * (from + to)).signum() * dir;
        let (least, _) = self.exact.reach(from, to);
        let is_uniform = growth.min_element() >= 0.0 || growth.max_element() <= 0.0;
        is_uniform && least.x.max(least.y) > 1e10 * TINY
    }

    /// Appends the single root of a monotone piece with a change. Returns true if none beyond it is needed.
    fn push_root(
        &self,
        [(from, starts_inside), (to, _)]: [(f64, bool); 2],
        roots: &mut Crossings,
    ) -> bool {
        let t = self.rough.root(self.exact, [from, to], starts_inside);
        roots.push(root(t, starts_inside));
        self.range.is_enough(t)
    }

    fn search(&self, ends: [(f64, bool); 2], depth: u32, roots: &mut Crossings) -> bool {
        let [(from, starts_inside), (to, ends_inside)] = ends;
        if self.range.is_before(to) {
            return false;
        }
        let is_change = starts_inside != ends_inside;
        let middle = 0.5 * (from + to);
        if !is_change && !starts_inside {
            let quarter = 0.5 * (middle - from);
            let stops = [from, from + quarter, middle, middle + quarter, to];
            if self.rough.is_above(&stops) == 0b1111 {
                return false;
            }
        }
        let bounded = self.bounded(from, to, middle);
        if !is_change && (bounded.values.low > SLACK || bounded.values.high < -SLACK) {
            return false;
        }
        let Interval { low, high } = bounded.slopes;
        if low >= 0.0 || high <= 0.0 {
            return is_change && self.push_root(ends, roots);
        }
        let change = 0.5 * (to - from) * high.max(-low);
        if !is_change && bounded.value.abs() > change + SLACK {
            return false;
        }
        if depth == 0 {
            let mut params = Roots::new();
            sign_changes(self.exact, ends.map(end), &mut params);
            roots.extend(alternating(&params, starts_inside));
            return params.iter().any(|t| self.range.is_enough(*t));
        }
        let half = (middle, self.is_below(bounded.value, middle));
        self.search([ends[0], half], depth - 1, roots)
            || self.search([half, ends[1]], depth - 1, roots)
    }

    /// Bounds that include the error of the slopes.
    fn bounded(&self, from: f64, to: f64, middle: f64) -> Bounded {
        let (least, most) = self.exact.reach(from, to);
        let corners = Corners {
            shape: self.rough.shape,
            points: [least, most, self.rough.ray.at(middle).abs()],
        };
        let [sizes, of_plane, of_size] = with_widest(|lanes| lanes.run(corners));
        // The sign of the growth of each coordinate's magnitude is the same on all of the piece.
        let growth = self.rough.ray.at(middle).signum() * self.rough.ray.dir;
        let by_ring = [of_size[0].min(of_size[1]), of_size[0].max(of_size[1])];
        let mut slopes = Interval::new(0.0, 0.0);
        for (axis, [a, b]) in [
            [of_plane[0], of_plane[1]],
            [of_plane[2], of_plane[3]],
            [of_size[2], of_size[3]],
        ]
        .into_iter()
        .enumerate()
        {
            if growth[axis] == 0.0 {
                continue;
            }
            let mut rates = [a.min(b), a.max(b)];
            if axis < 2 {
                rates = [rates[0] * by_ring[0], rates[1] * by_ring[1]];
            }
            let rates = [rates[0] * (1.0 - SLACK), rates[1] * (1.0 + SLACK)];
            let [a, b] = rates.map(|rate| rate * growth[axis]);
            slopes.low += a.min(b);
            slopes.high += a.max(b);
        }
        if slopes.low.is_nan() || slopes.high.is_nan() {
            slopes = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        }
        let excess = |size: f64| size - 1.0;
        Bounded {
            values: Interval {
                low: excess(sizes[0] * (1.0 - SLACK)),
                high: excess(sizes[1] * (1.0 + SLACK)),
            },
            slopes,
            value: excess(sizes[2]),
        }
    }
}

/// Norms at the nearest and the farthest corner of the box around a piece and in its middle; then the bounds, in some
/// order, of the derivatives of the ring by x and by y, and of the norm by the ring and by z.
struct Corners<'s> {
    shape: &'s Superellipsoid,
    points: [DVec3; 3],
}

impl SimdKernel for Corners<'_> {
    type Output = [[f64; 4]; 3];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [[f64; 4]; 3] {
        let Superellipsoid { across, along } = *self.shape;
        let [least, most, middle] = self.points;
        let x = [least.x, most.x, middle.x, middle.x];
        let y = [least.y, most.y, middle.y, middle.y];
        let z = [least.z, most.z, middle.z, middle.z];
        let ring = norm(F::from_array(&x), F::from_array(&y), across);
        let sizes = norm(ring, F::from_array(&z), along).to_array();
        let ring = ring.to_array();
        let of_plane = derivatives::<F>([[x[0], x[1]], [y[0], y[1]]], [ring[0], ring[1]], across);
        let of_size = derivatives::<F>(
            [[ring[0], ring[1]], [z[0], z[1]]],
            [sizes[0], sizes[1]],
            along,
        );
        [sizes, of_plane, of_size]
    }
}
