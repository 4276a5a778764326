//! Four rays and a convex superellipsoid at once: to the bit what each finds by itself.
//!
//! The rough part of the search is gone in lanes. Rays for which it is not clear, and those that start within the box, are
//! left to be asked for singly.

use super::rough::{LAST_ROUGH_STEP, MAX_STEPS, Rough, SLACK};
use super::{REACH, STEEP, Superellipsoid};
use crate::base::math::Ray;
use crate::base::math::conditioning::{COMFORTABLE_SQUARE, FAR_SQUARE};
use crate::base::math::simd::three::{dot, largest};
use crate::base::math::simd::{F64Lanes, F64x4, FourKernel, four, with_widest};
use crate::scene::shape::packet::{RayPacket, plus, scaled};
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
        with_widest(|lanes| four(lanes, &LeftBehind(self, asked)))
    }

    /// Where those of four rays that are asked for enter; not of those that have just left it.
    pub(crate) fn nearest_of_four(&self, asked: &FourAsked) -> FourFound {
        with_widest(|lanes| four(lanes, &Entering(self, asked)))
    }

    /// Newton's iteration from where the rays enter the box, as that of [`Rough::first_inside`].
    #[inline(always)]
    fn entries<F: F64Lanes>(&self, clipped: &Clipped<F>, mut asked: u32) -> Entries<F> {
        let Clipped { rays, from, to, .. } = clipped;
        let slack = F::all(SLACK);
        let falling = F::all(-SLACK).times(dot(rays.dir, rays.dir).root());
        let last = F::all(LAST_ROUGH_STEP).times(from.size().larger(to.size()));
        let mut entries = Entries {
            t: *from,
            slope: F::all(0.0),
            near: 0,
            unclear: 0,
        };
        for _ in 0..MAX_STEPS {
            let t = entries.t;
            let (value, slope) = self.rough_at(rays, t);
            let next = t.minus(value.over(slope));
            let falls = slope.below(falling);
            let is_there = F::bits(value.size().not_above(slack)) & asked;
            let goes_on = F::both(falls, F::all(0.0).not_above(to.minus(next)));
            let turns = !F::bits(goes_on) & asked & !is_there;
            let rest = slope.times(to.minus(t)).smaller(F::all(0.0)).plus(value);
            let is_clear = F::both(F::all(0.0).below(value), F::all(8.0 * SLACK).below(rest));
            let is_last =
                F::bits(next.minus(t).size().not_above(last)) & asked & !is_there & !turns;
            let falls = F::bits(falls);
            entries.unclear |= is_there & !falls | turns & !F::bits(is_clear);
            entries.near |= is_there & falls | is_last;
            entries.slope = F::pick(F::mask(asked), slope, entries.slope);
            entries.t = F::pick(F::mask(asked & !is_there), next, t);
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

impl FourKernel for LeftBehind<'_> {
    type Answer = u32;

    #[inline(always)]
    fn run<F: F64x4>(&self) -> u32 {
        let LeftBehind(shape, asked) = self;
        let rays = asked.rays::<F>();
        let is_near = largest(rays.origin).not_above(F::all(REACH));
        let (_, slope) = shape.rough_at(&rays, F::all(0.0));
        let least = F::all(STEEP).times(dot(rays.dir, rays.dir).root());
        F::bits(F::both(is_near, least.below(slope)))
    }
}

/// Asks where four rays enter the shape.
struct Entering<'a>(&'a Superellipsoid, &'a FourAsked);

impl FourKernel for Entering<'_> {
    type Answer = FourFound;

    #[inline(always)]
    fn run<F: F64x4>(&self) -> FourFound {
        let Entering(shape, asked) = self;
        let rays = asked.rays::<F>();
        let (from, far) = (F::load(&asked.from), F::load(&asked.far));
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
        let (mut t, slopes) = (entries.t.store(), entries.slope.store());
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
        let t = F::load(&t).plus(clipped.middle);
        let steep = F::all(-STEEP).times(dot(rays.dir, rays.dir).root());
        let is_seen = F::bits(F::both(from.below(t), entries.slope.below(steep)));
        let is_within = F::bits(t.not_above(far));
        found.t = t.store();
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
        let one_of = |of: &[F; 3]| DVec3::from_array(of.map(|of| of.store()[lane]));
        let ray = Ray::new(one_of(&self.rays.origin), one_of(&self.rays.dir));
        let scale = self.from.store()[lane]
            .abs()
            .max(self.to.store()[lane].abs());
        Rough::new(shape, &ray)?.sharpened(t, slope, scale)
    }
}

/// Which rays need not be rescaled, one bit each.
#[inline(always)]
fn comfortable<F: F64Lanes>(rays: &RayPacket<F>) -> u32 {
    let (dir_sq, origin_sq) = (dot(rays.dir, rays.dir), dot(rays.origin, rays.origin));
    let is_dir = F::both(
        F::all(1.0 / COMFORTABLE_SQUARE).not_above(dir_sq),
        dir_sq.below(F::all(COMFORTABLE_SQUARE)),
    );
    F::bits(F::both(is_dir, origin_sq.below(F::all(FAR_SQUARE))))
}

/// As [`super::clip`].
#[inline(always)]
fn clip<F: F64Lanes>(rays: &RayPacket<F>) -> Clipped<F> {
    let endless = F::all(f64::INFINITY);
    let (zero, one) = (F::all(0.0), F::all(1.0));
    let (mut from, mut to) = (endless.negated(), endless);
    let mut passes = 0;
    let mut axis = 0;
    while axis < 3 {
        let (p, d) = (rays.origin[axis], rays.dir[axis]);
        let is_along = d.equals(zero);
        passes |= F::bits(F::both(is_along, one.below(p.size())));
        let (a, b) = (one.negated().minus(p).over(d), one.minus(p).over(d));
        from = F::pick(is_along, from, from.larger(a.smaller(b)));
        to = F::pick(is_along, to, to.smaller(a.larger(b)));
        axis += 1;
    }
    let is_met = F::both(from.below(to), from.size().below(endless));
    let is_met = F::both(is_met, to.size().below(endless));
    let middle = F::all(0.5).times(from.plus(to));
    Clipped {
        rays: RayPacket {
            origin: plus(rays.origin, scaled(rays.dir, middle)),
            dir: rays.dir,
        },
        middle,
        from: from.minus(middle),
        to: to.minus(middle),
        met: F::bits(is_met) & !passes,
    }
}
