//! Bounding spheres of the items of a tree.

use super::node::{Aabb32, Frame};
use super::packet::REL_ERROR;
use crate::base::math::rounding::{f32_above, loose_above, loose_below, nearest};
use glam::{DVec3, Vec3};

/// A bounding sphere of an item, in the frame of its tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundingSphere {
    centre: [f32; 3],
    radius: f32,
    /// True if the item is the sphere itself, so that its box adds nothing.
    pub(super) is_filled: bool,
}

/// A bounding sphere relative to a point.
#[derive(Clone, Copy)]
pub(super) struct ViewedSphere {
    pub(super) centre: Vec3,
    pub(super) radius: f32,
    /// The distance of the centre.
    pub(super) distance: f32,
}

impl BoundingSphere {
    /// Converts a sphere to the frame; `is_filled` tells whether the item is that sphere itself.
    pub(super) fn new(frame: &Frame, centre: DVec3, radius: f64, is_filled: bool) -> Self {
        let centre = frame.in_frame(centre);
        let radius = radius * frame.scale();
        let rounded = [centre.x, centre.y, centre.z].map(nearest);
        let moved = (DVec3::from(rounded.map(f64::from)) - centre).length();
        BoundingSphere {
            centre: rounded,
            radius: f32_above((radius + moved) * (1.0 + 1e-9)),
            is_filled,
        }
    }

    /// The sphere of an item that is itself a sphere.
    #[inline(always)]
    pub(super) fn filled(centre: [f32; 3], radius: f32) -> Self {
        BoundingSphere {
            centre,
            radius,
            is_filled: true,
        }
    }

    /// Its centre and radius.
    #[inline(always)]
    pub(super) fn centre_and_radius(&self) -> (DVec3, f32) {
        (DVec3::from(self.centre.map(f64::from)), self.radius)
    }

    /// The box around it.
    pub(super) fn aabb(&self) -> Aabb32 {
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

    /// The bounding sphere of a box.
    #[inline(always)]
    pub(super) fn around(aabb: &Aabb32) -> Self {
        let (low, high) = (Vec3::from_array(aabb.low), Vec3::from_array(aabb.high));
        let centre = 0.5 * low + 0.5 * high;
        // The rounding error of the centre grows with its coordinates.
        let size = low.abs().max(high.abs()).max_element();
        BoundingSphere {
            centre: centre.to_array(),
            radius: (0.5 * high - 0.5 * low).length() * (1.0 + 4.0 * REL_ERROR) + REL_ERROR * size,
            is_filled: false,
        }
    }

    /// The sphere relative to a point in the frame, its radius enlarged by the rounding error of the centre.
    #[inline(always)]
    pub(super) fn viewed_from(&self, origin: DVec3) -> ViewedSphere {
        let centre = (DVec3::from(self.centre.map(f64::from)) - origin).as_vec3();
        let distance = centre.length();
        ViewedSphere {
            centre,
            radius: self.radius + 2.0 * REL_ERROR * distance,
            distance,
        }
    }
}
