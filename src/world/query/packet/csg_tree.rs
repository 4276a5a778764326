//! CSG trees for packets of four rays: like [`super::csg`], but each end is tested with the formula of the tree above the
//! operands tested.

use super::csg_packet::{CsgPacket, CsgPacketHits, NearestEnd};
use crate::base::math::simd::{F64Lanes, SimdKernel};
use crate::world::csg::packet_strategy::{MAX_NODES, MAX_OPERANDS};
use crate::world::csg::program::{Combine, CsgProgram, NONE, Node};
use arrayvec::ArrayVec;

/// A ray packet and the CSG tree that it is intersected with.
pub(in crate::world) struct CsgTreePacket<'a>(pub(in crate::world) CsgPacket<'a>);

/// An operand, and the entry and exit of each ray.
#[derive(Clone, Copy)]
struct OperandInterval<F> {
    number: u32,
    /// The index of its parent in a [`Subtree`].
    parent: usize,
    ends: (F, F),
}

/// The nodes above some operands.
struct Subtree {
    /// Their indices in the program, parents before children; empty if these are all nodes of the program.
    numbers: ArrayVec<u32, MAX_NODES>,
    /// The nodes, with indices of parents in this list.
    nodes: ArrayVec<Node, MAX_NODES>,
    /// For each node, the numbers of its other children that do not contain the rays, and of those that do. All rays are
    /// outside their leaves.
    rest: [[u32; 2]; MAX_NODES],
}

impl Subtree {
    /// The nodes above these operands, or all nodes if they are few; `None` if there are too many.
    fn above(program: &CsgProgram, operands: impl Iterator<Item = u32> + Clone) -> Option<Subtree> {
        let mut subtree = Subtree {
            numbers: ArrayVec::new(),
            nodes: ArrayVec::new(),
            rest: [[0; 2]; MAX_NODES],
        };
        if program.nodes.len() <= MAX_NODES {
            subtree.nodes.extend(program.nodes.iter().cloned());
        } else {
            subtree.numbers = numbers_above(program, operands.clone())?;
            for &number in &subtree.numbers {
                let node = program.nodes[number as usize].clone();
                let parent = subtree.index(node.parent);
                subtree.nodes.push(Node { parent, ..node });
            }
        }
        let Some(boxed) = &program.order.boxed else {
            return Some(subtree);
        };
        let has_all_nodes = subtree.numbers.is_empty();
        if has_all_nodes && operands.clone().count() == program.operands.len() {
            return Some(subtree);
        }
        for number in operands {
            let operand = &program.operands[number as usize];
            let parent = subtree.index(operand.parent) as usize;
            subtree.rest[parent % MAX_NODES][usize::from(operand.is_inverse)] += 1;
        }
        for (at, node) in (0..).zip(&subtree.nodes) {
            let count = program.rest.counts[subtree.number(at) as usize];
            if let Some(listed) = subtree.rest.get_mut(node.parent as usize) {
                listed[usize::from(node.holds(count))] += 1;
            }
        }
        for (at, _) in (0..).zip(&subtree.nodes) {
            let all = boxed.resting[subtree.number(at) as usize];
            let listed = &mut subtree.rest[at as usize];
            *listed = [all[0] - listed[0], all[1] - listed[1]];
        }
        Some(subtree)
    }

    /// The index in the program of a node of this list.
    #[inline(always)]
    fn number(&self, at: u32) -> u32 {
        self.numbers.get(at as usize).copied().unwrap_or(at)
    }

    /// The index in this list of a node of the program; [`NONE`] for that.
    #[inline(always)]
    fn index(&self, number: u32) -> u32 {
        if self.numbers.is_empty() {
            return number;
        }
        let mut own = (0..).zip(&self.numbers);
        own.find(|(_, own)| **own == number)
            .map_or(NONE, |(index, _)| index)
    }
}

/// The nodes above these operands, parents before children; `None` if there are too many.
fn numbers_above(
    program: &CsgProgram,
    operands: impl Iterator<Item = u32>,
) -> Option<ArrayVec<u32, MAX_NODES>> {
    let mut numbers = ArrayVec::new();
    for number in operands {
        let mut above = program.operands[number as usize].parent;
        while above != NONE && !numbers.contains(&above) {
            numbers.try_push(above).ok()?;
            above = program.nodes[above as usize].parent;
        }
    }
    numbers.sort_unstable();
    Some(numbers)
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
        let required = &packet.program.order.required;
        let numbers = required.iter().chain(packet.others).copied();
        let Some(tree) = Subtree::above(packet.program, numbers.clone()) else {
            return CsgPacketHits {
                unknown: packet.active,
                ..CsgPacketHits::NOTHING
            };
        };
        let mut unknown = clip.unknown;
        let mut parts = [OperandInterval {
            number: 0,
            parent: 0,
            ends: (clip.low, clip.low),
        }; MAX_OPERANDS];
        let mut count = 0;
        for (part, number) in parts.iter_mut().zip(numbers) {
            let (ends, own_unknown) = packet.ends(number, &rays, clip.low, clip.high);
            let parent = tree.index(packet.program.operands[number as usize].parent) as usize;
            *part = OperandInterval {
                number,
                parent,
                ends,
            };
            unknown |= own_unknown & packet.active;
            count += 1;
        }
        let parts = &parts[..count];
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
                    let is_covered = self.is_covered(&tree, parts, position, t);
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
    /// Lanes in which some ancestor hides the surface at `t` of the operand at `position`. An operand that also ends
    /// there is neither certainly inside nor certainly outside: a surface it may cover counts as shown, so that it is
    /// not missed.
    #[inline(always)]
    fn is_covered<F: F64Lanes>(
        &self,
        tree: &Subtree,
        parts: &[OperandInterval<F>],
        position: usize,
        t: F,
    ) -> F::Mask {
        let program = self.0.program;
        let (low, high) = self.0.around(t);
        let nodes = tree.nodes.iter().enumerate();
        let mut sides = [InsideMasks::<F>::of_nothing(Combine::Union); MAX_NODES];
        for ((at, node), rest) in nodes.clone().zip(&tree.rest) {
            sides[at] = InsideMasks::of_nothing(node.combine);
            for (is_in, &count) in [false, true].into_iter().zip(rest) {
                if count > 0 {
                    let outside = InsideMasks::of_nothing(Combine::Union);
                    sides[at].add(node.combine, outside.exchanged(is_in));
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
            let parent = part.parent % MAX_NODES;
            let combine = tree.nodes[parent].combine;
            sides[parent].add(combine, side.exchanged(operand.is_inverse));
        }
        let mut is_covered = F::mask_from_bits(0);
        let mut above = parts[position].parent;
        for (at, node) in nodes.rev() {
            let own = sides[at];
            if at != above {
                if let Some(parent) = tree.nodes.get(node.parent as usize) {
                    let side = own.exchanged(node.is_inverse);
                    sides[node.parent as usize % MAX_NODES].add(parent.combine, side);
                }
                continue;
            }
            above = node.parent as usize;
            is_covered = match node.combine {
                Combine::Union => is_covered,
                Combine::Merge => is_covered | own.inside,
                Combine::Intersection => is_covered | own.outside,
            };
        }
        is_covered
    }
}
