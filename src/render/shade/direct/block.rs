//! Direct light for a block of hits: point lights and their shadow rays, four hits at a time. Shadow rays are sorted so
//! that neighbours in a bundle share most of their traversal.

use super::area::is_its_own_mean;
use super::block_hits::{BlockHits, LightSortedOrder};
use crate::base::math::conditioning::Normalization;
use crate::base::math::rounding::nearest;
use crate::base::math::simd::vec3::{
    Vec3Lanes, add, dot, from_arrays, scale, splat, sub, to_arrays,
};
use crate::base::math::simd::{F64Lanes, SimdKernel, SimdLevel, with_widest};
use crate::render::shade::bsdf::{MAX_TILTED, NEGLIGIBLE, is_negligible};
use crate::render::shade::{Scratch, Tracer};
use crate::scene::light::{Area, Arrival, Light};
use crate::world::{HitPacket4, LightArea, Occlusion, ShadowPacket4, Surface};
use glam::DVec3;

/// The number of shadow rays in a bundle.
const BUNDLE_RAYS: usize = 64;
/// Hits are sorted by their direction from the light if the primitive changes more often than once in this many hits.
const SORT_THRESHOLD: usize = 12;
/// After a bundle without shared traversal, this many times as many rays are traced without bundling.
const UNBUNDLED: usize = 3;
/// Cells per axis of the sorting grid.
const CELLS: usize = 32;
const LAST_CELL: f32 = 31.0;
/// One in this many hits is used to estimate the bounds of all.
const BOUNDS_STEP: usize = 7;

/// Sets up shadow rays from four hits to a light.
struct LightPacket<'a> {
    centre: DVec3,
    normalization: Normalization,
    hits: &'a HitPacket4,
}

/// The light that arrives at four hits; masks have one bit per lane.
struct ArrivedLight {
    to_light: [[f64; 4]; 3],
    distance: [f64; 4],
    cosine: [f64; 4],
    /// The largest coordinate of the shadow ray's end, or its length if that is more.
    size: [f64; 4],
    /// Lanes whose shadow ray leaves on the outer side of the surface.
    goes_out: u32,
    /// Lanes whose numbers are finite, so that the fast path holds.
    is_finite: u32,
    /// Lanes whose surface faces the light.
    faces: u32,
    /// Lanes whose surface may face the light after bump mapping.
    nearly_faces: u32,
}

impl SimdKernel for LightPacket<'_> {
    type Output = ArrivedLight;

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> ArrivedLight {
        let point: Vec3Lanes<F> = from_arrays(&self.hits.point);
        let offset = sub(splat(self.centre), point);
        let distance = dot(offset, offset).sqrt();
        let to_light = self.normalization.divided_lanes(offset, distance);
        let cosine = dot(from_arrays(&self.hits.facing), to_light);
        let end = add(point, scale(to_light, distance));
        let [x, y, z] = [end[0].abs(), end[1].abs(), end[2].abs()];
        let finite = (x + y + z).lt(F::splat(f64::INFINITY));
        ArrivedLight {
            to_light: to_arrays(to_light),
            distance: distance.to_array(),
            cosine: cosine.to_array(),
            size: x.lane_max(y).lane_max(z).lane_max(distance).to_array(),
            goes_out: F::bitmask(F::splat(0.0).lt(dot(from_arrays(&self.hits.normal), to_light))),
            is_finite: F::bitmask(finite),
            faces: F::bitmask(F::splat(NEGLIGIBLE).le(cosine)),
            nearly_faces: F::bitmask(F::splat(MAX_TILTED).lt(cosine)),
        }
    }
}

impl Tracer<'_> {
    /// Sets up the shadow rays of the first `count` hits to each point light, and traces them if `traces`.
    pub(in crate::render::shade) fn light_all(
        &self,
        count: usize,
        traces: bool,
        all: &mut BlockHits,
        scratch: &mut Scratch,
    ) {
        all.has_occlusion = traces;
        let lights = &self.world.lights;
        if !self.quality.has_shadows || !self.quality.has_light {
            all.shadow_rays.clear();
            return;
        }
        let packets = all.hits.len();
        all.shadow_rays
            .resize(lights.len() * packets, ShadowPacket4::NOTHING);
        for shadow_rays in &mut all.shadow_rays {
            shadow_rays.reset_occlusion();
        }
        for number in (0u32..).take(lights.len()) {
            let light = lights.get(number);
            if light.is_parallel || light.is_shadowless() || lights.is_projected(number) {
                continue;
            }
            match &light.area {
                Some(area) if self.is_tested_by_beams(number, area) => {
                    self.set_up_area_light(number, light, area, count, all, scratch);
                }
                Some(_) => {}
                None if traces => self.light_block(number, light, count, all, scratch),
                None => self.set_up_block(number, light, count, all),
            }
        }
    }

    /// True if an area light is tested for whole packets of hits.
    fn is_tested_by_beams(&self, number: u32, area: &Area) -> bool {
        !area.has_area_illumination
            && self.quality.has_area_lights
            && !self.features.has_media
            && !self.is_attenuated_by_atmosphere(number)
    }

    /// Sets up the shadow rays of a block to the centre of an area light. Hits to which all of its light arrives are
    /// marked as clear, others that it may reach as filtered.
    fn set_up_area_light(
        &self,
        number: u32,
        light: &Light,
        area: &Area,
        count: usize,
        all: &mut BlockHits,
        scratch: &mut Scratch,
    ) {
        let BlockHits {
            hits, shadow_rays, ..
        } = all;
        let shadow_rays = &mut shadow_rays[number as usize * hits.len()..][..hits.len()];
        let light_area = LightArea::of(light, area, &area.axes);
        let samples = area.initial_grid_lights().len() as u64;
        self.set_up_pairs(
            number,
            light,
            hits,
            shadow_rays,
            count,
            #[inline(always)]
            |lanes, hits, shadow_rays, active| {
                let (mut lit, mut even) = (0, 0);
                for ray in (0..8).filter(|ray| active >> ray & 1 == 1) {
                    let arriving = light.color * shadow_rays[ray / 4].share[ray % 4];
                    lit |= u32::from(!is_negligible(arriving)) << ray;
                    even |= u32::from(is_its_own_mean(arriving)) << ray;
                }
                let clear = match area.is_oriented {
                    true => 0,
                    false => self.world.lanes_without_blockers(
                        lanes,
                        hits,
                        lit & even,
                        &light_area,
                        &mut scratch.query,
                    ),
                };
                scratch.query.rays.shadow += samples * u64::from(clear.count_ones());
                for ray in (0..8).filter(|ray| lit >> ray & 1 == 1) {
                    let occlusion = match clear >> ray & 1 {
                        1 => Occlusion::Clear,
                        _ => Occlusion::Transmissive,
                    };
                    shadow_rays[ray / 4].note(ray % 4, occlusion);
                }
            },
        );
    }

    /// Sets up the shadow rays of a block to a light, and calls `visit` with two packets each and the mask of their rays
    /// to trace, if there are any.
    #[inline(always)]
    fn set_up_pairs(
        &self,
        number: u32,
        light: &Light,
        hits: &[HitPacket4],
        shadow_rays: &mut [ShadowPacket4],
        count: usize,
        mut visit: impl FnMut(SimdLevel, &[HitPacket4], &mut [ShadowPacket4], u32),
    ) {
        with_widest(
            #[inline(always)]
            |lanes| {
                for (pair, (hits, shadow_rays)) in
                    hits.chunks(2).zip(shadow_rays.chunks_mut(2)).enumerate()
                {
                    let mut active = 0;
                    for (half, (hits, shadow_rays)) in
                        hits.iter().zip(&mut *shadow_rays).enumerate()
                    {
                        active |= self.set_up_packet(lanes, number, light, hits, shadow_rays)
                            << (4 * half);
                    }
                    let there = (count - 8 * pair).min(8);
                    active &= 0xff >> (8 - there);
                    if active != 0 {
                        visit(lanes, hits, shadow_rays, active);
                    }
                }
            },
        );
    }

    fn light_block(
        &self,
        number: u32,
        light: &Light,
        count: usize,
        all: &mut BlockHits,
        single: &mut Scratch,
    ) {
        let BlockHits {
            hits,
            shadow_rays,
            order,
            ..
        } = all;
        let shadow_rays = &mut shadow_rays[number as usize * hits.len()..][..hits.len()];
        if self.world.has_light_buffer(number) {
            self.trace_through_light_buffer(number, light, hits, shadow_rays, count, single);
            return;
        }
        order.active.clear();
        let mut sum = DVec3::ZERO;
        let mut changes = 0;
        with_widest(
            #[inline(always)]
            |lanes| {
                let mut last = u32::MAX;
                for (at, (hits, shadow_rays)) in hits.iter().zip(&mut *shadow_rays).enumerate() {
                    let there = (count - 4 * at).min(4);
                    let mut active = self.set_up_packet(lanes, number, light, hits, shadow_rays);
                    active &= 0b1111 >> (4 - there);
                    while active != 0 {
                        let lane = active.trailing_zeros() as usize % 4;
                        active &= active - 1;
                        #[allow(
                            clippy::cast_possible_truncation,
                            reason = "a block has few pixels"
                        )]
                        order.active.push((4 * at + lane) as u16);
                        changes += usize::from(hits.leaf[lane] != last);
                        last = hits.leaf[lane];
                        sum += shadow_rays.to_light(lane);
                    }
                }
                let jumps = changes * SORT_THRESHOLD >= order.active.len();
                match sum.try_normalize().filter(|_| jumps) {
                    Some(axis) => order.sort(lanes, axis, shadow_rays),
                    None => order.sorted.clone_from(&order.active),
                }
            },
        );
        order.occlusions.clear();
        let mut unbundled = 0;
        for indices in order.sorted.chunks(BUNDLE_RAYS) {
            let occlusions = &mut order.occlusions;
            let centre = (unbundled == 0).then_some(light.centre);
            let has_paid = self.world.occlusion_bundle(
                indices,
                hits,
                shadow_rays,
                centre,
                &mut single.query,
                occlusions,
            );
            unbundled = match centre {
                None => unbundled - 1,
                Some(_) if has_paid => 0,
                Some(_) => UNBUNDLED,
            };
        }
        for (&index, occlusion) in order.sorted.iter().zip(&order.occlusions) {
            let index = usize::from(index);
            shadow_rays[index / 4].note(index % 4, *occlusion);
        }
    }

    /// Sets up the shadow rays to a light without tracing them.
    fn set_up_block(&self, number: u32, light: &Light, count: usize, all: &mut BlockHits) {
        let shadow_rays =
            &mut all.shadow_rays[number as usize * all.hits.len()..][..all.hits.len()];
        with_widest(
            #[inline(always)]
            |lanes| {
                for (at, (hits, shadow_rays)) in all.hits.iter().zip(shadow_rays).enumerate() {
                    let active = self.set_up_packet(lanes, number, light, hits, shadow_rays);
                    for lane in (0..(count - 4 * at).min(4)).filter(|lane| active >> lane & 1 == 1)
                    {
                        shadow_rays.note(lane, Occlusion::Transmissive);
                    }
                }
            },
        );
    }

    /// Traces the shadow rays of a block through the light buffer of the light.
    fn trace_through_light_buffer(
        &self,
        number: u32,
        light: &Light,
        hits: &[HitPacket4],
        shadow_rays: &mut [ShadowPacket4],
        count: usize,
        scratch: &mut Scratch,
    ) {
        let query = &mut scratch.query;
        self.set_up_pairs(
            number,
            light,
            hits,
            shadow_rays,
            count,
            #[inline(always)]
            |lanes, hits, shadow_rays, active| {
                let world = self.world;
                world.occlusion_packet8(lanes, number, hits, shadow_rays, active, query);
            },
        );
    }

    /// Sets up the shadow rays of four hits. Returns the lanes to trace.
    #[inline(always)]
    fn set_up_packet(
        &self,
        lanes: SimdLevel,
        number: u32,
        light: &Light,
        hits: &HitPacket4,
        shadow_rays: &mut ShadowPacket4,
    ) -> u32 {
        if hits.hit_mask == 0 {
            return 0;
        }
        let arriving = LightPacket {
            centre: light.centre,
            normalization: light.normalization,
            hits,
        };
        let arrived = lanes.run(arriving);
        shadow_rays.to_light = arrived.to_light;
        shadow_rays.distance = arrived.distance;
        shadow_rays.cosine = arrived.cosine;
        shadow_rays.share = [1.0; 4];
        shadow_rays.goes_out = arrived.goes_out;
        shadow_rays.t_max = self.world.shadow_t_max_x4(&arrived.distance, &arrived.size);
        let mut active = hits.hit_mask & arrived.faces;
        if self.features.light_varies_by_surface || !self.world.lights.shines_on_all(number) {
            active = self.receiving_lanes(number, hits, &arrived);
        }
        let mut left = if light.is_unattenuated() {
            active & !arrived.is_finite
        } else {
            active
        };
        while left != 0 {
            let lane = left.trailing_zeros() as usize % 4;
            left &= left - 1;
            let arrival = Arrival {
                to_light: shadow_rays.to_light(lane),
                distance: shadow_rays.distance[lane],
            };
            let point = hits.point(lane);
            shadow_rays.share[lane] = light.attenuation(point, &arrival);
            let end = point + arrival.distance * arrival.to_light;
            shadow_rays.t_max[lane] = self.world.shadow_t_max(end, arrival.distance);
            if shadow_rays.share[lane] == 0.0 {
                active &= !(1 << lane);
            }
        }
        active
    }

    /// The lanes for which the light matters, where that differs between surfaces.
    #[inline(never)]
    fn receiving_lanes(&self, number: u32, hits: &HitPacket4, arrived: &ArrivedLight) -> u32 {
        let mut active = 0;
        let mut last = None;
        for lane in (0..4).filter(|&lane| hits.is_hit(lane)) {
            let surface = hits.surface[lane];
            let lit = match last {
                Some((previous, lit)) if previous == surface => lit,
                _ => self.lit_lanes(number, &self.world.surfaces[surface as usize], arrived),
            };
            last = Some((surface, lit));
            active |= lit & 1 << lane;
        }
        active
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

/// The view from a light of four directions to it.
struct ViewFromLight<'a> {
    shadow_rays: &'a ShadowPacket4,
    across: DVec3,
    up: DVec3,
}

impl SimdKernel for ViewFromLight<'_> {
    type Output = [[f64; 4]; 2];

    #[inline(always)]
    fn run<F: F64Lanes>(self) -> [[f64; 4]; 2] {
        let to_light: Vec3Lanes<F> = from_arrays(&self.shadow_rays.to_light);
        [
            dot(to_light, splat(self.across)).to_array(),
            dot(to_light, splat(self.up)).to_array(),
        ]
    }
}

impl LightSortedOrder {
    /// Sorts the shadow rays to trace by their direction from the light; `axis` is a unit direction to it.
    #[inline(always)]
    fn sort(&mut self, lanes: SimdLevel, axis: DVec3, shadow_rays: &[ShadowPacket4]) {
        let (across, up) = axis.any_orthonormal_pair();
        self.seen.clear();
        for shadow_rays in shadow_rays {
            let seen = lanes.run(ViewFromLight {
                shadow_rays,
                across,
                up,
            });
            // Explicit loops: `map` is not always inlined.
            let mut rounded = [[0.0; 4]; 2];
            for axis in 0..2 {
                for lane in 0..4 {
                    rounded[axis][lane] = nearest(seen[axis][lane]);
                }
            }
            self.seen.push(rounded);
        }
        let seen = |index: u16| {
            let [x, y] = &self.seen[usize::from(index) / 4];
            let lane = usize::from(index) % 4;
            [x[lane], y[lane]]
        };
        // A subset gives the approximate bounds.
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for &index in self.active.iter().step_by(BOUNDS_STEP) {
            for (axis, x) in seen(index).into_iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        let scale = [0, 1].map(|axis| LAST_CELL / (high[axis] - low[axis]).max(f32::MIN_POSITIVE));
        // Counting sort along a Morton curve: count the rays of each cell, sum up to the start of each cell, then
        // distribute.
        self.counts.clear();
        self.counts.resize(CELLS * CELLS, 0);
        self.cells.clear();
        for &index in &self.active {
            let [x, y] = seen(index);
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
        self.sorted.resize(self.active.len(), 0);
        for (&index, &cell) in self.active.iter().zip(&self.cells) {
            let next = &mut self.counts[usize::from(cell)];
            self.sorted[usize::from(*next)] = index;
            *next += 1;
        }
    }
}

/// The cell of a coordinate on one axis, clamped to the grid.
#[inline(always)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from 0 to 31"
)]
fn cell_of(x: f32) -> usize {
    let x = if x > 0.0 { x } else { 0.0 };
    (if x < LAST_CELL { x } else { LAST_CELL }) as usize % CELLS
}

/// The numbers below [`CELLS`] with their bits spread, so that those of another number fit between: the Morton order
/// keeps neighbours together.
const SPREAD: [u16; CELLS] = {
    let mut spread = [0; CELLS];
    let mut number = 1;
    while number < CELLS {
        spread[number] = spread[number / 2] << 2 | [0, 1][number % 2];
        number += 1;
    }
    spread
};
