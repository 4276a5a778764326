//! The packet algorithm that suits a CSG program.

use super::program::{Combine, CsgProgram};
use crate::world::primitive::Leaf;
use smallvec::SmallVec;

/// Most operands tested end by end, besides the required ones; the work grows with the square.
pub(in crate::world) const MAX_OPERANDS: usize = 16;
/// Most nodes above the operands tested.
pub(in crate::world) const MAX_NODES: usize = 8;

/// Indices of operands.
pub(in crate::world) type Numbers = SmallVec<[u32; MAX_OPERANDS]>;

/// The packet algorithm for a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::world) enum PacketStrategy {
    /// None: rays are intersected one by one.
    Scalar,
    /// A single intersection.
    Intersection,
    /// A tree of operations.
    Tree,
}

impl CsgProgram {
    /// Selects the algorithm for packets.
    pub(in crate::world) fn packet_strategy(&self, leaves: &[Leaf]) -> PacketStrategy {
        let boxed = self.order.boxed.as_ref();
        let always = boxed.map_or(&self.order.others[..], |boxed| boxed.free_others());
        let count = always.len();
        // Operands in the BVH need no packet code: few rays come near them.
        let mut always_tested = self.order.required.iter().chain(always);
        let has_spans = |&number: &u32| {
            leaves[(self.first + number) as usize]
                .shape
                .has_span_packet()
        };
        if count > MAX_OPERANDS || !always_tested.all(has_spans) {
            return PacketStrategy::Scalar;
        }
        match self.nodes.as_slice() {
            // Here all operands that are not inverse are required, so the others are subtracted.
            [node] if node.combine == Combine::Intersection && !node.is_inverse => {
                PacketStrategy::Intersection
            }
            // Of many nodes those above the operands that rays come near are few.
            nodes if nodes.len() <= MAX_NODES || boxed.is_some() => {
                if count + self.order.required.len() <= MAX_OPERANDS {
                    PacketStrategy::Tree
                } else {
                    PacketStrategy::Scalar
                }
            }
            _ => PacketStrategy::Scalar,
        }
    }
}
