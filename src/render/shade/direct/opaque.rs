//! The fast path of shading: one opaque layer without reflection, lit by point lights and by area lights that nothing
//! covers. Most pixels of most pictures need no more.
//!
//! It is the general path ([`Tracer::trace`]) without the terms that are zero here: the sums are the same, in the same
//! order. Where a shadow ray passes something transparent, both call the same transmittance.

use super::area::skip_clear;
use crate::base::color::Rgb;
use crate::render::shade::Scratch;
use crate::render::shade::bsdf::{LayerBsdf, LightContribution, ViewPoint, is_negligible};
use crate::render::shade::shading_point::{LightSample, LightSamples};
use crate::render::shade::surface::surface_point;
use crate::render::shade::{Quality, Sample, Tracer};
use crate::world::{Hit, Occlusion, Surface, World};
use glam::DVec3;

/// Unoccluded light from one light source.
struct DirectLight {
    number: u32,
    to_light: DVec3,
    /// The cosine between its direction and the normal on the viewer's side.
    cosine: f64,
    /// The share of the light that arrives.
    share: f64,
}

/// Returns true if plain surfaces of a world may be shaded by the fast path.
pub(in crate::render::shade) fn supports(world: &World, quality: Quality) -> bool {
    let globals = &world.globals;
    let is_simple = |number: u32| {
        let light = world.lights.get(number);
        let area = light.area.as_ref();
        area.is_none_or(|area| !area.has_area_illumination)
            && !light.is_parallel
            && !light.is_shadowless()
            && !world.lights.is_projected(number)
    };
    let mut lights = (0u32..).take(world.lights.len());
    quality == Quality::FULL
        && globals.max_trace_level > 0
        && (0.0..=1.0).contains(&globals.adc_bailout)
        && (world.has_clear_atmosphere() || atmosphere_affects_rays_only(world))
        && lights.all(is_simple)
}

/// Returns true if fog and rainbows attenuate camera and secondary rays but no shadow rays, and draw no random numbers.
fn atmosphere_affects_rays_only(world: &World) -> bool {
    let mut lights = world.lights.iter();
    !world.uses_random() && !lights.any(|light| light.media_attenuation)
}

impl Tracer<'_> {
    /// Direct light of a layer from an unoccluded light source.
    #[inline(always)]
    fn plain_light(
        &self,
        lit: &DirectLight,
        surface: &Surface,
        at: &ViewPoint,
        bsdf: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let Some(side) = bsdf.side(lit.cosine, surface.is_double_illuminated()) else {
            return Rgb::BLACK;
        };
        let arriving = self.world.lights.get(lit.number).color * lit.share;
        if is_negligible(arriving) {
            return Rgb::BLACK;
        }
        let contribution = LightContribution {
            to_light: lit.to_light,
            side,
            arriving,
            has_highlights: side.is_in_front,
        };
        self.add_contribution(&contribution, at, bsdf, scratch)
    }

    /// Shades a hit seen in this direction, if it is plain and the samples of area lights, where there are such, are
    /// complete.
    #[inline]
    pub(in crate::render::shade) fn shade_plain(
        &self,
        hit: &Hit,
        dir: DVec3,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let surface = &self.world.surfaces[hit.surface as usize];
        let is_lit = !self.features.has_area_lights || known.are_complete();
        if !(self.fast_paths.packets && surface.is_plain() && is_lit) || known.any_is_filtered() {
            return None;
        }
        let layer = surface.texture.layers().first()?;
        let color = layer.pigment.color(&surface_point(hit, dir));
        let (own, bsdf) = self.layer_bsdf(layer, color);
        let at = ViewPoint::new(hit, dir);
        let mut sum = Rgb::BLACK;
        for &number in self.world.lights.of(surface.lights) {
            let known = known.of(number);
            let known = known.unwrap_or_else(|| self.sample_light(number, hit, &at, scratch));
            match known.occlusion {
                Some(Occlusion::Clear) => {
                    if let Some(area) = &self.world.lights.get(number).area {
                        skip_clear(area, scratch);
                    }
                }
                Some(Occlusion::Transmissive) => return None,
                Some(Occlusion::Opaque) | None => continue,
            }
            let lit = DirectLight {
                number,
                to_light: known.arrival.to_light,
                cosine: known.cosine,
                share: known.share,
            };
            sum += self.plain_light(&lit, surface, &at, &bsdf, scratch);
        }
        Some(Sample {
            rgb: Rgb::BLACK + (own + sum),
            transmit: 0.0,
        })
    }

    /// Samples a light at a point, with its occlusion.
    fn sample_light(
        &self,
        number: u32,
        hit: &Hit,
        at: &ViewPoint,
        scratch: &mut Scratch,
    ) -> LightSample {
        let mut known = self.light_at(number, hit, at.normal);
        if known.share != 0.0 {
            let query = known.shadow_query(self.world, hit);
            known.occlusion = Some(self.world.occlusion(&query, number, &mut scratch.query));
        }
        known
    }
}
