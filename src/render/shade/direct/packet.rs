//! The fast path of shading ([`super::opaque`]) for packets of four hits, and the own light of surfaces that reflect or
//! refract ([`crate::render::shade::wavefront`]). Lanes that need more than diffuse light and highlights are left to the scalar path.

use super::block_hits::BlockHits;
use super::transmittance::ShadowPath;
use crate::base::color::Rgb;
use crate::base::math::powers::exact_power;
use crate::render::shade::Scratch;
use crate::render::shade::atmosphere::{AtmosphereTint, End, SegmentEnd};
use crate::render::shade::bsdf::{NEGLIGIBLE, ViewPoint, highlight, is_negligible, metallic};
use crate::render::shade::shade_cache::{PlainMaterial, ShadeCache};
use crate::render::shade::{Path, Sample, Tracer};
use crate::scene::light::Light;
use crate::scene::pattern::SurfacePoint;
use crate::scene::texture::{Finish, PreparedPigment};
use crate::world::{HitPacket4, InteriorId, LightList, RayKind, ShadowPacket4};
use glam::{DVec2, DVec3};

/// One value per lane. Aligned, so that a packet is not read together with the next one: a read that spans two fresh
/// writes stalls on store forwarding. For the same reason the results of a packet stay in place.
#[derive(Clone, Copy)]
#[repr(align(32))]
struct LaneValues([f32; 4]);

/// The colours of four lanes, channel by channel.
type RgbPacket = [LaneValues; 3];

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
    /// Its own light.
    pub(in crate::render::shade) own: Rgb,
    pub(in crate::render::shade) finish: &'w Finish,
    pub(in crate::render::shade) pigment: Rgb,
    /// The transmittance of its layer.
    pub(in crate::render::shade) transmittance: Rgb,
}

/// The buffers of a thread for shading.
pub(in crate::render::shade) struct ShadeBuffers<'a> {
    pub(in crate::render::shade) scratch: &'a mut Scratch,
    pub(in crate::render::shade) cache: &'a mut ShadeCache,
}

/// The rays that hit a packet of surfaces.
pub(in crate::render::shade) trait RaySource {
    /// The kind of the ray in this lane.
    fn kind(&self, lane: usize) -> RayKind;
    /// The common kind of all rays, if there is one.
    fn common_kind(&self) -> Option<RayKind>;
    /// The interiors around the ray in this lane.
    fn inside(&self, lane: usize) -> &[InteriorId];
    /// The path of the ray in this lane, in this direction.
    fn path(&self, lane: usize, dir: DVec3) -> Path;
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
    pub(in crate::render::shade) fn secondary(&self, lane: usize) -> Option<SecondarySurface<'w>> {
        let materials = &self.materials;
        let finish = materials.finishes[lane].filter(|_| self.has_own_light >> lane & 1 == 1)?;
        Some(SecondarySurface {
            own: one_of(&self.rgb, lane),
            finish,
            pigment: one_of(&materials.rgb, lane),
            transmittance: materials.transmittance[lane],
        })
    }
}

/// The outermost layers at four hits.
struct MaterialPacket4<'w> {
    /// Their ambient light and emission.
    own: RgbPacket,
    rgb: RgbPacket,
    /// The share of white light at normal incidence that is scattered diffusely.
    diffuse: [f64; 4],
    finishes: [Option<&'w Finish>; 4],
    /// Lanes with highlights, and lanes with a `brilliance`.
    shiny: u32,
    brilliant: u32,
    /// Lanes with secondary rays, and their transmittance.
    secondary: u32,
    transmittance: [Rgb; 4],
    /// The lights of all lanes.
    lights: LightList,
}

impl MaterialPacket4<'_> {
    const NOTHING: MaterialPacket4<'static> = MaterialPacket4 {
        own: BLACK,
        rgb: BLACK,
        diffuse: [0.0; 4],
        finishes: [None; 4],
        shiny: 0,
        brilliant: 0,
        secondary: 0,
        transmittance: [Rgb::BLACK; 4],
        lights: LightList::OUTSIDE,
    };
}

impl<'w> MaterialPacket4<'w> {
    /// Sets the material of one lane.
    #[inline(always)]
    fn put(&mut self, lane: usize, material: &PlainMaterial, finish: Option<&'w Finish>) {
        put(&mut self.own, lane, material.own);
        put(&mut self.rgb, lane, material.rgb);
        self.diffuse[lane] = material.diffuse;
        self.finishes[lane] = finish;
        self.shiny |= u32::from(material.is_shiny) << lane;
        self.brilliant |= u32::from(material.is_brilliant) << lane;
        if material.has_secondary {
            self.secondary |= 1 << lane;
            self.transmittance[lane] = material.transmittance;
        }
    }

    /// Sets the material of all lanes.
    #[inline(always)]
    fn put_all(&mut self, material: &PlainMaterial, finish: Option<&'w Finish>) {
        self.own = all_of(material.own);
        self.rgb = all_of(material.rgb);
        self.diffuse = [material.diffuse; 4];
        self.finishes = [finish; 4];
        self.shiny = if material.is_shiny { 0b1111 } else { 0 };
        self.brilliant = if material.is_brilliant { 0b1111 } else { 0 };
        if material.has_secondary {
            self.secondary = 0b1111;
            self.transmittance = [material.transmittance; 4];
        }
    }
}

const BLACK: RgbPacket = [LaneValues([0.0; 4]); 3];

#[inline(always)]
fn all_of(rgb: Rgb) -> RgbPacket {
    [
        LaneValues([rgb.r; 4]),
        LaneValues([rgb.g; 4]),
        LaneValues([rgb.b; 4]),
    ]
}

#[inline(always)]
fn one_of(of: &RgbPacket, lane: usize) -> Rgb {
    Rgb::new(of[0].0[lane], of[1].0[lane], of[2].0[lane])
}

#[inline(always)]
fn put(to: &mut RgbPacket, lane: usize, rgb: Rgb) {
    for (to, channel) in to.iter_mut().zip([rgb.r, rgb.g, rgb.b]) {
        to.0[lane] = channel;
    }
}

/// Calls `visit` with the index of each set bit.
#[inline(always)]
fn each_lane(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize % 4);
        bits &= bits - 1;
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
        let mut lit = self.materials(hits, there & hits.hit_mask, cache, &mut seen.materials);
        let materials = &seen.materials;
        let mut sum = BLACK;
        let mut arriving = ArrivingLight { rgb: BLACK, lit: 0 };
        for &number in self.world.lights.of(materials.lights) {
            let shadow_rays = &all.shadow_rays[number as usize * all.hits.len() + packet];
            let arrives = shadow_rays.known & !shadow_rays.blocked;
            if self.features.needs_backface_light {
                each_lane(arrives, |lane| {
                    if shadow_rays.cosine[lane] < NEGLIGIBLE {
                        lit &= !(1 << lane);
                    }
                });
            }
            let light = self.world.lights.get(number);
            let filtered = arrives & shadow_rays.filtered & lit;
            let free = arrives & !shadow_rays.filtered & lit;
            if free | filtered == 0 {
                continue;
            }
            arriving.set_unoccluded(light, shadow_rays, free);
            each_lane(filtered, |lane| {
                let index = 4 * packet + lane;
                let left = self.transmitted_light(number, all, index, rays.inside(lane), scratch);
                arriving.set_lane(lane, left);
            });
            add_light(&arriving, shadow_rays, hits, materials, &mut sum);
        }
        each_lane(lit, |lane| {
            let rgb = Rgb::BLACK + (one_of(&materials.own, lane) + one_of(&sum, lane));
            put(&mut seen.rgb, lane, rgb);
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
        };
        self.transmittance(arriving, &shadow_path, scratch)
    }

    /// Looks up the materials of these lanes. Returns the lanes with only diffuse light, highlights and secondary rays.
    #[inline(always)]
    fn materials(
        &self,
        hits: &HitPacket4,
        active: u32,
        shade_cache: &mut ShadeCache,
        materials: &mut MaterialPacket4<'w>,
    ) -> u32 {
        let first = hits.surface[active.trailing_zeros() as usize % 4];
        materials.lights = self.world.surfaces[first as usize].lights;
        (materials.shiny, materials.brilliant, materials.secondary) = (0, 0, 0);
        if active == 0b1111
            && hits.surface == [first; 4]
            && let Some(material) = shade_cache.known(first)
        {
            materials.put_all(material, self.finish_of(first, material));
            return active;
        }
        let mut plain = 0;
        each_lane(
            active,
            #[inline(always)]
            |lane| {
                let number = hits.surface[lane];
                let material = shade_cache.of(
                    number,
                    #[inline(always)]
                    || self.evaluate_material(hits, lane),
                );
                if let Some(material) = material
                    && material.lights == materials.lights
                {
                    materials.put(lane, material, self.finish_of(number, material));
                    plain |= 1 << lane;
                }
            },
        );
        plain
    }

    /// The finish of a surface, if it holds more than the material does.
    #[inline(always)]
    fn finish_of(&self, surface: u32, material: &PlainMaterial) -> Option<&'w Finish> {
        if !material.is_shiny && !material.is_brilliant && !material.has_secondary {
            return None;
        }
        let layers = self.world.surfaces[surface as usize].texture.layers();
        layers.first().map(|layer| &*layer.finish)
    }

    /// The material at a hit if it is plain, and whether it is constant over its surface.
    #[inline(never)]
    fn evaluate_material(&self, hits: &HitPacket4, lane: usize) -> (Option<PlainMaterial>, bool) {
        let surface = &self.world.surfaces[hits.surface[lane] as usize];
        let mut has_one_color = false;
        let material = self.plain_material(surface, |pigment| {
            has_one_color = matches!(pigment, PreparedPigment::Plain(_));
            pigment.color(&SurfacePoint {
                point: hits.point(lane),
                normal: hits.facing(lane),
                dir: hits.dir(lane),
                uv: DVec2::ZERO,
            })
        });
        (material, has_one_color)
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

/// The viewed point of a lane.
#[inline(always)]
pub(in crate::render::shade) fn viewed(hits: &HitPacket4, lane: usize) -> ViewPoint {
    ViewPoint {
        point: hits.point(lane),
        normal: hits.facing(lane),
        view: hits.dir(lane),
    }
}

/// Adds the light from one light source to the sums.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision, as in POV-Ray"
)]
fn add_light(
    arriving: &ArrivingLight,
    shadow_rays: &ShadowPacket4,
    hits: &HitPacket4,
    materials: &MaterialPacket4,
    sum: &mut RgbPacket,
) {
    let mut strength = [0.0; 4];
    for (lane, strength) in strength.iter_mut().enumerate() {
        *strength = materials.diffuse[lane] * shadow_rays.cosine[lane];
    }
    each_lane(arriving.lit & materials.brilliant, |lane| {
        if let Some(finish) = materials.finishes[lane] {
            let brilliance = f64::from(finish.brilliance);
            let cosine = exact_power(shadow_rays.cosine[lane].abs(), brilliance);
            strength[lane] = materials.diffuse[lane] * cosine;
        }
    });
    let mut contribution = BLACK;
    let tints = materials.rgb.iter().zip(&arriving.rgb);
    for (contribution, (rgb, arriving)) in contribution.iter_mut().zip(tints) {
        for (lane, contribution) in contribution.0.iter_mut().enumerate() {
            let tinted = rgb.0[lane] * arriving.0[lane];
            let scattered = (f64::from(tinted) * strength[lane]) as f32;
            *contribution = if materials.diffuse[lane] != 0.0 {
                scattered
            } else {
                0.0
            };
        }
    }
    let with_highlights = arriving.lit & materials.shiny;
    if with_highlights == 0 {
        add(&contribution, arriving.lit, sum);
        return;
    }
    each_lane(with_highlights, |lane| {
        let Some(finish) = materials.finishes[lane] else {
            return;
        };
        let strength = highlight(finish, &viewed(hits, lane), shadow_rays.to_light(lane));
        if strength != 0.0 {
            let pigment = one_of(&materials.rgb, lane);
            let shine = metallic(finish.metallic, pigment, shadow_rays.cosine[lane]);
            let shine = one_of(&arriving.rgb, lane) * shine * strength;
            let both = one_of(&contribution, lane) + shine;
            put(&mut contribution, lane, both);
        }
    });
    add(&contribution, arriving.lit, sum);
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
