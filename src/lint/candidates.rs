//! The objects that rays may hit and points may lie in, by their bounding boxes.

use super::Located;
use crate::base::accel::Bvh;
use crate::base::math::{Bounds, Ray};
use crate::scene::{Kind, Object};
use glam::DVec3;

/// Most pairs of an object and a ray or a point that are examined.
const MOST_PAIRS: usize = 2_000_000;
/// Relative width of the margin around a box, whose corners have single precision.
const MARGIN: f64 = 1e-6;

/// An object and a ray that hits its box or a point in it, by their indices.
pub(super) type Pair = (usize, usize);

/// The boxes of objects.
pub(super) struct Candidates {
    bounds: Vec<Bounds>,
    tree: Bvh,
}

impl Candidates {
    pub(super) fn new(objects: &[Located]) -> Self {
        let bounds: Vec<Bounds> = objects.iter().map(|one| bounds(&one.object)).collect();
        Candidates {
            tree: Bvh::build(&bounds),
            bounds,
        }
    }

    /// The objects that rays may hit, those nearest to the first ray's origin first; `None` if there are too many.
    pub(super) fn on_rays(&self, rays: &[Ray]) -> Option<Vec<Pair>> {
        let mut pairs = collected(rays, |ray, visit| {
            self.tree.any(ray, 0.0, f64::INFINITY, visit);
        })?;
        let origin = rays.first().map_or(DVec3::ZERO, |ray| ray.origin);
        // Distances are not negative: their bits have their order.
        pairs.sort_by_cached_key(|pair| (self.distance(pair.0, origin).to_bits(), *pair));
        Some(pairs)
    }

    /// The objects that points may lie in, in their order; `None` if there are too many.
    pub(super) fn around(&self, points: &[DVec3]) -> Option<Vec<Pair>> {
        let mut pairs = collected(points, |point, visit| {
            self.tree.visit_containing(*point, visit);
        })?;
        pairs.sort_unstable();
        Some(pairs)
    }

    /// The distance of the box of an object from a point.
    pub(super) fn distance(&self, object: usize, from: DVec3) -> f64 {
        let Bounds { min, max } = self.bounds[object];
        from.distance(from.clamp(min, max))
    }
}

/// The pairs of all objects that a search visits for each probe.
fn collected<T>(
    probes: &[T],
    search: impl Fn(&T, &mut dyn FnMut(u32) -> bool),
) -> Option<Vec<Pair>> {
    let mut pairs = Vec::new();
    for (probe, what) in probes.iter().enumerate() {
        search(what, &mut |object| {
            pairs.push((object as usize, probe));
            pairs.len() > MOST_PAIRS
        });
        if pairs.len() > MOST_PAIRS {
            return None;
        }
    }
    Some(pairs)
}

/// A box that holds the surface and the inside of an object.
fn bounds(object: &Object) -> Bounds {
    if has_inverse(object) {
        return Bounds::EVERYTHING;
    }
    let bounds = object.extent_below(&[]);
    if bounds.is_empty() || !bounds.is_finite() {
        return bounds;
    }
    let size = bounds.min.abs().max(bounds.max.abs()).max_element();
    Bounds::new(bounds.min - MARGIN * size, bounds.max + MARGIN * size)
}

/// True if a part of an object is inverse: what lies in it may lie outside of its box.
fn has_inverse(object: &Object) -> bool {
    object.is_inverse
        || match &object.kind {
            Kind::Csg { children, .. } => children.iter().any(|child| has_inverse(child)),
            _ => false,
        }
}
