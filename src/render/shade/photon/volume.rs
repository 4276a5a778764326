//! Volume photons: deposition in media, and the radiance that they scatter (docs/povray-facts.md, section 12.5).

use super::path::{PhotonPath, PhotonTally};
use crate::base::color::Rgb;
use crate::render::shade::Scratch;
use crate::render::shade::Tracer;
use crate::render::shade::media::{
    common_sampling, effect_at, parts_of, subdivided, transmittance_of,
};
use crate::scene::interior::{MediumCoefficients, PreparedMedia};
use crate::world::LightList;
use glam::DVec3;
use std::f64::consts::PI;

impl Tracer<'_> {
    /// Returns true if photons are stored in media.
    #[inline]
    pub(in crate::render::shade) fn has_volume_photons(&self) -> bool {
        self.photon_maps
            .as_ref()
            .is_some_and(|photon_maps| !photon_maps.media.is_empty())
    }

    /// The light of the photons around a point, scattered along a ray.
    pub(in crate::render::shade) fn volume_photon_light(
        &self,
        media: &[&PreparedMedia],
        point: DVec3,
        dir: DVec3,
        effect: &MediumCoefficients,
        scratch: &mut Scratch,
    ) -> Rgb {
        let Some(photon_maps) = self.photon_maps.as_deref() else {
            return Rgb::BLACK;
        };
        let near = &mut scratch.photons;
        let point_in_scene = self.scene_point(point);
        photon_maps
            .media
            .gather(&photon_maps.in_media, point_in_scene, DVec3::ZERO, near);
        let mut sum = Rgb::BLACK;
        for (to_light, light) in photon_maps.media.of(near) {
            let cosine = to_light.dot(dir);
            let phases: f64 = media.iter().map(|media| media.phase(cosine)).sum();
            sum += light * (phases / media.len() as f64);
        }
        let within = 4.0 / 3.0 * PI * near.radius.powi(3);
        sum * effect.scattering * (1.0 / within)
    }

    /// Attenuates a photon in the media of the interiors around it. Once it has hit its target, deposits volume photons
    /// there.
    pub(in crate::render::shade) fn through_media(
        &self,
        photon: &mut PhotonPath,
        length: f64,
        lights: LightList,
        tally: &mut PhotonTally,
        scratch: &mut Scratch,
    ) {
        let inside = &photon.path.inside;
        if !self.features.has_media || inside.is_empty() || !self.is_outside_solids(inside) {
            return;
        }
        let media = self.media_of(inside);
        let Some(sampling) = common_sampling(&media) else {
            return;
        };
        if !tally.photons.fills_media() {
            photon.light *= self.interior_transmittance(&photon.path.ray, length, inside, scratch);
            return;
        }
        let beams = self.beams(lights, &photon.path.ray, length);
        let is_stored = photon.has_hit_target && media.iter().any(|media| media.stores_photons);
        let ray = photon.path.ray;
        let (most, factor) = tally.photons.settings.media;
        let jitter = tally.photons.settings.jitter;
        let mut optical_depth = Rgb::BLACK;
        for interval in subdivided(&parts_of(&beams, length), &sampling) {
            let long = interval.to - interval.from;
            let own_length = long / tally.photons.unit;
            let at_start = tally.spread * tally.spreading(tally.path_length);
            let mut factor = factor;
            let wanted = own_length / (at_start * factor);
            let count = if wanted < f64::from(most) {
                wanted.floor().max(0.0)
            } else {
                factor = own_length / (at_start * f64::from(most));
                f64::from(most)
            };
            let mut number: f64 = 0.0;
            let mut sum = Rgb::BLACK;
            while number < count {
                let random = scratch.random.lights.next_number();
                let at = (number + 0.5 + random * jitter - 0.5 * jitter) / count;
                let in_interval = at * long;
                let along = in_interval + interval.from;
                let point = ray.at(along);
                let effect = effect_at(&media, point);
                sum += effect.extinction;
                if is_stored && effect.scattering != Rgb::BLACK {
                    let spreading =
                        tally.spreading(tally.path_length + in_interval + interval.from);
                    let light = photon.light * (factor * tally.spread * spreading);
                    let path_length = tally.path_length + along;
                    let stored = tally.photon(point, light, path_length, ray.origin);
                    tally.in_media.push(stored);
                }
                number += 1.0;
            }
            // Without samples it is not a number, and such photons are black, as in POV-Ray.
            optical_depth += sum / count * long;
        }
        photon.light *= transmittance_of(optical_depth);
    }
}
