//! Bounding spheres of the components of a blob: which of them a line may hit, eight at a time in single precision.
//!
//! The line is first moved in double precision to its closest approach to the common centre, and lengths are scaled by
//! the common size. All values are then of size 1, with errors far below [`SLACK`].

use super::component::Component;
use crate::base::math::simd::{F32x8, F64x4, SimdKernel, SimdLevel};
use crate::base::math::{Bounds, Ray};
use glam::DVec3;

/// Number of components that fit into one bit mask.
pub(super) const MAX_COMPONENTS: usize = 64;
const LANES: usize = 8;
/// Above the error of the squared distance from the line minus the squared radius.
const SLACK: f32 = 1e-4;
/// Distance of a ray's origin, in units of the common size, beyond which the closest approach is too inaccurate.
const MAX_DISTANCE: f64 = 1e6;

/// Eight spheres in units of the common size. The radius of an unused lane is NaN.
#[derive(Clone, Copy, Debug)]
struct Spheres8 {
    centre: [[f32; LANES]; 3],
    radius_sq: [f32; LANES],
}

/// Bounding spheres of up to [`MAX_COMPONENTS`] components.
#[derive(Clone, Debug)]
pub(super) struct BoundingSpheres {
    common_centre: DVec3,
    scale: f64,
    spheres: Vec<Spheres8>,
}

/// A line in units of the common size, from its closest approach to the common centre.
struct Line<'b> {
    spheres: &'b [Spheres8],
    origin: [f32; 3],
    dir: [f32; 3],
}

impl BoundingSpheres {
    /// `None` if there are too many components, or some are too large.
    pub(super) fn new<'c>(
        components: impl ExactSizeIterator<Item = &'c Component>,
    ) -> Option<Self> {
        if components.len() > MAX_COMPONENTS {
            return None;
        }
        let spheres: Vec<_> = components.map(Component::bounding_sphere).collect();
        let bounds = spheres
            .iter()
            .fold(Bounds::EMPTY, |bounds, (centre, radius)| {
                bounds.union(&Bounds::new(centre - *radius, centre + *radius))
            });
        let common_centre = bounds.centre();
        let scale = (bounds.max - bounds.min).max_element();
        let is_sound = common_centre.is_finite() && scale.is_normal() && (1.0 / scale).is_normal();
        is_sound.then(|| BoundingSpheres {
            common_centre,
            scale,
            spheres: spheres
                .chunks(LANES)
                .map(|spheres| Spheres8::new(spheres, common_centre, scale))
                .collect(),
        })
    }

    /// Bit mask of the components that a line may hit.
    pub(super) fn hit_mask(&self, lanes: SimdLevel, ray: &Ray) -> u64 {
        let origin = (ray.origin - self.common_centre) / self.scale;
        let dir = ray.dir / ray.dir.length();
        let nearest = origin - origin.dot(dir) * dir;
        // A positive test, so that NaN counts as not in range.
        let is_in_range = dir.is_finite() && origin.abs().max_element() < MAX_DISTANCE;
        if !is_in_range {
            return u64::MAX;
        }
        let to_f32 = |v: DVec3| v.as_vec3().to_array();
        let line = Line {
            spheres: &self.spheres,
            origin: to_f32(nearest),
            dir: to_f32(dir),
        };
        !lanes.run(line)
    }
}

impl Spheres8 {
    fn new(spheres: &[(DVec3, f64)], common_centre: DVec3, scale: f64) -> Self {
        let mut result = Spheres8 {
            centre: [[0.0; LANES]; 3],
            radius_sq: [f32::NAN; LANES],
        };
        for (lane, (centre, radius)) in spheres.iter().enumerate() {
            let centre = ((centre - common_centre) / scale).as_vec3();
            for axis in 0..3 {
                result.centre[axis][lane] = centre[axis];
            }
            let radius = DVec3::splat(radius / scale).as_vec3().x;
            result.radius_sq[lane] = radius * radius;
        }
        result
    }
}

impl SimdKernel for Line<'_> {
    type Output = u64;

    /// Bit mask of the spheres that are missed.
    #[inline(always)]
    fn run<F: F64x4>(self) -> u64 {
        let [dx, dy, dz] = [
            <F::F32>::splat(self.dir[0]),
            <F::F32>::splat(self.dir[1]),
            <F::F32>::splat(self.dir[2]),
        ];
        let slack = <F::F32>::splat(SLACK);
        let mut missed = 0;
        for (spheres, first) in self.spheres.iter().zip((0_u32..).step_by(LANES)) {
            let x = <F::F32>::from_array(&spheres.centre[0]) - <F::F32>::splat(self.origin[0]);
            let y = <F::F32>::from_array(&spheres.centre[1]) - <F::F32>::splat(self.origin[1]);
            let z = <F::F32>::from_array(&spheres.centre[2]) - <F::F32>::splat(self.origin[2]);
            let along = x * dx + y * dy + z * dz;
            let distance_sq = x * x + y * y + z * z;
            let line_distance_sq = distance_sq - along * along;
            let radius_sq_limit = <F::F32>::from_array(&spheres.radius_sq) + slack;
            missed |= u64::from(radius_sq_limit.le(line_distance_sq)) << first;
        }
        missed
    }
}
