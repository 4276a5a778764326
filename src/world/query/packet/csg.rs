//! CSG programs for packets of four rays.
//!
//! With few operands sorting does not pay. A surface is shown where the ray is inside all solids to be intersected and
//! outside all those subtracted; each end of a span is tested against the other spans (Roth 1982, inverted: all ends,
//! all spans, no order). Where two ends coincide, and where a shape is in doubt, the ray takes the scalar path: so the
//! hits are those of [`CsgProgram::nearest`], bit for bit.
//!
//! A program of many operands is reduced to those whose boxes some of the four rays hit, by the BVH over them: the
//! others contain none of the rays. This module handles intersections; nested operations are in `packet_csg_tree`.

use super::bundle::StreamPacket;
use super::csg_tree::CsgTreePacket;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{Crossing, RayPacket, Root, SpanPacket};
use crate::world::compiled::World;
use crate::world::csg::packet_strategy::{MOST_OPERANDS, Numbers, PacketStrategy};
use crate::world::csg::program::{CsgProgram, RawHit, hide_departure};
use crate::world::primitive::Leaf;
use crate::world::query::Scratch;
use crate::world::query::closest::SKIN;
use crate::world::ray::Query;

/// A ray packet and the program that it is intersected with.
#[derive(Clone, Copy)]
pub(in crate::world) struct CsgPacket<'a> {
    pub(in crate::world) program: &'a CsgProgram,
    pub(in crate::world) leaves: &'a [Leaf],
    pub(in crate::world) rays: &'a RayPacket4,
    /// Mask of the active lanes.
    pub(in crate::world) active: u32,
    /// The operands to be tested besides the required ones.
    pub(in crate::world) others: &'a [u32],
}

/// Hits of a ray packet.
pub(in crate::world) struct CsgPacketHits {
    pub(in crate::world) t: [f64; 4],
    /// The operand, as a whole number.
    pub(in crate::world) operand: [f64; 4],
    /// Mask of the lanes that hit something.
    pub(in crate::world) hit_mask: u32,
    /// Mask of the lanes that need the scalar path.
    pub(in crate::world) unknown: u32,
}

/// The interval of each ray inside all required operands, in which something may show.
pub(in crate::world) struct ClipInterval<F> {
    pub(in crate::world) low: F,
    pub(in crate::world) high: F,
    enter: End<F>,
    leave: End<F>,
    /// Mask of the lanes that need the scalar path.
    pub(in crate::world) unknown: u32,
}

/// The last of several entries, or the first of several exits.
#[derive(Clone, Copy)]
struct End<F> {
    t: F,
    /// The operand, as a whole number; negative if it only clips.
    operand: F,
    /// Positive where two of them coincide.
    tied: F,
}

impl<F: F64Lanes> End<F> {
    #[inline(always)]
    fn at(t: f64) -> Self {
        End {
            t: F::splat(t),
            operand: F::splat(-1.0),
            tied: F::splat(0.0),
        }
    }

    /// Takes the end of an operand into account, which replaces the current one where `is_new`.
    #[inline(always)]
    fn extend(&mut self, t: F, operand: F, is_new: F::Mask) {
        let [zero, one] = [F::splat(0.0), F::splat(1.0)];
        let tied = F::select(t.eq(self.t), one, self.tied);
        self.tied = F::select(is_new, zero, tied);
        self.operand = F::select(is_new, operand, self.operand);
        self.t = F::select(is_new, t, self.t);
    }

    /// Distance at which it may be shown: infinity where it only clips.
    #[inline(always)]
    fn shown(&self) -> F {
        let zero = F::splat(0.0);
        let is_shown = zero.le(self.operand) | zero.lt(self.tied);
        F::select(is_shown, self.t, F::splat(f64::INFINITY))
    }
}

/// Computes the interval of four rays in which something may show, and the lanes where it is not empty.
struct ClipKernel<'a>(CsgPacket<'a>);

impl CsgProgram {
    /// Hits of the active lanes by the selected algorithm. Not inlined: it is large with many call sites, and
    /// would take as long to compile as all the rest.
    #[inline(never)]
    fn intersect_packet4(
        &self,
        lanes: SimdLevel,
        strategy: PacketStrategy,
        leaves: &[Leaf],
        rays: &RayPacket4,
        active: u32,
    ) -> CsgPacketHits {
        let mut others = Numbers::from_slice(&self.order.others);
        let mut packet = CsgPacket {
            program: self,
            leaves,
            rays,
            active,
            others: &[],
        };
        if strategy == PacketStrategy::Scalar || packet.gather(lanes, &mut others).is_none() {
            return CsgPacketHits {
                unknown: active,
                ..CsgPacketHits::NOTHING
            };
        }
        if packet.active == 0 {
            return CsgPacketHits::NOTHING;
        }
        packet.others = &others;
        match strategy {
            PacketStrategy::Tree => lanes.run(CsgTreePacket(packet)),
            PacketStrategy::Intersection | PacketStrategy::Scalar => lanes.run(packet),
        }
    }
}

impl SimdKernel for ClipKernel<'_> {
    type Output = ([[f64; 4]; 2], u32);

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> ([[f64; 4]; 2], u32) {
        match self.0.narrowed(&self.0.rays.load::<F>()) {
            None => ([[0.0; 4]; 2], 0),
            Some(ClipInterval {
                low, high, unknown, ..
            }) => {
                let left = F::bitmask(low.le(high)) | unknown;
                ([low.to_array(), high.to_array()], left & self.0.active)
            }
        }
    }
}

impl SimdKernel for CsgPacket<'_> {
    type Output = CsgPacketHits;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> CsgPacketHits {
        let rays = self.rays.load::<F>();
        let Some(clip) = self.narrowed(&rays) else {
            return CsgPacketHits::NOTHING;
        };
        if let Some(hits) = self.early_hits(&clip, &rays) {
            return hits;
        }
        let endless = F::splat(f64::INFINITY);
        let mut unknown = clip.unknown;
        let mut ends = [(endless, -endless); MOST_OPERANDS];
        for (ends, &number) in ends.iter_mut().zip(self.others) {
            let (own, own_unknown) = self.ends(number, &rays, clip.low, clip.high);
            *ends = own;
            unknown |= own_unknown & self.active;
        }
        let cuts = &ends[..self.others.len().min(MOST_OPERANDS)];
        let mut best = self.nearer(&clip, cuts, clip.enter.shown(), endless);
        best = self.nearer(&clip, cuts, clip.leave.shown(), best);
        for (ends, &number) in cuts.iter().zip(self.others) {
            if !self.program.operands[number as usize].is_hidden {
                best = self.nearer(&clip, cuts, ends.0, best);
                best = self.nearer(&clip, cuts, ends.1, best);
            }
        }
        let mut at = NearestEnd::none();
        for end in [&clip.enter, &clip.leave] {
            at.add_tie(F::splat(0.0).lt(end.tied) & end.t.eq(best));
            at.add(end.t.eq(best), end.operand);
        }
        for (ends, &number) in cuts.iter().zip(self.others) {
            at.add(ends.0.eq(best), F::splat(f64::from(number)));
            at.add(ends.1.eq(best), F::splat(f64::from(number)));
        }
        at.answer(best, unknown, self.active)
    }
}

/// The operand whose end is the closest shown.
pub(in crate::world) struct NearestEnd<F: F64Lanes> {
    operand: F,
    once: F::Mask,
    twice: F::Mask,
}

impl<F: F64Lanes> NearestEnd<F> {
    #[inline(always)]
    pub(in crate::world) fn none() -> Self {
        NearestEnd {
            operand: F::splat(0.0),
            once: F::mask_from_bits(0),
            twice: F::mask_from_bits(0),
        }
    }

    #[inline(always)]
    pub(in crate::world) fn add(&mut self, is_best: F::Mask, operand: F) {
        self.twice = self.twice | (self.once & is_best);
        self.once = self.once | is_best;
        self.operand = F::select(is_best, operand, self.operand);
    }

    #[inline(always)]
    fn add_tie(&mut self, is_tied: F::Mask) {
        self.twice = self.twice | is_tied;
    }

    /// The hits, with the closest surface shown at `best`, or at infinity.
    #[inline(always)]
    pub(in crate::world) fn answer(&self, best: F, unknown: u32, active: u32) -> CsgPacketHits {
        let hit_mask = F::bitmask(best.lt(F::splat(f64::INFINITY))) & active;
        let unknown = unknown | F::bitmask(self.twice) & hit_mask;
        CsgPacketHits {
            t: best.to_array(),
            operand: self.operand.to_array(),
            hit_mask: hit_mask & !unknown,
            unknown,
        }
    }
}

impl CsgPacketHits {
    pub(in crate::world) const NOTHING: CsgPacketHits = CsgPacketHits {
        t: [0.0; 4],
        operand: [0.0; 4],
        hit_mask: 0,
        unknown: 0,
    };
}

impl CsgPacket<'_> {
    /// The intersection of the required operands; `None` if no active ray is left in it.
    #[inline(always)]
    pub(in crate::world) fn narrowed<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
    ) -> Option<ClipInterval<F>> {
        let mut clip = ClipInterval {
            low: F::from_array(&self.rays.t_min),
            high: F::from_array(&self.rays.t_max),
            enter: End::at(f64::NEG_INFINITY),
            leave: End::at(f64::INFINITY),
            unknown: 0,
        };
        for &number in &self.program.order.required {
            let ((enter, leave), unknown) = self.ends(number, rays, clip.low, clip.high);
            clip.unknown |= unknown & self.active;
            let operand = if self.program.operands[number as usize].is_hidden {
                -1.0
            } else {
                f64::from(number)
            };
            let operand = F::splat(operand);
            clip.enter.extend(enter, operand, clip.enter.t.lt(enter));
            clip.leave.extend(leave, operand, leave.lt(clip.leave.t));
            clip.low = clip.low.lane_max(enter);
            clip.high = clip.high.lane_min(leave);
            let is_open = F::bitmask(clip.low.le(clip.high)) | clip.unknown;
            if is_open & self.active == 0 {
                return None;
            }
        }
        Some(clip)
    }

    /// The hits if each ray either misses the required operands, or enters them at a point clear of all subtracted
    /// operands: then the ends of those are not needed.
    #[inline(always)]
    fn early_hits<F: F64Lanes>(
        &self,
        clip: &ClipInterval<F>,
        rays: &RayPacket<F>,
    ) -> Option<CsgPacketHits> {
        let t = clip.enter.shown();
        let passes = F::bitmask(clip.high.lt(clip.low));
        let is_plain = (F::from_array(&self.rays.t_min).lt(t) & t.lt(clip.high))
            & (t.eq(clip.low) & clip.enter.tied.eq(F::splat(0.0)));
        let mut clear = F::bitmask(is_plain) & !passes;
        for &number in self.others {
            if (clear | passes) & self.active != self.active {
                break;
            }
            let leaf = &self.leaves[(self.program.first + number) as usize];
            clear &= F::bitmask(match &leaf.object_from_world {
                None => leaf.shape.four_clear(rays, t),
                Some(matrix) => leaf.shape.four_clear(&rays.to_object(matrix), t),
            });
        }
        let is_known = clip.unknown == 0 && (clear | passes) & self.active == self.active;
        is_known.then(|| CsgPacketHits {
            t: t.to_array(),
            operand: clip.enter.operand.to_array(),
            hit_mask: clear & self.active,
            unknown: 0,
        })
    }

    /// The nearer of `best` and, where it is shown, an end at `t`; `cuts` are the spans subtracted. Not a closure,
    /// which would not be compiled for the wide lanes.
    #[inline(always)]
    fn nearer<F: F64Lanes>(&self, clip: &ClipInterval<F>, cuts: &[(F, F)], t: F, best: F) -> F {
        let from = F::from_array(&self.rays.t_min);
        let is_within = clip.low.le(t) & t.le(clip.high);
        let mut is_shown = (from.lt(t) & is_within) & t.lt(best);
        if F::bitmask(is_shown) & self.active == 0 {
            return best;
        }
        for (enter, leave) in cuts {
            is_shown = is_shown & (t.le(*enter) | leave.le(t));
        }
        F::select(is_shown, t, best)
    }

    /// Entry and exit of each ray into an operand, and the lanes that take the scalar path; ends outside the intervals
    /// `low` to `high` may be missing. A missed operand is entered at infinity and left at minus infinity.
    #[inline(always)]
    pub(in crate::world) fn ends<F: F64Lanes>(
        &self,
        number: u32,
        rays: &RayPacket<F>,
        low: F,
        high: F,
    ) -> ((F, F), u32) {
        let spans = self.spans(number, rays, low, high);
        let endless = F::splat(f64::INFINITY);
        let ends = (
            F::select(spans.is_met, spans.enter, endless),
            F::select(spans.is_met, spans.leave, -endless),
        );
        (ends, spans.unknown)
    }

    #[inline(always)]
    fn spans<F: F64Lanes>(
        &self,
        number: u32,
        rays: &RayPacket<F>,
        low: F,
        high: F,
    ) -> SpanPacket<F> {
        let leaf = &self.leaves[(self.program.first + number) as usize];
        // A single call site, so that all shapes are inlined once.
        let rays = match &leaf.object_from_world {
            None => *rays,
            Some(matrix) => rays.to_object(matrix),
        };
        leaf.shape.four(&rays, (low, high))
    }

    /// Adds the operands of a large program whose boxes some of the rays hit within their clip intervals, and updates
    /// the active lanes; drops operands of parts whose boxes no ray hits. Returns `None` if there are too many.
    #[inline(always)]
    fn gather(&mut self, lanes: SimdLevel, others: &mut Numbers) -> Option<()> {
        let order = &self.program.order;
        let boxed = order.boxed.as_ref();
        let Some(boxed) = boxed.filter(|boxed| !boxed.bounded.is_empty()) else {
            return Some(());
        };
        let ([low, high], left) = lanes.run(ClipKernel(*self));
        self.active = left;
        let capacity = match self.program.nodes.len() {
            1 => MOST_OPERANDS,
            _ => MOST_OPERANDS - order.required.len(),
        };
        let mut hit_parts = 0u64;
        for lane in (0..4).filter(|lane| left >> lane & 1 == 1) {
            let is_full = boxed.tree.any_in(
                lanes,
                &self.rays.ray(lane),
                (low[lane], high[lane]),
                #[inline(always)]
                |position| {
                    match boxed.bounded.get(position as usize) {
                        Some(number) if others.contains(number) => {}
                        Some(&number) => others.push(number),
                        None => hit_parts |= 1 << (position as usize - boxed.bounded.len()),
                    }
                    others.len() > capacity
                },
            );
            if is_full {
                return None;
            }
        }
        for (part, operands) in boxed.parts.iter().enumerate() {
            if hit_parts >> part & 1 == 0 {
                others.retain(|number| !operands.contains(number));
            }
        }
        Some(())
    }
}

/// Returns true if a hit at `t` may lie on the surface that the ray starts on, for its near limit.
#[inline(always)]
pub(in crate::world) fn may_be_self_hit(t_min: f64, t: f64) -> bool {
    SKIN * t <= t_min
}

impl World {
    /// Intersects four rays, which start at index `start`, with a CSG program up to and including their far limits:
    /// calls `take` with the index of each ray that hits it. Returns the lanes that need the scalar path. Unless
    /// `NEEDS_FACE`, only the distance of a root is set.
    #[inline(always)]
    pub(in crate::world) fn packet4_program<const NEEDS_FACE: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        packet: StreamPacket,
        query: impl Fn(usize) -> Query,
        scratch: &mut Scratch,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let StreamPacket {
            stream,
            start,
            active,
        } = packet;
        let rays = stream.packet(start);
        let (from, origin_leaf) = (rays.t_min, rays.origin_leaf);
        let program = &self.model.programs[number as usize];
        let strategy = self.model.packet_strategy(number);
        let mut hits = program.intersect_packet4(lanes, strategy, &self.model.leaves, rays, active);
        let mut hit_mask = hits.hit_mask;
        while hit_mask != 0 {
            let lane = hit_mask.trailing_zeros() as usize % 4;
            hit_mask &= hit_mask - 1;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let operand = hits.operand[lane] as u32;
            let leaf = program.first + operand;
            let ray = query(start + lane).ray;
            if !program.shows(operand, &self.model.leaves, &ray, &mut scratch.sweep) {
                hits.unknown |= 1 << lane;
                continue;
            }
            // The scalar path decides about self-intersections, and searches behind them.
            if may_be_self_hit(from[lane], hits.t[lane]) {
                hits.unknown |= 1 << lane;
                continue;
            }
            // The root that the ray starts on does not count; the scalar path searches behind it.
            if origin_leaf[lane] == leaf
                && self.spawn_t(&query(start + lane), scratch) == hits.t[lane]
            {
                hits.unknown |= 1 << lane;
                continue;
            }
            let hit_leaf = &self.model.leaves[leaf as usize];
            let surface = hit_leaf.surface;
            if !NEEDS_FACE {
                let root = Root {
                    t: hits.t[lane],
                    crossing: Crossing::Touch,
                    face: 0,
                    is_visible: true,
                };
                take(
                    stream,
                    start + lane,
                    RawHit {
                        root,
                        leaf,
                        surface,
                    },
                );
                continue;
            }
            match hit_leaf.root_at(&ray, hits.t[lane], &mut scratch.roots) {
                Some(root) => take(
                    stream,
                    start + lane,
                    RawHit {
                        root,
                        leaf,
                        surface,
                    },
                ),
                None => hits.unknown |= 1 << lane,
            }
        }
        hits.unknown
    }

    /// Distance of the root that the ray starts on, on a part of a CSG program; NaN if it starts on none.
    #[inline(never)]
    fn spawn_t(&self, query: &Query, scratch: &mut Scratch) -> f64 {
        let Some(origin) = &query.origin_surface else {
            return f64::NAN;
        };
        let leaf = &self.model.leaves[origin.leaf as usize];
        let roots = &mut scratch.roots;
        roots.clear();
        leaf.roots(&query.ray, roots);
        hide_departure(roots, origin, leaf, query.ray.dir);
        let hidden = roots.iter().find(|root| !root.is_visible);
        hidden.map_or(f64::NAN, |root| root.t)
    }
}

#[cfg(test)]
mod tests {
    use super::super::hits::HitPacket4;
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::world::csg::program::Combine;
    use crate::world::csg::program::{RayInterval, Sweep};
    use crate::world::csg::simplify::tests::{coarse, random_program};
    use glam::DVec3;

    #[test]
    fn packets_hit_what_single_rays_hit() {
        let mut rng = Random::new(77);
        let (mut sweep, mut stream) = (Sweep::default(), RayStream::default());
        let mut known = [[0; 2]; 2];
        for _ in 0..60_000 {
            let (mut program, leaves, bounds) = random_program(&mut rng);
            if let [node] = &mut program.nodes[..] {
                // One solid minus all others, or hardly anything would be shown.
                node.combine = Combine::Intersection;
                let others = program.operands.iter_mut().skip(1);
                others.for_each(|operand| operand.is_inverse = true);
            }
            program.prepare(&leaves, &bounds, Vec::new());
            let strategy = program.packet_strategy(&leaves);
            if strategy == PacketStrategy::Scalar {
                continue;
            }
            let origin = 2.0 * coarse(&mut rng) + 0.25 * rng.vector(1.0);
            let mut hits = HitPacket4::NOTHING;
            for lane in 0..4 {
                let aim = 2.0 * rng.vector(1.0) + coarse(&mut rng);
                hits.aim(lane, (aim - origin).normalize_or(DVec3::X));
            }
            stream.load_camera_rays(origin, 0.0, &[hits]);
            let intersect = |lanes: SimdLevel| {
                program.intersect_packet4(lanes, strategy, &leaves, stream.packet(0), 0b1111)
            };
            let (wide, narrow) = (intersect(SimdLevel::widest()), intersect(SimdLevel::NARROW));
            assert_eq!(
                (wide.hit_mask, wide.unknown),
                (narrow.hit_mask, narrow.unknown)
            );
            for lane in (0..4).filter(|lane| wide.unknown >> lane & 1 == 0) {
                let interval = RayInterval::FORWARD;
                let alone = program
                    .nearest(
                        &leaves,
                        &stream.ray(lane),
                        interval,
                        None,
                        &mut sweep,
                        |_| true,
                    )
                    .map(|raw_hit| (raw_hit.root.t, f64::from(raw_hit.leaf)));
                let together = |hits: &CsgPacketHits| {
                    let is_hit = hits.hit_mask >> lane & 1 == 1;
                    is_hit.then(|| (hits.t[lane], hits.operand[lane]))
                };
                assert_eq!(together(&wide), alone, "{program:?}");
                assert_eq!(together(&narrow), alone, "{program:?}");
                let is_cut = usize::from(program.order.boxed.is_some());
                known[usize::from(strategy == PacketStrategy::Tree)][is_cut] +=
                    usize::from(alone.is_some());
            }
        }
        assert!(
            known.as_flattened().iter().all(|&known| known > 300),
            "{known:?}"
        );
    }
}
