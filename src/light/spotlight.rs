//! `spotlight`: a cone of light, full within `radius`, none outside of `falloff`, brighter in the middle by `tightness`.

use super::edge;
use crate::args::Word;

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
        let middle = if self.tightness == 0.0 {
            1.0
        } else {
            cosine.powf(self.tightness)
        };
        if self.cos_radius <= 0.0 || cosine >= self.cos_radius {
            middle
        } else if cosine <= self.cos_falloff {
            // A `radius` beyond `falloff` has a sharp edge.
            0.0
        } else {
            middle * edge(cosine, self.cos_falloff, self.cos_radius)
        }
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
}
