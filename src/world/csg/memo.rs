//! Memo of the last CSG preparation: a program with the same structure as the one before reuses its result. Generated
//! scenes contain thousands that differ only in position and size.

use super::program::{CsgProgram, Node, Operand};
use crate::base::math::Bounds;
use crate::scene::shape::Geometry;
use crate::world::primitive::Leaf;
use smallvec::SmallVec;
use std::ops::Range;
use std::sync::Arc;

/// A program before and after [`CsgProgram::prepare`].
#[derive(Debug)]
pub(crate) struct CsgMemo {
    nodes: SmallVec<[Node; 1]>,
    operands: SmallVec<[Operand; 5]>,
    parts: SmallVec<[OperandKey; 5]>,
    boxed: Vec<Range<u32>>,
    hit_order: SmallVec<[u32; 5]>,
    ready: CsgProgram,
}

/// The properties of an operand that [`CsgProgram::prepare`] depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct OperandKey {
    is_solid: bool,
    has_matrix: bool,
    is_bounded: bool,
    may_miss_roots: bool,
}

impl OperandKey {
    fn new(leaf: &Leaf, bounds: &Bounds) -> Self {
        OperandKey {
            is_solid: leaf.shape.is_solid(),
            has_matrix: leaf.object_from_world.is_some(),
            is_bounded: bounds.is_finite() && !bounds.is_empty(),
            may_miss_roots: leaf.shape.may_miss_roots(),
        }
    }
}

impl CsgProgram {
    /// Same as [`CsgProgram::prepare`], but reuses the result in `last` if that matches; then `last` is this one.
    /// `hit_order` are the operands as POV-Ray lists their hits.
    pub(crate) fn prepare_as(
        &mut self,
        last: &mut Option<Box<CsgMemo>>,
        leaves: &[Leaf],
        bounds: &[Bounds],
        boxed: Vec<(Range<u32>, Bounds)>,
        hit_order: &[u32],
    ) {
        let own = leaves[self.first as usize..].iter().zip(bounds);
        let parts = || {
            own.clone()
                .map(|(leaf, bounds)| OperandKey::new(leaf, bounds))
        };
        if let Some(last) = last
            && last.nodes == self.nodes
            && last.operands == self.operands
            && parts().eq(last.parts.iter().copied())
            && boxed.iter().map(|(range, _)| range).eq(&last.boxed)
            && last.hit_order[..] == *hit_order
        {
            *self = CsgProgram {
                first: self.first,
                ..last.ready.clone()
            };
            return;
        }
        let mut now = Box::new(CsgMemo {
            nodes: self.nodes.clone(),
            operands: self.operands.clone(),
            parts: parts().collect(),
            boxed: boxed.iter().map(|(range, _)| range.clone()).collect(),
            hit_order: hit_order.into(),
            ready: CsgProgram::default(),
        });
        self.prepare(leaves, bounds, boxed);
        self.tie_ranks = tie_ranks(hit_order);
        // A BVH depends on positions, so the result cannot be reused.
        let is_anywhere = self.order.boxed.is_none();
        *last = is_anywhere.then(|| {
            now.ready = self.clone();
            now
        });
    }
}

/// The rank of each operand among operands that are hit at one distance, the highest of which is shown; `None` if they
/// rank by their numbers.
fn tie_ranks(hit_order: &[u32]) -> Option<Arc<[u32]>> {
    if hit_order.is_sorted() {
        return None;
    }
    let mut ranks = vec![0; hit_order.len()];
    for (rank, &operand) in (0..).zip(hit_order) {
        ranks[operand as usize] = rank;
    }
    Some(ranks.into())
}

#[cfg(test)]
mod tests {
    use crate::base::math::sampling::random::Random;
    use crate::world::csg::simplify::tests::random_program;

    #[test]
    fn a_combination_like_the_one_before_is_made_ready_as_by_itself() {
        let mut rng = Random::new(43);
        let (mut last, mut again) = (None, 0);
        for _ in 0..2000 {
            let seed = rng.bits();
            for _ in 0..2 {
                let (mut alone, leaves, bounds) = random_program(&mut Random::new(seed));
                let mut as_last = alone.clone();
                let had = last.is_some();
                alone.prepare(&leaves, &bounds, Vec::new());
                as_last.prepare_as(&mut last, &leaves, &bounds, Vec::new(), &[]);
                again += usize::from(had && last.is_some());
                let described = |program: &super::CsgProgram| {
                    let super::CsgProgram {
                        nodes,
                        operands,
                        turned,
                        order,
                        ..
                    } = program;
                    format!(
                        "{nodes:?} {operands:?} {turned:?} {order:?} {:?}",
                        program.rest.counts
                    )
                };
                assert_eq!(described(&alone), described(&as_last));
            }
        }
        assert!(again > 1000, "{again}");
    }
}
