//! Light that media scatter into a ray: the lights are sought from many points of the ray together.

use super::{LightBeam, MediaSegment};
use crate::base::accel::MAX_STREAM_RAYS;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::render::shade::bsdf::{ViewPoint, is_negligible};
use crate::render::shade::direct::transmittance::{SegmentEnd, ShadowSegment};
use crate::render::shade::shading_point::{LightSamples, ShadingPoint, shadow_query};
use crate::render::shade::{Scratch, Tracer};
use crate::scene::interior::MediumCoefficients;
use crate::scene::light::Arrival;
use crate::world::{Occlusion, Query};
use glam::DVec3;
use smallvec::SmallVec;

/// Points of a segment in media.
pub(super) struct MediaPoints<'a> {
    /// Their distances along the ray.
    pub(super) distances: &'a [f64],
    pub(super) points: &'a [DVec3],
    /// The effects of the media at them.
    pub(super) effects: &'a [MediumCoefficients],
}

/// Light that arrives at a point of a ray if nothing occludes it.
#[derive(Clone, Copy)]
struct UnoccludedLight {
    arrival: Arrival,
    arriving: Rgb,
}

impl Tracer<'_> {
    /// The light of a light source that media scatter into the ray at up to `N` points of an interval of this length,
    /// relative to their scattering.
    #[inline]
    pub(super) fn scattered<const N: usize>(
        &self,
        segment: &MediaSegment,
        beam: &LightBeam,
        length: f64,
        at: &MediaPoints,
        scratch: &mut Scratch,
    ) -> [Option<Rgb>; N] {
        if !segment.media.iter().any(|media| media.scatters()) {
            return [None; N];
        }
        let light = self.world.lights.get(beam.number);
        // POV-Ray attenuates the single lights of such a grid, and only where they shine on surfaces.
        let is_attenuated = !(self.samples_areas(segment.path)
            && light
                .area
                .as_ref()
                .is_some_and(|area| area.has_area_illumination));
        let mut unoccluded: [Option<UnoccludedLight>; N] = [None; N];
        let mut lit_count = 0;
        for (i, unoccluded) in unoccluded.iter_mut().enumerate().take(at.points.len()) {
            let distance = at.distances[i];
            // POV-Ray samples lights where the density is 0, too, which shows in their random numbers.
            let is_idle =
                !self.features.uses_random && is_negligible(at.effects[i].scattering * length);
            if is_idle || distance < beam.from || beam.to < distance {
                continue;
            }
            let arrival = light.arrival(at.points[i]);
            let share = match is_attenuated {
                true => light.attenuation(at.points[i], &arrival),
                false => 1.0,
            };
            let arriving = light.color * share;
            if !is_negligible(arriving) {
                *unoccluded = Some(UnoccludedLight { arrival, arriving });
                lit_count += 1;
            }
        }
        let mut occlusions = [None; N];
        if N > 1 && lit_count > 1 && self.can_stream(segment, beam.number) {
            self.find_occlusions(
                segment,
                beam.number,
                at,
                &unoccluded,
                &mut occlusions,
                scratch,
            );
        }
        let mut scattered = [None; N];
        for i in 0..at.points.len().min(N) {
            let Some(light) = &unoccluded[i] else {
                continue;
            };
            let left = match occlusions[i] {
                Some(Occlusion::Clear) => {
                    let Arrival { to_light, distance } = light.arrival;
                    let shadow = ShadowSegment {
                        ray: &Ray::new(at.points[i], to_light),
                        length: distance,
                        inside: &segment.path.inside,
                        end: SegmentEnd::Light,
                    };
                    self.through_atmosphere(light.arriving, beam.number, &shadow, scratch)
                }
                Some(Occlusion::Opaque) => continue,
                Some(Occlusion::Transmissive) | None => {
                    let (distance, point) = (at.distances[i], at.points[i]);
                    self.shadowed_in_media(segment, beam.number, distance, point, light, scratch)
                }
            };
            let cosine = light.arrival.to_light.dot(segment.ray.dir);
            let phases = segment.media.iter().map(|media| media.phase(cosine));
            scattered[i] = Some(left * (phases.sum::<f64>() / segment.media.len() as f64));
        }
        scattered
    }

    /// Returns true if shadow rays to a light may be traced together.
    fn can_stream(&self, segment: &MediaSegment, number: u32) -> bool {
        let light = self.world.lights.get(number);
        !self.features.uses_random
            && self.quality.has_shadows
            && (light.area.is_none() || !self.samples_areas(segment.path))
            && !self.world.lights.is_projected(number)
    }

    /// Finds out what lies before a light at up to [`MAX_STREAM_RAYS`] points, except in the surface that the ray has
    /// left.
    fn find_occlusions(
        &self,
        segment: &MediaSegment,
        number: u32,
        at: &MediaPoints,
        unoccluded: &[Option<UnoccludedLight>],
        occlusions: &mut [Option<Occlusion>],
        scratch: &mut Scratch,
    ) {
        let mut queries: SmallVec<[Query; MAX_STREAM_RAYS]> = SmallVec::new();
        let mut indices: SmallVec<[usize; MAX_STREAM_RAYS]> = SmallVec::new();
        for (i, light) in unoccluded.iter().enumerate() {
            let is_in_surface = segment.surface_at(at.distances[i]).is_some();
            if let Some(UnoccludedLight { arrival, .. }) = light.filter(|_| !is_in_surface) {
                let ray = Ray::new(at.points[i], arrival.to_light);
                queries.push(shadow_query(self.world, None, ray, arrival.distance));
                indices.push(i);
            }
        }
        if queries.is_empty() {
            return;
        }
        let scratch = &mut scratch.query;
        let all = self.world.occlusion_of_stream(&queries, number, scratch);
        for (i, occlusion) in indices.into_iter().zip(all) {
            occlusions[i] = Some(occlusion);
        }
    }

    /// The light that arrives at a point of the ray through what lies before the light.
    fn shadowed_in_media(
        &self,
        segment: &MediaSegment,
        number: u32,
        distance: f64,
        point: DVec3,
        light: &UnoccludedLight,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !self.quality.has_shadows {
            return light.arriving;
        }
        let spawn_surface = segment.surface_at(distance);
        let shading_point = ShadingPoint {
            at: ViewPoint {
                point,
                normal: DVec3::ZERO,
                view: segment.ray.dir,
            },
            spawn_surface,
            path: segment.path,
            known: LightSamples::NONE,
            shadow_cache: None,
            is_double_illuminated: false,
            lights: &[],
            collects: self.has_caustics(),
        };
        self.shadowed_light(
            light.arriving,
            number,
            &shading_point,
            &light.arrival,
            scratch,
        )
    }
}
