//! The light of lamps of one point at all points of a block that the camera sees, and what stands in its way: four points
//! at a time, the ways to the lamp in an order in which neighbours have much in common.

use super::light::{MOST_TILTED, NOTHING};
use crate::base::math::rounding::nearest;
use crate::base::math::simd::vec3::{
    Vec3Lanes, add, divide, dot, from_arrays, scale, splat, sub, to_arrays,
};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel, with_widest};
use crate::render::shade::Tracer;
use crate::scene::light::{Arrival, Light};
use crate::world::{HitPacket4, Occlusion, Scratch, ShadowPacket4, Surface};
use glam::DVec3;

/// So many points are lit together.
const LIT_TOGETHER: usize = 64;
/// Points that change from object to object more often than each time after so many are lit in the order in which the
/// light sees them.
const SORTED_BELOW: usize = 12;
/// After points that had nothing in common so many times as many are not expected to have.
const TAKEN_APART: usize = 3;
/// The number of cells on each axis by which a light tells points apart.
const CELLS: usize = 32;
const LAST_CELL: f32 = 31.0;
/// One in so many points tells how far all of them reach.
const SOME: usize = 7;

/// What is met by many rays, and how light comes there.
#[derive(Debug, Default)]
pub(in crate::render::shade) struct BlockHits {
    /// What they meet, four by four.
    pub(in crate::render::shade) hits: Vec<HitPacket4>,
    /// The ways from there to the lights, light by light.
    pub(in crate::render::shade) ways: Vec<ShadowPacket4>,
    /// Whether it is known what lies on the ways; otherwise those that matter are noted as filtered.
    pub(in crate::render::shade) knows_ways: bool,
    order: LightSortedOrder,
}

/// The order in which a light is asked about the points of a block.
#[derive(Debug, Default)]
struct LightSortedOrder {
    /// The places that it may light, in the order of the block.
    asked: Vec<u16>,
    /// Where the light sees each of all places, to the right and upwards: four by four.
    seen: Vec<[[f32; 4]; 2]>,
    /// The cell in which it sees each that is asked about.
    cells: Vec<u16>,
    /// How many it sees in each cell, or where those of the cell begin.
    counts: Vec<u16>,
    /// The places in the order in which the light sees them.
    sorted: Vec<u16>,
    answers: Vec<Occlusion>,
}

/// The light of a lamp on its way to four hits.
struct LightPacket<'a> {
    centre: DVec3,
    hits: &'a HitPacket4,
}

/// How it arrives, with bits by ray.
struct ArrivedLight {
    to_light: [[f64; 4]; 3],
    distance: [f64; 4],
    cosine: [f64; 4],
    /// The largest coordinate where the ray to the light ends, or the distance where that is more.
    size: [f64; 4],
    /// Who goes to the outer side of the surface.
    goes_out: u32,
    /// Whose numbers need no care.
    sure: u32,
    /// On whose side of the surface it arrives.
    faces: u32,
    /// On whose side it may be tilted by bumps.
    nearly_faces: u32,
}

impl SimdKernel for LightPacket<'_> {
    type Output = ArrivedLight;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> ArrivedLight {
        let point: Vec3Lanes<F> = from_arrays(&self.hits.point);
        let offset = sub(splat(self.centre), point);
        let distance = dot(offset, offset).sqrt();
        let to_light = divide(offset, distance);
        let cosine = dot(from_arrays(&self.hits.facing), to_light);
        let end = add(point, scale(to_light, distance));
        let [x, y, z] = [end[0].abs(), end[1].abs(), end[2].abs()];
        let is_finite = (x + y + z).lt(F::splat(f64::INFINITY));
        ArrivedLight {
            to_light: to_arrays(to_light),
            distance: distance.to_array(),
            cosine: cosine.to_array(),
            size: x.lane_max(y).lane_max(z).lane_max(distance).to_array(),
            goes_out: F::bitmask(F::splat(0.0).lt(dot(from_arrays(&self.hits.normal), to_light))),
            sure: F::bitmask(is_finite),
            faces: F::bitmask(F::splat(NOTHING).le(cosine)),
            nearly_faces: F::bitmask(F::splat(MOST_TILTED).lt(cosine)),
        }
    }
}

impl Tracer<'_> {
    /// Finds out for the first `count` of these hits what light arrives from each lamp of one point, and, if `asks`, what
    /// is in its way.
    pub(in crate::render::shade) fn light_all(
        &self,
        count: usize,
        asks: bool,
        all: &mut BlockHits,
        scratch: &mut Scratch,
    ) {
        all.knows_ways = asks;
        let lights = &self.world.lights;
        if !self.quality.has_shadows || !self.quality.has_light {
            all.ways.clear();
            return;
        }
        let fours = all.hits.len();
        all.ways
            .resize(lights.len() * fours, ShadowPacket4::NOTHING);
        for ways in &mut all.ways {
            ways.forget();
        }
        for number in (0u32..).take(lights.len()) {
            let light = lights.get(number);
            let is_one_point = light.area.is_none() && !light.is_parallel;
            if is_one_point && !light.is_shadowless() && !lights.is_projected(number) {
                if asks {
                    self.light_up_block((number, light), count, all, scratch);
                } else {
                    self.light_up_unasked((number, light), count, all);
                }
            }
        }
    }

    fn light_up_block(
        &self,
        (number, light): (u32, &Light),
        count: usize,
        all: &mut BlockHits,
        single: &mut Scratch,
    ) {
        let BlockHits {
            hits, ways, order, ..
        } = all;
        let ways = &mut ways[number as usize * hits.len()..][..hits.len()];
        if self.world.knows_around(number) {
            let lit = (&**hits, ways, count);
            self.light_up_around((number, light), lit, single);
            return;
        }
        order.asked.clear();
        let mut sum = DVec3::ZERO;
        let mut changes = 0;
        with_widest(
            #[inline(always)]
            |lanes| {
                let mut last = u32::MAX;
                for (at, (hits, ways)) in hits.iter().zip(&mut *ways).enumerate() {
                    let there = (count - 4 * at).min(4);
                    let mut asked = self.light_four(lanes, (number, light), hits, ways);
                    asked &= 0b1111 >> (4 - there);
                    while asked != 0 {
                        let lane = asked.trailing_zeros() as usize % 4;
                        asked &= asked - 1;
                        #[allow(
                            clippy::cast_possible_truncation,
                            reason = "a block has few places"
                        )]
                        order.asked.push((4 * at + lane) as u16);
                        changes += usize::from(hits.leaf[lane] != last);
                        last = hits.leaf[lane];
                        sum += ways.to_light(lane);
                    }
                }
                let jumps = changes * SORTED_BELOW >= order.asked.len();
                match sum.try_normalize().filter(|_| jumps) {
                    Some(axis) => order.sort(lanes, axis, ways),
                    None => order.sorted.clone_from(&order.asked),
                }
            },
        );
        order.answers.clear();
        let mut apart = 0;
        for places in order.sorted.chunks(LIT_TOGETHER) {
            let rays = (&**hits, &*ways);
            let answers = &mut order.answers;
            let centre = (apart == 0).then_some(light.centre);
            let has_paid = self
                .world
                .occlusion_bundle(places, rays, centre, single, answers);
            apart = match centre {
                None => apart - 1,
                Some(_) if has_paid => 0,
                Some(_) => TAKEN_APART,
            };
        }
        for (&place, way) in order.sorted.iter().zip(&order.answers) {
            let place = usize::from(place);
            ways[place / 4].note(place % 4, *way);
        }
    }

    /// The same without asking what is in the way.
    fn light_up_unasked(&self, (number, light): (u32, &Light), count: usize, all: &mut BlockHits) {
        let ways = &mut all.ways[number as usize * all.hits.len()..][..all.hits.len()];
        with_widest(
            #[inline(always)]
            |lanes| {
                for (at, (hits, ways)) in all.hits.iter().zip(ways).enumerate() {
                    let asked = self.light_four(lanes, (number, light), hits, ways);
                    for lane in (0..(count - 4 * at).min(4)).filter(|lane| asked >> lane & 1 == 1) {
                        ways.note(lane, Occlusion::Transmissive);
                    }
                }
            },
        );
    }

    /// The same where it is known what lies around the lamp.
    fn light_up_around(
        &self,
        light: (u32, &Light),
        (hits, ways, count): (&[HitPacket4], &mut [ShadowPacket4], usize),
        scratch: &mut Scratch,
    ) {
        with_widest(
            #[inline(always)]
            |lanes| {
                for (number, (hits, ways)) in hits.chunks(2).zip(ways.chunks_mut(2)).enumerate() {
                    let mut asked = 0;
                    for (half, (hits, ways)) in hits.iter().zip(&mut *ways).enumerate() {
                        asked |= self.light_four(lanes, light, hits, ways) << (4 * half);
                    }
                    let there = (count - 8 * number).min(8);
                    asked &= 0xff >> (8 - there);
                    if asked != 0 {
                        let asked = (asked, light.0);
                        self.world
                            .occlusion_packet8(lanes, (hits, ways), asked, scratch);
                    }
                }
            },
        );
    }

    /// How light arrives at four hits. Gives those whose way is to be asked about, one bit each.
    #[inline(always)]
    fn light_four(
        &self,
        lanes: SimdLevel,
        (number, light): (u32, &Light),
        hits: &HitPacket4,
        ways: &mut ShadowPacket4,
    ) -> u32 {
        if hits.met == 0 {
            return 0;
        }
        let arriving = LightPacket {
            centre: light.centre,
            hits,
        };
        let arrived = lanes.run(arriving);
        ways.to_light = arrived.to_light;
        ways.distance = arrived.distance;
        ways.cosine = arrived.cosine;
        ways.share = [1.0; 4];
        ways.goes_out = arrived.goes_out;
        ways.far = self.world.reach_of_four(&arrived.distance, &arrived.size);
        let mut asked = hits.met & arrived.faces;
        if self.minds_surfaces || !self.world.lights.shines_on_all(number) {
            asked = self.minded(number, hits, &arrived);
        }
        let mut left = if light.has_even_share() {
            asked & !arrived.sure
        } else {
            asked
        };
        while left != 0 {
            let lane = left.trailing_zeros() as usize % 4;
            left &= left - 1;
            let arrival = Arrival {
                to_light: ways.to_light(lane),
                distance: ways.distance[lane],
            };
            let point = hits.point(lane);
            ways.share[lane] = light.share(point, &arrival);
            let end = point + arrival.distance * arrival.to_light;
            ways.far[lane] = self.world.shadow_t_max(end, arrival.distance);
            if ways.share[lane] == 0.0 {
                asked &= !(1 << lane);
            }
        }
        asked
    }

    /// The hits to which the light of a lamp matters, where surfaces differ in that, one bit each.
    #[inline(never)]
    fn minded(&self, number: u32, hits: &HitPacket4, arrived: &ArrivedLight) -> u32 {
        let mut asked = 0;
        let mut last = None;
        for lane in (0..4).filter(|&lane| hits.is_met(lane)) {
            let met = hits.surface[lane];
            let lit = match last {
                Some((surface, lit)) if surface == met => lit,
                _ => self.lit_lanes(number, &self.world.surfaces[met as usize], arrived),
            };
            last = Some((met, lit));
            asked |= lit & 1 << lane;
        }
        asked
    }

    /// Mask of the lanes in which a surface with this material can receive the light.
    #[inline(always)]
    fn lit_lanes(&self, number: u32, surface: &Surface, arrived: &ArrivedLight) -> u32 {
        if !surface.takes_light() || !self.world.lights.of(surface.lights).contains(&number) {
            return 0;
        }
        if surface.is_lit_from_behind() {
            return 0b1111;
        }
        let nearly_faces = match surface.is_bumpy() {
            true => arrived.nearly_faces,
            false => 0,
        };
        arrived.faces | nearly_faces
    }
}

/// Where a light sees four directions to it.
struct ViewFromLight<'a> {
    ways: &'a ShadowPacket4,
    across: DVec3,
    up: DVec3,
}

impl SimdKernel for ViewFromLight<'_> {
    type Output = [[f64; 4]; 2];

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> [[f64; 4]; 2] {
        let to_light: Vec3Lanes<F> = from_arrays(&self.ways.to_light);
        [
            dot(to_light, splat(self.across)).to_array(),
            dot(to_light, splat(self.up)).to_array(),
        ]
    }
}

impl LightSortedOrder {
    /// Brings the places that are asked about into the order in which the light sees them; `axis` is a unit direction
    /// to it.
    #[inline(always)]
    fn sort(&mut self, lanes: SimdLevel, axis: DVec3, ways: &[ShadowPacket4]) {
        let (across, up) = axis.any_orthonormal_pair();
        self.seen.clear();
        for ways in ways {
            let seen = lanes.run(ViewFromLight { ways, across, up });
            // Spelt out: `map` is not always inlined.
            let mut rounded = [[0.0; 4]; 2];
            for axis in 0..2 {
                for lane in 0..4 {
                    rounded[axis][lane] = nearest(seen[axis][lane]);
                }
            }
            self.seen.push(rounded);
        }
        let seen = |place: u16| {
            let [x, y] = &self.seen[usize::from(place) / 4];
            let lane = usize::from(place) % 4;
            [x[lane], y[lane]]
        };
        // A few of them tell about how far all reach.
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for &place in self.asked.iter().step_by(SOME) {
            for (axis, x) in seen(place).into_iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        let scale = [0, 1].map(|axis| LAST_CELL / (high[axis] - low[axis]).max(f32::MIN_POSITIVE));
        // Counting sort: how many lie in each cell, where each cell begins, and then all into their places.
        self.counts.clear();
        self.counts.resize(CELLS * CELLS, 0);
        self.cells.clear();
        for &place in &self.asked {
            let [x, y] = seen(place);
            let column = cell_of((x - low[0]) * scale[0]);
            let row = cell_of((y - low[1]) * scale[1]);
            let cell = SPREAD[column] | SPREAD[row] << 1;
            self.cells.push(cell);
            self.counts[usize::from(cell)] += 1;
        }
        let mut next = 0;
        for count in &mut self.counts {
            (*count, next) = (next, next + *count);
        }
        self.sorted.resize(self.asked.len(), 0);
        for (&place, &cell) in self.asked.iter().zip(&self.cells) {
            let next = &mut self.counts[usize::from(cell)];
            self.sorted[usize::from(*next)] = place;
            *next += 1;
        }
    }
}

/// The cell of a number on one axis; the first or the last for what lies outside.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a number from nothing to 31"
)]
fn cell_of(x: f32) -> usize {
    let x = if x > 0.0 { x } else { 0.0 };
    (if x < LAST_CELL { x } else { LAST_CELL }) as usize % CELLS
}

/// The numbers below [`CELLS`] with their bits spread so that those of another fit between: cells in the order of
/// Morton keep neighbours together.
const SPREAD: [u16; CELLS] = {
    let mut spread = [0; CELLS];
    let mut number = 1;
    while number < CELLS {
        spread[number] = spread[number / 2] << 2 | [0, 1][number % 2];
        number += 1;
    }
    spread
};
