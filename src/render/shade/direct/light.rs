//! Direct light at a shading point: diffuse light and highlights. Shadows are computed in [`super::transmittance`].

use super::area::{AreaLight, skip_clear};
use crate::base::color::Rgb;
use crate::base::math::powers::exact_power;
use crate::base::math::sampling::hash;
use crate::render::shade::bsdf::{
    LayerBsdf, LightContribution, MAX_TILTED, NEGLIGIBLE, ViewPoint, half_cosine, is_negligible,
};
use crate::render::shade::shading_point::{LightSample, ShadingPoint};
use crate::render::shade::{Path, Scratch, Tracer};
use crate::scene::light::Arrival;
use crate::world::{Hit, Occlusion, Surface};
use glam::DVec3;

impl Tracer<'_> {
    /// Direct light of a layer from all lights.
    pub(in crate::render::shade) fn illuminate(
        &self,
        lit: &ShadingPoint,
        bsdf: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let mut sum = Rgb::BLACK;
        if !bsdf.finish.takes_light() {
            return sum;
        }
        for &light in lit.lights {
            sum += self.light_from(light, lit, bsdf, scratch);
        }
        sum
    }

    /// Samples a light at a hit without its occlusion. The share is zero if the surface receives none of it.
    #[inline]
    pub(in crate::render::shade) fn light_at(
        &self,
        number: u32,
        hit: &Hit,
        normal: DVec3,
    ) -> LightSample {
        let surface = &self.world.surfaces[hit.surface as usize];
        let lights = &self.world.lights;
        let light = lights.get(number);
        let arrival = light.arrival(hit.point);
        let cosine = normal.dot(arrival.to_light);
        if !surface.takes_light()
            || !(faces(surface, cosine) || surface.is_bumpy() && cosine > MAX_TILTED)
            || !lights.of(surface.lights).contains(&number)
        {
            return LightSample::NOTHING;
        }
        LightSample {
            arrival,
            cosine,
            share: light.attenuation(hit.point, &arrival),
            occlusion: None,
        }
    }

    /// Direct light of a layer from one light.
    fn light_from(
        &self,
        number: u32,
        lit: &ShadingPoint,
        bsdf: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let light = self.world.lights.get(number);
        let is_point = light.area.is_none() && !light.is_parallel;
        let known = lit.known.of(number);
        let known = known.filter(|known| is_point && known.occlusion.is_some());
        let arrival = known.map_or_else(|| light.arrival(lit.at.point), |known| known.arrival);
        if let Some(area) = &light.area
            && area.has_area_illumination
            && self.samples_areas(lit.path)
        {
            let area_light = AreaLight::new(number, light, area, lit, light.color);
            return self.illuminate_by_grid(area_light, bsdf, scratch);
        }
        let cosine = lit.at.normal.dot(arrival.to_light);
        let Some(side) = bsdf.side(cosine, lit.is_double_illuminated) else {
            return Rgb::BLACK;
        };
        let share = known.map_or_else(
            || light.attenuation(lit.at.point, &arrival),
            |known| known.share,
        );
        let mut arriving = light.color * share;
        if is_negligible(arriving) {
            return Rgb::BLACK;
        }
        if self.quality.has_shadows {
            let known = lit
                .shadow_cache
                .and_then(|shadow_cache| shadow_cache.of(number));
            arriving = known.unwrap_or_else(|| {
                let left = self.shadowed_light(arriving, number, lit, &arrival, scratch);
                if let Some(shadow_cache) = lit.shadow_cache {
                    shadow_cache.keep(number, left);
                }
                left
            });
            if is_negligible(arriving) {
                return Rgb::BLACK;
            }
        }
        let contribution = LightContribution {
            to_light: arrival.to_light,
            side,
            arriving,
            has_highlights: side.is_in_front
                && !light.is_shadowless()
                && lit.path.irradiance_depth == 0,
        };
        self.add_contribution(&contribution, &lit.at, bsdf, scratch)
    }

    /// Returns true if area lights are sampled for a ray; otherwise they are points.
    pub(in crate::render::shade) fn samples_areas(&self, path: &Path) -> bool {
        self.quality.has_area_lights && path.irradiance_depth == 0
    }

    /// The light that remains after shadows, for point and area lights.
    pub(in crate::render::shade) fn shadowed_light(
        &self,
        arriving: Rgb,
        number: u32,
        lit: &ShadingPoint,
        arrival: &Arrival,
        scratch: &mut Scratch,
    ) -> Rgb {
        let light = self.world.lights.get(number);
        if light.is_shadowless() && !self.world.lights.is_projected(number) {
            return arriving;
        }
        match &light.area {
            Some(area) if self.samples_areas(lit.path) => {
                if lit.known.occlusion(number) == Some(Occlusion::Clear) {
                    skip_clear(area, scratch);
                    return arriving;
                }
                let mut area_light = AreaLight::new(number, light, area, lit, arriving);
                self.shadowed_area_light(&mut area_light, scratch)
            }
            _ => self.shadowed_point_light(arriving, lit, number, arrival, scratch),
        }
    }

    /// The light that a layer scatters of light from one direction.
    #[inline]
    pub(in crate::render::shade) fn add_contribution(
        &self,
        contribution: &LightContribution,
        at: &ViewPoint,
        bsdf: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let sum = self.scattered_below_film(contribution, at, bsdf, scratch);
        let irid = &bsdf.finish.irid;
        if irid.amount > 0.0 {
            sum * self.film(irid, at, contribution.to_light)
        } else {
            sum
        }
    }

    /// The same without the factor of `irid`.
    #[inline]
    pub(in crate::render::shade) fn scattered_below_film(
        &self,
        contribution: &LightContribution,
        at: &ViewPoint,
        bsdf: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let finish = bsdf.finish;
        let LightContribution {
            to_light,
            side,
            arriving,
            has_highlights,
        } = *contribution;
        let cosine = side.cosine.abs();
        let mut sum = Rgb::BLACK;
        if side.diffuse != 0.0 {
            let mut strength = f64::from(side.diffuse)
                * bsdf.opacity
                * exact_power(cosine, f64::from(finish.brilliance));
            if finish.fresnel != 0.0 {
                strength *= bsdf.entering(cosine) * bsdf.entering(-at.view.dot(at.normal));
            }
            if finish.crand > 0.0 {
                strength -= grain(scratch) * f64::from(finish.crand);
            }
            sum += bsdf.rgb * arriving * strength;
        }
        if has_highlights {
            let highlight = bsdf.highlight(at, to_light);
            if highlight.strength != 0.0 {
                let half_cosine = || half_cosine(at, to_light);
                sum += highlight.tinted(finish, bsdf.rgb, arriving, cosine, half_cosine);
            }
        }
        sum
    }
}

/// The next random number of `crand`, from 0 to 1.
fn grain(scratch: &mut Scratch) -> f64 {
    scratch.random.crand = hash::next(scratch.random.crand);
    f64::from(scratch.random.crand) / f64::from(u32::MAX)
}

/// Returns true if light at this cosine to the normal can light a surface.
#[inline]
pub(in crate::render::shade) fn faces(surface: &Surface, cosine: f64) -> bool {
    cosine >= NEGLIGIBLE || surface.is_lit_from_behind()
}
