//! The leaves of a model whose hits are wanted with the last digits of POV-Ray.

use crate::base::math::Ray;
use crate::base::math::conditioning::Normalization;
use crate::scene::shape::{Geometry, Root, Rounded, RoundedHit};
use crate::world::primitive::Leaf;
use rustc_hash::FxHashMap;

/// The leaves whose hits are wanted with POV-Ray's rounding.
#[derive(Debug, Default)]
pub(crate) struct Rounding {
    /// Their rounded forms, of those that need one ([`Leaf::knows_rounding`]).
    pub(crate) forms: FxHashMap<u32, Rounded>,
    /// A bit for each leaf; empty if no hit of a picture is rounded.
    pub(crate) leaves: Vec<u64>,
    /// The rounding of what is divided by a length.
    pub(crate) normalization: Normalization,
}

impl Rounding {
    /// Returns true if the rounded distances of a leaf are known and decide ties.
    pub(crate) fn decides_ties(&self, leaf: u32, leaves: &[Leaf]) -> bool {
        leaves.get(leaf as usize).is_some_and(|of| {
            of.decides_ties_itself() || of.shape.decides_ties() && self.forms.contains_key(&leaf)
        })
    }

    /// The distance of a root of a leaf as POV-Ray rounds it, if it is known and decides ties.
    pub(crate) fn tied_distance(
        &self,
        leaf: u32,
        leaves: &[Leaf],
        ray: &Ray,
        root: &Root,
    ) -> Option<f64> {
        let decides = self.decides_ties(leaf, leaves);
        let hit = || self.hit(leaf, leaves, ray, root.t, root.face);
        decides.then(hit)?.map(|hit| hit.t)
    }

    /// The hit of a ray on a face of a leaf near `t` with POV-Ray's rounding, if that is known.
    pub(crate) fn hit(
        &self,
        leaf: u32,
        leaves: &[Leaf],
        ray: &Ray,
        t: f64,
        face: u32,
    ) -> Option<RoundedHit> {
        match self.forms.get(&leaf) {
            Some(form) => form.hit(ray, t, face),
            None => leaves
                .get(leaf as usize)?
                .rounded_hit(ray, t, face, self.normalization),
        }
    }

    /// True if hits on a leaf are rounded.
    #[inline(always)]
    pub(crate) fn is_wanted(&self, leaf: u32) -> bool {
        let bits = self.leaves.get((leaf / u64::BITS) as usize);
        bits.is_some_and(|bits| bits >> (leaf % u64::BITS) & 1 == 1)
    }
}
