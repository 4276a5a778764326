//! A ball around an item of a tree.

use super::node::{Aabb32, Frame};
use super::packet::DOUBT;
use crate::base::math::rounding::{f32_above, loose_above, loose_below, nearest};
use glam::{DVec3, Vec3};

/// A ball around an item, in the frame of its tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundingSphere {
    centre: [f32; 3],
    radius: f32,
    /// Whether the item fills it, so that its box tells no more.
    pub(super) is_filled: bool,
}

impl BoundingSphere {
    /// Around the points within a radius of a centre, which are all of the item or not.
    pub(super) fn new(frame: &Frame, (centre, radius, is_filled): (DVec3, f64, bool)) -> Self {
        let centre = frame.place(centre);
        let radius = radius * frame.scale();
        let rounded = [centre.x, centre.y, centre.z].map(nearest);
        let moved = (DVec3::from(rounded.map(f64::from)) - centre).length();
        BoundingSphere {
            centre: rounded,
            radius: f32_above((radius + moved) * (1.0 + 1e-9)),
            is_filled,
        }
    }

    /// One that its item fills.
    #[inline(always)]
    pub(super) fn filled(centre: [f32; 3], radius: f32) -> Self {
        BoundingSphere {
            centre,
            radius,
            is_filled: true,
        }
    }

    /// The box around it.
    pub(super) fn cell(&self) -> Aabb32 {
        let radius = f64::from(self.radius);
        Aabb32 {
            low: self
                .centre
                .map(|centre| loose_below(f64::from(centre) - radius)),
            high: self
                .centre
                .map(|centre| loose_above(f64::from(centre) + radius)),
        }
    }

    /// Around a box.
    #[inline(always)]
    pub(super) fn around(cell: &Aabb32) -> Self {
        let (low, high) = (Vec3::from_array(cell.low), Vec3::from_array(cell.high));
        let centre = 0.5 * low + 0.5 * high;
        // Beyond what is lost in the rounding of the middle.
        let size = low.abs().max(high.abs()).max_element();
        BoundingSphere {
            centre: centre.to_array(),
            radius: (0.5 * high - 0.5 * low).length() * (1.0 + 4.0 * DOUBT) + DOUBT * size,
            is_filled: false,
        }
    }

    /// Its centre as seen from a place in the frame, a radius that makes up for the rounding of that, and the distance.
    #[inline(always)]
    pub(super) fn seen_from(&self, origin: DVec3) -> (Vec3, f32, f32) {
        let centre = (DVec3::from(self.centre.map(f64::from)) - origin).as_vec3();
        let distance = centre.length();
        (centre, self.radius + 2.0 * DOUBT * distance, distance)
    }
}
