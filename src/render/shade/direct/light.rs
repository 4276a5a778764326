//! Direct light at a shading point: diffuse light and highlights. Shadows are computed in [`super::transmittance`].

use super::area::Lamps;
use super::block::BlockHits;
use super::shadow_cache::ShadowCache;
use super::transmittance::shadow_query;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::powers::exact_power;
use crate::base::math::sampling::hash;
use crate::render::shade::surface::facing_normal;
use crate::render::shade::{Path, Tracer};
use crate::scene::light::Arrival;
use crate::scene::texture::Finish;
use crate::world::{Hit, Occlusion, Query, Scratch, ShadowPacket4, SpawnSurface, Surface, World};
use glam::DVec3;
use std::f64::consts::FRAC_2_PI;

/// Below this a colour counts as no light, and the cosine of light as grazing; POV-Ray's value.
pub(in crate::render::shade) const NOTHING: f64 = 1e-10;
/// From this `phong_size` on, small highlights are cut off.
const SMALL_PHONG: f32 = 60.0;
/// The cosine at which they are cut off.
const PHONG_CUT: f64 = 0.0008;

/// A point of a surface, as it is viewed.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct ViewPoint {
    pub(in crate::render::shade) point: DVec3,
    /// The unit normal on the side of the viewer.
    pub(in crate::render::shade) normal: DVec3,
    /// The unit direction from the viewer.
    pub(in crate::render::shade) view: DVec3,
}

impl ViewPoint {
    /// What a ray of this direction meets.
    #[inline]
    pub(in crate::render::shade) fn new(hit: &Hit, dir: DVec3) -> ViewPoint {
        ViewPoint {
            point: hit.point,
            normal: facing_normal(hit, dir),
            view: dir,
        }
    }
}

/// A point of a surface, as light finds it.
pub(in crate::render::shade) struct ShadingPoint<'p> {
    pub(in crate::render::shade) at: ViewPoint,
    /// The root that rays from here leave; none in the middle of space.
    pub(in crate::render::shade) departure: Option<&'p SpawnSurface>,
    pub(in crate::render::shade) path: &'p Path,
    /// What is known of the lights.
    pub(in crate::render::shade) known: LightSamples<'p>,
    /// What shadows have left for layers and textures drawn before, where there is more than one.
    pub(in crate::render::shade) arrived: Option<&'p ShadowCache>,
    pub(in crate::render::shade) is_double_illuminated: bool,
    /// The numbers of the lights that shine on it.
    pub(in crate::render::shade) lights: &'p [u32],
    /// Whether photons stand for light that targets would let through to it.
    pub(in crate::render::shade) collects: bool,
}

/// What is known of the light of a lamp at a point before the point is looked at.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::shade) struct LightSample {
    /// How it arrives.
    pub(in crate::render::shade) arrival: Arrival,
    /// The cosine between its direction and the normal on the side of the viewer.
    pub(in crate::render::shade) cosine: f64,
    /// The share of its light that arrives if nothing is in the way.
    pub(in crate::render::shade) share: f64,
    /// What is in the way, if that was asked.
    pub(in crate::render::shade) way: Option<Occlusion>,
}

impl LightSample {
    /// Nothing.
    pub(in crate::render::shade) const NOTHING: LightSample = LightSample {
        arrival: Arrival {
            to_light: DVec3::ZERO,
            distance: 0.0,
        },
        cosine: 0.0,
        share: 0.0,
        way: None,
    };

    /// What is known of one of four ways.
    pub(in crate::render::shade) fn of(ways: &ShadowPacket4, lane: usize) -> LightSample {
        let way = ways.way(lane);
        if way.is_none() {
            return LightSample::NOTHING;
        }
        LightSample {
            arrival: Arrival {
                to_light: ways.to_light(lane),
                distance: ways.distance[lane],
            },
            cosine: ways.cosine[lane],
            share: ways.share[lane],
            way,
        }
    }

    /// The question what is in the way.
    #[inline]
    pub(in crate::render::shade) fn shadow_query(&self, world: &World, hit: &Hit) -> Query {
        let ray = Ray::new(hit.point, self.arrival.to_light);
        shadow_query(world, Some(hit.departure), ray, self.arrival.distance)
    }
}

/// What is known of the lights at a hit that was lit together with others.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct LightSamples<'a>(Option<(&'a BlockHits, usize)>);

impl<'a> LightSamples<'a> {
    /// Nothing.
    pub(in crate::render::shade) const NONE: LightSamples<'static> = LightSamples(None);

    /// What is known at a place of these.
    pub(in crate::render::shade) fn at(all: &'a BlockHits, place: usize) -> Self {
        LightSamples(all.knows_ways.then_some((all, place)))
    }

    /// What is known of the light of this number, if anything is known of any.
    #[inline]
    pub(in crate::render::shade) fn of(self, light: u32) -> Option<LightSample> {
        let (all, place) = self.0?;
        let ways = all.ways.get(light as usize * all.hits.len() + place / 4)?;
        Some(LightSample::of(ways, place % 4))
    }

    /// What is in the way of the light of this number, if that is known.
    #[inline]
    pub(in crate::render::shade) fn way(self, light: u32) -> Option<Occlusion> {
        let (all, place) = self.0?;
        let ways = all.ways.get(light as usize * all.hits.len() + place / 4)?;
        ways.way(place % 4)
    }

    /// Whether something transparent is in the way of any light.
    pub(in crate::render::shade) fn any_is_filtered(self) -> bool {
        self.0.is_some_and(|(all, place)| {
            let ways = all.ways.chunks(all.hits.len());
            let mut ways = ways.map(|ways| ways[place / 4].way(place % 4));
            ways.any(|way| way == Some(Occlusion::Transmissive))
        })
    }
}

/// The colour of a layer at a point.
pub(in crate::render::shade) struct LayerBsdf<'f> {
    pub(in crate::render::shade) finish: &'f Finish,
    pub(in crate::render::shade) rgb: Rgb,
    /// The share of light that does not pass the layer.
    pub(in crate::render::shade) opacity: f64,
}

/// How a layer takes light from one direction.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct Side {
    diffuse: f32,
    pub(in crate::render::shade) is_in_front: bool,
    /// The cosine between the normal and the direction to the light.
    cosine: f64,
}

/// Light from one direction on its way into a layer.
#[derive(Clone, Copy)]
pub(in crate::render::shade) struct LightContribution {
    /// The unit direction to the light.
    pub(in crate::render::shade) to_light: DVec3,
    pub(in crate::render::shade) side: Side,
    /// What the shadows have left.
    pub(in crate::render::shade) arriving: Rgb,
    pub(in crate::render::shade) has_highlights: bool,
}

impl LayerBsdf<'_> {
    /// The side on which light arrives at this cosine to the normal; `None` where the layer takes none from there.
    #[inline]
    pub(in crate::render::shade) fn side(
        &self,
        cosine: f64,
        is_double_illuminated: bool,
    ) -> Option<Side> {
        let (diffuse, is_in_front) = if cosine >= NOTHING || is_double_illuminated {
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
    /// What all lights give to a layer.
    pub(in crate::render::shade) fn illuminate(
        &self,
        lit: &ShadingPoint,
        coat: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let mut sum = Rgb::BLACK;
        if !coat.finish.takes_light() {
            return sum;
        }
        for &light in lit.lights {
            sum += self.light_up(light, lit, coat, scratch);
        }
        sum
    }

    /// What is known of the light of a lamp at a hit, besides what is in the way; its share is nothing where the surface
    /// takes none of it.
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
            way: None,
        }
    }

    /// What the light of this number gives to a layer.
    fn light_up(
        &self,
        number: u32,
        lit: &ShadingPoint,
        coat: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let light = self.world.lights.get(number);
        let is_point = light.area.is_none() && !light.is_parallel;
        let known = lit.known.of(number);
        let known = known.filter(|known| is_point && known.way.is_some());
        let arrival = known.map_or_else(|| light.arrival(lit.at.point), |known| known.arrival);
        if let Some(area) = &light.area
            && area.is_full
            && self.samples_areas(lit.path)
        {
            let lamps = Lamps::new(number, light, area, lit, light.color);
            return self.light_up_by_lamps(lamps, coat, scratch);
        }
        let cosine = lit.at.normal.dot(arrival.to_light);
        let Some(side) = coat.side(cosine, lit.is_double_illuminated) else {
            return Rgb::BLACK;
        };
        let share = known.map_or_else(|| light.share(lit.at.point, &arrival), |known| known.share);
        let mut arriving = light.color * share;
        if is_nothing(arriving) {
            return Rgb::BLACK;
        }
        if self.quality.has_shadows {
            let known = lit.arrived.and_then(|arrived| arrived.of(number));
            arriving = known.unwrap_or_else(|| {
                let left = self.after_shadows(arriving, number, lit, &arrival, scratch);
                if let Some(arrived) = lit.arrived {
                    arrived.keep(number, left);
                }
                left
            });
            if is_nothing(arriving) {
                return Rgb::BLACK;
            }
        }
        let shining = LightContribution {
            to_light: arrival.to_light,
            side,
            arriving,
            has_highlights: side.is_in_front && !light.is_shadowless() && lit.path.gathered == 0,
        };
        self.add_contribution(&shining, &lit.at, coat, scratch)
    }

    /// Whether area lights are more than a point to a ray.
    fn samples_areas(&self, path: &Path) -> bool {
        self.quality.has_area_lights && path.gathered == 0
    }

    /// What is left of light after all that stands between a point and the lamps of its source.
    pub(in crate::render::shade) fn after_shadows(
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
                let mut lamps = Lamps::new(number, light, area, lit, arriving);
                self.through_area(&mut lamps, scratch)
            }
            _ => self.through_shadows(arriving, lit, number, arrival, scratch),
        }
    }

    /// What light from one direction gives to a layer.
    #[inline]
    pub(in crate::render::shade) fn add_contribution(
        &self,
        shining: &LightContribution,
        at: &ViewPoint,
        coat: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let finish = coat.finish;
        let LightContribution {
            to_light,
            side,
            arriving,
            has_highlights,
        } = *shining;
        let cosine = side.cosine.abs();
        let mut sum = Rgb::BLACK;
        if side.diffuse != 0.0 {
            let mut strength = f64::from(side.diffuse)
                * coat.opacity
                * exact_power(cosine, f64::from(finish.brilliance));
            if finish.crand > 0.0 {
                strength -= grain(scratch) * f64::from(finish.crand);
            }
            sum += coat.rgb * arriving * strength;
        }
        if has_highlights {
            let strength = highlight(finish, at, to_light);
            if strength != 0.0 {
                let shine = metallic(finish.metallic, coat.rgb, cosine);
                sum += arriving * shine * strength;
            }
        }
        if finish.irid.amount > 0.0 {
            sum *= self.film(&finish.irid, at, to_light);
        }
        sum
    }
}

/// The next number of `crand`, from 0 to 1.
fn grain(scratch: &mut Scratch) -> f64 {
    scratch.crand = hash::next(scratch.crand);
    f64::from(scratch.crand) / f64::from(u32::MAX)
}

/// Bumps hardly ever let a surface face a light that is farther behind it.
pub(in crate::render::shade) const MOST_TILTED: f64 = -0.5;

/// Whether light at this cosine to the normal can matter to a surface.
#[inline]
pub(in crate::render::shade) fn faces(surface: &Surface, cosine: f64) -> bool {
    cosine >= NOTHING || surface.is_lit_from_behind()
}

#[inline]
pub(in crate::render::shade) fn is_nothing(light: Rgb) -> bool {
    let is_small = |c: f32| f64::from(c).abs() < NOTHING;
    is_small(light.r) && is_small(light.g) && is_small(light.b)
}

/// The highlights of light from one direction.
#[inline]
pub(in crate::render::shade) fn highlight(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    phong(finish, at, to_light) + specular(finish, at, to_light)
}

/// Phong's highlight: the cosine between mirrored view and light.
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

/// Blinn's highlight: the cosine between the normal and the half-way vector.
#[inline]
fn specular(finish: &Finish, at: &ViewPoint, to_light: DVec3) -> f64 {
    if finish.specular == 0.0 {
        return 0.0;
    }
    let half_way = 0.5 * (to_light - at.view);
    let cosine = half_way.dot(at.normal) / half_way.length();
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

/// The tint that a `metallic` of strength `m` gives to light that arrives at an angle of this cosine: less of the
/// pigment's colour the more grazing.
pub(in crate::render::shade) fn metallic(m: f32, pigment: Rgb, cosine: f64) -> Rgb {
    if m == 0.0 {
        return Rgb::WHITE;
    }
    let x = cosine.clamp(-1.0, 1.0).acos() * FRAC_2_PI;
    let fresnel = (0.014_567_225 / (x - 1.12).powi(2) - 0.011_612_903).clamp(0.0, 1.0);
    Rgb::WHITE + (pigment - Rgb::WHITE) * (f64::from(m) * (1.0 - fresnel))
}
