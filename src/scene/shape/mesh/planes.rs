//! POV-Ray's planes of the triangles of a mesh, in single precision.
//!
//! Normal and distance are computed in double precision, for a `mesh` from the corners as they are written, for `mesh2`
//! from the stored ones, and then rounded (docs/povray-shapes.md, section 5.4).

use super::{Mesh, Triangles};
use crate::base::math::conditioning::Normalization;
use crate::base::math::simd::with_widest;
use crate::base::math::{Ray, normal_from_inverse, rounding};
use crate::scene::shape::rounded::to_stored;
use crate::scene::shape::{Geometry, RoundedHit};
use glam::{DAffine3, DVec3, Vec3};

/// POV-Ray's least distance of a hit on a triangle, in units of the mesh.
const MIN_DISTANCE: f64 = 1e-6;

/// The plane of a triangle: `normal · p + distance = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FacePlane {
    /// A unit vector; zero for a degenerate triangle.
    pub(crate) normal: Vec3,
    distance: f32,
}

impl FacePlane {
    /// The plane through three corners.
    pub(crate) fn new([a, b, c]: [DVec3; 3]) -> Self {
        let normal = (a - b).cross(c - b);
        let length = normal.length();
        let normal = if length > 0.0 {
            normal * (1.0 / length)
        } else {
            DVec3::ZERO
        };
        FacePlane {
            normal: Vec3::from(normal.to_array().map(rounding::nearest)) + Vec3::ZERO,
            distance: rounding::nearest(-normal.dot(a)),
        }
    }

    /// The distance at which a ray intersects the plane.
    fn distance_along(&self, ray: &Ray) -> f64 {
        let normal = self.normal.as_dvec3();
        -(f64::from(self.distance) + normal.dot(ray.origin)) / normal.dot(ray.dir)
    }

    /// Intersects the whole line of a ray with the triangle of these corners, which lie near the plane; returns `t`.
    fn hit(&self, ray: &Ray, corners: &[DVec3; 3]) -> Option<f64> {
        let t = self.distance_along(ray);
        let along = self.normal.abs().max_position();
        let (right, up) = ((along + 1) % 3, (along + 2) % 3);
        let point = ray.at(t);
        let side = |from: DVec3, to: DVec3| {
            let edge = to - from;
            (point[right] - from[right]) * edge[up] - (point[up] - from[up]) * edge[right]
        };
        let [a, b, c] = *corners;
        let sides = [side(a, b), side(b, c), side(c, a)];
        let is_inside =
            sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
        is_inside.then_some(t)
    }
}

impl Mesh {
    /// The hit of a world ray on a triangle with the rounding of POV-Ray; `stored` is the inverse matrix of the mesh.
    /// `None` where it is not finite.
    pub(crate) fn rounded_hit(
        &self,
        ray: &Ray,
        stored: Option<&DAffine3>,
        face: u32,
        normalization: Normalization,
    ) -> Option<RoundedHit> {
        // POV-Ray normalises nothing in a mesh without transforms.
        let (local, length) = match stored {
            None => (*ray, 1.0),
            Some(stored) => to_stored(ray, stored, normalization),
        };
        let plane = self.triangles.plane(face);
        let local_t = plane.distance_along(&local);
        let t = local_t / length;
        let smooth = self.shading_normal(local.at(local_t), face);
        let normal = match smooth {
            Some(smooth) => normalization.unit(smooth),
            None => plane.normal.as_dvec3(),
        };
        let normal = match stored {
            None => normal,
            Some(stored) => normalization.unit(normal_from_inverse(stored, normal)),
        };
        let point = ray.at(t);
        let hit = RoundedHit { t, point, normal };
        (point.is_finite() && normal.is_finite()).then_some(hit)
    }
}

impl Triangles {
    /// The plane of a triangle.
    pub(crate) fn plane(&self, face: u32) -> FacePlane {
        match self.planes.get() {
            Some(planes) => planes[face as usize],
            None => FacePlane::new(self.corners(face)),
        }
    }

    /// Stores the planes of all triangles.
    pub(super) fn fill_planes(&self) {
        self.planes.get_or_init(|| {
            let faces = 0..u32::try_from(self.corners.len()).unwrap_or(u32::MAX);
            faces
                .map(|face| FacePlane::new(self.corners(face)))
                .collect()
        });
    }

    /// The nearest hit before `to` on the planes of the triangles. POV-Ray reports no other: where it is too near to
    /// count, the ray misses the mesh.
    pub(super) fn first_on_planes(&self, ray: &Ray, to: f64) -> Option<(f64, u32)> {
        let from = MIN_DISTANCE / ray.dir.length();
        let mut closest = None;
        with_widest(
            #[inline(always)]
            |lanes| {
                self.tree().nearest_in(lanes, ray, (from, to), |face, end| {
                    match self.plane(face).hit(ray, &self.corners(face)) {
                        Some(t) if from < t && t < end => {
                            closest = Some((t, face));
                            t
                        }
                        _ => end,
                    }
                });
            },
        );
        closest
    }
}
