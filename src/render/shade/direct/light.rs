//! Direct light at a shading point: diffuse light and highlights. Shadows are computed in [`super::transmittance`].

use super::area::AreaLight;
use super::block::BlockHits;
use super::shadow_cache::ShadowCache;
use super::transmittance::shadow_query;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use crate::base::math::sampling::hash;
use crate::render::shade::Scratch;
use crate::render::shade::surface::facing_normal;
use crate::render::shade::{Path, Tracer};
use crate::scene::light::Arrival;
use crate::scene::texture::Finish;
use crate::world::{Hit, Occlusion, Query, ShadowPacket4, SpawnSurface, Surface, World};
use glam::DVec3;
use std::f64::consts::FRAC_2_PI;

/// Below this a colour counts as no light, and the cosine of light as grazing; POV-Ray's value.
pub(in crate::render::shade) const NEGLIGIBLE: f64 = 1e-10;
/// From this `phong_size` on, small highlights are cut off.
const SMALL_PHONG: f32 = 60.0;
/// The cosine at which they are cut off.
const PHONG_CUT: f64 = 0.0008;

/// A surface point with its view direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct ViewPoint {
    pub(in crate::render::shade) point: DVec3,
    /// The unit normal on the viewer's side.
    pub(in crate::render::shade) normal: DVec3,
    /// The unit direction from the viewer.
    pub(in crate::render::shade) view: DVec3,
}

impl ViewPoint {
    /// The point that a ray of this direction hits.
    #[inline]
    pub(in crate::render::shade) fn new(hit: &Hit, dir: DVec3) -> ViewPoint {
        ViewPoint {
            point: hit.point,
            normal: facing_normal(hit, dir),
            view: dir,
        }
    }
}

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
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct LightSamples<'a>(Option<(&'a BlockHits, usize)>);

impl<'a> LightSamples<'a> {
    /// No samples.
    pub(in crate::render::shade) const NONE: LightSamples<'static> = LightSamples(None);

    /// The samples of a hit with this index.
    pub(in crate::render::shade) fn at(all: &'a BlockHits, index: usize) -> Self {
        LightSamples(all.has_occlusion.then_some((all, index)))
    }

    /// The sample of a light, if there are samples.
    #[inline]
    pub(in crate::render::shade) fn of(self, light: u32) -> Option<LightSample> {
        let (all, index) = self.0?;
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
        shadow_rays.occlusion(index % 4)
    }

    /// Reports if a transparent surface lies before any light.
    pub(in crate::render::shade) fn any_is_filtered(self) -> bool {
        self.0.is_some_and(|(all, index)| {
            let shadow_rays = all.shadow_rays.chunks(all.hits.len());
            let mut shadow_rays =
                shadow_rays.map(|shadow_rays| shadow_rays[index / 4].occlusion(index % 4));
            shadow_rays.any(|occlusion| occlusion == Some(Occlusion::Transmissive))
        })
    }
}

/// The reflective properties of a layer at a point.
pub(in crate::render::shade) struct LayerBsdf<'f> {
    pub(in crate::render::shade) finish: &'f Finish,
    pub(in crate::render::shade) rgb: Rgb,
    /// The share of light that does not pass the layer.
    pub(in crate::render::shade) opacity: f64,
}

/// The side of a layer that receives light from one direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct Side {
    diffuse: f32,
    pub(in crate::render::shade) is_in_front: bool,
    /// The cosine between the normal and the direction to the light.
    cosine: f64,
}

/// Light that arrives at a layer from one direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct LightContribution {
    /// The unit direction to the light.
    pub(in crate::render::shade) to_light: DVec3,
    pub(in crate::render::shade) side: Side,
    /// The light after shadows.
    pub(in crate::render::shade) arriving: Rgb,
    pub(in crate::render::shade) has_highlights: bool,
}

impl LayerBsdf<'_> {
    /// The side lit by light at this cosine to the normal; `None` if the layer receives none from there.
    #[inline]
    pub(in crate::render::shade) fn side(
        &self,
        cosine: f64,
        is_double_illuminated: bool,
    ) -> Option<Side> {
        let (diffuse, is_in_front) = if cosine >= NEGLIGIBLE || is_double_illuminated {
            (self.finish.diffuse, true)
        } else if self.finish.diffuse_back != 0.0 {
            (self.finish.diffuse_back, false)
        } else {
            return None;
        };
        Some(Side {
            diffuse,
            is_in_front,
            cosine,
        })
    }
}

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
            || !(faces(surface, cosine) || surface.is_bumpy() && cosine > MOST_TILTED)
            || !lights.of(surface.lights).contains(&number)
        {
            return LightSample::NOTHING;
        }
        LightSample {
            arrival,
            cosine,
            share: light.share(hit.point, &arrival),
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
            && area.is_full
            && self.samples_areas(lit.path)
        {
            let area_light = AreaLight::new(number, light, area, lit, light.color);
            return self.illuminate_by_grid(area_light, bsdf, scratch);
        }
        let cosine = lit.at.normal.dot(arrival.to_light);
        let Some(side) = bsdf.side(cosine, lit.is_double_illuminated) else {
            return Rgb::BLACK;
        };
        let share = known.map_or_else(|| light.share(lit.at.point, &arrival), |known| known.share);
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

    /// Reports if area lights are sampled for a ray; otherwise they are points.
    fn samples_areas(&self, path: &Path) -> bool {
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
            if finish.crand > 0.0 {
                strength -= grain(scratch) * f64::from(finish.crand);
            }
            sum += bsdf.rgb * arriving * strength;
        }
        if has_highlights {
            let strength = highlight(finish, at, to_light);
            if strength != 0.0 {
                let shine = metallic(finish.metallic, bsdf.rgb, cosine);
                sum += arriving * shine * strength;
            }
        }
        if finish.irid.amount > 0.0 {
            sum *= self.film(&finish.irid, at, to_light);
        }
        sum
    }
}

/// The next random number of `crand`, from 0 to 1.
fn grain(scratch: &mut Scratch) -> f64 {
    scratch.random.crand = hash::next(scratch.random.crand);
    f64::from(scratch.random.crand) / f64::from(u32::MAX)
}

/// Lights farther behind a surface are hardly ever faced after bump mapping.
pub(in crate::render::shade) const MOST_TILTED: f64 = -0.5;

/// Reports if light at this cosine to the normal can light a surface.
#[inline]
pub(in crate::render::shade) fn faces(surface: &Surface, cosine: f64) -> bool {
    cosine >= NEGLIGIBLE || surface.is_lit_from_behind()
}

#[inline]
pub(in crate::render::shade) fn is_negligible(light: Rgb) -> bool {
    let is_small = |c: f32| f64::from(c).abs() < NEGLIGIBLE;
    is_small(light.r) && is_small(light.g) && is_small(light.b)
}

/// The highlights of light from one direction.
#[inline]
pub(in crate::render::shade) fn highlight(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    phong(finish, at, to_light) + specular(finish, at, to_light)
}

/// Phong's highlight: the cosine between the reflected view direction and the light.
#[inline]
fn phong(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    if finish.phong == 0.0 {
        return 0.0;
    }
    let cosine = mirrored(at.view, at.normal).dot(to_light);
    let is_lit = cosine > 0.0 && (finish.phong_size < SMALL_PHONG || cosine > PHONG_CUT);
    if is_lit {
        f64::from(finish.phong) * exact_power(cosine, f64::from(finish.phong_size))
    } else {
        0.0
    }
}

/// Blinn's highlight: the cosine between the normal and the half vector.
#[inline]
fn specular(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    if finish.specular == 0.0 {
        return 0.0;
    }
    let half_vector = 0.5 * (to_light - at.view);
    let cosine = half_vector.dot(at.normal) / half_vector.length();
    if cosine > 0.0 {
        f64::from(finish.specular) * exact_power(cosine, f64::from(finish.shininess))
    } else {
        0.0
    }
}

/// The mirror image of a direction.
pub(in crate::render::shade) fn mirrored(dir: DVec3, normal: DVec3) -> DVec3 {
    dir - 2.0 * dir.dot(normal) * normal
}

/// The tint that a `metallic` of strength `m` gives to light at an angle of this cosine: less of the pigment's colour
/// the more grazing.
pub(in crate::render::shade) fn metallic(m: f32, pigment: Rgb, cosine: f64) -> Rgb {
    if m == 0.0 {
        return Rgb::WHITE;
    }
    let x = cosine.clamp(-1.0, 1.0).acos() * FRAC_2_PI;
    let fresnel = (0.014_567_225 / (x - 1.12).powi(2) - 0.011_612_903).clamp(0.0, 1.0);
    Rgb::WHITE + (pigment - Rgb::WHITE) * (f64::from(m) * (1.0 - fresnel))
}
