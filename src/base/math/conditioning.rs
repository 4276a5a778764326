//! Exact rescaling by powers of two, so that squares neither overflow nor vanish whatever unit a scene is drawn in.
//!
//! A product with a power of two only moves the exponent: a scene and the same scene scaled by 2^k give the same bits.

use super::Ray;
use glam::DVec3;

/// Lengths between 2^-200 and 2^200 can be squared and multiplied freely.
const COMFORTABLE_LENGTH: f64 = f64::from_bits((1023 + 200) << 52);
/// Squares of comfortable lengths.
pub(crate) const COMFORTABLE_SQUARE: f64 = f64::from_bits((1023 + 400) << 52);
/// Squared distances up to here do not overflow when they meet a comfortable square.
pub(crate) const FAR_SQUARE: f64 = f64::from_bits((1023 + 800) << 52);

/// The power of two `p` with `1 <= |x| / p < 2`; 1 for zero, infinity and NaN; the least normal one for subnormals.
pub(crate) fn power_of_two(x: f64) -> f64 {
    let exponent = x.to_bits() & f64::INFINITY.to_bits();
    if x == 0.0 || exponent == f64::INFINITY.to_bits() {
        1.0
    } else {
        f64::from_bits(exponent.max(f64::MIN_POSITIVE.to_bits()))
    }
}

/// The unit vector along `v` at any scale, or `None` for the zero vector and for what is not finite.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let size = v.abs().max_element();
    if size == 0.0 || !v.is_finite() {
        return None;
    }
    let near_one = v / power_of_two(size);
    Some(near_one / near_one.length())
}

/// Whether a body of this size and a ray can be worked on without rescaling: `dir_sq` is the square of the ray's
/// direction, `origin_sq` the squared distance of its origin from the body. False for NaN.
#[inline]
pub(crate) fn is_comfortable(size: f64, dir_sq: f64, origin_sq: f64) -> bool {
    is_comfortable_size(size)
        && (1.0 / COMFORTABLE_SQUARE..COMFORTABLE_SQUARE).contains(&dir_sq)
        && origin_sq < FAR_SQUARE
}

/// Whether a body of this size can be worked on without rescaling.
#[inline]
pub(crate) fn is_comfortable_size(size: f64) -> bool {
    (1.0 / COMFORTABLE_LENGTH..COMFORTABLE_LENGTH).contains(&size)
}

/// A ray moved near a body and rescaled, with the way back for its parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RescaledRay {
    /// The ray about the body, in units of `size`.
    pub(crate) ray: Ray,
    /// The power of two by which lengths were divided.
    pub(crate) size: f64,
    start: f64,
    dir_size: f64,
}

impl RescaledRay {
    /// Eases a ray whose origin is given from the body's centre. `None` for a ray that has no direction or cannot
    /// come near the body in finite numbers.
    pub(crate) fn new(about_body: &Ray, body_size: f64) -> Option<Self> {
        let dir_size = power_of_two(about_body.dir.abs().max_element());
        let dir = about_body.dir / dir_size;
        let size = power_of_two(body_size);
        let far = power_of_two(about_body.origin.abs().max_element());
        let dir_sq = dir.dot(dir);
        if dir_sq.is_nan() || dir_sq <= 0.0 {
            return None;
        }
        let start = if far / size > COMFORTABLE_LENGTH {
            -(about_body.origin / far).dot(dir) / dir_sq * far
        } else {
            0.0
        };
        let origin = (about_body.origin + start * dir) / size;
        origin.is_finite().then_some(RescaledRay {
            ray: Ray::new(origin, dir),
            size,
            start,
            dir_size,
        })
    }

    /// The parameter on the ray as it was given, of a parameter on the eased ray.
    pub(crate) fn t(&self, eased_t: f64) -> f64 {
        (self.start + eased_t * self.size) / self.dir_size
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
    fn an_eased_ray_keeps_its_points() {
        let ray = Ray::new(DVec3::new(0.0, 0.0, -3e-200), DVec3::Z * 1e-90);
        let eased = RescaledRay::new(&ray, 1e-200).unwrap();
        let t = eased.t(2.0);
        assert!((ray.at(t) - eased.ray.at(2.0) * eased.size).length() < 1e-215);
    }
}
