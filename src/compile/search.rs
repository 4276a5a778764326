//! The nearest surface on a ray, and what is known of the place where it is met.

use super::csg::{Found, hide_departure};
use super::flatten::Item;
use super::leaf::Leaf;
use super::order::Numbered;
use super::query::{Best, Departure, Hit, Query, Scratch, Seen};
use super::world::World;
use crate::math::lanes::with_widest;
use crate::math::{Bounds, Ray};
use crate::options::LeastDistance;
use crate::shape::{Geometry, Root};

/// Below this share of the coordinates' size two surfaces are not told apart by a ray that leaves one of them:
/// 4096 roundings of a double, which covers a chain of transforms and a slanted hit.
pub(super) const BLUR: f64 = 1.0 / (1u64 << 40) as f64;
/// POV-Ray's least distances, in units of the scene: for shadows and for all other rays.
pub(super) const POV_RAY_SHADOW: f64 = 1e-3;
const POV_RAY_LEAST: f64 = 1e-4;

impl World {
    /// The nearest visible surface on a ray.
    #[must_use]
    pub fn nearest(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        scratch.rays.count(query);
        let best = with_widest(
            #[inline(always)]
            || self.nearest_found(query, scratch),
        );
        best.map(|best| self.hit(query, &best.found))
    }

    #[inline(always)]
    fn nearest_found(&self, query: &Query, scratch: &mut Scratch) -> Option<Best> {
        let mut best: Option<Best> = None;
        let mut far = query.far;
        for &item in &self.finder.unbounded {
            far = self.try_item(item, query, far, &mut best, scratch);
        }
        self.nearest_bounded(query, &mut best, scratch);
        best
    }

    /// Makes `best` the nearest of itself and all bounded items.
    #[inline(always)]
    pub(super) fn nearest_bounded(
        &self,
        query: &Query,
        best: &mut Option<Best>,
        scratch: &mut Scratch,
    ) {
        let far = best.map_or(query.far, |best| best.found.root.t);
        self.finder.tree.nearest(
            &query.ray,
            0.0,
            far,
            #[inline(always)]
            |number, far| {
                let item = self.finder.bounded[number as usize];
                self.try_item(item, query, far, best, scratch)
            },
        );
    }

    /// How the items are found.
    /// Tries one item; gives the new far limit.
    #[inline(always)]
    pub(super) fn try_item(
        &self,
        item: Numbered,
        query: &Query,
        far: f64,
        best: &mut Option<Best>,
        scratch: &mut Scratch,
    ) -> f64 {
        match self.find(item, query, far, scratch, |_| true) {
            None => far,
            Some(found) => self.offer(item.number, found, query, far, best),
        }
    }

    /// Takes what was found of an item if it is the best so far; gives the new far limit.
    #[inline(always)]
    pub(super) fn offer(
        &self,
        item: u32,
        found: Found,
        query: &Query,
        far: f64,
        best: &mut Option<Best>,
    ) -> f64 {
        if found.root.t >= query.far {
            return far;
        }
        let is_better = match best {
            None => true,
            Some(best) => {
                found.root.t < best.found.root.t
                    || (found.root.t == best.found.root.t
                        && self.comes_first(item, best.item, &query.ray))
            }
        };
        if !is_better {
            return far;
        }
        *best = Some(Best { found, item });
        found.root.t
    }

    /// The distance up to which surfaces are not met: the error of the point that the ray leaves.
    pub(super) fn least_distance(&self, query: &Query) -> f64 {
        match (self.least_distance, query.seen) {
            (LeastDistance::Rounding, _) => query.from.map_or(0.0, |left| left.blur),
            (LeastDistance::PovRay, Seen::Shadow) => POV_RAY_SHADOW,
            (LeastDistance::PovRay, _) => POV_RAY_LEAST,
        }
    }

    /// The first surface of an item up to and including `far` that the asker can see and wants.
    #[inline(always)]
    pub(super) fn find(
        &self,
        item: Numbered,
        query: &Query,
        far: f64,
        scratch: &mut Scratch,
        mut wanted: impl FnMut(&Found) -> bool,
    ) -> Option<Found> {
        let from = self.least_distance(query);
        let mut wanted = |found: &Found| self.is_seen(found, query.seen) && wanted(found);
        match item.item {
            Item::Program(number) => {
                let program = &self.programs[number as usize];
                let departure = query.from.as_ref();
                let sweep = &mut scratch.sweep;
                program.nearest(
                    &self.leaves,
                    &query.ray,
                    (from, far),
                    departure,
                    sweep,
                    wanted,
                )
            }
            Item::Leaf(number) => {
                let leaf = &self.leaves[number as usize];
                let root = match &query.from {
                    Some(left) if left.leaf == number && leaf.shape.is_faceted() => {
                        leaf.nearest_beside(&query.ray, from, next_after(far), left.face)?
                    }
                    Some(left) if left.leaf == number => {
                        nearest_but(leaf, left, query, from, &mut scratch.roots)?
                    }
                    _ => leaf.nearest(&query.ray, from, next_after(far))?,
                };
                let found = Found { root, leaf: number };
                (root.t <= far && wanted(&found)).then_some(found)
            }
        }
    }

    /// Which of two items at exactly the same distance is drawn: unbounded ones come first, then the one whose box
    /// the ray enters first, then the one that stands first in the file (facts 11.2).
    #[cold]
    fn comes_first(&self, a: u32, b: u32, ray: &Ray) -> bool {
        if self.ties_by_box {
            let entry = |item: u32| {
                let bounds = &self.boxes[item as usize];
                if bounds.is_finite() {
                    slab_entry(bounds, ray)
                } else {
                    f64::NEG_INFINITY
                }
            };
            let (entry_a, entry_b) = (entry(a), entry(b));
            if entry_a != entry_b {
                return entry_a < entry_b;
            }
        }
        a < b
    }

    pub(super) fn hit(&self, query: &Query, found: &Found) -> Hit {
        let leaf = &self.leaves[found.leaf as usize];
        let Root {
            t, face, crossing, ..
        } = found.root;
        let point = query.ray.at(t);
        let (normal, shading_normal) = leaf.normals(point, face);
        let blur = BLUR * point.abs().max_element().max(t);
        let departure = Departure {
            leaf: found.leaf,
            face,
            normal,
            crossing,
            blur,
        };
        Hit {
            t,
            point,
            normal,
            shading_normal,
            surface: leaf.surface,
            departure,
        }
    }
}

/// The first visible root beyond `from`, on the leaf that the ray has just left.
#[inline(never)]
fn nearest_but(
    leaf: &Leaf,
    left: &Departure,
    query: &Query,
    from: f64,
    roots: &mut Vec<Root>,
) -> Option<Root> {
    // From a convex solid outward: the one place where the line leaves it is the one just left.
    if left.normal.dot(query.ray.dir) > 0.0 && leaf.is_left_behind(&query.ray) {
        return None;
    }
    roots.clear();
    leaf.roots(&query.ray, roots);
    hide_departure(roots, left, leaf, query.ray.dir);
    roots
        .iter()
        .find(|root| root.is_visible && root.t > from)
        .copied()
}

/// The next larger number, so that a limit that is left out takes `far` in.
fn next_after(far: f64) -> f64 {
    far.next_up()
}

/// Where the line of a ray enters a box, not clamped at its start.
fn slab_entry(bounds: &Bounds, ray: &Ray) -> f64 {
    (0..3).fold(f64::NEG_INFINITY, |entry, axis| {
        let d = ray.dir[axis];
        if d == 0.0 {
            return entry;
        }
        let near = if d > 0.0 {
            bounds.min[axis]
        } else {
            bounds.max[axis]
        };
        entry.max((near - ray.origin[axis]) / d)
    })
}
