//! The layers of surfaces at four hits, for shading in packets ([`super::packet`]).

use super::block_hits::RaySource;
use crate::base::color::Rgb;
use crate::render::shade::Tracer;
use crate::render::shade::bsdf::{LayerBsdf, NEGLIGIBLE, ViewPoint};
use crate::render::shade::shade_cache::{PlainMaterial, ShadeCache};
use crate::render::shade::surface::{Mirror, TextureUse};
use crate::scene::pattern::SurfacePoint;
use crate::scene::texture::{Finish, PreparedPigment, WeightedTexture};
use crate::world::{HitPacket4, InteriorId, LightList, ShadowPacket4};
use glam::{DVec2, DVec3};

/// One value per lane. Aligned, so that a packet is not read together with the next one: a read that spans two fresh
/// writes stalls on store forwarding. For the same reason the results of a packet stay in place.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct LaneValues(pub(super) [f32; 4]);

/// The colours of four lanes, channel by channel.
pub(super) type RgbPacket = [LaneValues; 3];

/// The layers at four hits.
pub(super) struct MaterialPacket4<'w> {
    /// The outermost layers.
    pub(super) top: LayerPacket4<'w>,
    /// The layers below, from the top down.
    pub(super) lower: Vec<LayerPacket4<'w>>,
    /// Lanes of surfaces with bumps, several layers, several textures or texture coordinates.
    pub(super) general: u32,
    /// Lanes with secondary rays, their transmittance and their reflection.
    pub(super) secondary: u32,
    pub(super) transmittance: [Rgb; 4],
    pub(super) mirrors: [Option<Mirror<'w>>; 4],
    /// The lights of all lanes.
    pub(super) lights: LightList,
}

/// One layer at each of four hits.
#[derive(Clone, Copy)]
pub(super) struct LayerPacket4<'w> {
    /// Ambient light and emission.
    pub(super) own: RgbPacket,
    pub(super) rgb: RgbPacket,
    /// The share of white light at normal incidence that is scattered diffusely.
    pub(super) diffuse: [f64; 4],
    pub(super) finishes: [Option<&'w Finish>; 4],
    /// Lanes with highlights, and lanes with a `brilliance`.
    pub(super) shiny: u32,
    pub(super) brilliant: u32,
    /// The light that it scatters.
    pub(super) scattered: RgbPacket,
    /// Lanes with this layer that receive the current light.
    pub(super) faces: u32,
    /// Lanes with bumps, and the normals there.
    pub(super) bumped: u32,
    pub(super) normals: [DVec3; 4],
    /// The cosines to the current light, in packets of general surfaces.
    pub(super) cosine: [f64; 4],
    /// Lanes with this layer, and the transmittance of the layers above.
    pub(super) there: u32,
    pub(super) filter: [Rgb; 4],
    /// Lanes in which it is the last layer of a texture, and the weights of these textures.
    pub(super) is_last: u32,
    pub(super) weight: [f32; 4],
}

impl MaterialPacket4<'_> {
    pub(super) const NOTHING: MaterialPacket4<'static> = MaterialPacket4 {
        top: LayerPacket4::NOTHING,
        lower: Vec::new(),
        general: 0,
        secondary: 0,
        transmittance: [Rgb::BLACK; 4],
        mirrors: [None; 4],
        lights: LightList::OUTSIDE,
    };

    /// Turns general surfaces to a light. Returns the lanes in which some layer faces it, and those in which bumps do.
    #[inline(never)]
    pub(super) fn turn_to(&mut self, shadow_rays: &ShadowPacket4) -> [u32; 2] {
        let general = self.general;
        let layers = std::iter::once(&mut self.top).chain(&mut self.lower);
        layers.fold([0; 2], |[any, bumped], layer| {
            layer.turn_to(shadow_rays, general);
            let faces = layer.faces & general;
            [any | faces, bumped | faces & layer.bumped]
        })
    }

    /// The own light of a general surface.
    pub(super) fn radiance(&self, lane: usize) -> Rgb {
        let layers = std::iter::once(&self.top).chain(&self.lower);
        let (mut sum, mut texture) = (Rgb::BLACK, Rgb::BLACK);
        for layer in layers.filter(|layer| layer.there >> lane & 1 == 1) {
            texture += layer.radiance(lane) * layer.filter[lane];
            if layer.is_last >> lane & 1 == 1 {
                sum += texture * f64::from(layer.weight[lane]);
                texture = Rgb::BLACK;
            }
        }
        sum
    }
}

impl LayerPacket4<'_> {
    pub(super) const NOTHING: LayerPacket4<'static> = LayerPacket4 {
        own: BLACK,
        rgb: BLACK,
        diffuse: [0.0; 4],
        finishes: [None; 4],
        shiny: 0,
        brilliant: 0,
        scattered: BLACK,
        faces: 0,
        bumped: 0,
        normals: [DVec3::ZERO; 4],
        cosine: [0.0; 4],
        there: 0,
        filter: [Rgb::WHITE; 4],
        is_last: 0,
        weight: [1.0; 4],
    };

    /// The viewed point of a lane.
    #[inline(always)]
    pub(super) fn viewed(&self, hits: &HitPacket4, lane: usize) -> ViewPoint {
        ViewPoint {
            point: hits.point(lane),
            normal: match self.bumped >> lane & 1 {
                1 => self.normals[lane],
                _ => hits.facing(lane),
            },
            view: hits.dir(lane),
        }
    }

    /// Sets the cosines to a light, and which of the general surfaces in these lanes face it.
    #[inline(always)]
    pub(super) fn turn_to(&mut self, shadow_rays: &ShadowPacket4, general: u32) {
        self.cosine = shadow_rays.cosine;
        each_lane(self.bumped, |lane| {
            self.cosine[lane] = self.normals[lane].dot(shadow_rays.to_light(lane));
        });
        self.faces = !general;
        each_lane(self.there & general, |lane| {
            self.faces |= u32::from(self.cosine[lane] >= NEGLIGIBLE) << lane;
        });
    }

    /// The light of the layer alone.
    #[inline(always)]
    pub(super) fn radiance(&self, lane: usize) -> Rgb {
        one_of(&self.own, lane) + one_of(&self.scattered, lane)
    }
}

impl<'w> MaterialPacket4<'w> {
    /// The layers of this number from the top; at most one more than there are.
    #[inline(always)]
    pub(super) fn layer(&mut self, number: usize) -> &mut LayerPacket4<'w> {
        if number == 0 {
            return &mut self.top;
        }
        if number > self.lower.len() {
            self.lower.push(LayerPacket4::NOTHING);
        }
        &mut self.lower[number - 1]
    }
}

impl<'w> LayerPacket4<'w> {
    /// Sets the material of one lane.
    #[inline(always)]
    pub(super) fn put(
        &mut self,
        lane: usize,
        material: &PlainMaterial,
        finish: Option<&'w Finish>,
    ) {
        put(&mut self.own, lane, material.own);
        put(&mut self.rgb, lane, material.rgb);
        self.diffuse[lane] = material.diffuse;
        self.finishes[lane] = finish;
        self.shiny |= u32::from(material.is_shiny) << lane;
        self.brilliant |= u32::from(material.is_brilliant) << lane;
    }

    /// Sets the material of all lanes.
    #[inline(always)]
    pub(super) fn put_all(&mut self, material: &PlainMaterial, finish: Option<&'w Finish>) {
        self.own = all_of(material.own);
        self.rgb = all_of(material.rgb);
        self.diffuse = [material.diffuse; 4];
        self.finishes = [finish; 4];
        self.shiny = if material.is_shiny { 0b1111 } else { 0 };
        self.brilliant = if material.is_brilliant { 0b1111 } else { 0 };
    }
}

pub(super) const BLACK: RgbPacket = [LaneValues([0.0; 4]); 3];

#[inline(always)]
pub(super) fn all_of(rgb: Rgb) -> RgbPacket {
    [
        LaneValues([rgb.r; 4]),
        LaneValues([rgb.g; 4]),
        LaneValues([rgb.b; 4]),
    ]
}

#[inline(always)]
pub(super) fn one_of(of: &RgbPacket, lane: usize) -> Rgb {
    Rgb::new(of[0].0[lane], of[1].0[lane], of[2].0[lane])
}

#[inline(always)]
pub(super) fn put(to: &mut RgbPacket, lane: usize, rgb: Rgb) {
    for (to, channel) in to.iter_mut().zip([rgb.r, rgb.g, rgb.b]) {
        to.0[lane] = channel;
    }
}

/// Calls `visit` with the index of each set bit.
#[inline(always)]
pub(super) fn each_lane(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize % 4);
        bits &= bits - 1;
    }
}

impl<'w> Tracer<'w> {
    /// Looks up the materials of these lanes. Returns the lanes with only diffuse light, highlights and secondary rays.
    /// Several layers are left out where light is sampled in POV-Ray's order.
    #[inline(always)]
    pub(super) fn materials(
        &self,
        rays: &(impl RaySource + ?Sized),
        hits: &HitPacket4,
        active: u32,
        in_order: bool,
        shade_cache: &mut ShadeCache,
        materials: &mut MaterialPacket4<'w>,
    ) -> u32 {
        let first = hits.surface[active.trailing_zeros() as usize % 4];
        materials.lights = self.world.surfaces[first as usize].lights;
        (materials.general, materials.secondary) = (0, 0);
        materials.lower.clear();
        let top = &mut materials.top;
        (top.shiny, top.brilliant, top.bumped) = (0, 0, 0);
        (top.there, top.is_last) = (0, 0);
        (top.scattered, top.faces) = (BLACK, 0b1111);
        if active == 0b1111
            && hits.surface == [first; 4]
            && let Some(material) = shade_cache.known(first)
        {
            let finish = self.finish_of(first, material);
            top.put_all(material, finish);
            if let (true, Some(finish)) = (material.has_secondary, finish) {
                each_lane(active, |lane| {
                    self.note_secondary(rays, hits, lane, (material, finish), materials);
                });
            }
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
                let Some(material) = material else {
                    if !in_order && self.put_layers(rays.inside(lane), hits, lane, materials) {
                        plain |= 1 << lane;
                    }
                    return;
                };
                if material.lights == materials.lights {
                    let finish = self.finish_of(number, material);
                    materials.top.put(lane, material, finish);
                    if let (true, Some(finish)) = (material.has_secondary, finish) {
                        self.note_secondary(rays, hits, lane, (material, finish), materials);
                    }
                    plain |= 1 << lane;
                }
            },
        );
        plain
    }

    /// Notes the secondary rays of a surface of one layer without bumps.
    #[inline(always)]
    fn note_secondary(
        &self,
        rays: &(impl RaySource + ?Sized),
        hits: &HitPacket4,
        lane: usize,
        (material, finish): (&PlainMaterial, &'w Finish),
        materials: &mut MaterialPacket4<'w>,
    ) {
        let at = materials.top.viewed(hits, lane);
        let mut filter = Rgb::WHITE;
        let bsdf = LayerBsdf {
            finish,
            rgb: material.rgb,
            opacity: 1.0,
            ior: 1.0,
        };
        let interior = self.world.surfaces[hits.surface[lane] as usize].interior;
        let ior = || self.relative_ior(rays.inside(lane), interior);
        materials.secondary |= 1 << lane;
        materials.mirrors[lane] = self.layer_mirror(&at, at.normal, &bsdf, ior, &mut filter);
        materials.transmittance[lane] = filter * material.transmittance;
    }

    /// Looks up the layers of the textures of a surface. Returns false if they need more than diffuse light, highlights
    /// and the secondary rays of one texture, are lit from behind, or have other lights than the packet.
    #[inline(never)]
    fn put_layers(
        &self,
        inside: &[InteriorId],
        hits: &HitPacket4,
        lane: usize,
        materials: &mut MaterialPacket4<'w>,
    ) -> bool {
        let surface = &self.world.surfaces[hits.surface[lane] as usize];
        let is_general = surface.has_plain_finishes() && !surface.is_lit_from_behind();
        let is_queued = self.fast_paths.wavefront || !surface.sends_rays();
        if !is_general || !is_queued || surface.lights != materials.lights {
            return false;
        }
        let Some(hit) = hits.hit(lane) else {
            return false;
        };
        let (flat, dir, bit) = (hits.facing(lane), hits.dir(lane), 1 << lane);
        let textures = self.textures_at(surface, &hit, dir, TextureUse::Drawn);
        let (_, mut spot) = self.pattern_point(&hit, dir);
        let (mut seen, mut image, mut filter) = (flat, None, Rgb::WHITE);
        let mut number = 0;
        for &WeightedTexture {
            weight,
            texture,
            point,
        } in &textures
        {
            filter = Rgb::WHITE;
            for layer in texture.layers() {
                let to = materials.layer(number);
                number += 1;
                if let Some(bumps) = layer.normal() {
                    spot.normal = flat;
                    (to.normals[lane], seen) =
                        bumps.perturbed_with_pattern_normal(point, flat, &spot);
                    to.bumped |= bit;
                }
                spot.normal = seen;
                let color = layer.pigment.color_at(point, &spot);
                let (own, bsdf) = self.layer_bsdf(layer, color);
                let material = PlainMaterial::new(own, &bsdf, surface, color);
                to.put(lane, &material, Some(&layer.finish));
                to.there |= bit;
                to.filter[lane] = filter;
                let ior = || self.relative_ior(inside, surface.interior);
                let at = to.viewed(hits, lane);
                if let Some(mirror) = self.layer_mirror(&at, flat, &bsdf, ior, &mut filter)
                    && image.replace(mirror).is_some()
                {
                    return false;
                }
                filter *= material.transmittance;
                if self.is_opaque(0, filter) {
                    break;
                }
            }
            if number == 0 {
                return false;
            }
            let last = materials.layer(number - 1);
            last.is_last |= bit;
            last.weight[lane] = weight;
            let has_secondary = image.is_some() || !self.is_opaque(0, filter);
            if has_secondary && (textures.len() > 1 || weight != 1.0) {
                return false;
            }
            if has_secondary {
                materials.secondary |= bit;
            }
        }
        materials.mirrors[lane] = image;
        materials.transmittance[lane] = filter;
        materials.general |= bit;
        number > 0
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
