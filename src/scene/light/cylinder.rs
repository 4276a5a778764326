//! `cylinder`: a cylindrical beam of parallel light, at full strength within `radius` of its axis and zero beyond
//! `falloff`.

use super::edge;
use crate::base::args::Word;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use glam::DVec3;

/// A ray has no interval in the beam if its discriminant is within this of zero, relative to the square of the radius, as
/// the sine of its angle with the axis is then within the root of it. POV-Ray takes it for a beam of radius 1.
const PARALLEL: f64 = 1e-10;

/// A cylindrical beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// The radius of the fully lit core.
    pub radius: f64,
    /// The radius of the whole beam.
    pub falloff: f64,
    /// The exponent of the falloff from the axis outwards.
    pub tightness: f64,
}

impl Default for Cylinder {
    fn default() -> Self {
        Cylinder {
            radius: 0.75,
            falloff: 1.0,
            tightness: 0.0,
        }
    }
}

impl Cylinder {
    /// Sets `radius`, `falloff` or `tightness`. Transforms change none of them.
    pub(super) fn set(&mut self, word: Word, value: f64) {
        match word {
            Word::Radius => self.radius = value,
            Word::Falloff => self.falloff = value,
            _ => self.tightness = value,
        }
    }

    /// The fraction of the light at `point`, given relative to the light's centre. `axis` is the unit direction of the
    /// beam.
    #[must_use]
    pub fn attenuation(&self, point: DVec3, axis: DVec3) -> f64 {
        let along = point.dot(axis);
        let from_axis = (point - along * axis).length();
        if along <= 0.0 || from_axis >= self.falloff {
            return 0.0;
        }
        let inwards = 1.0 - from_axis / self.falloff;
        let core = exact_power(inwards, self.tightness);
        if self.radius > 0.0 && from_axis > self.radius {
            core * edge(inwards, 0.0, 1.0 - self.radius / self.falloff)
        } else {
            core
        }
    }
}

impl Cylinder {
    /// The interval of parameters of a ray of unit direction inside the infinite cylinder, which extends behind the light
    /// too. In POV-Ray a ray that leaves it there, or is parallel to it, has none, and one that enters it there has been in
    /// it from the beginning. The last digits are POV-Ray's, as in [`super::spotlight::Spotlight::interval`].
    pub(super) fn interval(&self, ray: &Ray, centre: DVec3, axis: DVec3) -> Option<(f64, f64)> {
        let from = ray.origin - centre;
        let (rise, height) = (ray.dir.dot(axis), from.dot(axis));
        let a = 1.0 - rise * rise;
        let b = ray.dir.dot(from) - rise * height;
        let radius_sq = self.falloff * self.falloff;
        let c = from.length_squared() - height * height - radius_sq;
        let discriminant = b * b - a * c;
        if discriminant <= PARALLEL * radius_sq {
            return None;
        }
        let root = discriminant.sqrt();
        let (enter, leave) = ((-b - root) / a, (-b + root) / a);
        let is_before_light = |t: f64| height + t * rise > 0.0;
        let from = match is_before_light(enter) {
            true => enter,
            false => f64::NEG_INFINITY,
        };
        is_before_light(leave).then_some((from, leave))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attenuation(radius: f64, falloff: f64, tightness: f64, from_axis: f64) -> f64 {
        let beam = Cylinder {
            radius,
            falloff,
            tightness,
        };
        beam.attenuation(DVec3::new(from_axis, -8.0, 0.0), DVec3::NEG_Y)
    }

    #[test]
    fn light_falls_off_smoothly_between_radius_and_falloff() {
        // As POV-Ray 3.7 renders it on a floor.
        let results = [1.0, 3.0, 5.0, 7.0].map(|from_axis| attenuation(3.0, 6.0, 0.0, from_axis));
        assert_eq!((results[0], results[1], results[3]), (1.0, 1.0, 0.0));
        assert!((results[2] - 0.25927).abs() < 2e-5);
    }

    #[test]
    fn tightness_attenuates_light_off_the_axis() {
        for (from_axis, expected) in [(1.0, 0.69444), (3.0, 0.25), (5.0, 0.02777)] {
            assert!((attenuation(0.0, 6.0, 2.0, from_axis) - expected).abs() < 2e-5);
        }
    }

    #[test]
    fn interval_of_a_ray_in_the_beam() {
        let beam = Cylinder {
            falloff: 5.0,
            ..Cylinder::default()
        };
        let interval = |origin: DVec3, dir: DVec3| {
            beam.interval(&Ray::new(origin, dir), DVec3::ZERO, DVec3::Z)
        };
        let at = |height: f64| height * DVec3::Z;
        let slope = DVec3::new(0.6, 0.0, 0.8);
        assert_eq!(interval(at(1.0), DVec3::X), Some((-5.0, 5.0)));
        assert!(interval(at(7.0), slope).is_some());
        let (from, to) = interval(at(-1.0), slope).expect("it leaves it before the light");
        assert!(from == f64::NEG_INFINITY && to > 0.0);
        assert!(interval(at(7.0), slope.with_z(-0.8)).is_some());
        // They leave it behind the light.
        assert_eq!(interval(at(6.0), slope.with_z(-0.8)), None);
        assert_eq!(interval(at(-7.0), slope), None);
        // Parallel to it.
        assert_eq!(interval(at(1.0), DVec3::Z), None);
    }

    #[test]
    fn no_light_behind_the_centre() {
        let beam = Cylinder::default();
        assert_eq!(beam.attenuation(DVec3::Y, DVec3::NEG_Y), 0.0);
        assert_eq!(beam.attenuation(DVec3::NEG_Y, DVec3::NEG_Y), 1.0);
    }
}
