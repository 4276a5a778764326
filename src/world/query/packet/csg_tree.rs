//! CSG trees for packets of four rays: like [`super::csg`], but each end is tested with the formula of the whole tree.

use super::csg_packet::{CsgPacket, CsgPacketHits, NearestEnd};
use crate::base::math::simd::{F64Lanes, SimdKernel};
use crate::world::csg::packet_strategy::{MAX_NODES, MAX_OPERANDS};
use crate::world::csg::program::{Combine, NONE};

/// A ray packet and the CSG tree that it is intersected with.
pub(in crate::world) struct CsgTreePacket<'a>(pub(in crate::world) CsgPacket<'a>);

/// An operand, and the entry and exit of each ray.
#[derive(Clone, Copy)]
struct OperandInterval<F> {
    number: u32,
    ends: (F, F),
}

/// Lanes that are certainly inside, and those that are certainly outside.
struct InsideMasks<F: F64Lanes> {
    inside: F::Mask,
    outside: F::Mask,
}

impl<F: F64Lanes> Clone for InsideMasks<F> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: F64Lanes> Copy for InsideMasks<F> {}

impl<F: F64Lanes> InsideMasks<F> {
    /// Neutral element of an operation.
    #[inline(always)]
    fn of_nothing(combine: Combine) -> Self {
        let (all, none) = (F::mask_from_bits(0b1111), F::mask_from_bits(0));
        match combine {
            Combine::Intersection => InsideMasks {
                inside: all,
                outside: none,
            },
            Combine::Union | Combine::Merge => InsideMasks {
                inside: none,
                outside: all,
            },
        }
    }

    /// Combines a part with the node.
    #[inline(always)]
    fn add(&mut self, combine: Combine, part: Self) {
        match combine {
            Combine::Intersection => {
                self.inside = self.inside & part.inside;
                self.outside = self.outside | part.outside;
            }
            Combine::Union | Combine::Merge => {
                self.inside = self.inside | part.inside;
                self.outside = self.outside & part.outside;
            }
        }
    }

    #[inline(always)]
    fn exchanged(self, is_inverse: bool) -> Self {
        if is_inverse {
            InsideMasks {
                inside: self.outside,
                outside: self.inside,
            }
        } else {
            self
        }
    }
}

impl SimdKernel for CsgTreePacket<'_> {
    type Output = CsgPacketHits;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> CsgPacketHits {
        let CsgTreePacket(packet) = self;
        let rays = packet.rays.load::<F>();
        let Some(clip) = packet.narrowed(&rays) else {
            return CsgPacketHits::NOTHING;
        };
        let mut unknown = clip.unknown;
        let mut parts = [OperandInterval {
            number: 0,
            ends: (clip.low, clip.low),
        }; MAX_OPERANDS];
        let required = &packet.program.order.required;
        let numbers = required.iter().chain(packet.others);
        let mut count = 0;
        for (part, &number) in parts.iter_mut().zip(numbers) {
            let (ends, own_unknown) = packet.ends(number, &rays, clip.low, clip.high);
            *part = OperandInterval { number, ends };
            unknown |= own_unknown & packet.active;
            count += 1;
        }
        let parts = &parts[..count];
        let rest = self.rest(parts);
        let from = F::from_array(&packet.rays.t_min);
        let mut best = F::splat(f64::INFINITY);
        for (position, part) in parts.iter().enumerate() {
            if packet.program.operands[part.number as usize].is_hidden {
                continue;
            }
            for t in [part.ends.0, part.ends.1] {
                let is_within = clip.low.le(t) & t.le(clip.high);
                let is_next = (from.lt(t) & is_within) & t.lt(best);
                if F::bitmask(is_next) & packet.active != 0 {
                    let is_covered = self.is_covered(parts, position, t, &rest);
                    best = F::select(is_next, F::select(is_covered, best, t), best);
                }
            }
        }
        let mut at = NearestEnd::new(best, packet.around(best));
        for part in parts {
            let number = F::splat(f64::from(part.number));
            at.add(part.ends.0, number);
            at.add(part.ends.1, number);
        }
        at.answer(packet.rays, unknown, packet.active)
    }
}

impl CsgTreePacket<'_> {
    /// For each node, the counts of operands not among `parts`, plain and inverse. All rays are outside their leaves,
    /// so inside the inverse ones.
    #[inline(always)]
    fn rest<F: F64Lanes>(&self, parts: &[OperandInterval<F>]) -> [[u32; 2]; MAX_NODES] {
        let order = &self.0.program.order;
        let mut rest = [[0; 2]; MAX_NODES];
        if let Some(boxed) = &order.boxed {
            for (rest, resting) in rest.iter_mut().zip(&boxed.resting) {
                *rest = *resting;
            }
            for part in &parts[order.required.len()..] {
                let operand = &self.0.program.operands[part.number as usize];
                rest[operand.parent as usize % MAX_NODES][usize::from(operand.is_inverse)] -= 1;
            }
        }
        rest
    }

    /// Lanes in which some ancestor hides the surface at `t` of the operand at `position`. An operand that also ends
    /// there is neither certainly inside nor certainly outside: a surface it may cover counts as shown, so that it is
    /// not missed.
    #[inline(always)]
    fn is_covered<F: F64Lanes>(
        &self,
        parts: &[OperandInterval<F>],
        position: usize,
        t: F,
        rest: &[[u32; 2]; MAX_NODES],
    ) -> F::Mask {
        let program = self.0.program;
        let (low, high) = self.0.around(t);
        let nodes = program.nodes.iter().take(MAX_NODES).enumerate();
        let mut sides = [InsideMasks::<F>::of_nothing(Combine::Union); MAX_NODES];
        for (at, node) in nodes.clone() {
            sides[at] = InsideMasks::of_nothing(node.combine);
            for is_inverse in [false, true] {
                if rest[at][usize::from(is_inverse)] > 0 {
                    let outside = InsideMasks::of_nothing(Combine::Union);
                    sides[at].add(node.combine, outside.exchanged(is_inverse));
                }
            }
        }
        for (other, part) in parts.iter().enumerate() {
            if other == position {
                continue;
            }
            let operand = &program.operands[part.number as usize];
            let (enter, leave) = part.ends;
            let side = InsideMasks {
                inside: enter.lt(low) & high.lt(leave),
                outside: high.lt(enter) | leave.lt(low),
            };
            let combine = program.nodes[operand.parent as usize].combine;
            let parent = operand.parent as usize % MAX_NODES;
            sides[parent].add(combine, side.exchanged(operand.is_inverse));
        }
        let mut is_covered = F::mask_from_bits(0);
        let mut above = program.operands[parts[position].number as usize].parent;
        for (at, node) in nodes.rev() {
            let own = sides[at];
            if at != above as usize {
                if node.parent != NONE {
                    let combine = program.nodes[node.parent as usize].combine;
                    let parent = node.parent as usize % MAX_NODES;
                    sides[parent].add(combine, own.exchanged(node.is_inverse));
                }
                continue;
            }
            above = node.parent;
            is_covered = match node.combine {
                Combine::Union => is_covered,
                Combine::Merge => is_covered | own.inside,
                Combine::Intersection => is_covered | own.outside,
            };
        }
        is_covered
    }
}
