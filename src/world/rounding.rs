//! The leaves of a model whose hits are wanted with the last digits of POV-Ray.

use crate::scene::shape::{Geometry, Rounded};
use crate::world::primitive::Leaf;
use rustc_hash::FxHashMap;

/// The leaves whose hits are wanted with POV-Ray's rounding.
#[derive(Debug, Default)]
pub(crate) struct Rounding {
    /// Their rounded forms; spheres in world coordinates need none.
    pub(crate) forms: FxHashMap<u32, Rounded>,
    /// A bit for each leaf; empty if no hit of a picture is rounded.
    pub(crate) leaves: Vec<u64>,
}

impl Rounding {
    /// The form of a leaf, if it is known and decides ties.
    pub(crate) fn of_ties(&self, leaf: u32, leaves: &[Leaf]) -> Option<&Rounded> {
        let form = self.forms.get(&leaf)?;
        let decides = leaves.get(leaf as usize)?.shape.decides_ties();
        decides.then_some(form)
    }

    /// True if hits on a leaf are rounded.
    #[inline(always)]
    pub(crate) fn is_wanted(&self, leaf: u32) -> bool {
        let bits = self.leaves.get((leaf / u64::BITS) as usize);
        bits.is_some_and(|bits| bits >> (leaf % u64::BITS) & 1 == 1)
    }
}
