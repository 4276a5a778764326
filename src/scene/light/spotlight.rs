//! `spotlight`: a cone of light, at full strength within `radius`, zero beyond `falloff`, and concentrated towards the
//! axis by `tightness`.

use super::edge;
use crate::base::args::Word;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use glam::DVec3;

/// A ray through the apex has no interval in the cone, as in POV-Ray: its discriminant is within this of zero, relative to
/// the square of the linear coefficient.
const APEX: f64 = 1.0 / (1_u64 << 30) as f64;

/// Default half-angles.
const RADIUS_DEG: f64 = 30.0;
const FALLOFF_DEG: f64 = 45.0;

/// A cone of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spotlight {
    /// Cosine of the half-angle of the fully lit cone; 0 or less disables the penumbra.
    pub cos_radius: f64,
    /// Cosine of the half-angle of the whole cone.
    pub cos_falloff: f64,
    /// Exponent of the cosine of the angle from the axis.
    pub tightness: f64,
}

impl Default for Spotlight {
    fn default() -> Self {
        Spotlight {
            cos_radius: RADIUS_DEG.to_radians().cos(),
            cos_falloff: FALLOFF_DEG.to_radians().cos(),
            tightness: 0.0,
        }
    }
}

impl Spotlight {
    /// Sets `radius`, `falloff` (half-angles in degrees) or `tightness`.
    pub(super) fn set(&mut self, word: Word, value: f64) {
        match word {
            Word::Radius => self.cos_radius = value.to_radians().cos(),
            Word::Falloff => self.cos_falloff = value.to_radians().cos(),
            _ => self.tightness = value,
        }
    }

    /// The fraction of the light emitted at an angle from the axis, given by its cosine.
    #[must_use]
    pub fn attenuation(&self, cosine: f64) -> f64 {
        if cosine <= 0.0 {
            return 0.0;
        }
        let core = || exact_power(cosine, self.tightness);
        if self.cos_radius <= 0.0 || cosine >= self.cos_radius {
            core()
        } else if cosine <= self.cos_falloff {
            // A `radius` beyond `falloff` has a sharp edge.
            0.0
        } else {
            core() * edge(cosine, self.cos_falloff, self.cos_radius)
        }
    }
}

impl Spotlight {
    /// The interval of parameters of a ray of unit direction inside the cone of half-angle `falloff`, with apex `centre`
    /// and unit `axis`. The last digits are POV-Ray's (docs/povray-facts.md, section 10): they decide whether an interval
    /// of media is left over.
    pub(super) fn interval(&self, ray: &Ray, centre: DVec3, axis: DVec3) -> Option<(f64, f64)> {
        let from = ray.origin - centre;
        let per_cos_sq = 1.0 / (self.cos_falloff * self.cos_falloff);
        let (rise, height) = (ray.dir.dot(axis), from.dot(axis));
        let a = 1.0 - rise * rise * per_cos_sq;
        let b = ray.dir.dot(from) - rise * height * per_cos_sq;
        let c = from.length_squared() - height * height * per_cos_sq;
        let mut ends = [
            f64::NEG_INFINITY,
            f64::INFINITY,
            f64::INFINITY,
            f64::INFINITY,
        ];
        let discriminant = b * b - a * c;
        let mut count = 1;
        if a == 0.0 {
            if b != 0.0 {
                ends[count] = -0.5 * c / b;
                count += 1;
            }
        } else if discriminant <= APEX * b * b {
            return None;
        } else {
            let root = discriminant.sqrt();
            let (one, other) = ((-b - root) / a, (-b + root) / a);
            ends[1] = one.min(other);
            ends[2] = one.max(other);
            count = 3;
        }
        // Between two neighbouring ends the ray is either inside or outside throughout.
        let is_inside = |t: f64| {
            let height = height + t * rise;
            height > 0.0 && a * t * t + 2.0 * b * t + c < 0.0
        };
        let mut inside: Option<(f64, f64)> = None;
        for index in 0..count {
            let (from, to) = (ends[index], ends[index + 1]);
            let middle = match (from.is_finite(), to.is_finite()) {
                (true, true) => 0.5 * (from + to),
                (true, false) => from + from.abs() + 1.0,
                (false, true) => to - to.abs() - 1.0,
                (false, false) => 0.0,
            };
            if is_inside(middle) {
                inside = Some((inside.map_or(from, |inside| inside.0), to));
            }
        }
        inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attenuation(radius: f64, falloff: f64, tightness: f64, angle_deg: f64) -> f64 {
        let mut spotlight = Spotlight::default();
        spotlight.set(Word::Radius, radius);
        spotlight.set(Word::Falloff, falloff);
        spotlight.set(Word::Tightness, tightness);
        spotlight.attenuation(angle_deg.to_radians().cos())
    }

    /// Compares with POV-Ray's spotlight at <0, 8, 0> on the floor at x; the cosine at the floor is a factor.
    fn check(radius: f64, falloff: f64, tightness: f64, at: [(f64, f64); 3]) {
        for (x, expected) in at {
            let angle = f64::atan(x / 8.0);
            let result = attenuation(radius, falloff, tightness, angle.to_degrees()) * angle.cos();
            assert!(
                (result - expected).abs() < 2e-5,
                "{x}: {result}, not {expected}"
            );
        }
    }

    #[test]
    fn light_falls_off_smoothly_between_radius_and_falloff() {
        check(
            30.0,
            45.0,
            0.0,
            [(7.0, 0.14957), (5.0, 0.81773), (3.0, 0.93632)],
        );
        check(
            20.0,
            60.0,
            10.0,
            [(7.0, 0.02679), (5.0, 0.14475), (1.0, 0.91826)],
        );
    }

    #[test]
    fn a_radius_beyond_falloff_has_a_sharp_edge() {
        check(
            40.0,
            20.0,
            0.0,
            [(7.0, 0.0), (5.0, 0.84800), (3.0, 0.93632)],
        );
    }

    #[test]
    fn a_radius_beyond_90_degrees_has_no_penumbra() {
        check(
            100.0,
            120.0,
            0.0,
            [(7.0, 0.75257), (5.0, 0.84800), (3.0, 0.93632)],
        );
        assert_eq!(attenuation(100.0, 120.0, 0.0, 91.0), 0.0);
    }

    #[test]
    fn interval_of_a_ray_in_the_cone() {
        let mut spotlight = Spotlight::default();
        spotlight.set(Word::Falloff, 45.0);
        let interval = |origin: DVec3, dir: DVec3| {
            spotlight.interval(&Ray::new(origin, dir), DVec3::ZERO, DVec3::Z)
        };
        let across = interval(DVec3::new(-9.0, 0.0, 2.0), DVec3::X).expect("it crosses");
        assert!((across.0 - 7.0).abs() < 1e-9 && (across.1 - 11.0).abs() < 1e-9);
        assert_eq!(interval(DVec3::new(-9.0, 0.0, -2.0), DVec3::X), None);
        let along = interval(DVec3::new(1.0, 0.0, -5.0), DVec3::Z).expect("it goes in");
        assert!((along.0 - 6.0).abs() < 1e-9 && along.1 == f64::INFINITY);
    }
}
