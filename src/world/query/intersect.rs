//! Intersection of a ray with one item: a primitive, a CSG program or an instance.

use super::QueryScratch;
use super::packet::hits::NO_LEAF;
use crate::base::math::Ray;
use crate::base::math::simd::SimdLevel;
use crate::scene::shape::{Geometry, Root, Shape};
use crate::world::csg::sweep::{RawHit, RayInterval, SweepContext, hide_departure};
use crate::world::model::{Item, Model};
use crate::world::primitive::Leaf;
use crate::world::ray::SpawnSurface;

/// Distance from the ray's origin, in units of the error there, within which the root that the ray left almost always
/// lies.
const NEAR: f64 = 16.0;

/// Selects the hits that a query accepts.
pub(in crate::world) trait HitPolicy {
    /// If true, any accepted hit ends the search; otherwise the first one on the ray is needed.
    const ANY: bool;

    /// Returns true if the query accepts this hit.
    fn accepts(&mut self, hit: &RawHit) -> bool;
}

/// Index of a model's first leaf and first surface.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::world) struct IndexBase {
    pub(in crate::world) leaf: u32,
    pub(in crate::world) surface: u32,
}

/// A ray query in the space of a model.
#[derive(Clone, Copy)]
pub(in crate::world) struct Search<'a> {
    /// The ray, in the space of the model.
    pub(in crate::world) ray: &'a Ray,
    /// The surface point it leaves, if that belongs to the model.
    pub(in crate::world) origin_surface: Option<&'a SpawnSurface>,
    /// Hits up to this distance are ignored.
    pub(in crate::world) t_min: f64,
    /// The same for blobs, if it is larger.
    pub(in crate::world) blob_t_min: f64,
    /// The unit of distances that shapes ignore hits up to.
    pub(in crate::world) unit: f64,
    /// Up to this distance a hit may be rejected as a self-intersection, so that the search goes on behind it.
    pub(in crate::world) origin_error: f64,
    /// Base of the indices in the hits.
    pub(in crate::world) start: IndexBase,
    /// The convex leaf that the ray has exited, which need not be tested; [`NO_LEAF`] for none.
    pub(in crate::world) exited_leaf: u32,
}

impl Search<'_> {
    /// Hits on this leaf up to this distance are ignored.
    #[inline(always)]
    pub(in crate::world) fn t_min_of(&self, leaf: &Leaf) -> f64 {
        match &leaf.shape {
            Shape::Blob(_) => self.t_min.max(self.blob_t_min),
            Shape::SphereSweep(sweep) => self.t_min.max(sweep.tolerance() * self.unit),
            _ => self.t_min,
        }
    }
}

impl Model {
    /// The convex leaf that a ray has exited for good: an outgoing line leaves a convex solid once, at the ray's
    /// origin. [`NO_LEAF`] if there is none.
    #[inline(always)]
    pub(in crate::world) fn exited_convex(&self, origin: Option<&SpawnSurface>, ray: &Ray) -> u32 {
        let Some(origin) = origin else {
            return NO_LEAF;
        };
        match self.leaves.get(origin.leaf as usize) {
            Some(leaf) if origin.normal.dot(ray.dir) > 0.0 && leaf.has_exited_convex(ray) => {
                origin.leaf
            }
            _ => NO_LEAF,
        }
    }

    /// The first accepted hit on an item up to and including `far`.
    #[inline(always)]
    pub(in crate::world) fn first_hit<W: HitPolicy>(
        &self,
        item: Item,
        search: &Search,
        far: f64,
        scratch: &mut QueryScratch,
        policy: &mut W,
    ) -> Option<RawHit> {
        let start = search.start;
        match item {
            Item::Program(number) => {
                let program = &self.programs[number as usize];
                let sweep = &mut scratch.sweep;
                let interval = RayInterval {
                    from: search.t_min,
                    to: far,
                };
                let context = SweepContext {
                    leaves: &self.leaves,
                    ray: search.ray,
                    departure: search.origin_surface,
                    is_shadow: W::ANY,
                    rounding: Some(&self.rounding),
                };
                let mut first = None;
                program.nearest(context, interval, sweep, |hit| {
                    let t_min = search.t_min_of(&self.leaves[hit.leaf as usize]);
                    let hit = RawHit {
                        leaf: start.leaf + hit.leaf,
                        surface: start.surface + hit.surface,
                        ..*hit
                    };
                    let is_wanted = hit.root.t >= t_min && policy.accepts(&hit);
                    first = is_wanted.then_some(hit);
                    is_wanted
                })?;
                first
            }
            Item::Leaf(number) if number == search.exited_leaf => None,
            Item::Leaf(number) => {
                let leaf = &self.leaves[number as usize];
                let (ray, mut t_min) = (search.ray, search.t_min_of(leaf));
                loop {
                    let root = match search.origin_surface {
                        Some(origin) if origin.leaf == number && leaf.shape.is_faceted() => {
                            leaf.nearest_beside(ray, t_min, beyond(far), origin.face)?
                        }
                        Some(origin) if origin.leaf == number => nearest_but(
                            leaf,
                            origin,
                            ray,
                            (t_min, beyond(far)),
                            &mut scratch.roots,
                        )?,
                        _ => leaf.nearest(ray, t_min, beyond(far))?,
                    };
                    let hit = RawHit {
                        root,
                        leaf: start.leaf + number,
                        surface: start.surface + leaf.surface,
                    };
                    if root.t <= far && policy.accepts(&hit) {
                        return Some(hit);
                    }
                    if root.t > search.origin_error {
                        return None;
                    }
                    t_min = root.t;
                }
            }
            Item::Instance(number) => {
                self.instances[number as usize].first_hit(search, far, scratch, policy)
            }
        }
    }

    /// The first accepted hit on all items up to and including `far`, or any one if the policy is content with that. Of
    /// two at exactly the same distance, the first in the file.
    #[inline(always)]
    pub(in crate::world) fn first_hit_of_all<W: HitPolicy>(
        &self,
        lanes: SimdLevel,
        search: &Search,
        far: f64,
        scratch: &mut QueryScratch,
        policy: &mut W,
    ) -> Option<RawHit> {
        let mut best: Option<(RawHit, u32)> = None;
        let mut end = far;
        let key = |of: &(RawHit, u32)| (of.0.root.t, of.1);
        if let Some(cluster) = &self.cluster {
            let is_decided = cluster.each(
                lanes,
                search.ray,
                far,
                #[inline(always)]
                |position| {
                    let item = self.bvh.bounded[position as usize];
                    let Some(hit) = self.first_hit(item.item, search, end, scratch, policy) else {
                        return false;
                    };
                    let this = (hit, item.number);
                    if best.is_none_or(|best| key(&this) < key(&best)) {
                        end = hit.root.t;
                        best = Some(this);
                    }
                    W::ANY
                },
            );
            if is_decided {
                return best.map(|(hit, _)| hit);
            }
        }
        for item in &self.bvh.unbounded {
            if let Some(hit) = self.first_hit(item.item, search, end, scratch, policy) {
                if best.is_none_or(|(best, _)| hit.root.t < best.root.t) {
                    end = hit.root.t;
                    best = Some((hit, item.number));
                }
                if W::ANY {
                    return Some(hit);
                }
            }
        }
        let tree = &self.bvh.tree;
        if W::ANY {
            tree.any_in(
                lanes,
                search.ray,
                (0.0, far),
                #[inline(always)]
                |position| {
                    let item = self.bvh.bounded[position as usize];
                    let hit = self.first_hit(item.item, search, far, scratch, policy);
                    best = hit.map(|hit| (hit, item.number));
                    best.is_some()
                },
            );
        } else {
            tree.nearest_in(
                lanes,
                search.ray,
                (0.0, end),
                #[inline(always)]
                |position, end| {
                    let item = self.bvh.bounded[position as usize];
                    let Some(hit) = self.first_hit(item.item, search, end, scratch, policy) else {
                        return end;
                    };
                    let this = (hit, item.number);
                    if best.is_none_or(|best| key(&this) < key(&best)) {
                        best = Some(this);
                    }
                    hit.root.t
                },
            );
        }
        best.map(|(hit, _)| hit)
    }
}

/// The first visible root beyond `t_min` on the leaf that the ray starts on; one from `far` on may be missing.
#[inline(never)]
fn nearest_but(
    leaf: &Leaf,
    origin: &SpawnSurface,
    ray: &Ray,
    (t_min, far): (f64, f64),
    roots: &mut Vec<Root>,
) -> Option<Root> {
    if let Some(sphere) = leaf.world_sphere() {
        let root = sphere.other_root(ray, origin.normal.dot(ray.dir) > 0.0)?;
        return (root.t > t_min).then_some(root);
    }
    if origin.normal.dot(ray.dir) > 0.0
        && let Some(start) = leaf.departure(ray)
    {
        return leaf.nearest(ray, start.max(t_min), far);
    }
    // Of the roots of the same crossing, the one that the ray left is nearest to its origin: a root this near is that
    // one.
    let near = NEAR * origin.blur;
    roots.clear();
    let are_all = leaf.roots_from(ray, -near, near.max(t_min), roots);
    let hidden = hide_departure(roots, origin, leaf, ray.dir);
    if !are_all && hidden.is_none_or(|t| t.abs() > near) {
        roots.clear();
        leaf.roots(ray, roots);
        hide_departure(roots, origin, leaf, ray.dir);
    }
    roots
        .iter()
        .find(|root| root.is_visible && root.t > t_min)
        .copied()
}

/// A slightly larger number, which makes an exclusive limit include `far`: one or two roundings, or the least normal
/// number where that is more.
#[inline(always)]
fn beyond(far: f64) -> f64 {
    far * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE
}
