//! Shadow rays: the occlusion of a light, and the transmittance of transparent surfaces and atmosphere before it.

use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::render::shade::bsdf::is_negligible;
use crate::render::shade::shading_point::{ShadingPoint, shadow_query};
use crate::render::shade::transmission::interior_stack;
use crate::render::shade::{InteriorStack, MAX_STRAIGHT, Scratch, Tracer};
use crate::scene::light::{Arrival, Light};
use crate::world::{InteriorId, Occlusion, Query, TransmissiveHit, TransmissiveHits};

/// A shadow ray to a light with its known occlusion.
pub(in crate::render::shade) struct ShadowPath<'i> {
    /// The index of the light.
    pub(in crate::render::shade) light: u32,
    /// The occlusion query.
    pub(in crate::render::shade) query: Query,
    pub(in crate::render::shade) distance: f64,
    /// The occlusion, if traced before.
    pub(in crate::render::shade) known: Option<Occlusion>,
    /// The interiors around the shading point.
    pub(in crate::render::shade) inside: &'i [InteriorId],
    /// Photons replace the light that their targets would transmit to the point.
    pub(in crate::render::shade) collects: bool,
    /// The light is one of the grid of an area light, for which the atmosphere attenuates the last segment only once.
    pub(in crate::render::shade) is_to_grid: bool,
}

/// A part of a shadow ray between surfaces.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::shade) struct ShadowSegment<'a> {
    /// The ray from the start of the segment on.
    pub(in crate::render::shade) ray: &'a Ray,
    pub(in crate::render::shade) length: f64,
    /// The interiors that it is in.
    pub(in crate::render::shade) inside: &'a [InteriorId],
    pub(in crate::render::shade) end: SegmentEnd,
}

/// End of a segment of a shadow ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::render::shade) enum SegmentEnd {
    Surface,
    Light,
}

impl ShadowPath<'_> {
    /// Notes the length of what is left of the ray, if it leads to the grid of an area light.
    fn note_segment(&self, length: f64, scratch: &mut Scratch) {
        if self.is_to_grid {
            scratch.area.last_segment = Some(length);
        }
    }
}

impl Tracer<'_> {
    /// The light of a single light position that remains after shadows.
    pub(in crate::render::shade) fn shadowed_point_light(
        &self,
        arriving: Rgb,
        lit: &ShadingPoint,
        light: u32,
        arrival: &Arrival,
        scratch: &mut Scratch,
    ) -> Rgb {
        let source = self.world.lights.get(light);
        // That of an area light is not the one of each of its lights.
        let known = lit.known.occlusion(light);
        let known = known.filter(|_| source.area.is_none());
        match known {
            Some(Occlusion::Opaque) => return Rgb::BLACK,
            Some(Occlusion::Clear) if !self.is_attenuated_by_atmosphere(light) => return arriving,
            _ => {}
        }
        match self.shadow_path(lit, light, arrival, scratch) {
            None => Rgb::BLACK,
            Some(path) if source.is_shadowless() => {
                let segment = ShadowSegment {
                    ray: &path.query.ray,
                    length: path.distance,
                    inside: path.inside,
                    end: SegmentEnd::Light,
                };
                self.through_atmosphere(arriving, light, &segment, scratch)
            }
            Some(path) => {
                let shadow_path = ShadowPath { known, ..path };
                self.transmittance(arriving, &shadow_path, scratch)
            }
        }
    }

    /// The shadow ray to a light; none if it misses the object through which the light is projected.
    pub(super) fn shadow_path<'i>(
        &self,
        lit: &'i ShadingPoint,
        light: u32,
        arrival: &Arrival,
        scratch: &mut Scratch,
    ) -> Option<ShadowPath<'i>> {
        let ray = Ray::new(lit.at.point, arrival.to_light);
        let distance = arrival.distance;
        let query = shadow_query(self.world, lit.spawn_surface.copied(), ray, distance);
        let t_max = self.world.shadow_reach(&query, light, &mut scratch.query)?;
        Some(ShadowPath {
            light,
            query: Query { t_max, ..query },
            distance,
            known: None,
            inside: &lit.path.inside,
            collects: lit.collects,
            is_to_grid: false,
        })
    }

    /// Returns true if the media of the atmosphere attenuate a light.
    fn is_attenuated_by_media(&self, source: &Light) -> bool {
        self.features.has_media
            && !self.world.media.is_empty()
            && source.media_attenuation
            && source.media_interaction
    }

    /// Returns true if fog or media attenuate a light.
    pub(in crate::render::shade) fn is_attenuated_by_atmosphere(&self, light: u32) -> bool {
        let source = self.world.lights.get(light);
        let by_fog = source.media_attenuation && !self.world.fogs.is_empty();
        by_fog || self.is_attenuated_by_media(source)
    }

    /// The light that remains after everything along a shadow ray; to the grid of an area light without the atmosphere
    /// behind the last surface, of which the length is noted instead.
    pub(in crate::render::shade) fn transmittance(
        &self,
        mut arriving: Rgb,
        shadow_path: &ShadowPath,
        scratch: &mut Scratch,
    ) -> Rgb {
        let (query, light) = (&shadow_path.query, shadow_path.light);
        let occlusion = match shadow_path.known {
            // Packet queries do not record the transparent hits.
            Some(Occlusion::Transmissive) => {
                self.world
                    .gather_transmissive(query, light, &mut scratch.query)
            }
            Some(known) => known,
            None => self.world.occlusion(query, light, &mut scratch.query),
        };
        let length = shadow_path.distance;
        match occlusion {
            Occlusion::Clear => {
                shadow_path.note_segment(length, scratch);
                if shadow_path.is_to_grid {
                    return arriving;
                }
                let segment = ShadowSegment {
                    ray: &query.ray,
                    length,
                    inside: shadow_path.inside,
                    end: SegmentEnd::Light,
                };
                return self.through_atmosphere(arriving, light, &segment, scratch);
            }
            Occlusion::Opaque => {
                shadow_path.note_segment(length, scratch);
                return Rgb::BLACK;
            }
            Occlusion::Transmissive => {}
        }
        let is_attenuated = self.is_attenuated_by_atmosphere(light);
        if !(is_attenuated || self.features.has_media || !self.quality.has_transparency)
            && let Some(passed) = self.world.transmissive_hits(query, &mut scratch.query)
        {
            let mut surfaces = passed.iter().map(TransmissiveHit::surface);
            if shadow_path.collects && surfaces.any(|surface| self.replaces(surface, light)) {
                return Rgb::BLACK;
            }
            return self.through_uniform_surfaces(
                arriving,
                &query.ray,
                &passed,
                shadow_path.inside,
            );
        }
        let ray = query.ray;
        let mut query = *query;
        let mut inside = InteriorStack::from_slice(shadow_path.inside);
        let mut left = length;
        for _ in 0..MAX_STRAIGHT {
            let hit = self.world.next_transmissive_hit(&query, &mut scratch.query);
            let segment = ShadowSegment {
                ray: &query.ray,
                length: hit.as_ref().map_or(left, |hit| hit.t),
                inside: &inside,
                end: match hit {
                    Some(_) => SegmentEnd::Surface,
                    None => SegmentEnd::Light,
                },
            };
            let Some(hit) = hit else {
                // As in POV-Ray, interiors do not attenuate the last segment, which no surface ends.
                if shadow_path.is_to_grid {
                    return arriving;
                }
                return self.through_atmosphere(arriving, light, &segment, scratch);
            };
            arriving = self.through_atmosphere(arriving, light, &segment, scratch);
            if shadow_path.collects && self.replaces(hit.surface, light) {
                return Rgb::BLACK;
            }
            arriving *= self.interior_transmittance(&query.ray, hit.t, &inside, scratch);
            left -= hit.t;
            let interior = self.world.surfaces[hit.surface as usize].interior;
            arriving *= self.transmission(&hit, &ray) * self.fade(&inside, interior, hit.t);
            cross(&mut inside, interior, arriving);
            shadow_path.note_segment(left, scratch);
            if is_negligible(arriving) {
                return Rgb::BLACK;
            }
            query.ray.origin = hit.point;
            query.origin_surface = Some(hit.spawn_surface);
            query.t_max -= hit.t;
        }
        Rgb::BLACK
    }

    /// The light that remains behind the fog and the media of the atmosphere over a segment of a shadow ray.
    #[inline(always)]
    pub(in crate::render::shade) fn through_atmosphere(
        &self,
        arriving: Rgb,
        light: u32,
        segment: &ShadowSegment<'_>,
        scratch: &mut Scratch,
    ) -> Rgb {
        match self.is_attenuated_by_atmosphere(light) {
            true => self.attenuated(arriving, light, segment, scratch),
            false => arriving,
        }
    }

    /// The same for a light that is attenuated. Behind parallel light, where the length is negative, none is lost, nor
    /// is any of a light that is negative in all channels. In solids, media attenuate the segments that end at a surface.
    #[inline(never)]
    fn attenuated(
        &self,
        mut arriving: Rgb,
        light: u32,
        segment: &ShadowSegment<'_>,
        scratch: &mut Scratch,
    ) -> Rgb {
        let (ray, length) = (segment.ray, segment.length);
        if length <= 0.0 || !has_positive_channel(arriving) {
            return arriving;
        }
        let source = self.world.lights.get(light);
        if source.media_attenuation
            && let Some(fog) = self.fog(ray, length)
            && self.is_outside_solids(segment.inside)
        {
            arriving *= fog.factor;
        }
        if self.is_attenuated_by_media(source)
            && (segment.end == SegmentEnd::Surface || self.is_outside_solids(segment.inside))
        {
            arriving *= self.atmosphere_transmittance(ray, length, scratch);
        }
        arriving
    }

    /// The light that remains behind surfaces with a uniform transmittance each, apart from the angle.
    fn through_uniform_surfaces(
        &self,
        mut arriving: Rgb,
        ray: &Ray,
        passed: &TransmissiveHits,
        inside: &[InteriorId],
    ) -> Rgb {
        let mut inside = self
            .features
            .light_fades
            .then(|| InteriorStack::from_slice(inside));
        let mut from = 0.0;
        for passing in passed {
            let interior = self.world.surfaces[passing.surface() as usize].interior;
            let mut share = if self.world.interiors.get(interior).caustics == 0.0 {
                let even = self.world.uniform_transmittance(passing.surface());
                even.unwrap_or(Rgb::WHITE)
            } else {
                self.transmission(&self.world.hit_at(ray, passing), ray)
            };
            if let Some(inside) = &inside {
                share *= self.fade(inside, interior, passing.t() - from);
            }
            arriving *= share;
            if is_negligible(arriving) {
                return Rgb::BLACK;
            }
            if let Some(inside) = &mut inside {
                cross(inside, interior, arriving);
            }
            from = passing.t();
        }
        arriving
    }

    /// The attenuation of a segment of this length that ends at a surface of an interior.
    fn fade(&self, inside: &[InteriorId], interior: InteriorId, length: f64) -> Rgb {
        if inside.contains(&interior) {
            self.world.interiors.get(interior).shadow_ray_fade(length)
        } else {
            Rgb::WHITE
        }
    }
}

/// Updates the interior stack at a surface with this much light behind it. As in POV-Ray, light without a positive channel
/// enters and leaves no interior (docs/povray-facts.md, section 4.4).
fn cross(inside: &mut InteriorStack, interior: InteriorId, behind: Rgb) {
    if has_positive_channel(behind) {
        interior_stack::cross(inside, interior);
    }
}

fn has_positive_channel(light: Rgb) -> bool {
    light.r.max(light.g).max(light.b) > 0.0
}
