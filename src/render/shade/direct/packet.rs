//! The fast path of shading ([`super::opaque`]) for four shading points of a block at once, and for the own light of surfaces
//! that reflect or refract ([`crate::render::shade::wavefront`]). A point that needs more than diffuse light and highlights is left to the
//! scalar path.

use super::block::BlockHits;
use super::light::{NOTHING, ViewPoint, highlight, is_nothing, metallic};
use super::transmittance::ShadowPath;
use crate::base::color::Rgb;
use crate::base::math::powers::exact_power;
use crate::render::shade::atmosphere::{AirTint, End};
use crate::render::shade::shade_cache::{PlainMaterial, ShadeCache};
use crate::render::shade::{Path, Sample, Tracer};
use crate::scene::light::Light;
use crate::scene::pattern::SurfacePoint;
use crate::scene::texture::{Finish, PreparedPigment};
use crate::world::{HitPacket4, InteriorId, LightList, RayKind, Scratch, ShadowPacket4};
use glam::{DVec2, DVec3};

/// A number for each of four places, far enough from the next four that the two are not read as one: what was just written
/// in two pieces is slow to read in one. For the same reason all that is told of four places stays where it is.
#[derive(Clone, Copy)]
#[repr(align(32))]
struct LaneValues([f32; 4]);

/// The colours of four places, channel by channel.
type RgbPacket = [LaneValues; 3];

/// What is seen at four places.
pub(in crate::render::shade) struct RadiancePacket4<'w> {
    rgb: RgbPacket,
    transmit: [f32; 4],
    /// At which of them it is known, one bit each.
    known: u32,
    /// At which of them it is known of the surface itself, which shows others.
    half_known: u32,
    coats: MaterialPacket4<'w>,
}

/// What is seen of a surface that shows others.
pub(in crate::render::shade) struct SecondarySurface<'w> {
    /// Its own light.
    pub(in crate::render::shade) own: Rgb,
    pub(in crate::render::shade) finish: &'w Finish,
    pub(in crate::render::shade) pigment: Rgb,
    /// The share of light that it lets through.
    pub(in crate::render::shade) through: Rgb,
}

/// Rays that see what is met at four places.
pub(in crate::render::shade) trait RaySource {
    /// Who looks in this lane.
    fn seen(&self, lane: usize) -> RayKind;
    /// Who looks in all lanes, if that is the same.
    fn all_seen(&self) -> Option<RayKind>;
    /// The interiors that the ray in this lane is in.
    fn inside(&self, lane: usize) -> &[InteriorId];
    /// The ray in this lane, which goes in this direction.
    fn path(&self, lane: usize, dir: DVec3) -> Path;
}

impl<'w> RadiancePacket4<'w> {
    pub(in crate::render::shade) const NOTHING: RadiancePacket4<'static> = RadiancePacket4 {
        rgb: BLACK,
        transmit: [0.0; 4],
        known: 0,
        half_known: 0,
        coats: MaterialPacket4::NOTHING,
    };

    /// Takes note of the same at all of these.
    #[inline(always)]
    fn see(&mut self, Sample { rgb, transmit }: Sample, known: u32) {
        self.rgb = all_of(rgb);
        self.transmit = [transmit; 4];
        self.known = known;
    }

    /// What is seen at one of them, if that is known.
    #[inline(always)]
    pub(in crate::render::shade) fn sample(&self, lane: usize) -> Option<Sample> {
        (self.known >> lane & 1 == 1).then(|| self.known(lane))
    }

    /// Whether it is known what is seen at so many of them from the first on.
    #[inline(always)]
    pub(in crate::render::shade) fn is_known(&self, count: usize) -> bool {
        self.known == (1 << count) - 1
    }

    /// What is seen at one of them where that is known.
    #[inline(always)]
    pub(in crate::render::shade) fn known(&self, lane: usize) -> Sample {
        Sample {
            rgb: one_of(&self.rgb, lane),
            transmit: self.transmit[lane],
        }
    }

    /// What is seen of a surface itself at one of them, if that shows others and is known.
    #[inline(always)]
    pub(in crate::render::shade) fn showing(&self, lane: usize) -> Option<SecondarySurface<'w>> {
        let coats = &self.coats;
        let finish = coats.finishes[lane].filter(|_| self.half_known >> lane & 1 == 1)?;
        Some(SecondarySurface {
            own: one_of(&self.rgb, lane),
            finish,
            pigment: one_of(&coats.rgb, lane),
            through: coats.through[lane],
        })
    }
}

/// The outermost layers at four hits.
struct MaterialPacket4<'w> {
    /// What they shine of themselves.
    own: RgbPacket,
    rgb: RgbPacket,
    /// How much of white light from straight above they scatter.
    diffuse: [f64; 4],
    finishes: [Option<&'w Finish>; 4],
    /// Which of them have highlights, and which a `brilliance`, one bit each.
    shiny: u32,
    brilliant: u32,
    /// Which of them show others, and the shares of light that these let through.
    showing: u32,
    through: [Rgb; 4],
    /// The lights that shine on all of them.
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
        showing: 0,
        through: [Rgb::BLACK; 4],
        lights: LightList::OUTSIDE,
    };
}

impl<'w> MaterialPacket4<'w> {
    /// Takes in the coat of one hit.
    #[inline(always)]
    fn put(&mut self, lane: usize, coat: &PlainMaterial, finish: Option<&'w Finish>) {
        put(&mut self.own, lane, coat.own);
        put(&mut self.rgb, lane, coat.rgb);
        self.diffuse[lane] = coat.diffuse;
        self.finishes[lane] = finish;
        self.shiny |= u32::from(coat.is_shiny) << lane;
        self.brilliant |= u32::from(coat.is_brilliant) << lane;
        if coat.shows_more {
            self.showing |= 1 << lane;
            self.through[lane] = coat.through;
        }
    }

    /// Takes in the coat that all four hits have.
    #[inline(always)]
    fn put_all(&mut self, coat: &PlainMaterial, finish: Option<&'w Finish>) {
        self.own = all_of(coat.own);
        self.rgb = all_of(coat.rgb);
        self.diffuse = [coat.diffuse; 4];
        self.finishes = [finish; 4];
        self.shiny = if coat.is_shiny { 0b1111 } else { 0 };
        self.brilliant = if coat.is_brilliant { 0b1111 } else { 0 };
        if coat.shows_more {
            self.showing = 0b1111;
            self.through = [coat.through; 4];
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

/// Calls `visit` with the number of each bit that is set.
#[inline(always)]
fn each_lane(mut bits: u32, mut visit: impl FnMut(usize)) {
    while bits != 0 {
        visit(bits.trailing_zeros() as usize % 4);
        bits &= bits - 1;
    }
}

impl<'w> Tracer<'w> {
    /// What rays see at the first `count` of these four places of a block, where that is plain, put into `seen`.
    #[inline(always)]
    pub(in crate::render::shade) fn shade_packet4(
        &self,
        rays: &(impl RaySource + ?Sized),
        (four, count): (usize, usize),
        all: &BlockHits,
        (scratch, kept): (&mut Scratch, &mut ShadeCache),
        seen: &mut RadiancePacket4<'w>,
    ) {
        (seen.known, seen.half_known) = (0, 0);
        if !self.takes_plain || self.stop.is_asked() {
            return;
        }
        let hits = &all.hits[four];
        let there = 0b1111 >> (4 - (count - 4 * four).min(4));
        let meets_nothing = there & hits.met == 0;
        if meets_nothing
            && self.world.sky.is_none()
            && !self.has_air()
            && let Some(who) = rays.all_seen()
        {
            seen.see(self.background_of(who).seen, there);
            return;
        }
        seen.transmit = [0.0; 4];
        each_lane(there & !hits.met, |lane| {
            let behind = self.background_radiance(hits.dir(lane), rays.seen(lane));
            put(&mut seen.rgb, lane, behind.rgb);
            seen.transmit[lane] = behind.transmit;
            seen.known |= 1 << lane;
        });
        if meets_nothing {
            self.attenuate(rays, hits, scratch, seen);
            return;
        }
        let mut lit = self.materials(hits, there & hits.met, kept, &mut seen.coats);
        let coats = &seen.coats;
        let mut sum = BLACK;
        let mut arriving = ArrivingLight { rgb: BLACK, lit: 0 };
        for &number in self.world.lights.of(coats.lights) {
            let ways = &all.ways[number as usize * all.hits.len() + four];
            let arrives = ways.asked & !ways.blocked;
            if self.minds_backs {
                each_lane(arrives, |lane| {
                    if ways.cosine[lane] < NOTHING {
                        lit &= !(1 << lane);
                    }
                });
            }
            let light = self.world.lights.get(number);
            let filtered = arrives & ways.filtered & lit;
            let free = arrives & !ways.filtered & lit;
            if free | filtered == 0 {
                continue;
            }
            arriving.come(light, ways, free);
            each_lane(filtered, |lane| {
                let of = (all, 4 * four + lane);
                let left = self.filtered(number, of, rays.inside(lane), scratch);
                arriving.take(lane, left);
            });
            add_light(&arriving, ways, hits, coats, &mut sum);
        }
        each_lane(lit, |lane| {
            let rgb = Rgb::BLACK + (one_of(&coats.own, lane) + one_of(&sum, lane));
            put(&mut seen.rgb, lane, rgb);
        });
        seen.known |= lit & !coats.showing;
        seen.half_known = lit & coats.showing;
        self.attenuate(rays, hits, scratch, seen);
    }

    /// Takes the air between into account where it is known what is seen.
    #[inline(always)]
    fn attenuate(
        &self,
        rays: &(impl RaySource + ?Sized),
        hits: &HitPacket4,
        scratch: &mut Scratch,
        seen: &mut RadiancePacket4<'w>,
    ) {
        if !self.has_air() {
            return;
        }
        each_lane(seen.known, |lane| {
            let air = self.air_before(hits, lane, || rays.path(lane, hits.dir(lane)), scratch);
            let Sample { rgb, transmit } = seen.known(lane).through(air);
            put(&mut seen.rgb, lane, rgb);
            seen.transmit[lane] = transmit;
        });
    }

    /// What the air does to light on its way from one of four hits, or from where nothing is met.
    #[inline]
    pub(in crate::render::shade) fn air_before(
        &self,
        hits: &HitPacket4,
        lane: usize,
        path: impl FnOnce() -> Path,
        scratch: &mut Scratch,
    ) -> Option<AirTint> {
        if !self.has_air() {
            return None;
        }
        let end = match hits.is_met(lane) {
            true => {
                let surface = &self.world.surfaces[hits.surface[lane] as usize];
                End::Surface(hits.t[lane], surface.lights)
            }
            false => End::Nothing,
        };
        self.air(&path(), end, scratch)
    }

    /// What is left of the light of this number at a place behind all that filters it on its way.
    #[inline(never)]
    fn filtered(
        &self,
        number: u32,
        (all, place): (&BlockHits, usize),
        inside: &[InteriorId],
        scratch: &mut Scratch,
    ) -> Rgb {
        let (hits, lane) = (&all.hits[place / 4], place % 4);
        let ways = &all.ways[number as usize * all.hits.len() + place / 4];
        let arriving = self.world.lights.get(number).color * ways.share[lane];
        if is_nothing(arriving) {
            return Rgb::BLACK;
        }
        let way = ShadowPath {
            light: number,
            query: ways.query(hits, lane),
            distance: ways.distance[lane],
            known: if all.knows_ways { ways.way(lane) } else { None },
            inside,
            collects: false,
        };
        self.transmittance(arriving, &way, scratch)
    }

    /// Puts the layers at these of four hits into `coats`. Gives those of them at which diffuse light and highlights are all
    /// that there is, one bit each.
    #[inline(always)]
    fn materials(
        &self,
        hits: &HitPacket4,
        asked: u32,
        kept: &mut ShadeCache,
        coats: &mut MaterialPacket4<'w>,
    ) -> u32 {
        let first = hits.surface[asked.trailing_zeros() as usize % 4];
        coats.lights = self.world.surfaces[first as usize].lights;
        (coats.shiny, coats.brilliant, coats.showing) = (0, 0, 0);
        if asked == 0b1111
            && hits.surface == [first; 4]
            && let Some(coat) = kept.known(first)
        {
            coats.put_all(coat, self.finish_of(first, coat));
            return asked;
        }
        let mut plain = 0;
        each_lane(
            asked,
            #[inline(always)]
            |lane| {
                let number = hits.surface[lane];
                let coat = kept.of(
                    number,
                    #[inline(always)]
                    || self.material_at(hits, lane),
                );
                if let Some(coat) = coat
                    && coat.lights == coats.lights
                {
                    coats.put(lane, coat, self.finish_of(number, coat));
                    plain |= 1 << lane;
                }
            },
        );
        plain
    }

    /// The finish of a surface, where it matters besides what the coat tells.
    #[inline(always)]
    fn finish_of(&self, surface: u32, coat: &PlainMaterial) -> Option<&'w Finish> {
        if !coat.is_shiny && !coat.is_brilliant && !coat.shows_more {
            return None;
        }
        let layers = self.world.surfaces[surface as usize].texture.layers();
        layers.first().map(|layer| &*layer.finish)
    }

    /// The layer at one of four hits, if it is plain, and whether it is so everywhere on its surface.
    #[inline(never)]
    fn material_at(&self, hits: &HitPacket4, lane: usize) -> (Option<PlainMaterial>, bool) {
        let surface = &self.world.surfaces[hits.surface[lane] as usize];
        let mut has_one_color = false;
        let coat = self.plain_coat(surface, |pigment| {
            has_one_color = matches!(pigment, PreparedPigment::Plain(_));
            pigment.color(&SurfacePoint {
                point: hits.point(lane),
                normal: hits.facing(lane),
                dir: hits.dir(lane),
                uv: DVec2::ZERO,
            })
        });
        (coat, has_one_color)
    }
}

/// The light of one lamp that arrives at four hits.
struct ArrivingLight {
    rgb: RgbPacket,
    /// At which of them any arrives, one bit each.
    lit: u32,
}

impl ArrivingLight {
    /// Becomes the light of a lamp, of which nothing is stopped on its way to these hits.
    #[inline(always)]
    fn come(&mut self, light: &Light, ways: &ShadowPacket4, free: u32) {
        self.rgb = all_of(light.color);
        self.lit = if is_nothing(light.color) { 0 } else { free };
        if !light.has_even_share() {
            each_lane(free, |lane| self.take(lane, light.color * ways.share[lane]));
        }
    }

    /// Takes what arrives at one of them.
    #[inline(always)]
    fn take(&mut self, lane: usize, rgb: Rgb) {
        put(&mut self.rgb, lane, rgb);
        self.lit = self.lit & !(1 << lane) | u32::from(!is_nothing(rgb)) << lane;
    }
}

/// What is viewed at one of four hits.
#[inline(always)]
pub(in crate::render::shade) fn viewed(hits: &HitPacket4, lane: usize) -> ViewPoint {
    ViewPoint {
        point: hits.point(lane),
        normal: hits.facing(lane),
        view: hits.dir(lane),
    }
}

/// Adds the light of one lamp that arrives at these hits.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision, as in POV-Ray"
)]
fn add_light(
    arriving: &ArrivingLight,
    ways: &ShadowPacket4,
    hits: &HitPacket4,
    coats: &MaterialPacket4,
    sum: &mut RgbPacket,
) {
    let mut strength = [0.0; 4];
    for (lane, strength) in strength.iter_mut().enumerate() {
        *strength = coats.diffuse[lane] * ways.cosine[lane];
    }
    each_lane(arriving.lit & coats.brilliant, |lane| {
        if let Some(finish) = coats.finishes[lane] {
            let brilliance = f64::from(finish.brilliance);
            let cosine = exact_power(ways.cosine[lane].abs(), brilliance);
            strength[lane] = coats.diffuse[lane] * cosine;
        }
    });
    let mut given = BLACK;
    let tints = coats.rgb.iter().zip(&arriving.rgb);
    for (given, (rgb, arriving)) in given.iter_mut().zip(tints) {
        for (lane, given) in given.0.iter_mut().enumerate() {
            let tinted = rgb.0[lane] * arriving.0[lane];
            let scattered = (f64::from(tinted) * strength[lane]) as f32;
            *given = if coats.diffuse[lane] != 0.0 {
                scattered
            } else {
                0.0
            };
        }
    }
    let shining = arriving.lit & coats.shiny;
    if shining == 0 {
        add(&given, arriving.lit, sum);
        return;
    }
    each_lane(shining, |lane| {
        let Some(finish) = coats.finishes[lane] else {
            return;
        };
        let strength = highlight(finish, &viewed(hits, lane), ways.to_light(lane));
        if strength != 0.0 {
            let pigment = one_of(&coats.rgb, lane);
            let shine = metallic(finish.metallic, pigment, ways.cosine[lane]);
            let shine = one_of(&arriving.rgb, lane) * shine * strength;
            let both = one_of(&given, lane) + shine;
            put(&mut given, lane, both);
        }
    });
    add(&given, arriving.lit, sum);
}

/// Adds the light given by those that are lit.
#[inline(always)]
fn add(given: &RgbPacket, lit: u32, sum: &mut RgbPacket) {
    for (sum, given) in sum.iter_mut().zip(given) {
        for (lane, sum) in sum.0.iter_mut().enumerate() {
            let is_lit = lit >> lane & 1 == 1;
            *sum += if is_lit { given.0[lane] } else { 0.0 };
        }
    }
}
