//! Combinations for four rays at once.
//!
//! With few operands no sorting pays. A surface is shown where the ray is within all solids that are to be shared and
//! outside of all that are taken away; each end of a span is tried against the other spans (Roth 1982, turned about:
//! all ends, all spans, no order). Where two ends coincide, and wherever a shape is in doubt, the ray is left to the scalar
//! path: so the hits are those of [`CsgProgram::nearest`], to the bit.
//!
//! A combination of many operands is cut down to those whose boxes some of the four rays meet, by the tree over them: the
//! others hold none of the rays. Here is what operands have in common; combinations of combinations are in `packet_csg_tree`.

use super::csg_tree::CsgTreePacket;
use super::rays::{RayPacket4, RayStream};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{Crossing, RayPacket, Root, SpanPacket};
use crate::world::compiled::World;
use crate::world::csg::program::{Combine, CsgProgram, RawHit, hide_departure};
use crate::world::primitive::Leaf;
use crate::world::query::closest::SKIN;
use crate::world::query::{Query, Scratch};
use smallvec::SmallVec;

/// Up to so many operands are tried end by end, besides those that must all hold; the work grows with the square.
pub(in crate::world) const MOST_OPERANDS: usize = 16;
/// Up to so many nodes are.
pub(in crate::world) const MOST_NODES: usize = 8;

/// The numbers of some operands.
pub(in crate::world) type Numbers = SmallVec<[u32; MOST_OPERANDS]>;

/// In which way four rays can be asked about a combination at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::world) enum PacketStrategy {
    /// In none.
    Scalar,
    /// As one intersection.
    Intersection,
    /// As a combination of combinations.
    Tree,
}

/// Four rays on their way through a combination.
#[derive(Clone, Copy)]
pub(in crate::world) struct CsgPacket<'a> {
    pub(in crate::world) program: &'a CsgProgram,
    pub(in crate::world) leaves: &'a [Leaf],
    pub(in crate::world) rays: &'a RayPacket4,
    /// Which rays there are, one bit each.
    pub(in crate::world) there: u32,
    /// The operands that count besides those that must all hold.
    pub(in crate::world) others: &'a [u32],
}

/// What four rays find.
pub(in crate::world) struct CsgPacketHits {
    pub(in crate::world) t: [f64; 4],
    /// The operand, a whole number.
    pub(in crate::world) operand: [f64; 4],
    /// Which rays meet something.
    pub(in crate::world) met: u32,
    /// Which rays must be asked for singly.
    pub(in crate::world) unknown: u32,
}

/// Where four rays are inside of what must all hold, and where along them something may be shown.
pub(in crate::world) struct ClipInterval<F> {
    pub(in crate::world) low: F,
    pub(in crate::world) high: F,
    enter: End<F>,
    leave: End<F>,
    /// Which rays must be asked for singly.
    pub(in crate::world) unknown: u32,
}

/// The last of several ends, or the first.
#[derive(Clone, Copy)]
struct End<F> {
    t: F,
    /// The operand, a whole number; below zero if it only clips.
    operand: F,
    /// Above zero where two of them fall together.
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

    /// Takes in the end of an operand, which counts where `is_new`.
    #[inline(always)]
    fn take(&mut self, t: F, operand: F, is_new: F::Mask) {
        let [zero, one] = [F::splat(0.0), F::splat(1.0)];
        let tied = F::select(t.eq(self.t), one, self.tied);
        self.tied = F::select(is_new, zero, tied);
        self.operand = F::select(is_new, operand, self.operand);
        self.t = F::select(is_new, t, self.t);
    }

    /// Where it may be shown: infinitely far where it only clips.
    #[inline(always)]
    fn shown(&self) -> F {
        let zero = F::splat(0.0);
        let is_shown = zero.le(self.operand) | zero.lt(self.tied);
        F::select(is_shown, self.t, F::splat(f64::INFINITY))
    }
}

/// Asks where along four rays something may be shown, and on which of them.
struct ClipKernel<'a>(CsgPacket<'a>);

impl CsgProgram {
    /// In which way four rays can be asked about it at once.
    pub(in crate::world) fn way_of_four(&self, leaves: &[Leaf]) -> PacketStrategy {
        let asked = self.order.others.len();
        // What few rays come near need not be known to four.
        let mut always_asked = self.order.required.iter().chain(&self.order.others);
        let has_four = |&number: &u32| leaves[(self.first + number) as usize].shape.has_four();
        if asked > MOST_OPERANDS || !always_asked.all(has_four) {
            return PacketStrategy::Scalar;
        }
        match self.nodes.as_slice() {
            // What is not inverse must then hold.
            [node] if node.combine == Combine::Intersection && !node.is_inverse => {
                PacketStrategy::Intersection
            }
            nodes if nodes.len() <= MOST_NODES => {
                if asked + self.order.required.len() <= MOST_OPERANDS {
                    PacketStrategy::Tree
                } else {
                    PacketStrategy::Scalar
                }
            }
            _ => PacketStrategy::Scalar,
        }
    }

    /// What those of four rays that are `there` find in a way that it suits. Large, and called from many places: inlined, it
    /// would take as long to compile as all the rest.
    #[inline(never)]
    fn ask_four(
        &self,
        lanes: SimdLevel,
        way: PacketStrategy,
        leaves: &[Leaf],
        (rays, there): (&RayPacket4, u32),
    ) -> CsgPacketHits {
        let mut others = Numbers::from_slice(&self.order.others);
        let mut passing = CsgPacket {
            program: self,
            leaves,
            rays,
            there,
            others: &[],
        };
        if way == PacketStrategy::Scalar || passing.gather(lanes, &mut others).is_none() {
            return CsgPacketHits {
                unknown: there,
                ..CsgPacketHits::NOTHING
            };
        }
        if passing.there == 0 {
            return CsgPacketHits::NOTHING;
        }
        passing.others = &others;
        match way {
            PacketStrategy::Tree => lanes.run(CsgTreePacket(passing)),
            PacketStrategy::Intersection | PacketStrategy::Scalar => lanes.run(passing),
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
                ([low.to_array(), high.to_array()], left & self.0.there)
            }
        }
    }
}

impl SimdKernel for CsgPacket<'_> {
    type Output = CsgPacketHits;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> CsgPacketHits {
        let rays = self.rays.load::<F>();
        let Some(held) = self.narrowed(&rays) else {
            return CsgPacketHits::NOTHING;
        };
        if let Some(found) = self.found_at_once(&held, &rays) {
            return found;
        }
        let endless = F::splat(f64::INFINITY);
        let mut unknown = held.unknown;
        let mut ends = [(endless, -endless); MOST_OPERANDS];
        for (ends, &number) in ends.iter_mut().zip(self.others) {
            let (own, own_unknown) = self.ends(number, &rays, (held.low, held.high));
            *ends = own;
            unknown |= own_unknown & self.there;
        }
        let cuts = &ends[..self.others.len().min(MOST_OPERANDS)];
        let mut best = self.nearer(&held, cuts, held.enter.shown(), endless);
        best = self.nearer(&held, cuts, held.leave.shown(), best);
        for (ends, &number) in cuts.iter().zip(self.others) {
            if !self.program.operands[number as usize].is_hidden {
                best = self.nearer(&held, cuts, ends.0, best);
                best = self.nearer(&held, cuts, ends.1, best);
            }
        }
        let mut at = NearestEnd::none();
        for end in [&held.enter, &held.leave] {
            at.is_met_twice(F::splat(0.0).lt(end.tied) & end.t.eq(best));
            at.meet(end.t.eq(best), end.operand);
        }
        for (ends, &number) in cuts.iter().zip(self.others) {
            at.meet(ends.0.eq(best), F::splat(f64::from(number)));
            at.meet(ends.1.eq(best), F::splat(f64::from(number)));
        }
        at.answer(best, unknown, self.there)
    }
}

/// Whose end is the nearest.
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
    pub(in crate::world) fn meet(&mut self, is_best: F::Mask, operand: F) {
        self.twice = self.twice | (self.once & is_best);
        self.once = self.once | is_best;
        self.operand = F::select(is_best, operand, self.operand);
    }

    #[inline(always)]
    fn is_met_twice(&mut self, is_tied: F::Mask) {
        self.twice = self.twice | is_tied;
    }

    /// What is found where the first surface shown is at `best`, or infinitely far.
    #[inline(always)]
    pub(in crate::world) fn answer(&self, best: F, unknown: u32, there: u32) -> CsgPacketHits {
        let met = F::bitmask(best.lt(F::splat(f64::INFINITY))) & there;
        let unknown = unknown | F::bitmask(self.twice) & met;
        CsgPacketHits {
            t: best.to_array(),
            operand: self.operand.to_array(),
            met: met & !unknown,
            unknown,
        }
    }
}

impl CsgPacketHits {
    pub(in crate::world) const NOTHING: CsgPacketHits = CsgPacketHits {
        t: [0.0; 4],
        operand: [0.0; 4],
        met: 0,
        unknown: 0,
    };
}

impl CsgPacket<'_> {
    /// What the operands that must all hold have in common; nothing if no ray is left on which something may be shown.
    #[inline(always)]
    pub(in crate::world) fn narrowed<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
    ) -> Option<ClipInterval<F>> {
        let mut held = ClipInterval {
            low: F::from_array(&self.rays.from),
            high: F::from_array(&self.rays.far),
            enter: End::at(f64::NEG_INFINITY),
            leave: End::at(f64::INFINITY),
            unknown: 0,
        };
        for &number in &self.program.order.required {
            let ((enter, leave), unknown) = self.ends(number, rays, (held.low, held.high));
            held.unknown |= unknown & self.there;
            let operand = if self.program.operands[number as usize].is_hidden {
                -1.0
            } else {
                f64::from(number)
            };
            let operand = F::splat(operand);
            held.enter.take(enter, operand, held.enter.t.lt(enter));
            held.leave.take(leave, operand, leave.lt(held.leave.t));
            held.low = held.low.lane_max(enter);
            held.high = held.high.lane_min(leave);
            let is_open = F::bitmask(held.low.le(held.high)) | held.unknown;
            if is_open & self.there == 0 {
                return None;
            }
        }
        Some(held)
    }

    /// What is found if each ray either passes by what must all hold, or enters it where nothing is near that is taken away:
    /// that needs no ends of what is.
    #[inline(always)]
    fn found_at_once<F: F64Lanes>(
        &self,
        held: &ClipInterval<F>,
        rays: &RayPacket<F>,
    ) -> Option<CsgPacketHits> {
        let t = held.enter.shown();
        let passes = F::bitmask(held.high.lt(held.low));
        let is_plain = (F::from_array(&self.rays.from).lt(t) & t.lt(held.high))
            & (t.eq(held.low) & held.enter.tied.eq(F::splat(0.0)));
        let mut clear = F::bitmask(is_plain) & !passes;
        for &number in self.others {
            if (clear | passes) & self.there != self.there {
                break;
            }
            let leaf = &self.leaves[(self.program.first + number) as usize];
            clear &= F::bitmask(match &leaf.object_from_world {
                None => leaf.shape.four_clear(rays, t),
                Some(matrix) => leaf.shape.four_clear(&rays.to_object(matrix), t),
            });
        }
        let is_known = held.unknown == 0 && (clear | passes) & self.there == self.there;
        is_known.then(|| CsgPacketHits {
            t: t.to_array(),
            operand: held.enter.operand.to_array(),
            met: clear & self.there,
            unknown: 0,
        })
    }

    /// The nearest surface that is shown of the one at `best` and one at `t`, with what is taken away. No closure: that
    /// would not take part in the wide lanes.
    #[inline(always)]
    fn nearer<F: F64Lanes>(&self, held: &ClipInterval<F>, cuts: &[(F, F)], t: F, best: F) -> F {
        let from = F::from_array(&self.rays.from);
        let is_within = held.low.le(t) & t.le(held.high);
        let mut is_shown = (from.lt(t) & is_within) & t.lt(best);
        if F::bitmask(is_shown) & self.there == 0 {
            return best;
        }
        for (enter, leave) in cuts {
            is_shown = is_shown & (t.le(*enter) | leave.le(t));
        }
        F::select(is_shown, t, best)
    }

    /// Entry and exit of each ray into an operand, and the lanes that take the scalar path; ends outside of the intervals
    /// `within` may be missing. An operand that is missed is entered at infinity and left at minus infinity.
    #[inline(always)]
    pub(in crate::world) fn ends<F: F64Lanes>(
        &self,
        number: u32,
        rays: &RayPacket<F>,
        within: (F, F),
    ) -> ((F, F), u32) {
        let spans = self.spans(number, rays, within);
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
        within: (F, F),
    ) -> SpanPacket<F> {
        let leaf = &self.leaves[(self.program.first + number) as usize];
        // One place to inline all shapes, not one for each case.
        let rays = match &leaf.object_from_world {
            None => *rays,
            Some(matrix) => rays.to_object(matrix),
        };
        leaf.shape.four(&rays, within)
    }

    /// Finds the operands of a large combination whose boxes some of the rays meet where something may be shown, and
    /// which rays those are; takes out those of parts whose boxes none meets. Gives nothing if they are too many.
    #[inline(always)]
    fn gather(&mut self, lanes: SimdLevel, others: &mut Numbers) -> Option<()> {
        let order = &self.program.order;
        let boxed = order.boxed.as_ref();
        let Some(boxed) = boxed.filter(|boxed| !boxed.bounded.is_empty()) else {
            return Some(());
        };
        let ([low, high], left) = lanes.run(ClipKernel(*self));
        self.there = left;
        let room = match self.program.nodes.len() {
            1 => MOST_OPERANDS,
            _ => MOST_OPERANDS - order.required.len(),
        };
        let mut met_parts = 0u64;
        for lane in (0..4).filter(|lane| left >> lane & 1 == 1) {
            let is_full = boxed.tree.any_in(
                lanes,
                &self.rays.ray(lane),
                (low[lane], high[lane]),
                #[inline(always)]
                |place| {
                    match boxed.bounded.get(place as usize) {
                        Some(number) if others.contains(number) => {}
                        Some(&number) => others.push(number),
                        None => met_parts |= 1 << (place as usize - boxed.bounded.len()),
                    }
                    others.len() > room
                },
            );
            if is_full {
                return None;
            }
        }
        for (part, operands) in boxed.parts.iter().enumerate() {
            if met_parts >> part & 1 == 0 {
                others.retain(|number| !operands.contains(number));
            }
        }
        Some(())
    }
}

/// Whether a ray for which nothing counts up to `from` may start on the surface that it meets at `t`.
#[inline(always)]
pub(in crate::world) fn may_be_left(from: f64, t: f64) -> bool {
    SKIN * t <= from
}

impl World {
    /// What some of four rays from `start` on find of a combination up to and including where they end: calls `take` with the number of
    /// each ray that meets it. Gives those that must be asked for singly, one bit each. Unless `ASKS_FACE`, no more is
    /// told of a root than its distance.
    #[inline(always)]
    pub(in crate::world) fn ask_four<const ASKS_FACE: bool>(
        &self,
        lanes: SimdLevel,
        number: u32,
        (lot, start, there): (&mut RayStream, usize, u32),
        query: impl Fn(usize) -> Query,
        scratch: &mut Scratch,
        take: &mut impl FnMut(&mut RayStream, usize, RawHit),
    ) -> u32 {
        let rays = lot.four(start);
        let (from, left) = (rays.from, rays.left);
        let program = &self.model.programs[number as usize];
        let way = self.model.way_of_four(number);
        let mut found = program.ask_four(lanes, way, &self.model.leaves, (rays, there));
        let mut met = found.met;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % 4;
            met &= met - 1;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let operand = found.operand[lane] as u32;
            let leaf = program.first + operand;
            let ray = query(start + lane).ray;
            if !program.shows(operand, &self.model.leaves, &ray, &mut scratch.sweep) {
                found.unknown |= 1 << lane;
                continue;
            }
            // A surface on which the ray may start is for the search that looks behind it.
            if may_be_left(from[lane], found.t[lane]) {
                found.unknown |= 1 << lane;
                continue;
            }
            // The root that the ray has just left is none; what lies behind it only a single ray finds.
            if left[lane] == leaf && self.left_at(&query(start + lane), scratch) == found.t[lane] {
                found.unknown |= 1 << lane;
                continue;
            }
            let found_leaf = &self.model.leaves[leaf as usize];
            let surface = found_leaf.surface;
            if !ASKS_FACE {
                let root = Root {
                    t: found.t[lane],
                    crossing: Crossing::Touch,
                    face: 0,
                    is_visible: true,
                };
                take(
                    lot,
                    start + lane,
                    RawHit {
                        root,
                        leaf,
                        surface,
                    },
                );
                continue;
            }
            match found_leaf.root_at(&ray, found.t[lane], &mut scratch.roots) {
                Some(root) => take(
                    lot,
                    start + lane,
                    RawHit {
                        root,
                        leaf,
                        surface,
                    },
                ),
                None => found.unknown |= 1 << lane,
            }
        }
        found.unknown
    }

    /// Where a ray has just left a part of a combination; not a number if it has not.
    #[inline(never)]
    fn left_at(&self, query: &Query, scratch: &mut Scratch) -> f64 {
        let Some(left) = &query.origin_surface else {
            return f64::NAN;
        };
        let leaf = &self.model.leaves[left.leaf as usize];
        let roots = &mut scratch.roots;
        roots.clear();
        leaf.roots(&query.ray, roots);
        hide_departure(roots, left, leaf, query.ray.dir);
        let hidden = roots.iter().find(|root| !root.is_visible);
        hidden.map_or(f64::NAN, |root| root.t)
    }
}

#[cfg(test)]
mod tests {
    use super::super::hits::HitPacket4;
    use super::*;
    use crate::base::math::sampling::random::Random;
    use crate::world::csg::program::Sweep;
    use crate::world::csg::simplify::tests::{coarse, random_program};
    use glam::DVec3;

    #[test]
    fn four_rays_find_what_each_finds() {
        let mut rng = Random::new(77);
        let (mut sweep, mut lot) = (Sweep::default(), RayStream::default());
        let mut known = [[0; 2]; 2];
        for _ in 0..60_000 {
            let (mut program, leaves, bounds) = random_program(&mut rng);
            if let [node] = &mut program.nodes[..] {
                // One solid less all others, or hardly anything would be shown.
                node.combine = Combine::Intersection;
                let others = program.operands.iter_mut().skip(1);
                others.for_each(|operand| operand.is_inverse = true);
            }
            program.prepare(&leaves, &bounds, Vec::new());
            let way = program.way_of_four(&leaves);
            if way == PacketStrategy::Scalar {
                continue;
            }
            let origin = 2.0 * coarse(&mut rng) + 0.25 * rng.vector(1.0);
            let mut hits = HitPacket4::NOTHING;
            for lane in 0..4 {
                let aim = 2.0 * rng.vector(1.0) + coarse(&mut rng);
                hits.aim(lane, (aim - origin).normalize_or(DVec3::X));
            }
            lot.load_camera_rays(origin, 0.0, &[hits]);
            let ask =
                |lanes: SimdLevel| program.ask_four(lanes, way, &leaves, (lot.four(0), 0b1111));
            let (wide, narrow) = (ask(SimdLevel::widest()), ask(SimdLevel::NARROW));
            assert_eq!((wide.met, wide.unknown), (narrow.met, narrow.unknown));
            for lane in (0..4).filter(|lane| wide.unknown >> lane & 1 == 0) {
                let span = (0.0, f64::INFINITY);
                let alone = program
                    .nearest(&leaves, &lot.ray(lane), span, None, &mut sweep, |_| true)
                    .map(|found| (found.root.t, f64::from(found.leaf)));
                let together = |found: &CsgPacketHits| {
                    let is_met = found.met >> lane & 1 == 1;
                    is_met.then(|| (found.t[lane], found.operand[lane]))
                };
                assert_eq!(together(&wide), alone, "{program:?}");
                assert_eq!(together(&narrow), alone, "{program:?}");
                let is_cut = usize::from(program.order.boxed.is_some());
                known[usize::from(way == PacketStrategy::Tree)][is_cut] +=
                    usize::from(alone.is_some());
            }
        }
        assert!(
            known.as_flattened().iter().all(|&known| known > 300),
            "{known:?}"
        );
    }
}
