//! The short way to a colour ([`super::plain`]) for four places of a block at once, and for what a mirror shows itself. A
//! place that needs more than diffuse light and highlights is left to the way for single ones.

use super::coats::PlainCoat;
use super::light::{NOTHING, Viewed, highlight, is_nothing, metallic};
use super::shadows::Together;
use super::{Sample, Tracer};
use crate::color::Rgb;
use crate::compile::{FourHits, FourWays, LightList, Seen, Way};
use crate::light::Light;
use crate::pattern::Spot;
use crate::texture::Finish;
use glam::DVec2;

/// What is seen at four places.
pub(super) struct FourSeen<'w> {
    rgb: [[f32; 4]; 3],
    transmit: [f32; 4],
    /// At which of them it is known, one bit each.
    known: u32,
    /// At which of them it is known but for a mirror image.
    mirrors: u32,
    /// The colours of pigments and the finishes of these.
    pigment: [[f32; 4]; 3],
    finishes: [Option<&'w Finish>; 4],
}

impl<'w> FourSeen<'w> {
    const NOTHING: FourSeen<'static> = FourSeen {
        rgb: [[0.0; 4]; 3],
        transmit: [0.0; 4],
        known: 0,
        mirrors: 0,
        pigment: [[0.0; 4]; 3],
        finishes: [None; 4],
    };

    /// The same at all of these.
    #[inline(always)]
    fn alike(Sample { rgb, transmit }: Sample, known: u32) -> FourSeen<'w> {
        FourSeen {
            rgb: [[rgb.r; 4], [rgb.g; 4], [rgb.b; 4]],
            transmit: [transmit; 4],
            known,
            ..FourSeen::NOTHING
        }
    }

    /// What is seen at one of them, if that is known.
    #[inline(always)]
    pub(super) fn sample(&self, lane: usize) -> Option<Sample> {
        (self.known >> lane & 1 == 1).then(|| Sample {
            rgb: one_of(&self.rgb, lane),
            transmit: self.transmit[lane],
        })
    }

    /// What is seen of a mirror at one of them without its image, if there is one and that is known, the finish and the
    /// colour of the pigment.
    #[inline(always)]
    pub(super) fn mirror(&self, lane: usize) -> Option<(Rgb, &'w Finish, Rgb)> {
        let finish = self.finishes[lane].filter(|_| self.mirrors >> lane & 1 == 1)?;
        Some((one_of(&self.rgb, lane), finish, one_of(&self.pigment, lane)))
    }
}

/// The outermost layers at four hits.
struct FourCoats<'w> {
    /// What they shine of themselves.
    own: [[f32; 4]; 3],
    rgb: [[f32; 4]; 3],
    /// How much of white light from straight above they scatter.
    diffuse: [f64; 4],
    finishes: [Option<&'w Finish>; 4],
    /// Which of them have highlights, one bit each.
    shiny: u32,
    /// Which of them have mirror images.
    mirrors: u32,
    /// The lights that shine on all of them.
    lights: LightList,
}

#[inline(always)]
fn one_of(of: &[[f32; 4]; 3], lane: usize) -> Rgb {
    Rgb::new(of[0][lane], of[1][lane], of[2][lane])
}

#[inline(always)]
fn put(to: &mut [[f32; 4]; 3], lane: usize, rgb: Rgb) {
    for (to, channel) in to.iter_mut().zip([rgb.r, rgb.g, rgb.b]) {
        to[lane] = channel;
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
    /// What such rays see at the first `count` of these four places of a block, where that is plain.
    #[inline(always)]
    pub(super) fn plain_four(
        &self,
        kind: Seen,
        four: usize,
        count: usize,
        together: &Together,
    ) -> FourSeen<'w> {
        let mut seen = FourSeen::NOTHING;
        if !self.takes_plain || self.stop.is_asked() {
            return seen;
        }
        let hits = &together.hits[four];
        let there = 0b1111 >> (4 - count.min(4));
        if there & hits.met == 0 && self.world.sky.is_none() {
            return FourSeen::alike(self.background_of(kind).seen, there);
        }
        each_lane(there & !hits.met, |lane| {
            let behind = self.behind_everything(hits.dir(lane), kind);
            put(&mut seen.rgb, lane, behind.rgb);
            seen.transmit[lane] = behind.transmit;
            seen.known |= 1 << lane;
        });
        if there & hits.met == 0 {
            return seen;
        }
        let (coats, mut lit) = self.coats(hits, there & hits.met);
        let mut sum = [[0.0; 4]; 3];
        for &number in self.world.lights.of(coats.lights) {
            let ways = &together.ways[number as usize * together.hits.len() + four];
            let mut free = 0;
            for (lane, way) in ways.ways.iter().enumerate() {
                let is_lit_from_behind = || self.minds_backs && ways.cosine[lane] < NOTHING;
                match way {
                    Some(Way::Free) if !is_lit_from_behind() => free |= 1 << lane,
                    Some(Way::Free | Way::Filtered) => lit &= !(1 << lane),
                    Some(Way::Blocked) | None => {}
                }
            }
            if free & lit != 0 {
                let light = self.world.lights.get(number);
                add_light(light, ways, hits, &coats, free & lit, &mut sum);
            }
        }
        each_lane(lit, |lane| {
            let rgb = Rgb::BLACK + (one_of(&coats.own, lane) + one_of(&sum, lane));
            put(&mut seen.rgb, lane, rgb);
        });
        seen.known |= lit & !coats.mirrors;
        seen.mirrors = lit & coats.mirrors;
        if seen.mirrors != 0 {
            seen.pigment = coats.rgb;
            seen.finishes = coats.finishes;
        }
        seen
    }

    /// The layers at these of four hits, and at which of them diffuse light and highlights are all that there is.
    #[inline(always)]
    fn coats(&self, hits: &FourHits, asked: u32) -> (FourCoats<'w>, u32) {
        let first = hits.surface[asked.trailing_zeros() as usize % 4];
        let mut coats = FourCoats {
            own: [[0.0; 4]; 3],
            rgb: [[0.0; 4]; 3],
            diffuse: [0.0; 4],
            finishes: [None; 4],
            shiny: 0,
            mirrors: 0,
            lights: self.world.surfaces[first as usize].lights,
        };
        let mut plain = 0;
        each_lane(
            asked,
            #[inline(always)]
            |lane| {
                let number = hits.surface[lane] as usize;
                let known = self.coats.get(number).copied().flatten();
                let coat = match known.or_else(|| self.coat_at(hits, lane)) {
                    Some(coat) if coat.lights == coats.lights => coat,
                    _ => return,
                };
                put(&mut coats.own, lane, coat.own);
                put(&mut coats.rgb, lane, coat.rgb);
                coats.diffuse[lane] = coat.diffuse;
                coats.finishes[lane] = Some(coat.finish);
                coats.shiny |= u32::from(coat.is_shiny) << lane;
                coats.mirrors |= u32::from(coat.is_mirror) << lane;
                plain |= 1 << lane;
            },
        );
        (coats, plain)
    }

    /// The layer at one of four hits, if it is plain.
    #[inline(never)]
    fn coat_at(&self, hits: &FourHits, lane: usize) -> Option<PlainCoat<'w>> {
        let surface = &self.world.surfaces[hits.surface[lane] as usize];
        self.plain_coat(surface, |pigment| {
            pigment.color(&Spot {
                point: hits.point(lane),
                normal: hits.facing(lane),
                dir: hits.dir(lane),
                uv: DVec2::ZERO,
            })
        })
    }
}

/// Adds the light of one lamp, of which nothing is stopped on its way to these hits.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision, as in POV-Ray"
)]
fn add_light(
    light: &Light,
    ways: &FourWays,
    hits: &FourHits,
    coats: &FourCoats,
    mut lit: u32,
    sum: &mut [[f32; 4]; 3],
) {
    let mut arriving = [[light.color.r; 4], [light.color.g; 4], [light.color.b; 4]];
    if light.has_even_share() {
        if is_nothing(light.color) {
            return;
        }
    } else {
        each_lane(lit, |lane| {
            let share = light.color * ways.share[lane];
            put(&mut arriving, lane, share);
            lit &= !(u32::from(is_nothing(share)) << lane);
        });
    }
    let mut strength = [0.0; 4];
    for (lane, strength) in strength.iter_mut().enumerate() {
        *strength = coats.diffuse[lane] * ways.cosine[lane];
    }
    let mut given = [[0.0; 4]; 3];
    for channel in 0..3 {
        for lane in 0..4 {
            let tinted = coats.rgb[channel][lane] * arriving[channel][lane];
            let scattered = (f64::from(tinted) * strength[lane]) as f32;
            given[channel][lane] = if coats.diffuse[lane] != 0.0 {
                scattered
            } else {
                0.0
            };
        }
    }
    each_lane(lit & coats.shiny, |lane| {
        let Some(finish) = coats.finishes[lane] else {
            return;
        };
        let at = Viewed {
            point: hits.point(lane),
            normal: hits.facing(lane),
            view: hits.dir(lane),
        };
        let strength = highlight(finish, &at, ways.to_light(lane));
        if strength != 0.0 {
            let pigment = one_of(&coats.rgb, lane);
            let shine = metallic(finish.metallic, pigment, ways.cosine[lane]);
            let shine = one_of(&arriving, lane) * shine * strength;
            let both = one_of(&given, lane) + shine;
            put(&mut given, lane, both);
        }
    });
    for channel in 0..3 {
        for lane in 0..4 {
            let given = if lit >> lane & 1 == 1 {
                given[channel][lane]
            } else {
                0.0
            };
            sum[channel][lane] += given;
        }
    }
}
