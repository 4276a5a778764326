//! The fast path of shading: one opaque layer without reflection, lit by point lights. Most pixels of most pictures are
//! that.
//!
//! It is the general path ([`Tracer::trace`]) without the terms that are zero here: the sums are the same, in the same
//! order. Where a shadow ray passes something transparent, both call the same transmittance.

use super::light::{
    LayerBsdf, LightContribution, LightSample, LightSamples, ViewPoint, is_nothing,
};
use crate::base::color::Rgb;
use crate::render::shade::surface::spot;
use crate::render::shade::{Quality, Sample, Tracer};
use crate::world::{Hit, Occlusion, Scratch, Surface, World};
use glam::DVec3;

/// Light of a lamp that arrives.
struct DirectLight {
    number: u32,
    to_light: DVec3,
    /// The cosine between its direction and the normal on the side of the viewer.
    cosine: f64,
    /// The share of the light that arrives.
    share: f64,
}

/// Whether plain surfaces of a world may be coloured the short way.
pub(in crate::render::shade) fn suits(world: &World, quality: Quality) -> bool {
    let globals = &world.globals;
    let is_simple = |number: u32| {
        let light = world.lights.get(number);
        let is_point = light.area.is_none() && !light.is_parallel;
        is_point && !light.is_shadowless() && !world.lights.is_projected(number)
    };
    let mut lights = (0u32..).take(world.lights.len());
    quality == Quality::FULL
        && globals.max_trace_level > 0
        && (0.0..=1.0).contains(&globals.adc_bailout)
        && (world.has_clear_air() || dims_rays_alone(world))
        && lights.all(is_simple)
}

/// Whether fog and rainbows change what rays see and not what light arrives, and take no random numbers.
fn dims_rays_alone(world: &World) -> bool {
    let mut lights = world.lights.iter();
    !world.uses_random() && !lights.any(|light| light.media_attenuation)
}

impl Tracer<'_> {
    /// What light that nothing stops gives to a layer.
    #[inline(always)]
    fn plain_light(
        &self,
        lit: &DirectLight,
        surface: &Surface,
        at: &ViewPoint,
        coat: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let Some(side) = coat.side(lit.cosine, surface.is_double_illuminated()) else {
            return Rgb::BLACK;
        };
        let arriving = self.world.lights.get(lit.number).color * lit.share;
        if is_nothing(arriving) {
            return Rgb::BLACK;
        }
        let shining = LightContribution {
            to_light: lit.to_light,
            side,
            arriving,
            has_highlights: side.is_in_front,
        };
        self.add_contribution(&shining, at, coat, scratch)
    }

    /// What a ray in this direction sees at a hit, if that is plain. Of each light either what can be known is known, or
    /// nothing is.
    #[inline]
    pub(in crate::render::shade) fn plain(
        &self,
        hit: &Hit,
        dir: DVec3,
        known: LightSamples,
        scratch: &mut Scratch,
    ) -> Option<Sample> {
        let surface = &self.world.surfaces[hit.surface as usize];
        if !self.takes_plain || !surface.is_plain() || known.any_is_filtered() {
            return None;
        }
        let layer = surface.texture.layers().first()?;
        let color = layer.pigment.color(&spot(hit, dir));
        let (own, coat) = self.coat(layer, color);
        let at = ViewPoint::new(hit, dir);
        let mut sum = Rgb::BLACK;
        for &number in self.world.lights.of(surface.lights) {
            let known = known.of(number);
            let known = known.unwrap_or_else(|| self.find_out(number, hit, &at, scratch));
            match known.way {
                Some(Occlusion::Clear) => {}
                Some(Occlusion::Transmissive) => return None,
                Some(Occlusion::Opaque) | None => continue,
            }
            let lit = DirectLight {
                number,
                to_light: known.arrival.to_light,
                cosine: known.cosine,
                share: known.share,
            };
            sum += self.plain_light(&lit, surface, &at, &coat, scratch);
        }
        Some(Sample {
            rgb: Rgb::BLACK + (own + sum),
            transmit: 0.0,
        })
    }

    /// What can be known of a light at a point.
    fn find_out(
        &self,
        number: u32,
        hit: &Hit,
        at: &ViewPoint,
        scratch: &mut Scratch,
    ) -> LightSample {
        let mut known = self.light_at(number, hit, at.normal);
        if known.share != 0.0 {
            let query = known.shadow_query(self.world, hit);
            known.way = Some(self.world.way(&query, number, scratch));
        }
        known
    }
}
