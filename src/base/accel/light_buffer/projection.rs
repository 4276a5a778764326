//! Where in the view from a point things lie: by the slopes of the ways there.

use super::grid::{Grid, Rect};
use crate::base::accel::node::Aabb32;
use crate::base::accel::packet::DOUBT;
use glam::{DMat3, DVec3, Vec3};

/// The centre of a ball as seen from a point, its radius, and its distance.
type ViewedSphere = (Vec3, f32, f32);

/// No rounding of a ray may move it by more than this share of a cell.
const SHARP: f64 = 1.0 / 32.0;

/// How a point looks at a tree.
#[derive(Clone, Copy)]
pub(crate) struct Projection {
    /// In the frame of the tree.
    pub(crate) origin: DVec3,
    /// By which slopes are measured.
    pub(crate) axes: [DVec3; 3],
}

impl Projection {
    /// The slopes between which lies what is in a box, and in a ball if one is given, as seen from here, and whether all of
    /// that is.
    pub(crate) fn rect(
        &self,
        (ball, is_filled): (Option<ViewedSphere>, bool),
        cell: &Aabb32,
    ) -> ViewExtent {
        let of_ball = ball.map_or(ViewExtent::Everywhere, |ball| self.rect_of_ball(&ball));
        if is_filled {
            return of_ball;
        }
        match (of_ball, self.rect_of_cell(cell)) {
            (ViewExtent::Nowhere, _) | (_, ViewExtent::Nowhere) => ViewExtent::Nowhere,
            (ViewExtent::Everywhere, one) | (one, ViewExtent::Everywhere) => one,
            (ViewExtent::Within(a), ViewExtent::Within(b)) => ViewExtent::Within(a.both(&b)),
        }
    }

    /// Tangent planes of a ball: those of slope `s` have the normal `n = axis - s · axes[2]`, and `n · centre = ± radius · |n|`.
    #[inline(always)]
    pub(crate) fn rect_of_ball(&self, &(centre, radius, _): &ViewedSphere) -> ViewExtent {
        let (centre, radius) = (centre.as_dvec3(), f64::from(radius));
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
        let share = 1.0 / a;
        for (side, axis) in self.axes[..2].iter().enumerate() {
            let place = axis.dot(centre);
            let b = place * depth - radius * radius * axis.dot(along);
            let c = place * place - radius * radius * axis.length_squared();
            let spread = (b * b - a * c).max(0.0).sqrt();
            rect.low[side] = (b - spread) * share;
            rect.high[side] = (b + spread) * share;
        }
        ViewExtent::Within(rect)
    }

    /// Whether single precision tells the cells of a grid over a window apart.
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
            let error = 2.0 * f64::from(DOUBT) * size / least * f64::from(grid.rate[side])
                + f64::from(DOUBT * grid.start[side].abs());
            error < SHARP
        };
        // Not a number is not enough.
        least > 0.0 && is_sharp(0) && is_sharp(1)
    }

    /// The slopes between which a box lies.
    fn rect_of_cell(&self, cell: &Aabb32) -> ViewExtent {
        let (low, high) = cell.ends();
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
        // NaN is everywhere.
        if nearest > 1e-6 * size {
            ViewExtent::Within(rect)
        } else if farthest < -1e-6 * size {
            ViewExtent::Nowhere
        } else {
            ViewExtent::Everywhere
        }
    }
}

/// Where something is seen.
pub(crate) enum ViewExtent {
    Nowhere,
    Within(Rect),
    Everywhere,
}
