//! Packets of rays against CSG programs: hits, and the nearest visible end of a span.

use super::rays::RayPacket4;
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel};
use crate::scene::shape::{RayPacket, SpanPacket};
use crate::world::csg::coincidence::Widening;
use crate::world::csg::packet_strategy::{MAX_NODES, MAX_OPERANDS, Numbers};
use crate::world::csg::program::{CsgProgram, NONE};
use crate::world::primitive::Leaf;
use crate::world::query::closest::SKIN;
use arrayvec::ArrayVec;

/// The most boxes of operands, and of parts, that the rays of a packet may hit.
const MAX_BOXES: usize = 32;
/// Positions of boxes.
type Boxes = ArrayVec<u32, MAX_BOXES>;

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

/// The interval of each ray inside all required operands, in which something may show, wider by the distance within
/// which surfaces coincide.
pub(in crate::world) struct ClipInterval<F: F64Lanes> {
    pub(in crate::world) low: F,
    pub(in crate::world) high: F,
    pub(crate) enter: End<F>,
    pub(crate) leave: End<F>,
    /// Mask of the lanes that need the scalar path.
    pub(in crate::world) unknown: u32,
}

/// The last of several entries, or the first of several exits.
pub(crate) struct End<F: F64Lanes> {
    pub(crate) t: F,
    /// The operand, as a whole number; negative if it only clips.
    pub(crate) operand: F,
    /// The entry before it, or the exit after it.
    next: F,
    /// Lanes in which `next` may coincide with it; set once all operands are included.
    tied: F::Mask,
}

impl<F: F64Lanes> End<F> {
    #[inline(always)]
    fn at(t: f64) -> Self {
        End {
            t: F::splat(t),
            operand: F::splat(-1.0),
            next: F::splat(t),
            tied: F::mask_from_bits(0),
        }
    }

    /// Includes the entry into another operand.
    #[inline(always)]
    fn extend_entry(&mut self, enter: F, operand: F) {
        self.next = self.next.lane_max(enter.lane_min(self.t));
        self.operand = F::select(self.t.lt(enter), operand, self.operand);
        self.t = self.t.lane_max(enter);
    }

    /// Includes the exit out of another operand.
    #[inline(always)]
    fn extend_exit(&mut self, leave: F, operand: F) {
        self.next = self.next.lane_min(leave.lane_max(self.t));
        self.operand = F::select(leave.lt(self.t), operand, self.operand);
        self.t = self.t.lane_min(leave);
    }

    /// Distance at which it may be shown: infinity where it only clips.
    #[inline(always)]
    fn shown(&self) -> F {
        let is_shown = F::splat(0.0).le(self.operand) | self.tied;
        F::select(is_shown, self.t, F::splat(f64::INFINITY))
    }
}

/// Computes the interval of four rays in which something may show, and the lanes where it is not empty.
pub(crate) struct ClipKernel<'a>(CsgPacket<'a>);

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
        let mut ends = [(endless, -endless); MAX_OPERANDS];
        for (ends, &number) in ends.iter_mut().zip(self.others) {
            let (own, own_unknown) = self.ends(number, &rays, clip.low, clip.high);
            *ends = own;
            unknown |= own_unknown & self.active;
        }
        let cuts = &ends[..self.others.len().min(MAX_OPERANDS)];
        let mut best = self.nearer(&clip, cuts, clip.enter.shown(), endless);
        best = self.nearer(&clip, cuts, clip.leave.shown(), best);
        for (ends, &number) in cuts.iter().zip(self.others) {
            if !self.program.operands[number as usize].is_hidden {
                best = self.nearer(&clip, cuts, ends.0, best);
                best = self.nearer(&clip, cuts, ends.1, best);
            }
        }
        let mut at = NearestEnd::new(best, self.around(best));
        for end in [&clip.enter, &clip.leave] {
            at.add_tie(end.tied, end.t);
            at.add(end.t, end.operand);
        }
        for (ends, &number) in cuts.iter().zip(self.others) {
            at.add(ends.0, F::splat(f64::from(number)));
            at.add(ends.1, F::splat(f64::from(number)));
        }
        at.answer(self.rays, unknown, self.active)
    }
}

/// The operand whose end is the closest shown.
pub(in crate::world) struct NearestEnd<F: F64Lanes> {
    best: F,
    around: (F, F),
    pub(crate) operand: F,
    pub(crate) once: F::Mask,
    pub(crate) twice: F::Mask,
}

impl<F: F64Lanes> NearestEnd<F> {
    /// The closest end at `best`, before its operand is found; ends within `around` may coincide with it.
    #[inline(always)]
    pub(in crate::world) fn new(best: F, around: (F, F)) -> Self {
        NearestEnd {
            best,
            around,
            operand: F::splat(0.0),
            once: F::mask_from_bits(0),
            twice: F::mask_from_bits(0),
        }
    }

    #[inline(always)]
    pub(in crate::world) fn add(&mut self, t: F, operand: F) {
        let is_best = self.around.0.le(t) & t.le(self.around.1);
        self.twice = self.twice | (self.once & is_best);
        self.once = self.once | is_best;
        self.operand = F::select(is_best, operand, self.operand);
    }

    #[inline(always)]
    fn add_tie(&mut self, is_tied: F::Mask, t: F) {
        self.twice = self.twice | (is_tied & t.eq(self.best));
    }

    /// The hits, with the closest surface shown at `best`, or at infinity.
    #[inline(always)]
    pub(in crate::world) fn answer(
        &self,
        rays: &RayPacket4,
        unknown: u32,
        active: u32,
    ) -> CsgPacketHits {
        let best = self.best;
        let is_shown = best.lt(F::splat(f64::INFINITY));
        // One of the others may be within the ray's interval even if this one is not.
        let unknown = unknown | F::bitmask(self.twice & is_shown) & active;
        let is_hit = is_shown & best.le(F::from_array(&rays.t_max));
        let hit_mask = F::bitmask(is_hit) & active;
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
    /// The distances between which an end may coincide with one at `t`.
    #[inline(always)]
    pub(in crate::world) fn around<F: F64Lanes>(&self, t: F) -> (F, F) {
        let Widening { down, up } = self.program.widening.of_packets();
        (t * F::splat(down), t * F::splat(up))
    }

    /// The intersection of the required operands; `None` if no active ray is left in it.
    #[inline(always)]
    pub(in crate::world) fn narrowed<F: F64Lanes>(
        &self,
        rays: &RayPacket<F>,
    ) -> Option<ClipInterval<F>> {
        let mut clip = ClipInterval {
            low: self.around(F::from_array(&self.rays.t_min)).0,
            high: self.around(F::from_array(&self.rays.t_max)).1,
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
            clip.enter.extend_entry(enter, operand);
            clip.leave.extend_exit(leave, operand);
            clip.low = clip.low.lane_max(self.around(enter).0);
            clip.high = clip.high.lane_min(self.around(leave).1);
            let is_open = F::bitmask(clip.low.le(clip.high)) | clip.unknown;
            if is_open & self.active == 0 {
                return None;
            }
        }
        clip.enter.tied = self.around(clip.enter.t).0.le(clip.enter.next);
        clip.leave.tied = clip.leave.next.le(self.around(clip.leave.t).1);
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
        let around = self.around(t);
        let is_alone = around.1.lt(clip.leave.t);
        let (t_min, t_max) = (&self.rays.t_min, &self.rays.t_max);
        let is_plain = (F::from_array(t_min).lt(t) & t.le(F::from_array(t_max))) & is_alone;
        let mut clear = F::bitmask(is_plain) & !(passes | F::bitmask(clip.enter.tied));
        for &number in self.others {
            if (clear | passes) & self.active != self.active {
                break;
            }
            let leaf = &self.leaves[(self.program.first + number) as usize];
            clear &= F::bitmask(match &leaf.object_from_world {
                None => leaf.shape.clearly_outside_packet(rays, t),
                Some(matrix) => leaf
                    .shape
                    .clearly_outside_packet(&rays.to_object(matrix), t),
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

    /// The nearer of `best` and an end at `t`, where that is not certainly hidden; `cuts` are the spans subtracted. Not a closure,
    /// which would not be compiled for the wide lanes.
    #[inline(always)]
    fn nearer<F: F64Lanes>(&self, clip: &ClipInterval<F>, cuts: &[(F, F)], t: F, best: F) -> F {
        let from = F::from_array(&self.rays.t_min);
        let is_within = clip.low.le(t) & t.le(clip.high);
        let mut is_shown = (from.lt(t) & is_within) & t.lt(best);
        if F::bitmask(is_shown) & self.active == 0 {
            return best;
        }
        let around = self.around(t);
        for (enter, leave) in cuts {
            is_shown = is_shown & (around.0.le(*enter) | leave.le(around.1));
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
            F::select(spans.is_hit, spans.enter, endless),
            F::select(spans.is_hit, spans.leave, -endless),
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
        leaf.shape.span_packet(&rays, low, high)
    }

    /// Collects the operands to be tested besides the required ones, and updates the active lanes: of a large program,
    /// those whose boxes some of the rays hit within their clip intervals, and those of parts whose boxes they hit.
    /// Returns `None` if there are too many.
    #[inline(always)]
    pub(crate) fn gather(&mut self, lanes: SimdLevel, others: &mut Numbers) -> Option<()> {
        let order = &self.program.order;
        let nodes = self.program.nodes.len();
        let capacity = match nodes {
            1 => MAX_OPERANDS,
            _ => MAX_OPERANDS - order.required.len(),
        };
        let Some(boxed) = &order.boxed else {
            others.extend_from_slice(&order.others);
            return Some(());
        };
        if boxed.bounded.is_empty() && order.others.len() <= capacity && nodes <= MAX_NODES {
            // All of them take less time than a search.
            others.extend_from_slice(&order.others);
            return Some(());
        }
        let ([low, high], left) = lanes.run(ClipKernel(*self));
        self.active = left;
        let (mut near, mut hit_parts) = (Boxes::new(), Boxes::new());
        for lane in (0..4).filter(|lane| left >> lane & 1 == 1) {
            let is_full = boxed.tree.any_in(
                lanes,
                &self.rays.ray(lane),
                (low[lane], high[lane]),
                #[inline(always)]
                |position| {
                    let (hits, number) = match position.checked_sub(boxed.first_part) {
                        None => (&mut near, position),
                        Some(part) => (&mut hit_parts, part),
                    };
                    !hits.contains(&number) && hits.try_push(number).is_err()
                },
            );
            if is_full {
                return None;
            }
        }
        // Parts come before those within them, which are out of reach if the rays miss the box around them.
        hit_parts.sort_unstable();
        let mut reached = Boxes::new();
        for part in hit_parts {
            let around = boxed.parts[part as usize].around;
            if around == NONE || reached.contains(&around) {
                reached.push(part);
            }
        }
        let mut add = |numbers: &[u32]| {
            let fits = others.len() + numbers.len() <= capacity;
            fits.then(|| others.extend_from_slice(numbers))
        };
        add(boxed.free_others())?;
        for &part in &reached {
            add(boxed.others_of(part))?;
        }
        for position in near {
            let part = boxed.part_of_bounded[position as usize];
            if part == NONE || reached.contains(&part) {
                add(&[boxed.bounded[position as usize]])?;
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
