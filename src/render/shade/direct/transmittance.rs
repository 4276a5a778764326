//! The way of light from its source to a point: what lies on it, and what is left of light behind that.

use super::light::{ShadingPoint, is_nothing};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::render::shade::{Inside, MOST_PASSED, Tracer, interior_stack};
use crate::scene::light::{Arrival, Light};
use crate::world::{
    InteriorId, Occlusion, Query, RayKind, Scratch, SpawnSurface, TransmissiveHit,
    TransmissiveHits, World,
};

/// A way from a point to a light, and what is known of it.
pub(in crate::render::shade) struct ShadowPath<'i> {
    /// The number of the light.
    pub(in crate::render::shade) light: u32,
    /// The question what lies on it.
    pub(in crate::render::shade) query: Query,
    pub(in crate::render::shade) distance: f64,
    /// What lies on it, if that was asked before.
    pub(in crate::render::shade) known: Option<Occlusion>,
    /// The interiors that the point is in.
    pub(in crate::render::shade) inside: &'i [InteriorId],
    /// Whether photons stand for light that targets would let through to it.
    pub(in crate::render::shade) collects: bool,
}

impl Tracer<'_> {
    /// What is left of light after all that stands between a point and its source.
    pub(in crate::render::shade) fn through_shadows(
        &self,
        arriving: Rgb,
        lit: &ShadingPoint,
        light: u32,
        arrival: &Arrival,
        scratch: &mut Scratch,
    ) -> Rgb {
        let known = lit.known.way(light);
        match known {
            Some(Occlusion::Opaque) => return Rgb::BLACK,
            Some(Occlusion::Clear) if !self.minds_air(light) => return arriving,
            _ => {}
        }
        let ray = Ray::new(lit.at.point, arrival.to_light);
        let distance = arrival.distance;
        let mut query = shadow_query(self.world, lit.departure.copied(), ray, distance);
        let Some(far) = self.world.shadow_reach(&query, light, scratch) else {
            return Rgb::BLACK;
        };
        query.t_max = far;
        let source = self.world.lights.get(light);
        if source.is_shadowless() {
            return arriving;
        }
        let way = ShadowPath {
            light,
            query,
            distance,
            known,
            inside: &lit.path.inside,
            collects: lit.collects,
        };
        self.transmittance(arriving, &way, scratch)
    }

    /// Whether the media of the atmosphere take something of the light of a source.
    fn is_dimmed_by_media(&self, source: &Light) -> bool {
        self.has_media
            && !self.world.media.is_empty()
            && source.media_attenuation
            && source.media_interaction
    }

    /// Whether the air takes something of the light of this number.
    fn minds_air(&self, light: u32) -> bool {
        let source = self.world.lights.get(light);
        let by_fog = source.media_attenuation && !self.world.fogs.is_empty();
        by_fog || self.is_dimmed_by_media(source)
    }

    /// What is left of light behind all that lies on its way.
    pub(in crate::render::shade) fn transmittance(
        &self,
        mut arriving: Rgb,
        way: &ShadowPath,
        scratch: &mut Scratch,
    ) -> Rgb {
        let (query, light) = (&way.query, way.light);
        let source = self.world.lights.get(light);
        let by_air = self.is_dimmed_by_media(source);
        let minds_air = self.minds_air(light);
        match way
            .known
            .unwrap_or_else(|| self.world.way(query, light, scratch))
        {
            Occlusion::Clear if !minds_air => return arriving,
            Occlusion::Opaque => return Rgb::BLACK,
            // What was asked for many rays at once was not gathered.
            Occlusion::Clear | Occlusion::Transmissive if way.known.is_some() => {
                let way = self.world.occlusion_unrecorded(query, light, scratch);
                if way == Occlusion::Opaque {
                    return Rgb::BLACK;
                }
            }
            Occlusion::Clear | Occlusion::Transmissive => {}
        }
        if !(minds_air || self.has_media || !self.quality.has_transparency)
            && let Some(passed) = self.world.transmissive_hits(query, scratch)
        {
            let mut surfaces = passed.iter().map(TransmissiveHit::surface);
            if way.collects && surfaces.any(|surface| self.replaces(surface, light)) {
                return Rgb::BLACK;
            }
            return self.through_all(arriving, &query.ray, &passed, way.inside);
        }
        let ray = query.ray;
        let mut query = *query;
        let mut inside = Inside::from_slice(way.inside);
        let mut left = way.distance;
        for _ in 0..MOST_PASSED {
            let hit = self.world.next_transmissive_hit(&query, scratch);
            if minds_air {
                let length = hit.map_or(left, |hit| hit.t);
                if source.media_attenuation
                    && let Some(fog) = self.fog(&query.ray, length)
                    && self.is_in_air(&inside)
                {
                    arriving *= fog.factor;
                }
            }
            if by_air {
                let length = hit.map_or(left, |hit| hit.t);
                arriving *= self.dimmed_by_air(&query.ray, length, &inside, scratch);
            }
            let Some(hit) = hit else {
                // As in POV-Ray interiors take no light from where nothing ends them.
                return arriving;
            };
            if way.collects && self.replaces(hit.surface, light) {
                return Rgb::BLACK;
            }
            arriving *= self.dimmed_inside(&query.ray, hit.t, &inside, scratch);
            left -= hit.t;
            let interior = self.world.surfaces[hit.surface as usize].interior;
            arriving *= self.transmission(&hit, &ray) * self.fade(&mut inside, interior, hit.t);
            if is_nothing(arriving) {
                return Rgb::BLACK;
            }
            query.ray.origin = hit.point;
            query.origin_surface = Some(hit.departure);
            query.t_max -= hit.t;
        }
        Rgb::BLACK
    }

    /// What is left of light behind surfaces each of which lets the same share through everywhere, but for the angle.
    fn through_all(
        &self,
        mut arriving: Rgb,
        ray: &Ray,
        passed: &TransmissiveHits,
        inside: &[InteriorId],
    ) -> Rgb {
        let mut inside = self.light_fades.then(|| Inside::from_slice(inside));
        let mut from = 0.0;
        for passing in passed {
            let interior = self.world.surfaces[passing.surface() as usize].interior;
            let mut share = if self.world.interiors.get(interior).caustics == 0.0 {
                let even = self.world.even_filter(passing.surface());
                even.unwrap_or(Rgb::WHITE)
            } else {
                self.transmission(&self.world.hit_at(ray, passing), ray)
            };
            if let Some(inside) = &mut inside {
                share *= self.fade(inside, interior, passing.t() - from);
            }
            arriving *= share;
            if is_nothing(arriving) {
                return Rgb::BLACK;
            }
            from = passing.t();
        }
        arriving
    }

    /// The fading of light along a segment of this length that ends at the surface of an interior, which changes what the
    /// light is inside of.
    fn fade(&self, inside: &mut Inside, interior: InteriorId, length: f64) -> Rgb {
        if interior_stack::cross(inside, interior) {
            self.world.interiors.get(interior).fade_on_light(length)
        } else {
            Rgb::WHITE
        }
    }
}

/// The question what lies between a point and a light.
#[inline]
pub(in crate::render::shade) fn shadow_query(
    world: &World,
    from: Option<SpawnSurface>,
    ray: Ray,
    distance: f64,
) -> Query {
    Query {
        ray,
        origin_surface: from,
        t_max: world.shadow_t_max(ray.at(distance), distance),
        kind: RayKind::Shadow,
    }
}
