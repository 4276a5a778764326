//! `cylinder`: a round beam of parallel light, full within `radius` of its axis, none outside of `falloff`.

use super::edge;
use crate::base::args::Word;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use glam::DVec3;

/// A round beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// The radius of full light.
    pub radius: f64,
    /// The radius of all light.
    pub falloff: f64,
    /// The power by which light weakens from the axis outwards.
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

    /// The share of light at a point relative to the light's centre; `axis` is the unit direction of the beam.
    #[must_use]
    pub fn share(&self, point: DVec3, axis: DVec3) -> f64 {
        let along = point.dot(axis);
        let aside = (point - along * axis).length();
        if along <= 0.0 || aside >= self.falloff {
            return 0.0;
        }
        let inwards = 1.0 - aside / self.falloff;
        let middle = exact_power(inwards, self.tightness);
        if self.radius > 0.0 && aside > self.radius {
            middle * edge(inwards, 0.0, 1.0 - self.radius / self.falloff)
        } else {
            middle
        }
    }
}

impl Cylinder {
    /// The stretch of a ray within the beam, without regard to where it begins.
    pub(super) fn crossed_by(&self, ray: &Ray, centre: DVec3, axis: DVec3) -> Option<(f64, f64)> {
        let aside = |v: DVec3| v - v.dot(axis) * axis;
        let (from, dir) = (aside(ray.origin - centre), aside(ray.dir));
        let a = dir.length_squared();
        let b = from.dot(dir);
        let c = from.length_squared() - self.falloff * self.falloff;
        if a == 0.0 {
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

    fn share(radius: f64, falloff: f64, tightness: f64, aside: f64) -> f64 {
        let beam = Cylinder {
            radius,
            falloff,
            tightness,
        };
        beam.share(DVec3::new(aside, -8.0, 0.0), DVec3::NEG_Y)
    }

    #[test]
    fn light_ends_softly_between_radius_and_falloff() {
        // As POV-Ray 3.7 draws it on a floor.
        let found = [1.0, 3.0, 5.0, 7.0].map(|aside| share(3.0, 6.0, 0.0, aside));
        assert_eq!((found[0], found[1], found[3]), (1.0, 1.0, 0.0));
        assert!((found[2] - 0.25927).abs() < 2e-5);
    }

    #[test]
    fn tightness_weakens_light_off_the_axis() {
        for (aside, expected) in [(1.0, 0.69444), (3.0, 0.25), (5.0, 0.02777)] {
            assert!((share(0.0, 6.0, 2.0, aside) - expected).abs() < 2e-5);
        }
    }

    #[test]
    fn nothing_lies_behind_the_light() {
        let beam = Cylinder::default();
        assert_eq!(beam.share(DVec3::Y, DVec3::NEG_Y), 0.0);
        assert_eq!(beam.share(DVec3::NEG_Y, DVec3::NEG_Y), 1.0);
    }
}
