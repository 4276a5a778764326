//! A surface point to be lit, and the light samples that are known of it.

use super::Path;
use super::bsdf::ViewPoint;
use super::direct::block_hits::BlockHits;
use super::direct::shadow_cache::ShadowCache;
use crate::base::math::Ray;
use crate::scene::light::Arrival;
use crate::world::{Hit, Occlusion, Query, RayKind, ShadowPacket4, SpawnSurface, World};
use glam::DVec3;

/// A surface point to be lit.
pub(in crate::render::shade) struct ShadingPoint<'p> {
    pub(in crate::render::shade) at: ViewPoint,
    /// The surface that shadow rays leave; none in space.
    pub(in crate::render::shade) spawn_surface: Option<&'p SpawnSurface>,
    pub(in crate::render::shade) path: &'p Path,
    /// The light samples that are known already.
    pub(in crate::render::shade) known: LightSamples<'p>,
    /// The shadowed light cached by earlier layers and textures, if there are several.
    pub(in crate::render::shade) shadow_cache: Option<&'p ShadowCache>,
    pub(in crate::render::shade) is_double_illuminated: bool,
    /// The lights that shine on it.
    pub(in crate::render::shade) lights: &'p [u32],
    /// Photons replace the light that their targets would transmit to it.
    pub(in crate::render::shade) collects: bool,
}

/// Light from one light source at a hit, before the material is known.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::shade) struct LightSample {
    /// Its direction and distance.
    pub(in crate::render::shade) arrival: Arrival,
    /// The cosine between its direction and the normal on the viewer's side.
    pub(in crate::render::shade) cosine: f64,
    /// The share of its light that arrives if nothing occludes it.
    pub(in crate::render::shade) share: f64,
    /// The occlusion of its shadow ray, if traced.
    pub(in crate::render::shade) occlusion: Option<Occlusion>,
}

impl LightSample {
    /// No light.
    pub(in crate::render::shade) const NOTHING: LightSample = LightSample {
        arrival: Arrival {
            to_light: DVec3::ZERO,
            distance: 0.0,
        },
        cosine: 0.0,
        share: 0.0,
        occlusion: None,
    };

    /// The sample of one lane.
    pub(in crate::render::shade) fn of(shadow_rays: &ShadowPacket4, lane: usize) -> LightSample {
        let occlusion = shadow_rays.occlusion(lane);
        if occlusion.is_none() {
            return LightSample::NOTHING;
        }
        LightSample {
            arrival: Arrival {
                to_light: shadow_rays.to_light(lane),
                distance: shadow_rays.distance[lane],
            },
            cosine: shadow_rays.cosine[lane],
            share: shadow_rays.share[lane],
            occlusion,
        }
    }

    /// The shadow ray.
    #[inline]
    pub(in crate::render::shade) fn shadow_query(&self, world: &World, hit: &Hit) -> Query {
        let ray = Ray::new(hit.point, self.arrival.to_light);
        shadow_query(world, Some(hit.spawn_surface), ray, self.arrival.distance)
    }
}

/// The light samples of a hit that was lit in a block.
///
/// An area light is clear if all of its light arrives; otherwise it counts as transmissive, and is still to be sampled.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct LightSamples<'a>(Option<(&'a BlockHits, usize)>);

impl<'a> LightSamples<'a> {
    /// No samples.
    pub(in crate::render::shade) const NONE: LightSamples<'static> = LightSamples(None);

    /// The samples of a hit with this index.
    pub(in crate::render::shade) fn at(all: &'a BlockHits, index: usize) -> Self {
        LightSamples(Some((all, index)))
    }

    /// True if the shadow rays of all point lights are traced.
    #[inline]
    pub(in crate::render::shade) fn are_complete(self) -> bool {
        self.0.is_some_and(|(all, _)| all.has_occlusion)
    }

    /// The sample of a light, if the shadow rays are traced.
    #[inline]
    pub(in crate::render::shade) fn of(self, light: u32) -> Option<LightSample> {
        let (all, index) = self.0.filter(|(all, _)| all.has_occlusion)?;
        let shadow_rays = all
            .shadow_rays
            .get(light as usize * all.hits.len() + index / 4)?;
        Some(LightSample::of(shadow_rays, index % 4))
    }

    /// The occlusion of a light, if known.
    #[inline]
    pub(in crate::render::shade) fn occlusion(self, light: u32) -> Option<Occlusion> {
        let (all, index) = self.0?;
        let shadow_rays = all
            .shadow_rays
            .get(light as usize * all.hits.len() + index / 4)?;
        let occlusion = shadow_rays.occlusion(index % 4);
        occlusion.filter(|&occlusion| all.has_occlusion || occlusion == Occlusion::Clear)
    }

    /// Returns true if a transparent surface lies before any light, or it is an area light still to be sampled.
    pub(in crate::render::shade) fn any_is_filtered(self) -> bool {
        let samples = self.0.filter(|(all, _)| all.has_occlusion);
        samples.is_some_and(|(all, index)| {
            let shadow_rays = all.shadow_rays.chunks(all.hits.len());
            let mut shadow_rays =
                shadow_rays.map(|shadow_rays| shadow_rays[index / 4].occlusion(index % 4));
            shadow_rays.any(|occlusion| occlusion == Some(Occlusion::Transmissive))
        })
    }
}

/// The occlusion query between a point and a light.
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
