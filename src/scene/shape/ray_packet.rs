//! A packet of rays in the object space of a shape.

use crate::base::math::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{Vec3Lanes, add, scale, splat};
use glam::DAffine3;

/// A packet of four rays.
#[derive(Clone, Copy)]
pub(crate) struct RayPacket<F> {
    pub(crate) origin: Vec3Lanes<F>,
    pub(crate) dir: Vec3Lanes<F>,
}

impl<F: F64Lanes> RayPacket<F> {
    /// Packs four rays.
    #[cfg(test)]
    pub(crate) fn of_each(rays: &[Ray; 4]) -> Self {
        let axis = |of: fn(&Ray) -> glam::DVec3, axis: usize| {
            F::from_array(&[0, 1, 2, 3].map(|i| of(&rays[i])[axis]))
        };
        RayPacket {
            origin: [0, 1, 2].map(|i| axis(|ray| ray.origin, i)),
            dir: [0, 1, 2].map(|i| axis(|ray| ray.dir, i)),
        }
    }
}

impl RayPacket<f64> {
    /// A packet with one lane.
    #[inline(always)]
    pub(crate) fn of(ray: &Ray) -> Self {
        RayPacket {
            origin: ray.origin.to_array(),
            dir: ray.dir.to_array(),
        }
    }
}

impl<F: F64Lanes> RayPacket<F> {
    /// Transforms the packet to object space.
    #[inline(always)]
    pub(crate) fn to_object(self, matrix: &DAffine3) -> Self {
        let turned = turned(self.origin, matrix);
        RayPacket {
            origin: add(turned, splat(matrix.translation)),
            dir: self::turned(self.dir, matrix),
        }
    }
}

/// Applies the linear part of a matrix to a packet of vectors.
#[inline(always)]
pub(crate) fn turned<F: F64Lanes>(v: Vec3Lanes<F>, matrix: &DAffine3) -> Vec3Lanes<F> {
    let (x, y, z) = (
        matrix.matrix3.x_axis,
        matrix.matrix3.y_axis,
        matrix.matrix3.z_axis,
    );
    let [x, y, z] = [
        scale(splat(x), v[0]),
        scale(splat(y), v[1]),
        scale(splat(z), v[2]),
    ];
    add(add(x, y), z)
}
