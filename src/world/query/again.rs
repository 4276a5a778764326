//! Hits of photons that POV-Ray finds by its rounding alone.

use crate::base::math::Ray;
use crate::scene::shape::{Crossing, Root};
use crate::world::compiled::World;
use crate::world::csg::sweep::RawHit;
use crate::world::query::closest::POV_RAY_T_MIN;
use crate::world::ray::{Hit, SpawnSurface};

impl World {
    /// The hit on the sphere that a photon leaves, before its nearest hit: photons of far lights are so far beside the
    /// sphere that POV-Ray's formula gives a root beyond its minimum distance.
    #[must_use]
    pub fn hit_again(&self, ray: &Ray, from: &SpawnSurface, nearest: Option<&Hit>) -> Option<Hit> {
        let sphere = self.model.world_sphere(from.leaf)?;
        let unit = self.globals.unit;
        let (t, is_exit) = sphere.rounded_root_beyond(ray, POV_RAY_T_MIN * unit, unit)?;
        let is_nearest = |hit: &Hit| {
            let is_same_root = hit.spawn_surface.leaf == from.leaf && hit.t < 2.0 * t;
            hit.t <= t || is_same_root
        };
        // Of roots in CSG the search has decided, which may hide them.
        let is_in_csg = || self.model.program_of(from.leaf).is_some();
        if nearest.is_some_and(is_nearest) || is_in_csg() {
            return None;
        }
        let root = Root {
            t,
            crossing: match is_exit {
                true => Crossing::Leave,
                false => Crossing::Enter,
            },
            face: 0,
            is_visible: true,
        };
        let hit = RawHit {
            root,
            leaf: from.leaf,
            surface: self.model.leaves[from.leaf as usize].surface,
        };
        Some(self.hit(ray, &hit))
    }
}
