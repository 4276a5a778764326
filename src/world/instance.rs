//! An instance of a shared model: one copy of a union that a scene repeats.

use super::csg::program::RawHit;
use super::model::Model;
use super::query::intersect::{HitPolicy, IndexBase, Search};
use super::query::{Scratch, SpawnSurface};
use crate::base::math::normal_from_inverse;
use crate::base::math::simd::with_widest;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A shared model with its transform.
#[derive(Debug)]
pub(super) struct Instance {
    /// The shared model.
    pub(super) model: Arc<Model>,
    /// World-to-model matrix; the world is the surrounding model.
    pub(super) object_from_world: DAffine3,
    /// Index of its first leaf.
    pub(super) first: u32,
    /// Index of its first surface.
    pub(super) surface: u32,
}

impl Instance {
    /// The first accepted hit on the model up to and including `far`.
    #[inline(never)]
    pub(super) fn first_hit<W: HitPolicy>(
        &self,
        search: &Search,
        far: f64,
        scratch: &mut Scratch,
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

    /// The unit outward normals at a point of a leaf: the geometric one and the shading normal.
    pub(super) fn normals(&self, leaf: u32, point: DVec3, face: u32) -> (DVec3, DVec3) {
        let local = self.object_from_world.transform_point3(point);
        let (geometric, shading) = self.model.normals(leaf - self.first, local, face);
        let around =
            |normal| normal_from_inverse(&self.object_from_world, normal).normalize_or_zero();
        let turned = around(geometric);
        let is_smooth = shading != geometric;
        (turned, if is_smooth { around(shading) } else { turned })
    }
}
