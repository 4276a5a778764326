//! Projections from a point: the slopes that bound spheres and boxes.

use super::grid::{Grid, Rect};
use crate::base::accel::bounding_sphere::ViewedSphere;
use crate::base::accel::node::Aabb32;
use crate::base::accel::packet::REL_ERROR;
use glam::{DMat3, DVec3};

/// Maximum rounding error of a ray, as a part of a cell.
const MAX_CELL_ERROR: f64 = 1.0 / 32.0;

/// A perspective projection of a tree from a point.
#[derive(Clone, Copy)]
pub(crate) struct Projection {
    /// In the frame of the tree.
    pub(crate) origin: DVec3,
    /// The axes by which slopes are measured: across, up and along.
    pub(crate) axes: [DVec3; 3],
}

impl Projection {
    /// The slopes that bound the contents of a box and of a sphere, if one is given; the box is ignored if the item
    /// fills the sphere.
    pub(crate) fn rect(
        &self,
        sphere: Option<ViewedSphere>,
        is_filled: bool,
        aabb: &Aabb32,
    ) -> ViewExtent {
        let sphere_rect = sphere.map_or(ViewExtent::Everywhere, |sphere| {
            self.rect_of_sphere(&sphere)
        });
        if is_filled {
            return sphere_rect;
        }
        match (sphere_rect, self.rect_of_box(aabb)) {
            (ViewExtent::Nowhere, _) | (_, ViewExtent::Nowhere) => ViewExtent::Nowhere,
            (ViewExtent::Everywhere, one) | (one, ViewExtent::Everywhere) => one,
            (ViewExtent::Within(a), ViewExtent::Within(b)) => {
                ViewExtent::Within(a.intersection(&b))
            }
        }
    }

    /// The slopes that bound a sphere. Its tangent plane of slope `s` has the normal
    /// `n = axis - s · axes[2]`, and `n · centre = ± radius · |n|`.
    #[inline(always)]
    pub(crate) fn rect_of_sphere(&self, sphere: &ViewedSphere) -> ViewExtent {
        let (centre, radius) = (sphere.centre.as_dvec3(), f64::from(sphere.radius));
        let along = self.axes[2];
        let depth = along.dot(centre);
        let a = depth * depth - radius * radius * along.length_squared();
        if depth <= 0.0 && a > 0.0 {
            return ViewExtent::Nowhere;
        }
        if a <= 1e-6 * depth * depth {
            return ViewExtent::Everywhere;
        }
        let mut rect = Rect::EMPTY;
        let inverse_a = 1.0 / a;
        for (side, axis) in self.axes[..2].iter().enumerate() {
            let offset = axis.dot(centre);
            let b = offset * depth - radius * radius * axis.dot(along);
            let c = offset * offset - radius * radius * axis.length_squared();
            let spread = (b * b - a * c).max(0.0).sqrt();
            rect.low[side] = (b - spread) * inverse_a;
            rect.high[side] = (b + spread) * inverse_a;
        }
        ViewExtent::Within(rect)
    }

    /// True if single precision separates the cells of a grid over a window.
    pub(crate) fn is_sharp(&self, window: &Rect, grid: &Grid) -> bool {
        let [across, up, along] = self.axes;
        let dirs = DMat3::from_cols(across, up, along).transpose().inverse();
        let mut least = f64::INFINITY;
        for x in [window.low[0], window.high[0]] {
            for y in [window.low[1], window.high[1]] {
                let dir = dirs * DVec3::new(x, y, 1.0);
                least = least.min(along.dot(dir) / (along.length() * dir.length()));
            }
        }
        let is_sharp = |side: usize| {
            let farthest = window.low[side].abs().max(window.high[side].abs());
            let size = self.axes[side].length() / along.length() + farthest;
            let error = 2.0 * f64::from(REL_ERROR) * size / least * f64::from(grid.rate[side])
                + f64::from(REL_ERROR * grid.start[side].abs());
            error < MAX_CELL_ERROR
        };
        // NaN fails.
        least > 0.0 && is_sharp(0) && is_sharp(1)
    }

    /// The slopes that bound a box.
    fn rect_of_box(&self, aabb: &Aabb32) -> ViewExtent {
        let (low, high) = aabb.ends();
        let (low, high) = (low - self.origin, high - self.origin);
        let size = low.abs().max(high.abs()).max_element() * self.axes[2].length();
        let mut rect = Rect::EMPTY;
        let (mut nearest, mut farthest) = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in 0..8 {
            let pick = |axis: usize| [low[axis], high[axis]][corner >> axis & 1];
            let corner = DVec3::new(pick(0), pick(1), pick(2));
            let depth = self.axes[2].dot(corner);
            nearest = nearest.min(depth);
            farthest = farthest.max(depth);
            for side in 0..2 {
                let slope = self.axes[side].dot(corner) / depth;
                rect.low[side] = rect.low[side].min(slope);
                rect.high[side] = rect.high[side].max(slope);
            }
        }
        // NaN gives the whole view.
        if nearest > 1e-6 * size {
            ViewExtent::Within(rect)
        } else if farthest < -1e-6 * size {
            ViewExtent::Nowhere
        } else {
            ViewExtent::Everywhere
        }
    }
}

/// The extent of something in the view.
pub(crate) enum ViewExtent {
    Nowhere,
    Within(Rect),
    Everywhere,
}
