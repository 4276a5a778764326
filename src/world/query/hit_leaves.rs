//! The primitives that rays have hit, to know on which surfaces a part of a picture depends.
//!
//! Noted are the hits whose surfaces are shaded. Opaque surfaces that only end shadow rays are not: their textures do not
//! matter.

use super::ClosestHit;

/// Least number of notes before repeated ones are removed.
const MANY: usize = 1 << 14;

/// Indices of primitives.
#[derive(Debug, Default)]
pub struct HitLeaves {
    leaves: Vec<u32>,
    /// Number of notes from which repeated ones are removed again.
    many: usize,
}

impl HitLeaves {
    /// The indices, ascending, each once.
    #[must_use]
    pub fn into_sorted(mut self) -> Vec<u32> {
        self.sort();
        self.leaves.shrink_to_fit();
        self.leaves
    }

    #[inline]
    pub(super) fn note(&mut self, leaf: u32) {
        if self.leaves.last() == Some(&leaf) {
            return;
        }
        self.leaves.push(leaf);
        if self.leaves.len() > self.many {
            self.sort();
            self.many = MANY.max(2 * self.leaves.len());
        }
    }

    pub(super) fn note_all(&mut self, bests: &[Option<ClosestHit>]) {
        for best in bests.iter().flatten() {
            self.note(best.hit.leaf);
        }
    }

    fn sort(&mut self) {
        self.leaves.sort_unstable();
        self.leaves.dedup();
    }
}
