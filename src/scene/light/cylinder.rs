//! `cylinder`: a cylindrical beam of parallel light, at full strength within `radius` of its axis and zero beyond
//! `falloff`.

use super::edge;
use crate::base::args::Word;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use glam::DVec3;

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
    /// too. The last digits are POV-Ray's, as in [`super::spotlight::Spotlight::interval`].
    pub(super) fn interval(&self, ray: &Ray, centre: DVec3, axis: DVec3) -> Option<(f64, f64)> {
        let from = ray.origin - centre;
        let (rise, height) = (ray.dir.dot(axis), from.dot(axis));
        let a = 1.0 - rise * rise;
        let b = ray.dir.dot(from) - rise * height;
        let c = from.length_squared() - height * height - self.falloff * self.falloff;
        if a <= 0.0 {
            return (c < 0.0).then_some((f64::NEG_INFINITY, f64::INFINITY));
        }
        let discriminant = b * b - a * c;
        (discriminant > 0.0).then(|| {
            let root = discriminant.sqrt();
            ((-b - root) / a, (-b + root) / a)
        })
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
    fn no_light_behind_the_centre() {
        let beam = Cylinder::default();
        assert_eq!(beam.attenuation(DVec3::Y, DVec3::NEG_Y), 0.0);
        assert_eq!(beam.attenuation(DVec3::NEG_Y, DVec3::NEG_Y), 1.0);
    }
}
