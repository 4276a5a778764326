//! The fast path of shading ([`super::opaque`]) for packets of four hits, and the own light of surfaces that reflect or
//! refract ([`crate::render::shade::wavefront`]). Lanes that need more than diffuse light and highlights of any number of
//! layers, and the secondary rays of one texture, are left to the scalar path.

use super::area::AreaLight;
use super::block_hits::{BlockHits, RaySource};
use super::materials::{
    BLACK, LayerPacket4, MaterialPacket4, RgbPacket, all_of, each_lane, one_of, put,
};
use super::transmittance::ShadowPath;
use crate::base::color::Rgb;
use crate::base::math::powers::exact_power;
use crate::render::shade::atmosphere::{AtmosphereTint, End, SegmentEnd};
use crate::render::shade::bsdf::{Highlight, NEGLIGIBLE, ViewPoint, half_cosine, is_negligible};
use crate::render::shade::shade_cache::ShadeCache;
use crate::render::shade::shading_point::{LightSamples, ShadingPoint};
use crate::render::shade::surface::Mirror;
use crate::render::shade::{Path, Sample, Scratch, Tracer};
use crate::scene::light::{Area, Light};
use crate::world::{HitPacket4, InteriorId, ShadowPacket4};

/// Radiance of four rays.
pub(in crate::render::shade) struct RadiancePacket4<'w> {
    rgb: RgbPacket,
    transmit: [f32; 4],
    /// Mask of the lanes whose sample is complete.
    known: u32,
    /// Mask of the lanes with only the surface's own light: secondary rays are still to be traced.
    has_own_light: u32,
    materials: MaterialPacket4<'w>,
}

/// A surface with secondary rays.
pub(in crate::render::shade) struct SecondarySurface<'w> {
    /// The viewed point, with the normal of the top layer.
    pub(in crate::render::shade) at: ViewPoint,
    /// Its own light.
    pub(in crate::render::shade) own: Rgb,
    /// The transmittance of all layers.
    pub(in crate::render::shade) transmittance: Rgb,
    pub(in crate::render::shade) mirror: Option<Mirror<'w>>,
}

/// The buffers of a thread for shading.
pub(in crate::render::shade) struct ShadeBuffers<'a> {
    pub(in crate::render::shade) scratch: &'a mut Scratch,
    pub(in crate::render::shade) cache: &'a mut ShadeCache,
}

impl<'w> RadiancePacket4<'w> {
    pub(in crate::render::shade) const NOTHING: RadiancePacket4<'static> = RadiancePacket4 {
        rgb: BLACK,
        transmit: [0.0; 4],
        known: 0,
        has_own_light: 0,
        materials: MaterialPacket4::NOTHING,
    };

    /// Sets all of these lanes to the same sample.
    #[inline(always)]
    fn set_all(&mut self, Sample { rgb, transmit }: Sample, known: u32) {
        self.rgb = all_of(rgb);
        self.transmit = [transmit; 4];
        self.known = known;
    }

    /// The sample of a lane, if it is complete.
    #[inline(always)]
    pub(in crate::render::shade) fn sample(&self, lane: usize) -> Option<Sample> {
        (self.known >> lane & 1 == 1).then(|| self.known(lane))
    }

    /// Returns true if the first `count` lanes are complete.
    #[inline(always)]
    pub(in crate::render::shade) fn is_known(&self, count: usize) -> bool {
        self.known == (1 << count) - 1
    }

    /// The sample of a lane that is complete.
    #[inline(always)]
    pub(in crate::render::shade) fn known(&self, lane: usize) -> Sample {
        Sample {
            rgb: one_of(&self.rgb, lane),
            transmit: self.transmit[lane],
        }
    }

    /// The surface of a lane that has secondary rays.
    #[inline(always)]
    pub(in crate::render::shade) fn secondary(
        &self,
        hits: &HitPacket4,
        lane: usize,
    ) -> Option<SecondarySurface<'w>> {
        let materials = &self.materials;
        (self.has_own_light >> lane & 1 == 1).then(|| SecondarySurface {
            at: materials.top.viewed(hits, lane),
            own: one_of(&self.rgb, lane),
            transmittance: materials.transmittance[lane],
            mirror: materials.mirrors[lane],
        })
    }
}

impl<'w> Tracer<'w> {
    /// Shades the first `count` hits of a packet of a block into `seen`, in lanes with plain materials.
    #[inline(always)]
    pub(in crate::render::shade) fn shade_packet4(
        &self,
        rays: &(impl RaySource + ?Sized),
        packet: usize,
        count: usize,
        all: &BlockHits,
        buffers: ShadeBuffers,
        seen: &mut RadiancePacket4<'w>,
    ) {
        let ShadeBuffers { scratch, cache } = buffers;
        (seen.known, seen.has_own_light) = (0, 0);
        if !self.fast_paths.packets || self.stop.is_cancelled() {
            return;
        }
        let hits = &all.hits[packet];
        let there = 0b1111 >> (4 - (count - 4 * packet).min(4));
        let has_no_hit = there & hits.hit_mask == 0;
        if has_no_hit
            && self.world.sky.is_none()
            && !self.has_atmosphere()
            && let Some(kind) = rays.common_kind()
        {
            seen.set_all(self.background_of(kind).seen, there);
            return;
        }
        seen.transmit = [0.0; 4];
        each_lane(there & !hits.hit_mask, |lane| {
            let behind = self.background_radiance(hits.dir(lane), rays.kind(lane));
            put(&mut seen.rgb, lane, behind.rgb);
            seen.transmit[lane] = behind.transmit;
            seen.known |= 1 << lane;
        });
        if has_no_hit {
            self.attenuate(rays, hits, scratch, seen);
            return;
        }
        let materials = &mut seen.materials;
        let in_order = scratch.random.continues;
        let mut lit = self.materials(
            rays,
            hits,
            there & hits.hit_mask,
            in_order,
            cache,
            materials,
        );
        let mut arriving = ArrivingLight { rgb: BLACK, lit: 0 };
        for &number in self.world.lights.of(materials.lights) {
            let shadow_rays = &all.shadow_rays[number as usize * all.hits.len() + packet];
            let mut arrives = shadow_rays.known & !shadow_rays.blocked;
            if self.features.needs_backface_light {
                each_lane(arrives & !materials.general, |lane| {
                    if shadow_rays.cosine[lane] < NEGLIGIBLE {
                        lit &= !(1 << lane);
                    }
                });
            }
            if materials.general != 0 {
                let [faces, bumped] = materials.turn_to(shadow_rays);
                arrives &= faces | !materials.general;
                // Bumps turn a few surfaces to lights so far behind them that their shadow rays are not traced.
                each_lane(bumped & !shadow_rays.known, |lane| {
                    if shadow_rays.share[lane] != 0.0 {
                        lit &= !(1 << lane);
                    }
                });
            }
            let light = self.world.lights.get(number);
            let draws = light.area.as_ref().is_some_and(|area| area.has_jitter);
            if arrives & shadow_rays.filtered != 0 && (draws || in_order) {
                lit &=
                    !(arrives & shadow_rays.filtered) | self.own_draws(rays, materials, in_order);
            }
            let filtered = arrives & shadow_rays.filtered & lit;
            let free = arrives & !shadow_rays.filtered & lit;
            if free | filtered == 0 {
                continue;
            }
            arriving.set_unoccluded(light, shadow_rays, free);
            each_lane(filtered, |lane| {
                let index = 4 * packet + lane;
                if draws && let Some(stream) = rays.stream(lane) {
                    scratch.random.lights = stream;
                }
                let path = || rays.path(lane, hits.dir(lane));
                let left = match &light.area {
                    Some(area) => self.sampled_light(number, area, all, index, path, scratch),
                    None => self.transmitted_light(number, all, index, rays.inside(lane), scratch),
                };
                arriving.set_lane(lane, left);
            });
            let is_general = materials.general != 0;
            add_light(&arriving, shadow_rays, hits, is_general, &mut materials.top);
            for layer in &mut materials.lower {
                add_light(&arriving, shadow_rays, hits, is_general, layer);
            }
        }
        each_lane(lit & !materials.general, |lane| {
            put(
                &mut seen.rgb,
                lane,
                Rgb::BLACK + materials.top.radiance(lane),
            );
        });
        each_lane(lit & materials.general, |lane| {
            put(&mut seen.rgb, lane, materials.radiance(lane));
        });
        seen.known |= lit & !materials.secondary;
        seen.has_own_light = lit & materials.secondary;
        self.attenuate(rays, hits, scratch, seen);
    }

    /// Applies the atmosphere along the rays to the lanes that are complete.
    #[inline(always)]
    fn attenuate(
        &self,
        rays: &(impl RaySource + ?Sized),
        hits: &HitPacket4,
        scratch: &mut Scratch,
        seen: &mut RadiancePacket4<'w>,
    ) {
        if !self.has_atmosphere() {
            return;
        }
        each_lane(seen.known, |lane| {
            let atmosphere =
                self.atmosphere_before(hits, lane, || rays.path(lane, hits.dir(lane)), scratch);
            let Sample { rgb, transmit } = seen.known(lane).behind_atmosphere(atmosphere);
            put(&mut seen.rgb, lane, rgb);
            seen.transmit[lane] = transmit;
        });
    }

    /// The effect of the atmosphere along the ray of a lane.
    #[inline]
    pub(in crate::render::shade) fn atmosphere_before(
        &self,
        hits: &HitPacket4,
        lane: usize,
        path: impl FnOnce() -> Path,
        scratch: &mut Scratch,
    ) -> Option<AtmosphereTint> {
        if !self.has_atmosphere() {
            return None;
        }
        let end = match hits.is_hit(lane) {
            true => {
                let surface = &self.world.surfaces[hits.surface[lane] as usize];
                End::Surface(SegmentEnd {
                    length: hits.t[lane],
                    surface: hits.spawn_surface(lane),
                    lights: surface.lights,
                })
            }
            false => End::Nothing,
        };
        self.atmosphere(&path(), end, scratch)
    }

    /// Mask of the lanes whose light may draw random numbers: they begin a sample with numbers of its own, only one light
    /// draws any, and no secondary ray draws more.
    #[inline(never)]
    fn own_draws(
        &self,
        rays: &(impl RaySource + ?Sized),
        materials: &MaterialPacket4<'w>,
        in_order: bool,
    ) -> u32 {
        let lights = &self.world.lights;
        let draws = |&&number: &&u32| {
            let area = lights.get(number).area.as_ref();
            area.is_some_and(|area| area.has_jitter)
        };
        let is_one = lights.of(materials.lights).iter().filter(draws).count() == 1;
        match is_one && !in_order && rays.stream(0).is_some() {
            true => !materials.secondary,
            false => 0,
        }
    }

    /// The light from this area light that arrives at a hit.
    #[inline(never)]
    fn sampled_light(
        &self,
        number: u32,
        area: &Area,
        all: &BlockHits,
        index: usize,
        path: impl FnOnce() -> Path,
        scratch: &mut Scratch,
    ) -> Rgb {
        let (hits, lane) = (&all.hits[index / 4], index % 4);
        let shadow_rays = &all.shadow_rays[number as usize * all.hits.len() + index / 4];
        let light = self.world.lights.get(number);
        let lit = ShadingPoint {
            at: ViewPoint {
                point: hits.point(lane),
                normal: hits.facing(lane),
                view: hits.dir(lane),
            },
            spawn_surface: Some(&hits.spawn_surface(lane)),
            path: &path(),
            known: LightSamples::NONE,
            shadow_cache: None,
            is_double_illuminated: false,
            lights: &[],
            collects: false,
        };
        let arriving = light.color * shadow_rays.share[lane];
        let mut area_light = AreaLight::new(number, light, area, &lit, arriving);
        self.shadowed_area_light(&mut area_light, scratch)
    }

    /// The light from this light source that arrives at a hit through transparent surfaces.
    #[inline(never)]
    fn transmitted_light(
        &self,
        number: u32,
        all: &BlockHits,
        index: usize,
        inside: &[InteriorId],
        scratch: &mut Scratch,
    ) -> Rgb {
        let (hits, lane) = (&all.hits[index / 4], index % 4);
        let shadow_rays = &all.shadow_rays[number as usize * all.hits.len() + index / 4];
        let arriving = self.world.lights.get(number).color * shadow_rays.share[lane];
        if is_negligible(arriving) {
            return Rgb::BLACK;
        }
        let shadow_path = ShadowPath {
            light: number,
            query: shadow_rays.query(hits, lane),
            distance: shadow_rays.distance[lane],
            known: if all.has_occlusion {
                shadow_rays.occlusion(lane)
            } else {
                None
            },
            inside,
            collects: false,
            is_to_grid: false,
        };
        self.transmittance(arriving, &shadow_path, scratch)
    }
}

/// Light from one light source that arrives at four hits.
struct ArrivingLight {
    rgb: RgbPacket,
    /// Mask of the lanes with any light.
    lit: u32,
}

impl ArrivingLight {
    /// Sets the light in unoccluded lanes.
    #[inline(always)]
    fn set_unoccluded(&mut self, light: &Light, shadow_rays: &ShadowPacket4, free: u32) {
        self.rgb = all_of(light.color);
        self.lit = if is_negligible(light.color) { 0 } else { free };
        if !light.is_unattenuated() {
            each_lane(free, |lane| {
                self.set_lane(lane, light.color * shadow_rays.share[lane])
            });
        }
    }

    /// Sets the light of one lane.
    #[inline(always)]
    fn set_lane(&mut self, lane: usize, rgb: Rgb) {
        put(&mut self.rgb, lane, rgb);
        self.lit = self.lit & !(1 << lane) | u32::from(!is_negligible(rgb)) << lane;
    }
}

/// Adds the light that a layer scatters from one light source; in packets of general surfaces, to those that face it.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision, as in POV-Ray"
)]
fn add_light(
    arriving: &ArrivingLight,
    shadow_rays: &ShadowPacket4,
    hits: &HitPacket4,
    is_general: bool,
    layer: &mut LayerPacket4,
) {
    let lit = arriving.lit & layer.faces;
    let cosine = match is_general {
        true => layer.cosine,
        false => shadow_rays.cosine,
    };
    let mut strength = [0.0; 4];
    for (lane, strength) in strength.iter_mut().enumerate() {
        *strength = layer.diffuse[lane] * cosine[lane];
    }
    each_lane(lit & layer.brilliant, |lane| {
        if let Some(finish) = layer.finishes[lane] {
            let brilliance = f64::from(finish.brilliance);
            let cosine = exact_power(cosine[lane].abs(), brilliance);
            strength[lane] = layer.diffuse[lane] * cosine;
        }
    });
    let mut contribution = BLACK;
    let tints = layer.rgb.iter().zip(&arriving.rgb);
    for (contribution, (rgb, arriving)) in contribution.iter_mut().zip(tints) {
        for (lane, contribution) in contribution.0.iter_mut().enumerate() {
            let tinted = rgb.0[lane] * arriving.0[lane];
            let scattered = (f64::from(tinted) * strength[lane]) as f32;
            *contribution = if layer.diffuse[lane] != 0.0 {
                scattered
            } else {
                0.0
            };
        }
    }
    let with_highlights = lit & layer.shiny;
    if with_highlights == 0 {
        add(&contribution, lit, &mut layer.scattered);
        return;
    }
    each_lane(with_highlights, |lane| {
        let Some(finish) = layer.finishes[lane] else {
            return;
        };
        let (at, to_light) = (layer.viewed(hits, lane), shadow_rays.to_light(lane));
        let highlight = Highlight::of(finish, &at, to_light);
        if highlight.strength != 0.0 {
            let pigment = one_of(&layer.rgb, lane);
            let arriving = one_of(&arriving.rgb, lane);
            let half_cosine = || half_cosine(&at, to_light);
            let shine = highlight.tinted(finish, pigment, arriving, cosine[lane], half_cosine);
            let both = one_of(&contribution, lane) + shine;
            put(&mut contribution, lane, both);
        }
    });
    add(&contribution, lit, &mut layer.scattered);
}

/// Adds the contributions of these lanes.
#[inline(always)]
fn add(contribution: &RgbPacket, lit: u32, sum: &mut RgbPacket) {
    for (sum, contribution) in sum.iter_mut().zip(contribution) {
        for (lane, sum) in sum.0.iter_mut().enumerate() {
            let is_lit = lit >> lane & 1 == 1;
            *sum += if is_lit { contribution.0[lane] } else { 0.0 };
        }
    }
}
