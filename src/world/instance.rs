//! A model in its place: what rays find of one copy of a union that a scene shows again and again.

use super::csg::program::RawHit;
use super::model::Model;
use super::query::intersect::{HitPolicy, IndexBase, Search};
use super::query::{Scratch, SpawnSurface};
use crate::base::math::normal_from_inverse;
use crate::base::math::simd::with_widest;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A model with the matrix that takes rays to it.
#[derive(Debug)]
pub(super) struct Instance {
    /// What it shows.
    pub(super) model: Arc<Model>,
    /// Takes what is around it to the model.
    pub(super) object_from_world: DAffine3,
    /// The number of its first leaf.
    pub(super) first: u32,
    /// The number of its first surface.
    pub(super) surface: u32,
}

impl Instance {
    /// The first surface of the model up to and including `far` that is wanted.
    #[inline(never)]
    pub(super) fn find<W: HitPolicy>(
        &self,
        search: &Search,
        far: f64,
        scratch: &mut Scratch,
        wants: &mut W,
    ) -> Option<RawHit> {
        let ray = search.ray.to_object(&self.object_from_world);
        let from = search
            .origin_surface
            .and_then(|left| self.departure(left, search.ray.dir, ray.dir));
        let inner = Search {
            ray: &ray,
            exited_leaf: self.model.exited_convex(from.as_ref(), &ray),
            origin_surface: from.as_ref(),
            t_min: search.t_min,
            origin_error: search.origin_error,
            start: IndexBase {
                leaf: search.start.leaf + self.first,
                surface: search.start.surface + self.surface,
            },
        };
        with_widest(
            #[inline(always)]
            |lanes| self.model.find_all(lanes, &inner, far, scratch, wants),
        )
    }

    /// What the model knows of the root that a ray left. All that is asked of the normal is on which side of it the ray
    /// goes.
    fn departure(&self, left: &SpawnSurface, dir: DVec3, own_dir: DVec3) -> Option<SpawnSurface> {
        let leaf = left.leaf.checked_sub(self.first)?;
        let goes_out = left.normal.dot(dir) > 0.0;
        (leaf < self.model.len()).then_some(SpawnSurface {
            leaf,
            normal: if goes_out { own_dir } else { -own_dir },
            ..*left
        })
    }

    /// The unit outward normals at a point of a leaf: the geometric one, and that for shading.
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
