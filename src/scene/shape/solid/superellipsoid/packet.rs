//! Intersection of a convex superellipsoid in lanes, bit for bit the same for packets and for single rays.
//!
//! The rough part of the search runs in lanes, which are four rays or both ends of one. Inconclusive lanes, and rays that
//! start within the box, take the scalar path.

use super::rough::{Estimate, LAST_ROUGH_STEP, MAX_STEPS, Rough, SLACK};
use super::{REACH, STEEP, Superellipsoid};
use crate::base::math::Ray;
use crate::base::math::conditioning::{COMFORTABLE_SQUARE, FAR_SQUARE};
use crate::base::math::simd::vec3::{dot, max_abs, splat};
use crate::base::math::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use crate::scene::shape::packet::{add, scale};
use crate::scene::shape::packet_search::{NearestQuery4, NearestResult4, SpanResult4};
use crate::scene::shape::ray_packet::RayPacket;
use glam::DVec3;

/// A ray packet clipped to the box from -1 to 1.
struct Clipped<F: F64Lanes> {
    /// Rays relative to the middles of their intervals.
    rays: RayPacket<F>,
    middle: F,
    from: F,
    to: F,
    hit_mask: u32,
}

/// Points of a packet at which the convex norm falls below 1.
struct Entries<F: F64Lanes> {
    t: F,
    slope: F,
    /// Bit mask of the lanes with a root very near `t`.
    near: u32,
    /// Bit mask of the inconclusive lanes.
    unclear: u32,
}

impl Superellipsoid {
    /// True if ray packets are supported: the norm is convex and ten digits suffice.
    pub(crate) fn supports_packets(&self) -> bool {
        self.is_convex() && self.has_rough()
    }

    /// Packet version of `is_exiting`, as a bit mask.
    #[inline(never)]
    pub(crate) fn is_exiting_packet(&self, query: &NearestQuery4) -> u32 {
        with_widest(|lanes| lanes.run(ExitingKernel(self, query)))
    }

    /// Nearest entering roots of the active lanes; rays that have just left the shape take the scalar path.
    pub(crate) fn nearest_packet(&self, query: &NearestQuery4) -> NearestResult4 {
        with_widest(|lanes| lanes.run(NearestKernel(self, query)))
    }

    /// The span of each ray; ends outside the query's interval may be too far out.
    pub(crate) fn spans(&self, query: &NearestQuery4) -> SpanResult4 {
        with_widest(|lanes| lanes.run(SpanKernel(self, query)))
    }

    /// Where a convex norm falls below 1 on an interval of a ray, from its start and from its end.
    pub(super) fn estimates(&self, ray: &Ray, from: f64, to: f64) -> [Estimate; 2] {
        if !self.has_rough() {
            return [Estimate::Unclear; 2];
        }
        with_widest(|lanes| {
            lanes.run(EndsKernel {
                shape: self,
                ray,
                from,
                to,
            })
        })
    }

    /// Newton's iteration from where the rays enter the box to where a convex norm falls below 1.
    #[inline(always)]
    fn entries<F: F64Lanes>(&self, clipped: &Clipped<F>, mut active: u32) -> Entries<F> {
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
            let is_on_surface = F::bitmask(value.abs().le(slack)) & active;
            let continues = falls & F::splat(0.0).le(*to - next);
            let turns = !F::bitmask(continues) & active & !is_on_surface;
            // Lower bound of a convex function on the remaining interval; the box is less than 4 long.
            let rest = (slope * (*to - t)).lane_min(F::splat(0.0)) + value;
            let is_clear = F::splat(0.0).lt(value) & F::splat(8.0 * SLACK).lt(rest);
            let is_last = F::bitmask((next - t).abs().le(last)) & active & !is_on_surface & !turns;
            let falls = F::bitmask(falls);
            entries.unclear |= is_on_surface & !falls | turns & !F::bitmask(is_clear);
            entries.near |= is_on_surface & falls | is_last;
            entries.slope = F::select(F::mask_from_bits(active), slope, entries.slope);
            entries.t = F::select(F::mask_from_bits(active & !is_on_surface), next, t);
            active &= !(is_on_surface | turns | is_last);
            if active == 0 {
                break;
            }
        }
        entries.unclear |= active;
        entries
    }

    /// Bit mask of the lanes that are certainly inside at `t`.
    #[inline(always)]
    fn inside<F: F64Lanes>(&self, clipped: &Clipped<F>, t: F) -> u32 {
        let (value, _) = self.rough_at(&clipped.rays, t - clipped.middle);
        F::bitmask(value.lt(F::splat(-SLACK)))
    }

    /// As [`Self::entries`], with the roots of the exact norm.
    #[inline(always)]
    fn sharp_entries<F: F64Lanes>(&self, clipped: &Clipped<F>, active: u32) -> Entries<F> {
        let mut entries = self.entries(clipped, active);
        let (mut t, slopes) = (entries.t.to_array(), entries.slope.to_array());
        let mut near = entries.near;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % 4;
            near &= near - 1;
            match clipped.sharpened(self, lane, t[lane], slopes[lane]) {
                Some(exact) => t[lane] = exact,
                None => entries.unclear |= 1 << lane,
            }
        }
        entries.near &= !entries.unclear;
        entries.t = F::from_array(&t);
        entries
    }
}

/// Kernel that tests which rays do not hit the shape again.
struct ExitingKernel<'a>(&'a Superellipsoid, &'a NearestQuery4);

impl SimdKernel for ExitingKernel<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<F: F64x4>(self) -> u32 {
        let ExitingKernel(shape, query) = self;
        let rays = query.rays::<F>();
        let is_near = max_abs(rays.origin).le(F::splat(REACH));
        let (_, slope) = shape.rough_at(&rays, F::splat(0.0));
        let least = F::splat(STEEP) * dot(rays.dir, rays.dir).sqrt();
        F::bitmask(is_near & least.lt(slope))
    }
}

/// Kernel that finds where the rays enter the shape.
struct NearestKernel<'a>(&'a Superellipsoid, &'a NearestQuery4);

impl SimdKernel for NearestKernel<'_> {
    type Output = NearestResult4;

    #[inline(always)]
    fn run<F: F64x4>(self) -> NearestResult4 {
        let NearestKernel(shape, query) = self;
        let rays = query.rays::<F>();
        let (from, far) = (F::from_array(&query.from), F::from_array(&query.far));
        let unknown = (query.left | !comfortable(&rays)) & query.active;
        let clipped = clip(&rays);
        let mut result = NearestResult4 {
            unknown,
            ..NearestResult4::default()
        };
        let active = clipped.hit_mask & query.active & !unknown;
        if active == 0 {
            return result;
        }
        let entries = shape.sharp_entries(&clipped, active);
        result.unknown |= entries.unclear;
        let near = entries.near;
        let t = entries.t + clipped.middle;
        let steep = F::splat(-STEEP) * dot(rays.dir, rays.dir).sqrt();
        let is_valid = F::bitmask(from.lt(t) & entries.slope.lt(steep));
        let is_within = F::bitmask(t.le(far));
        result.t = t.to_array();
        result.hit_mask = near & is_valid & is_within;
        result.unknown |= near & !is_valid & is_within;
        result
    }
}

/// Kernel that finds where a convex norm falls below 1 from both ends of an interval of a ray.
struct EndsKernel<'a> {
    shape: &'a Superellipsoid,
    ray: &'a Ray,
    from: f64,
    to: f64,
}

impl SimdKernel for EndsKernel<'_> {
    type Output = [Estimate; 2];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [Estimate; 2] {
        let EndsKernel {
            shape,
            ray,
            from,
            to,
        } = self;
        let DVec3 { x, y, z } = ray.dir;
        let clipped = Clipped {
            rays: RayPacket {
                origin: splat(ray.origin),
                dir: [
                    F::from_array(&[x, -x, x, -x]),
                    F::from_array(&[y, -y, y, -y]),
                    F::from_array(&[z, -z, z, -z]),
                ],
            },
            middle: F::splat(0.0),
            from: F::from_array(&[from, -to, from, -to]),
            to: F::from_array(&[to, -from, to, -from]),
            hit_mask: 0b11,
        };
        let entries = shape.entries(&clipped, clipped.hit_mask);
        let (t, slope) = (entries.t.to_array(), entries.slope.to_array());
        [(0, 1.0), (1, -1.0)].map(|(lane, sign)| {
            if entries.unclear >> lane & 1 == 1 {
                Estimate::Unclear
            } else if entries.near >> lane & 1 == 1 {
                Estimate::Near(sign * t[lane], sign * slope[lane])
            } else {
                Estimate::None
            }
        })
    }
}

/// Kernel that finds where the rays enter and leave the shape.
struct SpanKernel<'a>(&'a Superellipsoid, &'a NearestQuery4);

impl SimdKernel for SpanKernel<'_> {
    type Output = SpanResult4;

    #[inline(always)]
    fn run<F: F64x4>(self) -> SpanResult4 {
        let SpanKernel(shape, query) = self;
        let rays = query.rays::<F>();
        let (low, high) = (F::from_array(&query.from), F::from_array(&query.far));
        let mut unknown = !comfortable(&rays) & query.active;
        let clipped = clip(&rays);
        let middle = clipped.middle;
        let (from, to) = (clipped.from + middle, clipped.to + middle);
        let is_within = F::bitmask(low.le(to) & from.le(high));
        let active = clipped.hit_mask & is_within & query.active & !unknown;
        if active == 0 {
            return SpanResult4 {
                unknown,
                ..SpanResult4::default()
            };
        }
        // An end is not needed where the interval already begins or ends inside.
        let (mut starts_inside, mut ends_inside) = (0, 0);
        if F::bitmask(from.lt(low)) & active != 0 {
            starts_inside = shape.inside(&clipped, low) & active;
            ends_inside = shape.inside(&clipped, high) & active;
        }
        let entries = shape.sharp_entries(&clipped, active & !starts_inside);
        let enter = entries.t + middle;
        let is_far = F::bitmask(high.lt(enter));
        let enters = entries.near | starts_inside;
        let stays = enters & (is_far | ends_inside);
        let exits = shape.sharp_entries(&clipped.reversed(), enters & !stays);
        unknown |= entries.unclear | exits.unclear;
        SpanResult4 {
            enter: F::select(F::mask_from_bits(starts_inside), from, enter).to_array(),
            leave: F::select(F::mask_from_bits(exits.near), middle - exits.t, to).to_array(),
            hit_mask: stays | exits.near,
            unknown,
        }
    }
}

impl<F: F64Lanes> Clipped<F> {
    /// The same intervals from the other end.
    #[inline(always)]
    fn reversed(&self) -> Self {
        let [x, y, z] = self.rays.dir;
        Clipped {
            rays: RayPacket {
                origin: self.rays.origin,
                dir: [-x, -y, -z],
            },
            middle: -self.middle,
            from: -self.to,
            to: -self.from,
            hit_mask: self.hit_mask,
        }
    }

    /// The root of the exact norm of one ray near a rough one.
    #[inline(never)]
    fn sharpened(&self, shape: &Superellipsoid, lane: usize, t: f64, slope: f64) -> Option<f64> {
        let one_of = |of: &[F; 3]| DVec3::from_array(of.map(|of| of.to_array()[lane]));
        let ray = Ray::new(one_of(&self.rays.origin), one_of(&self.rays.dir));
        let scale = self.from.to_array()[lane]
            .abs()
            .max(self.to.to_array()[lane].abs());
        Rough::new(shape, &ray)?.sharpened(t, slope, scale)
    }
}

/// Bit mask of the lanes that need no rescaling.
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
    let mut misses = 0;
    let mut axis = 0;
    while axis < 3 {
        let (p, d) = (rays.origin[axis], rays.dir[axis]);
        let is_along = d.eq(zero);
        misses |= F::bitmask(is_along & one.lt(p.abs()));
        let (a, b) = ((-one - p) / d, (one - p) / d);
        from = F::select(is_along, from, from.lane_max(a.lane_min(b)));
        to = F::select(is_along, to, to.lane_min(a.lane_max(b)));
        axis += 1;
    }
    let is_hit = from.lt(to) & from.abs().lt(endless);
    let is_hit = is_hit & to.abs().lt(endless);
    let middle = F::splat(0.5) * (from + to);
    Clipped {
        rays: RayPacket {
            origin: add(rays.origin, scale(rays.dir, middle)),
            dir: rays.dir,
        },
        middle,
        from: from - middle,
        to: to - middle,
        hit_mask: F::bitmask(is_hit) & !misses,
    }
}
