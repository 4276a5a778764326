//! Queries of single rays on instances.

use super::QueryScratch;
use super::intersect::{HitPolicy, IndexBase, Search};
use crate::base::math::simd::with_widest;
use crate::world::csg::sweep::RawHit;
use crate::world::model::Instance;
use crate::world::ray::SpawnSurface;
use glam::DVec3;

impl Instance {
    /// The first accepted hit on the model up to and including `far`.
    #[inline(never)]
    pub(super) fn first_hit<W: HitPolicy>(
        &self,
        search: &Search,
        far: f64,
        scratch: &mut QueryScratch,
        policy: &mut W,
    ) -> Option<RawHit> {
        let ray = search.ray.to_object(&self.object_from_world);
        let origin_surface = search
            .origin_surface
            .and_then(|origin| self.departure(origin, search.ray.dir, ray.dir));
        let inner = Search {
            ray: &ray,
            exited_leaf: self.model.exited_convex(origin_surface.as_ref(), &ray),
            origin_surface: origin_surface.as_ref(),
            t_min: search.t_min,
            blob_t_min: search.blob_t_min,
            unit: search.unit,
            origin_error: search.origin_error,
            start: IndexBase {
                leaf: search.start.leaf + self.first,
                surface: search.start.surface + self.surface,
            },
        };
        with_widest(
            #[inline(always)]
            |lanes| {
                self.model
                    .first_hit_of_all(lanes, &inner, far, scratch, policy)
            },
        )
    }

    /// The surface point that a ray leaves, in terms of the model. Of the normal, only the side on which the ray leaves
    /// is used.
    fn departure(&self, origin: &SpawnSurface, dir: DVec3, own_dir: DVec3) -> Option<SpawnSurface> {
        let leaf = origin.leaf.checked_sub(self.first)?;
        let goes_out = origin.normal.dot(dir) > 0.0;
        (leaf < self.model.len()).then_some(SpawnSurface {
            leaf,
            normal: if goes_out { own_dir } else { -own_dir },
            ..*origin
        })
    }
}
