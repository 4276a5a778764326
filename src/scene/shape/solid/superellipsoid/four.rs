//! Four rays and a convex superellipsoid at once: to the bit what each finds by itself.
//!
//! The rough part of the search is gone in lanes. Rays for which it is not clear, and those that start within the box, are
//! left to be asked for singly.

use super::rough::{LAST_ROUGH_STEP, MAX_STEPS, Rough, SLACK};
use super::{REACH, STEEP, Superellipsoid};
use crate::base::math::Ray;
use crate::base::math::conditioning::{COMFORTABLE_SQUARE, FAR_SQUARE};
use crate::base::math::simd::vec3::{dot, max_abs};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::scene::shape::packet::{RayPacket, add, scale};
use crate::scene::shape::packet_search::{FourAsked, FourFound};
use glam::DVec3;

/// Where four rays pass the box from -1 to 1.
struct Clipped<F: F64Lanes> {
    /// About the middles of the stretches.
    rays: RayPacket<F>,
    middle: F,
    from: F,
    to: F,
    met: u32,
}

/// Where four convex sizes fall below 1.
struct Entries<F: F64Lanes> {
    t: F,
    slope: F,
    /// Which do very near there, one bit each.
    near: u32,
    /// Of which it is not known whether they do.
    unclear: u32,
}

impl Superellipsoid {
    /// Whether it can be asked for four rays at once.
    pub(crate) fn has_four(&self) -> bool {
        self.is_convex() && self.has_rough()
    }

    /// Which of four rays that go out from the surface do not meet it again, one bit each.
    #[inline(never)]
    pub(crate) fn four_left_behind(&self, asked: &FourAsked) -> u32 {
        with_widest(|lanes| lanes.run(LeftBehind(self, asked)))
    }

    /// Where those of four rays that are asked for enter; not of those that have just left it.
    pub(crate) fn nearest_of_four(&self, asked: &FourAsked) -> FourFound {
        with_widest(|lanes| lanes.run(Entering(self, asked)))
    }

    /// Newton's iteration from where the rays enter the box, as that of [`Rough::first_inside`].
    #[inline(always)]
    fn entries<F: F64Lanes>(&self, clipped: &Clipped<F>, mut asked: u32) -> Entries<F> {
        let Clipped { rays, from, to, .. } = clipped;
        let slack = F::splat(SLACK);
        let falling = F::splat(-SLACK) * dot(rays.dir, rays.dir).sqrt();
        let last = F::splat(LAST_ROUGH_STEP) * from.abs().lane_max(to.abs());
        let mut entries = Entries {
            t: *from,
            slope: F::splat(0.0),
            near: 0,
            unclear: 0,
        };
        for _ in 0..MAX_STEPS {
            let t = entries.t;
            let (value, slope) = self.rough_at(rays, t);
            let next = t - value / slope;
            let falls = slope.lt(falling);
            let is_there = F::bitmask(value.abs().le(slack)) & asked;
            let goes_on = falls & F::splat(0.0).le(*to - next);
            let turns = !F::bitmask(goes_on) & asked & !is_there;
            let rest = (slope * (*to - t)).lane_min(F::splat(0.0)) + value;
            let is_clear = F::splat(0.0).lt(value) & F::splat(8.0 * SLACK).lt(rest);
            let is_last = F::bitmask((next - t).abs().le(last)) & asked & !is_there & !turns;
            let falls = F::bitmask(falls);
            entries.unclear |= is_there & !falls | turns & !F::bitmask(is_clear);
            entries.near |= is_there & falls | is_last;
            entries.slope = F::select(F::mask_from_bits(asked), slope, entries.slope);
            entries.t = F::select(F::mask_from_bits(asked & !is_there), next, t);
            asked &= !(is_there | turns | is_last);
            if asked == 0 {
                break;
            }
        }
        entries.unclear |= asked;
        entries
    }
}

/// Asks which of four rays do not meet the shape again.
struct LeftBehind<'a>(&'a Superellipsoid, &'a FourAsked);

impl SimdKernel for LeftBehind<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let LeftBehind(shape, asked) = self;
        let rays = asked.rays::<F>();
        let is_near = max_abs(rays.origin).le(F::splat(REACH));
        let (_, slope) = shape.rough_at(&rays, F::splat(0.0));
        let least = F::splat(STEEP) * dot(rays.dir, rays.dir).sqrt();
        F::bitmask(is_near & least.lt(slope))
    }
}

/// Asks where four rays enter the shape.
struct Entering<'a>(&'a Superellipsoid, &'a FourAsked);

impl SimdKernel for Entering<'_> {
    type Output = FourFound;

    #[inline(always)]
    fn run<F: F64x4>(self) -> FourFound {
        let Entering(shape, asked) = self;
        let rays = asked.rays::<F>();
        let (from, far) = (F::from_array(&asked.from), F::from_array(&asked.far));
        let unknown = (asked.left | !comfortable(&rays)) & asked.there;
        let clipped = clip(&rays);
        let mut found = FourFound {
            unknown,
            ..FourFound::default()
        };
        let asked = clipped.met & asked.there & !unknown;
        if asked == 0 {
            return found;
        }
        let entries = shape.entries(&clipped, asked);
        found.unknown |= entries.unclear;
        let (mut t, slopes) = (entries.t.to_array(), entries.slope.to_array());
        let mut near = entries.near;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % 4;
            near &= near - 1;
            match clipped.sharpened(shape, lane, (t[lane], slopes[lane])) {
                Some(exact) => t[lane] = exact,
                None => found.unknown |= 1 << lane,
            }
        }
        let near = entries.near & !found.unknown;
        let t = F::from_array(&t) + clipped.middle;
        let steep = F::splat(-STEEP) * dot(rays.dir, rays.dir).sqrt();
        let is_seen = F::bitmask(from.lt(t) & entries.slope.lt(steep));
        let is_within = F::bitmask(t.le(far));
        found.t = t.to_array();
        found.met = near & is_seen & is_within;
        found.unknown |= near & !is_seen & is_within;
        found
    }
}

impl<F: F64Lanes> Clipped<F> {
    /// The root of the exact size of one ray near a rough one.
    #[inline(never)]
    fn sharpened(
        &self,
        shape: &Superellipsoid,
        lane: usize,
        (t, slope): (f64, f64),
    ) -> Option<f64> {
        let one_of = |of: &[F; 3]| DVec3::from_array(of.map(|of| of.to_array()[lane]));
        let ray = Ray::new(one_of(&self.rays.origin), one_of(&self.rays.dir));
        let scale = self.from.to_array()[lane]
            .abs()
            .max(self.to.to_array()[lane].abs());
        Rough::new(shape, &ray)?.sharpened(t, slope, scale)
    }
}

/// Which rays need not be rescaled, one bit each.
#[inline(always)]
fn comfortable<F: F64Lanes>(rays: &RayPacket<F>) -> u32 {
    let (dir_sq, origin_sq) = (dot(rays.dir, rays.dir), dot(rays.origin, rays.origin));
    let is_dir =
        F::splat(1.0 / COMFORTABLE_SQUARE).le(dir_sq) & dir_sq.lt(F::splat(COMFORTABLE_SQUARE));
    F::bitmask(is_dir & origin_sq.lt(F::splat(FAR_SQUARE)))
}

/// As [`super::clip`].
#[inline(always)]
fn clip<F: F64Lanes>(rays: &RayPacket<F>) -> Clipped<F> {
    let endless = F::splat(f64::INFINITY);
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let (mut from, mut to) = (-endless, endless);
    let mut passes = 0;
    let mut axis = 0;
    while axis < 3 {
        let (p, d) = (rays.origin[axis], rays.dir[axis]);
        let is_along = d.eq(zero);
        passes |= F::bitmask(is_along & one.lt(p.abs()));
        let (a, b) = ((-one - p) / d, (one - p) / d);
        from = F::select(is_along, from, from.lane_max(a.lane_min(b)));
        to = F::select(is_along, to, to.lane_min(a.lane_max(b)));
        axis += 1;
    }
    let is_met = from.lt(to) & from.abs().lt(endless);
    let is_met = is_met & to.abs().lt(endless);
    let middle = F::splat(0.5) * (from + to);
    Clipped {
        rays: RayPacket {
            origin: add(rays.origin, scale(rays.dir, middle)),
            dir: rays.dir,
        },
        middle,
        from: from - middle,
        to: to - middle,
        met: F::bitmask(is_met) & !passes,
    }
}
