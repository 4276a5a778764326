//! The CSG program: a tree of n-ary nodes over leaves, stored as a flat list, parents before children.

use super::coincidence::Widening;
use super::inside::InsideInit;
use crate::base::accel::Bvh;
use crate::world::primitive::Leaf;
use glam::DVec3;
use smallvec::{SmallVec, smallvec};
use std::ops::Range;
use std::sync::Arc;

/// Operation of a node on its children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combine {
    /// Shows all surfaces; inside where any child is.
    Union,
    /// Shows surfaces outside the other children; inside where any child is.
    Merge,
    /// Shows surfaces inside the other children; inside where all children are.
    Intersection,
}

/// The parent of the root.
pub(crate) const NONE: u32 = u32::MAX;

/// An inner node of a CSG program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    /// Its operation.
    pub(crate) combine: Combine,
    /// True if inside and outside are exchanged.
    pub(crate) is_inverse: bool,
    /// Number of children.
    pub(crate) children: u32,
    /// Its parent, or [`NONE`].
    pub(crate) parent: u32,
}

impl Node {
    /// Returns true if a ray inside `count` children is inside the node.
    #[inline(always)]
    pub(in crate::world) fn holds(&self, count: u32) -> bool {
        let least = match self.combine {
            // An intersection of nothing contains everything, as in POV-Ray.
            Combine::Intersection => self.children,
            Combine::Union | Combine::Merge => 1,
        };
        (count >= least) != self.is_inverse
    }

    /// Returns true if the other children leave the surface of one child visible, with the ray inside `count` in all.
    #[inline(always)]
    pub(super) fn lets_through(&self, count: u32, child_in: bool) -> bool {
        let others = count - u32::from(child_in);
        match self.combine {
            Combine::Union => true,
            Combine::Merge => others == 0,
            Combine::Intersection => others + 1 == self.children,
        }
    }
}

/// A leaf as an operand of the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Operand {
    /// The parent node.
    pub(crate) parent: u32,
    /// True if inside and outside are exchanged.
    pub(crate) is_inverse: bool,
    /// True if its surface is never shown: it only clips.
    pub(crate) is_hidden: bool,
}

/// CSG of the leaves `first .. first + operands.len()` of a model. Scenes may have many small programs, which store
/// their parts inline.
#[derive(Clone, Debug, Default)]
pub(crate) struct CsgProgram {
    /// The nodes, parents before children.
    pub(crate) nodes: SmallVec<[Node; 1]>,
    /// The operands, in the order of the leaves.
    pub(crate) operands: SmallVec<[Operand; 5]>,
    /// The rank of each operand where surfaces coincide, the highest of which is shown; `None` if that is its number.
    pub(crate) tie_ranks: Option<Arc<[u32]>>,
    /// Index of the first leaf.
    pub(crate) first: u32,
    /// The `bounded_by` objects.
    pub(crate) gates: Vec<BoundGate>,
    /// Inside state of a ray outside all leaves.
    pub(crate) rest: InsideInit,
    /// Inverse patches, sorted; inversion only flips the side of their normals.
    pub(crate) turned: SmallVec<[u32; 4]>,
    /// The order in which operands are intersected.
    pub(crate) order: OperandOrder,
    /// The rule by which surfaces coincide.
    pub(crate) widening: Widening,
}

/// Operands that a ray can hit only if it hits a bounding object.
#[derive(Clone, Debug)]
pub(crate) struct BoundGate {
    /// The operands.
    pub(crate) operands: Range<u32>,
    /// The bounding object.
    pub(crate) bound: CsgProgram,
    /// True if shadow rays hit the operands all the same.
    pub(crate) spares_shadows: bool,
    /// True if it holds only in scenes for which POV-Ray builds a tree.
    pub(crate) needs_tree: bool,
}

impl CsgProgram {
    /// Returns true if inside and outside of an operand are exchanged, by itself or by its ancestors; false for an
    /// index out of range.
    pub(crate) fn is_inverse(&self, operand: u32) -> bool {
        let is_turned = self.turned.binary_search(&operand).is_ok();
        let Some(operand) = self.operands.get(operand as usize) else {
            return false;
        };
        let (mut is_inverse, mut above) = (operand.is_inverse != is_turned, operand.parent);
        while above != NONE {
            let node = &self.nodes[above as usize];
            is_inverse ^= node.is_inverse;
            above = node.parent;
        }
        is_inverse
    }

    /// Updates the indices of its leaves, and of those of its bounding objects, after reordering.
    pub(crate) fn move_leaves(&mut self, positions: &[u32]) {
        if let Some(position) = positions.get(self.first as usize) {
            self.first = *position;
        }
        for gate in &mut self.gates {
            gate.bound.move_leaves(positions);
        }
    }

    /// Indices of its leaves.
    pub(crate) fn leaves(&self) -> Range<u32> {
        self.first..self.first + self.len()
    }

    /// Number of its leaves.
    pub(crate) fn len(&self) -> u32 {
        u32::try_from(self.operands.len()).unwrap_or(u32::MAX)
    }

    /// Completes the counts of nodes from those of their leaves: each node that contains the ray counts in its parent.
    pub(crate) fn count_from_below(&self, counts: &mut [u32]) {
        for (number, node) in self.nodes.iter().enumerate().rev() {
            if node.parent != NONE && node.holds(counts[number]) {
                counts[node.parent as usize] += 1;
            }
        }
    }

    /// Returns true if a point lies in the solid, by each leaf's own rule for points on its surface.
    pub(crate) fn contains(&self, leaves: &[Leaf], point: DVec3) -> bool {
        let mut counts: SmallVec<[u32; 8]> = smallvec![0; self.nodes.len()];
        for (index, operand) in self.operands.iter().enumerate() {
            let holds = leaves[self.first as usize + index].contains(point);
            if holds != operand.is_inverse && operand.parent != NONE {
                counts[operand.parent as usize] += 1;
            }
        }
        self.count_from_below(&mut counts);
        self.nodes[0].holds(counts[0])
    }
}

/// The order in which a program intersects its operands.
#[derive(Clone, Debug, Default)]
pub(crate) struct OperandOrder {
    /// Required operands: nothing shows outside them, so they clip the interval of the ray.
    pub(crate) required: SmallVec<[u32; 4]>,
    /// All others, except those in the BVH.
    pub(crate) others: SmallVec<[u32; 4]>,
    /// Operands in which the points of other surfaces are tested, because their own roots may miss a part.
    pub(crate) point_tested: SmallVec<[u32; 2]>,
    /// BVH over operands and parts, if there are enough.
    pub(crate) boxed: Option<Box<OperandBvh>>,
}

/// A part of a program with a box of its own. If the box is missed, its operands are skipped.
#[derive(Clone, Debug)]
pub(crate) struct BoxedPart {
    /// The smallest part around it, or [`NONE`].
    pub(crate) around: u32,
    /// Those of [`OperandBvh::others`] that are in this part and in none within it.
    pub(crate) others: Range<u32>,
}

/// BVH over operands and parts of a program.
#[derive(Clone, Debug)]
pub(crate) struct OperandBvh {
    /// Over `bounded`, followed by `parts`.
    pub(crate) tree: Bvh,
    /// The largest extent of all its boxes along an axis.
    pub(crate) size: f64,
    /// The bounded operands of a large program, which come first in the BVH.
    pub(crate) bounded: Vec<u32>,
    /// Their number: the position of the first part in the BVH.
    pub(crate) first_part: u32,
    /// For each of them, the smallest part that contains it, or [`NONE`].
    pub(crate) part_of_bounded: Vec<u32>,
    /// The parts with boxes of their own; each comes before those within it.
    pub(crate) parts: Vec<BoxedPart>,
    /// [`OperandOrder::others`] by the smallest part that contains them; those in no part come last.
    pub(crate) others: Vec<u32>,
    /// The number of those in a part.
    pub(crate) others_in_parts: u32,
    /// For each node, the numbers of its children, operands and nodes, that do not contain a ray outside all boxes, and of
    /// those that do.
    pub(crate) resting: Vec<[u32; 2]>,
}

impl OperandBvh {
    /// The operands outside the BVH that are in no part.
    pub(crate) fn free_others(&self) -> &[u32] {
        &self.others[self.others_in_parts as usize..]
    }

    /// The operands outside the BVH that are in a part and in none within it.
    #[inline(always)]
    pub(crate) fn others_of(&self, part: u32) -> &[u32] {
        let others = &self.parts[part as usize].others;
        &self.others[others.start as usize..others.end as usize]
    }
}
