//! `spotlight`: a cone of light, full within `radius`, none outside of `falloff`, brighter in the middle by `tightness`.

use super::edge;
use crate::base::args::Word;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use glam::DVec3;

/// The half-angles that a spotlight has unless it gives others.
const RADIUS_DEG: f64 = 30.0;
const FALLOFF_DEG: f64 = 45.0;

/// A cone of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spotlight {
    /// The cosine of the half-angle of full light; 0 and less for no edge at all.
    pub cos_radius: f64,
    /// The cosine of the half-angle of all light.
    pub cos_falloff: f64,
    /// The power of the cosine by which the middle is brighter.
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

    /// The share of light that leaves at an angle of this cosine from the axis.
    #[must_use]
    pub fn share(&self, cosine: f64) -> f64 {
        if cosine <= 0.0 {
            return 0.0;
        }
        let middle = || exact_power(cosine, self.tightness);
        if self.cos_radius <= 0.0 || cosine >= self.cos_radius {
            middle()
        } else if cosine <= self.cos_falloff {
            // A `radius` beyond `falloff` has a sharp edge.
            0.0
        } else {
            middle() * edge(cosine, self.cos_falloff, self.cos_radius)
        }
    }
}

impl Spotlight {
    /// The stretch of a ray within the cone of all light, which stands on `centre` about the unit `axis`.
    pub(super) fn crossed_by(&self, ray: &Ray, centre: DVec3, axis: DVec3) -> Option<(f64, f64)> {
        let from = ray.origin - centre;
        let cos_sq = self.cos_falloff * self.cos_falloff;
        let (rise, height) = (ray.dir.dot(axis), from.dot(axis));
        let a = rise * rise - cos_sq * ray.dir.length_squared();
        let b = rise * height - cos_sq * ray.dir.dot(from);
        let c = height * height - cos_sq * from.length_squared();
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
        } else if discriminant > 0.0 {
            let root = discriminant.sqrt();
            let (one, other) = ((-b - root) / a, (-b + root) / a);
            ends[1] = one.min(other);
            ends[2] = one.max(other);
            count = 3;
        }
        // Between two ends the ray is in the cone or not all along.
        let is_in = |t: f64| {
            let height = height + t * rise;
            height > 0.0 && a * t * t + 2.0 * b * t + c > 0.0
        };
        let mut found: Option<(f64, f64)> = None;
        for place in 0..count {
            let (from, to) = (ends[place], ends[place + 1]);
            let middle = match (from.is_finite(), to.is_finite()) {
                (true, true) => 0.5 * (from + to),
                (true, false) => from + from.abs() + 1.0,
                (false, true) => to - to.abs() - 1.0,
                (false, false) => 0.0,
            };
            if is_in(middle) {
                found = Some((found.map_or(from, |found| found.0), to));
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(radius: f64, falloff: f64, tightness: f64, angle_deg: f64) -> f64 {
        let mut spotlight = Spotlight::default();
        spotlight.set(Word::Radius, radius);
        spotlight.set(Word::Falloff, falloff);
        spotlight.set(Word::Tightness, tightness);
        spotlight.share(angle_deg.to_radians().cos())
    }

    /// Compares with the light of POV-Ray's spotlight at <0, 8, 0> on the floor at x, less the cosine of the floor.
    fn check(radius: f64, falloff: f64, tightness: f64, at: [(f64, f64); 3]) {
        for (x, expected) in at {
            let angle = f64::atan(x / 8.0);
            let found = share(radius, falloff, tightness, angle.to_degrees()) * angle.cos();
            assert!(
                (found - expected).abs() < 2e-5,
                "{x}: {found}, not {expected}"
            );
        }
    }

    #[test]
    fn light_ends_softly_between_radius_and_falloff() {
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
    fn a_radius_beyond_falloff_ends_sharply() {
        check(
            40.0,
            20.0,
            0.0,
            [(7.0, 0.0), (5.0, 0.84800), (3.0, 0.93632)],
        );
    }

    #[test]
    fn a_radius_beyond_90_degrees_has_no_edge() {
        check(
            100.0,
            120.0,
            0.0,
            [(7.0, 0.75257), (5.0, 0.84800), (3.0, 0.93632)],
        );
        assert_eq!(share(100.0, 120.0, 0.0, 91.0), 0.0);
    }

    #[test]
    fn a_ray_is_in_the_cone_where_light_arrives() {
        let mut spotlight = Spotlight::default();
        spotlight.set(Word::Falloff, 45.0);
        let crossed = |origin: DVec3, dir: DVec3| {
            spotlight.crossed_by(&Ray::new(origin, dir), DVec3::ZERO, DVec3::Z)
        };
        let across = crossed(DVec3::new(-9.0, 0.0, 2.0), DVec3::X).expect("it crosses");
        assert!((across.0 - 7.0).abs() < 1e-9 && (across.1 - 11.0).abs() < 1e-9);
        assert_eq!(crossed(DVec3::new(-9.0, 0.0, -2.0), DVec3::X), None);
        let along = crossed(DVec3::new(1.0, 0.0, -5.0), DVec3::Z).expect("it goes in");
        assert!((along.0 - 6.0).abs() < 1e-9 && along.1 == f64::INFINITY);
    }
}
