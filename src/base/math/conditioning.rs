//! Exact rescaling by powers of two, so that squares neither overflow nor underflow, whatever the scale of the scene.
//!
//! Multiplying by a power of two only changes the exponent: a scene and its copy scaled by 2^k give the same bits.

use super::Ray;
use crate::base::math::simd::F64Lanes;
use crate::base::math::simd::vec3::{Vec3Lanes, divide, scale};
use glam::DVec3;

/// Comfortable lengths lie between 2^-200 and 2^200: their squares and products stay in range.
const COMFORTABLE_LENGTH: f64 = f64::from_bits((1023 + 200) << 52);
/// Upper limit of the squares of comfortable lengths; the lower limit is its reciprocal.
pub(crate) const COMFORTABLE_SQUARE: f64 = f64::from_bits((1023 + 400) << 52);
/// Squared distances below this do not overflow when multiplied by a comfortable square.
pub(crate) const FAR_SQUARE: f64 = f64::from_bits((1023 + 800) << 52);

/// The power of two `p` with `1 <= |x| / p < 2`. It is 1 for zero, infinity and NaN, and the smallest normal number for
/// subnormals.
pub(crate) fn power_of_two(x: f64) -> f64 {
    let exponent = x.to_bits() & f64::INFINITY.to_bits();
    if x == 0.0 || exponent == f64::INFINITY.to_bits() {
        1.0
    } else {
        f64::from_bits(exponent.max(f64::MIN_POSITIVE.to_bits()))
    }
}

/// `v` normalised, at any scale; `None` for the zero vector and for one that is not finite.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let size = v.abs().max_element();
    if size == 0.0 || !v.is_finite() {
        return None;
    }
    let near_one = v / power_of_two(size);
    Some(near_one / near_one.length())
}

/// The rounding of a vector that is divided by a length, in which the versions of POV-Ray differ, as in that of the rows of
/// a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normalization {
    /// Times the reciprocal of the length, up to version 3.7.
    #[default]
    Reciprocal,
    /// The quotient, from version 3.8 on.
    Quotient,
}

impl Normalization {
    /// That of scenes of version 3.8, or of older ones.
    #[must_use]
    pub fn of_version(is_3_8: bool) -> Self {
        match is_3_8 {
            true => Normalization::Quotient,
            false => Normalization::Reciprocal,
        }
    }

    /// The vector divided by a length.
    #[inline]
    pub(crate) fn divided(self, v: DVec3, length: f64) -> DVec3 {
        match self {
            Normalization::Reciprocal => v * length.recip(),
            Normalization::Quotient => v / length,
        }
    }

    /// The same in lanes.
    #[inline(always)]
    pub(crate) fn divided_lanes<F: F64Lanes>(self, v: Vec3Lanes<F>, length: F) -> Vec3Lanes<F> {
        match self {
            Normalization::Reciprocal => scale(v, F::splat(1.0) / length),
            Normalization::Quotient => divide(v, length),
        }
    }

    /// The vector divided by its length.
    #[inline]
    pub(crate) fn unit(self, v: DVec3) -> DVec3 {
        self.divided(v, v.length())
    }

    /// [`Normalization::unit`], or zero where that is not finite.
    #[inline]
    pub(crate) fn unit_or_zero(self, v: DVec3) -> DVec3 {
        let unit = self.unit(v);
        if unit.is_finite() { unit } else { DVec3::ZERO }
    }

    /// [`Normalization::unit`] at any scale; `None` for the zero vector and for one that is not finite.
    pub(crate) fn unit_at_any_scale(self, v: DVec3) -> Option<DVec3> {
        let size = v.abs().max_element();
        if size == 0.0 || !v.is_finite() {
            return None;
        }
        Some(self.unit(v / power_of_two(size)))
    }
}

/// True if a shape of this size can be intersected with a ray without rescaling. `dir_sq` is the squared length of the
/// ray's direction, `origin_sq` the squared distance of its origin from the shape. False for NaN.
#[inline]
pub(crate) fn is_comfortable(size: f64, dir_sq: f64, origin_sq: f64) -> bool {
    is_comfortable_size(size)
        && (1.0 / COMFORTABLE_SQUARE..COMFORTABLE_SQUARE).contains(&dir_sq)
        && origin_sq < FAR_SQUARE
}

/// True if a shape of this size can be intersected without rescaling.
#[inline]
pub(crate) fn is_comfortable_size(size: f64) -> bool {
    (1.0 / COMFORTABLE_LENGTH..COMFORTABLE_LENGTH).contains(&size)
}

/// A ray whose origin is moved close to a shape and whose lengths are rescaled, with the inverse map for `t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RescaledRay {
    /// The ray relative to the shape's centre, in units of `size`.
    pub(crate) ray: Ray,
    /// The power of two that all lengths are divided by.
    pub(crate) size: f64,
    /// Distance by which the origin was moved along the rescaled direction.
    shift: f64,
    /// The power of two that the direction is divided by.
    dir_scale: f64,
}

impl RescaledRay {
    /// Rescales a ray whose origin is relative to the centre of a shape of size `shape_size`. `None` if the direction
    /// is zero or the moved origin is not finite.
    pub(crate) fn new(about_centre: &Ray, shape_size: f64) -> Option<Self> {
        let dir_scale = power_of_two(about_centre.dir.abs().max_element());
        let dir = about_centre.dir / dir_scale;
        let size = power_of_two(shape_size);
        let far = power_of_two(about_centre.origin.abs().max_element());
        let dir_sq = dir.dot(dir);
        if dir_sq.is_nan() || dir_sq <= 0.0 {
            return None;
        }
        let shift = if far / size > COMFORTABLE_LENGTH {
            -(about_centre.origin / far).dot(dir) / dir_sq * far
        } else {
            0.0
        };
        let origin = (about_centre.origin + shift * dir) / size;
        origin.is_finite().then_some(RescaledRay {
            ray: Ray::new(origin, dir),
            size,
            shift,
            dir_scale,
        })
    }

    /// The `t` on the original ray for a `t` on the rescaled one.
    pub(crate) fn t(&self, rescaled_t: f64) -> f64 {
        (self.shift + rescaled_t * self.size) / self.dir_scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_power_of_two_has_the_exponent_of_the_number() {
        assert_eq!(power_of_two(1.5), 1.0);
        assert_eq!(power_of_two(-6.0), 4.0);
        assert_eq!(power_of_two(0.3), 0.25);
        assert_eq!(power_of_two(0.0), 1.0);
        assert_eq!(power_of_two(f64::NAN), 1.0);
        assert_eq!(power_of_two(5e-324), f64::MIN_POSITIVE);
    }

    #[test]
    fn unit_vectors_exist_at_every_scale() {
        for scale in [1e-300, 1e-160, 1.0, 1e160, 1e300] {
            let u = unit(DVec3::new(3.0, 0.0, -4.0) * scale).unwrap();
            assert!((u - DVec3::new(0.6, 0.0, -0.8)).length() < 1e-15);
        }
        assert_eq!(unit(DVec3::ZERO), None);
        assert_eq!(unit(DVec3::new(f64::NAN, 1.0, 0.0)), None);
        assert_eq!(unit(DVec3::new(0.0, 7.3, 0.0)), Some(DVec3::Y));
    }

    #[test]
    fn a_rescaled_ray_keeps_its_points() {
        let ray = Ray::new(DVec3::new(0.0, 0.0, -3e-200), DVec3::Z * 1e-90);
        let rescaled = RescaledRay::new(&ray, 1e-200).unwrap();
        let t = rescaled.t(2.0);
        assert!((ray.at(t) - rescaled.ray.at(2.0) * rescaled.size).length() < 1e-215);
    }
}
