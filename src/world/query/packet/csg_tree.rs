//! Combinations of combinations, for four rays at once: as `four`, with the formula of the whole tree for each end.

use super::csg::{CsgPacket, CsgPacketHits, MOST_NODES, MOST_OPERANDS, NearestEnd};
use crate::base::math::simd::{F64Lanes, SimdKernel};
use crate::world::csg::program::{Combine, NONE};

/// Four rays on their way through a combination of combinations.
pub(in crate::world) struct CsgTreePacket<'a>(pub(in crate::world) CsgPacket<'a>);

/// An operand, and where four rays enter and leave it.
#[derive(Clone, Copy)]
struct OperandInterval<F> {
    number: u32,
    ends: (F, F),
}

/// Which rays are certainly inside of something, and which outside.
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
    /// Where a combination of nothing is.
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

    /// Takes in a part of a combination.
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
        let CsgTreePacket(passing) = self;
        let rays = passing.rays.load::<F>();
        let Some(held) = passing.narrowed(&rays) else {
            return CsgPacketHits::NOTHING;
        };
        let mut unknown = held.unknown;
        let mut parts = [OperandInterval {
            number: 0,
            ends: (held.low, held.low),
        }; MOST_OPERANDS];
        let required = &passing.program.order.required;
        let numbers = required.iter().chain(passing.others);
        let mut count = 0;
        for (part, &number) in parts.iter_mut().zip(numbers) {
            let (ends, own_unknown) = passing.ends(number, &rays, (held.low, held.high));
            *part = OperandInterval { number, ends };
            unknown |= own_unknown & passing.there;
            count += 1;
        }
        let parts = &parts[..count];
        let apart = self.apart(parts);
        let from = F::from_array(&passing.rays.from);
        let mut best = F::splat(f64::INFINITY);
        for (place, part) in parts.iter().enumerate() {
            if passing.program.operands[part.number as usize].is_hidden {
                continue;
            }
            for t in [part.ends.0, part.ends.1] {
                let is_within = held.low.le(t) & t.le(held.high);
                let is_next = (from.lt(t) & is_within) & t.lt(best);
                if F::bitmask(is_next) & passing.there != 0 {
                    let is_covered = self.is_covered((parts, place), t, &apart);
                    best = F::select(is_next, F::select(is_covered, best, t), best);
                }
            }
        }
        let mut at = NearestEnd::none();
        for part in parts {
            let number = F::splat(f64::from(part.number));
            at.meet(part.ends.0.eq(best), number);
            at.meet(part.ends.1.eq(best), number);
        }
        at.answer(best, unknown, passing.there)
    }
}

impl CsgTreePacket<'_> {
    /// What the operands that are not among these come to in each node: outside of all of them the ray may be inside of
    /// what they stand for, or not.
    #[inline(always)]
    fn apart<F: F64Lanes>(&self, parts: &[OperandInterval<F>]) -> [[u32; 2]; MOST_NODES] {
        let order = &self.0.program.order;
        let mut apart = [[0; 2]; MOST_NODES];
        if let Some(boxed) = &order.boxed {
            for (apart, resting) in apart.iter_mut().zip(&boxed.resting) {
                *apart = *resting;
            }
            for part in &parts[order.required.len()..] {
                let operand = &self.0.program.operands[part.number as usize];
                apart[operand.parent as usize % MOST_NODES][usize::from(operand.is_inverse)] -= 1;
            }
        }
        apart
    }

    /// To which rays some node above does not let the surface of the operand in a place at `t` through. Of an operand that
    /// ends there too neither side is certain: what it may cover counts as shown, so that it is not passed over.
    #[inline(always)]
    fn is_covered<F: F64Lanes>(
        &self,
        (parts, place): (&[OperandInterval<F>], usize),
        t: F,
        apart: &[[u32; 2]; MOST_NODES],
    ) -> F::Mask {
        let program = self.0.program;
        let nodes = program.nodes.iter().take(MOST_NODES).enumerate();
        let mut sides = [InsideMasks::<F>::of_nothing(Combine::Union); MOST_NODES];
        for (at, node) in nodes.clone() {
            sides[at] = InsideMasks::of_nothing(node.combine);
            for is_inverse in [false, true] {
                if apart[at][usize::from(is_inverse)] > 0 {
                    let outside = InsideMasks::of_nothing(Combine::Union);
                    sides[at].add(node.combine, outside.exchanged(is_inverse));
                }
            }
        }
        for (other, part) in parts.iter().enumerate() {
            if other == place {
                continue;
            }
            let operand = &program.operands[part.number as usize];
            let (enter, leave) = part.ends;
            let side = InsideMasks {
                inside: enter.lt(t) & t.lt(leave),
                outside: t.lt(enter) | leave.lt(t),
            };
            let combine = program.nodes[operand.parent as usize].combine;
            let parent = operand.parent as usize % MOST_NODES;
            sides[parent].add(combine, side.exchanged(operand.is_inverse));
        }
        let mut is_covered = F::mask_from_bits(0);
        let mut above = program.operands[parts[place].number as usize].parent;
        for (at, node) in nodes.rev() {
            let own = sides[at];
            if at != above as usize {
                if node.parent != NONE {
                    let combine = program.nodes[node.parent as usize].combine;
                    let parent = node.parent as usize % MOST_NODES;
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
