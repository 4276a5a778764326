//! Participating media prepared for rendering: coefficients at a point, and phase functions.

use super::{Media, Phase, Sampling, Scattering};
use crate::base::color::Rgb;
use crate::base::math::Step;
use crate::scene::pattern::{Settings, SurfacePoint};
use crate::scene::texture::PreparedPigment;
use glam::DVec3;

/// A medium prepared for ray queries.
#[derive(Debug)]
pub struct PreparedMedia {
    absorption: Rgb,
    emission: Rgb,
    scattering: Scattering,
    densities: Vec<PreparedPigment>,
    /// The coefficients of a homogeneous medium.
    homogeneous: Option<MediumCoefficients>,
    /// Photons are stored in the medium.
    pub stores_photons: bool,
    /// Sampling along rays.
    pub sampling: Sampling,
}

/// Coefficients of media, per unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MediumCoefficients {
    /// Extinction coefficient.
    pub extinction: Rgb,
    /// Emitted radiance.
    pub emission: Rgb,
    /// Scattering coefficient, over all directions.
    pub scattering: Rgb,
}

impl MediumCoefficients {
    /// Coefficients of empty space.
    pub const NONE: MediumCoefficients = MediumCoefficients {
        extinction: Rgb::BLACK,
        emission: Rgb::BLACK,
        scattering: Rgb::BLACK,
    };

    #[inline]
    fn add(&mut self, other: &MediumCoefficients) {
        self.extinction += other.extinction;
        self.emission += other.emission;
        self.scattering += other.scattering;
    }
}

impl Media {
    /// Prepares the medium for rendering; `after` are the transforms of its container.
    #[must_use]
    pub fn prepare(&self, after: &[Step], settings: &Settings) -> PreparedMedia {
        let densities = self.densities.iter();
        let mut media = PreparedMedia {
            absorption: self.absorption,
            emission: self.emission,
            scattering: self.scattering,
            stores_photons: self.collect,
            densities: densities
                .map(|density| PreparedPigment::new(&density.0, after, settings))
                .collect(),
            homogeneous: None,
            sampling: self.sampling,
        };
        let is_plain = |density: &PreparedPigment| matches!(density, PreparedPigment::Plain(_));
        if media.densities.iter().all(is_plain) {
            media.homogeneous = Some(media.coefficients(media.density(DVec3::ZERO)));
        }
        media
    }
}

impl PreparedMedia {
    /// Returns true if the scene gives it a density.
    #[must_use]
    pub fn has_density(&self) -> bool {
        !self.densities.is_empty()
    }

    /// Returns true if the medium is homogeneous.
    #[must_use]
    pub fn is_homogeneous(&self) -> bool {
        self.homogeneous.is_some()
    }

    /// Returns true if the medium scatters light at some density.
    #[must_use]
    pub fn scatters(&self) -> bool {
        self.scattering.color != Rgb::BLACK
    }

    /// Returns true if the medium attenuates light.
    #[must_use]
    pub fn attenuates(&self) -> bool {
        let scattered = self.scattering.color * self.scattering.extinction;
        self.absorption != Rgb::BLACK || scattered != Rgb::BLACK
    }

    /// Adds the coefficients at each of these points to one of the sums.
    pub fn add_coefficients(&self, points: &[DVec3], sums: &mut [MediumCoefficients]) {
        if let Some(coefficients) = &self.homogeneous {
            sums.iter_mut().for_each(|sum| sum.add(coefficients));
            return;
        }
        for (points, sums) in points.chunks(4).zip(sums.chunks_mut(4)) {
            if let Ok(points) = points.try_into() {
                for (sum, density) in sums.iter_mut().zip(self.densities_x4(points)) {
                    sum.add(&self.coefficients(density));
                }
            } else {
                for (sum, point) in sums.iter_mut().zip(points) {
                    sum.add(&self.coefficients(self.density(*point)));
                }
            }
        }
    }

    /// The product of the densities at a point.
    fn density(&self, point: DVec3) -> Rgb {
        let surface_point = SurfacePoint::at(point);
        let mut density = Rgb::WHITE;
        for factor in &self.densities {
            density *= factor.color(&surface_point).rgb;
            if density == Rgb::BLACK {
                break;
            }
        }
        density
    }

    /// The products of the densities at four points.
    fn densities_x4(&self, points: &[DVec3; 4]) -> [Rgb; 4] {
        let mut densities = [Rgb::WHITE; 4];
        for factor in &self.densities {
            for (density, color) in densities.iter_mut().zip(factor.colors_x4(points)) {
                if *density != Rgb::BLACK {
                    *density *= color.rgb;
                }
            }
            if densities == [Rgb::BLACK; 4] {
                break;
            }
        }
        densities
    }

    /// The coefficients at this density.
    #[inline]
    fn coefficients(&self, density: Rgb) -> MediumCoefficients {
        let scattering = self.scattering.color;
        MediumCoefficients {
            extinction: density * (self.absorption + scattering * self.scattering.extinction),
            emission: density * self.emission,
            scattering: density * scattering,
        }
    }

    /// The phase function, relative to isotropic scattering; `cosine` is of the angle between the directions from the
    /// viewer to the point and from the point to the light.
    #[must_use]
    pub fn phase(&self, cosine: f64) -> f64 {
        match self.scattering.phase {
            Phase::Isotropic => 1.0,
            Phase::MieHazy => 0.576_655_375 * (1.0 + 9.0 * (0.5 * (1.0 + cosine)).powi(8)),
            Phase::MieMurky => 0.495_714_547 * (1.0 + 50.0 * (0.5 * (1.0 + cosine)).powi(32)),
            Phase::Rayleigh => 0.799_372_013 * (1.0 + cosine * cosine),
            Phase::HenyeyGreenstein => {
                let g = self.scattering.eccentricity;
                (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn prepare(text: &str) -> PreparedMedia {
        let media = Media::read(&mut TextArgs::new(text)).unwrap();
        media.prepare(&[], &Settings::default())
    }

    #[test]
    fn densities_multiply_and_extinction_is_absorption_plus_scattering() {
        let media = prepare(
            "{ absorption 0.5 emission 2 scattering { 1, 0.25 extinction 2 }
               density { rgb 0.5 } density { gradient <1,0,0> } }",
        );
        let mut coefficients = [MediumCoefficients::NONE];
        media.add_coefficients(&[DVec3::new(0.5, 0.0, 0.0)], &mut coefficients);
        let [coefficients] = coefficients;
        assert_eq!(coefficients.extinction, Rgb::splat(0.25));
        assert_eq!(coefficients.emission, Rgb::splat(0.5));
        assert_eq!(coefficients.scattering, Rgb::splat(0.0625));
        assert!(media.has_density() && !media.is_homogeneous());
    }

    #[test]
    fn emission_and_scattering_without_extinction_do_not_attenuate() {
        for text in ["{ emission 1 }", "{ scattering { 1, 1 extinction 0 } }"] {
            assert!(!prepare(text).attenuates(), "{text}");
        }
        for text in ["{ absorption 1 }", "{ scattering { 1, 1 } }"] {
            assert!(prepare(text).attenuates(), "{text}");
        }
    }

    #[test]
    fn types_1_and_5_conserve_energy() {
        for text in ["1, 1", "5, 1 eccentricity 0.6", "5, 1 eccentricity -0.3"] {
            let media = prepare(&format!("{{ scattering {{ {text} }} }}"));
            let steps = 2000;
            let cosine = |i: i32| (f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0;
            let sum: f64 = (0..steps).map(|i| media.phase(cosine(i))).sum();
            assert!((sum / f64::from(steps) - 1.0).abs() < 1e-3, "{text}");
        }
    }
}
