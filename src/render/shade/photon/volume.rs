//! Photons in media: where they are left, and the light that they give (facts 2, section 3.5).

use super::path::{PhotonPath, PhotonTally};
use crate::base::color::Rgb;
use crate::render::photons::Photon;
use crate::render::shade::Tracer;
use crate::render::shade::media::{common_sampling, divided, parts_of, vanishing};
use crate::scene::interior::{Effect, PreparedMedia};
use crate::world::{LightList, Scratch};
use glam::DVec3;
use std::f64::consts::PI;

impl Tracer<'_> {
    /// Whether photons lie in media.
    #[inline]
    pub(in crate::render::shade) fn has_cloud(&self) -> bool {
        self.kept
            .as_ref()
            .is_some_and(|kept| !kept.media.is_empty())
    }

    /// The light that photons around a point give, scattered along a ray.
    pub(in crate::render::shade) fn cloud_light(
        &self,
        media: &[&PreparedMedia],
        (point, dir): (DVec3, DVec3),
        effect: &Effect,
        scratch: &mut Scratch,
    ) -> Rgb {
        let Some(kept) = self.kept.as_deref() else {
            return Rgb::BLACK;
        };
        let near = &mut scratch.photons;
        let place = self.own_place(point);
        kept.media.gather(&kept.in_media, place, DVec3::ZERO, near);
        let mut sum = Rgb::BLACK;
        for (to_light, light) in kept.media.of(near) {
            let cosine = to_light.dot(dir);
            let phases: f64 = media.iter().map(|media| media.phase(cosine)).sum();
            sum += light * (phases / media.len() as f64);
        }
        let within = 4.0 / 3.0 * PI * near.radius.powi(3);
        sum * effect.scattering * (1.0 / within)
    }

    /// Takes a photon through the media of the interiors that it is in; once it has met its target, leaves photons there.
    pub(in crate::render::shade) fn through_media(
        &self,
        flight: &mut PhotonPath,
        length: f64,
        lights: LightList,
        shot: &mut PhotonTally,
        scratch: &mut Scratch,
    ) {
        let inside = &flight.path.inside;
        if !self.has_media || inside.is_empty() || !self.is_in_air(inside) {
            return;
        }
        let media = self.media_of(inside);
        let Some(sampling) = common_sampling(&media) else {
            return;
        };
        if !shot.photons.fills_media() {
            flight.light *= self.dimmed_inside(&flight.path.ray, length, inside, scratch);
            return;
        }
        let beams = self.beams(lights, &flight.path.ray, length);
        let is_kept = flight.has_met && media.iter().any(|media| media.collects);
        let ray = flight.path.ray;
        let (most, factor) = shot.photons.settings.media;
        let jitter = shot.photons.settings.jitter;
        let mut swallowed = Rgb::BLACK;
        for interval in divided(&parts_of(&beams, length), &sampling) {
            let long = interval.to - interval.from;
            let own_length = long / shot.photons.unit;
            let at_start = shot.width(flight.way);
            let mut factor = factor;
            let wanted = own_length / (at_start * factor);
            let count = if wanted < f64::from(most) {
                wanted.floor().max(0.0)
            } else {
                factor = own_length / (at_start * f64::from(most));
                f64::from(most)
            };
            let mut number = 0.0;
            let mut sum = Rgb::BLACK;
            while number < count {
                let random = scratch.stream.next_number() - 0.5;
                let at = (number + 0.5 + jitter * random) / count;
                let along = interval.from + at * long;
                let point = ray.at(along);
                let mut effect = Effect::NONE;
                for media in &media {
                    media.add_effect(point, &mut effect);
                }
                sum += effect.extinction;
                if is_kept && effect.scattering != Rgb::BLACK {
                    let way = flight.way + along;
                    let size = factor * shot.width(way).powi(3);
                    let fading = shot.light.map_or(1.0, |light| light.fade.share(way));
                    let light = flight.light * (size * fading);
                    let [point, origin] = [point, ray.origin].map(|at| shot.photons.own(at));
                    shot.in_media.push(Photon::new(point, light, origin));
                }
                number += 1.0;
            }
            if count > 0.0 {
                swallowed += sum * (long / count);
            }
        }
        flight.light *= vanishing(swallowed);
    }
}
