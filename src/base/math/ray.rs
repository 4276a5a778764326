//! A ray: the points `origin + t · dir`.

use glam::{DAffine3, DVec3};

/// A ray with the points `origin + t · dir`. World-space rays have unit directions. Object-space rays need not, so that
/// `t` is the same in both spaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The point at `t = 0`.
    pub origin: DVec3,
    /// The direction; its length is the distance covered per unit of `t`.
    pub dir: DVec3,
}

impl Ray {
    /// The ray from `origin` along `dir`.
    #[must_use]
    pub fn new(origin: DVec3, dir: DVec3) -> Self {
        Ray { origin, dir }
    }

    /// The point at `t`.
    #[must_use]
    #[inline(always)]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.dir
    }

    /// The ray transformed to object space, with the same `t`.
    #[must_use]
    #[inline]
    pub fn to_object(&self, object_from_world: &DAffine3) -> Ray {
        Ray {
            origin: object_from_world.transform_point3(self.origin),
            dir: object_from_world.transform_vector3(self.dir),
        }
    }
}
