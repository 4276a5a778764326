//! The first surface of one item on a ray.

use super::packet::hits::NO_LEAF;
use super::{Scratch, SpawnSurface};
use crate::base::math::Ray;
use crate::base::math::simd::SimdLevel;
use crate::scene::shape::{Geometry, Root, Shape};
use crate::world::csg::program::{RawHit, hide_departure};
use crate::world::model::{Item, Model};
use crate::world::primitive::Leaf;

/// As far from the start of a ray as the root that it has left almost always is, in units of the blur there.
const NEAR: f64 = 16.0;

/// Which surfaces a question is about.
pub(in crate::world) trait HitPolicy {
    /// Whether any of them will do; otherwise it must be the first.
    const ANY: bool;

    /// Whether it is about this one.
    fn takes(&mut self, found: &RawHit) -> bool;
}

/// Where the numbers of a model begin.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::world) struct IndexBase {
    pub(in crate::world) leaf: u32,
    pub(in crate::world) surface: u32,
}

/// A ray as a model sees it.
#[derive(Clone, Copy)]
pub(in crate::world) struct Search<'a> {
    /// The ray, in the space of the model.
    pub(in crate::world) ray: &'a Ray,
    /// The root it left, if that is one of the model's.
    pub(in crate::world) origin_surface: Option<&'a SpawnSurface>,
    /// Up to this distance nothing counts.
    pub(in crate::world) t_min: f64,
    /// Up to this distance a surface may be refused because the ray starts on it, and another one come behind.
    pub(in crate::world) origin_error: f64,
    /// Where the numbers of what is found begin.
    pub(in crate::world) start: IndexBase,
    /// The leaf that the ray has left for good: it need not be asked; [`NO_LEAF`] for none.
    pub(in crate::world) exited_leaf: u32,
}

impl Model {
    /// The leaf that a ray has left for good: from a convex solid outward the one place where its line leaves the solid is
    /// the one just left. [`NO_LEAF`] if there is none.
    #[inline(always)]
    pub(in crate::world) fn exited_convex(&self, left: Option<&SpawnSurface>, ray: &Ray) -> u32 {
        let Some(left) = left else {
            return NO_LEAF;
        };
        match self.leaves.get(left.leaf as usize) {
            Some(leaf) if left.normal.dot(ray.dir) > 0.0 && leaf.is_left_for_good(ray) => left.leaf,
            _ => NO_LEAF,
        }
    }

    /// The first surface of an item up to and including `far` that is wanted.
    #[inline(always)]
    pub(in crate::world) fn find<W: HitPolicy>(
        &self,
        item: Item,
        search: &Search,
        far: f64,
        scratch: &mut Scratch,
        wants: &mut W,
    ) -> Option<RawHit> {
        let start = search.start;
        match item {
            Item::Program(number) => {
                let program = &self.programs[number as usize];
                let sweep = &mut scratch.sweep;
                let span = (search.t_min, far);
                let mut first = None;
                program.nearest(
                    &self.leaves,
                    search.ray,
                    span,
                    search.origin_surface,
                    sweep,
                    |found| {
                        let found = RawHit {
                            leaf: start.leaf + found.leaf,
                            surface: start.surface + found.surface,
                            ..*found
                        };
                        let is_wanted = wants.takes(&found);
                        first = is_wanted.then_some(found);
                        is_wanted
                    },
                )?;
                first
            }
            Item::Leaf(number) if number == search.exited_leaf => None,
            Item::Leaf(number) => {
                let leaf = &self.leaves[number as usize];
                let (ray, mut least) = (search.ray, search.t_min);
                loop {
                    let root = match search.origin_surface {
                        Some(left) if left.leaf == number && leaf.shape.is_faceted() => {
                            leaf.nearest_beside(ray, least, beyond(far), left.face)?
                        }
                        Some(left) if left.leaf == number => {
                            nearest_but(leaf, left, ray, least, &mut scratch.roots)?
                        }
                        _ => leaf.nearest(ray, least, beyond(far))?,
                    };
                    let found = RawHit {
                        root,
                        leaf: start.leaf + number,
                        surface: start.surface + leaf.surface,
                    };
                    if root.t <= far && wants.takes(&found) {
                        return Some(found);
                    }
                    if root.t > search.origin_error {
                        return None;
                    }
                    least = root.t;
                }
            }
            Item::Instance(number) => {
                self.instances[number as usize].find(search, far, scratch, wants)
            }
        }
    }

    /// The first surface of all items up to and including `far` that is wanted, or any one if that is enough. Of two at
    /// exactly the same distance it is the one that stands first in the file.
    #[inline(always)]
    pub(in crate::world) fn find_all<W: HitPolicy>(
        &self,
        lanes: SimdLevel,
        search: &Search,
        far: f64,
        scratch: &mut Scratch,
        wants: &mut W,
    ) -> Option<RawHit> {
        let mut best: Option<(RawHit, u32)> = None;
        let mut end = far;
        let key = |of: &(RawHit, u32)| (of.0.root.t, of.1);
        if let Some(cluster) = &self.cluster {
            let is_told = cluster.each(
                lanes,
                search.ray,
                far,
                #[inline(always)]
                |place| {
                    let item = self.finder.bounded[place as usize];
                    let Some(found) = self.find(item.item, search, end, scratch, wants) else {
                        return false;
                    };
                    let this = (found, item.number);
                    if best.is_none_or(|best| key(&this) < key(&best)) {
                        end = found.root.t;
                        best = Some(this);
                    }
                    W::ANY
                },
            );
            if is_told {
                return best.map(|(found, _)| found);
            }
        }
        for item in &self.finder.unbounded {
            if let Some(found) = self.find(item.item, search, end, scratch, wants) {
                if best.is_none_or(|(best, _)| found.root.t < best.root.t) {
                    end = found.root.t;
                    best = Some((found, item.number));
                }
                if W::ANY {
                    return Some(found);
                }
            }
        }
        let tree = &self.finder.tree;
        if W::ANY {
            tree.any_in(
                lanes,
                search.ray,
                (0.0, far),
                #[inline(always)]
                |place| {
                    let item = self.finder.bounded[place as usize];
                    let found = self.find(item.item, search, far, scratch, wants);
                    best = found.map(|found| (found, item.number));
                    best.is_some()
                },
            );
        } else {
            tree.nearest_in(
                lanes,
                search.ray,
                (0.0, end),
                #[inline(always)]
                |place, end| {
                    let item = self.finder.bounded[place as usize];
                    let Some(found) = self.find(item.item, search, end, scratch, wants) else {
                        return end;
                    };
                    let this = (found, item.number);
                    if best.is_none_or(|best| key(&this) < key(&best)) {
                        best = Some(this);
                    }
                    found.root.t
                },
            );
        }
        best.map(|(found, _)| found)
    }
}

/// The first visible root beyond `least`, on the leaf that the ray has just left.
#[inline(never)]
fn nearest_but(
    leaf: &Leaf,
    left: &SpawnSurface,
    ray: &Ray,
    least: f64,
    roots: &mut Vec<Root>,
) -> Option<Root> {
    if let (Shape::Sphere(sphere), None) = (&leaf.shape, &leaf.object_from_world) {
        let root = sphere.other_root(ray, left.normal.dot(ray.dir) > 0.0)?;
        return (root.t > least).then_some(root);
    }
    // Of the roots of its crossing the one that is left is the nearest to the start of the ray: one that near is it.
    let near = NEAR * left.blur;
    roots.clear();
    let are_all = leaf.roots_from(ray, -near, near.max(least), roots);
    let hidden = hide_departure(roots, left, leaf, ray.dir);
    if !are_all && hidden.is_none_or(|t| t.abs() > near) {
        roots.clear();
        leaf.roots(ray, roots);
        hide_departure(roots, left, leaf, ray.dir);
    }
    roots
        .iter()
        .find(|root| root.is_visible && root.t > least)
        .copied()
}

/// A number a little larger, so that a limit that is left out takes `far` in: one or two roundings, or the least normal
/// number where that is more.
#[inline(always)]
fn beyond(far: f64) -> f64 {
    far * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE
}
