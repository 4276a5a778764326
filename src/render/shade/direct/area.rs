//! Area lights: soft shadows from a grid of point lights, and light from each of them with `area_illumination`.

use super::transmittance::{SegmentEnd, ShadowPath, ShadowSegment};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::conditioning::Normalization;
use crate::base::math::simd::vec3::{
    Vec3Lanes, add, dot, from_arrays, max_abs, scale, splat, sub, to_arrays,
};
use crate::base::math::simd::{F64x4, SimdKernel, SimdLevel, with_widest};
use crate::render::shade::Scratch;
use crate::render::shade::Tracer;
use crate::render::shade::bsdf::{LayerBsdf, LightContribution, is_negligible};
use crate::render::shade::scratch::GridSample;
use crate::render::shade::shading_point::ShadingPoint;
use crate::render::shade::shading_point::shadow_query;
use crate::scene::light::{Area, Arrival, Axes, Light, Part};
use crate::world::{AreaBlockers, HitPacket4, LightArea, Occlusion, ShadowPacket4};
use glam::DVec3;
use smallvec::SmallVec;

/// Threshold of adaptive subdivision: a part is divided if its corners differ by more, summed over the channels.
const MAX_DIFFERENCE: f32 = 0.1;

/// An area light seen from one shading point.
pub(in crate::render::shade) struct AreaLight<'a> {
    light_index: u32,
    light: &'a Light,
    area: &'a Area,
    axes: Axes,
    lit: &'a ShadingPoint<'a>,
    /// The direction and distance to its centre.
    arrival: Arrival,
    /// The light that is spread over the grid.
    arriving: Rgb,
    /// The shading point in all four lanes, if shadow rays can be traced as packets.
    hits: Option<HitPacket4>,
    /// The items that may block its light, where they are few.
    blockers: Option<AreaBlockers>,
    /// True if grid lights must be sampled one after the other in POV-Ray's order.
    is_in_order: bool,
    /// True if the atmosphere attenuates it.
    is_attenuated: bool,
}

/// Sets up four shadow rays to grid lights with these offsets from the centre of a light.
struct GridAim<'a> {
    centre: DVec3,
    point: DVec3,
    normalization: Normalization,
    /// The normal at the origin of the rays; zero in space.
    normal: DVec3,
    offset: &'a [[f64; 4]; 3],
}

impl SimdKernel for GridAim<'_> {
    /// The rays, and the largest of their lengths and of the coordinates of their ends.
    type Output = (ShadowPacket4, [f64; 4]);

    #[inline(always)]
    fn run<F: F64x4>(self) -> (ShadowPacket4, [f64; 4]) {
        let centre: Vec3Lanes<F> = add(splat(self.centre), from_arrays(self.offset));
        let offset = sub(centre, splat(self.point));
        let distance = dot(offset, offset).sqrt();
        let to_light = self.normalization.divided_lanes(offset, distance);
        let end = add(splat(self.point), scale(to_light, distance));
        let cosine = dot(splat(self.normal), to_light);
        let shadow_rays = ShadowPacket4 {
            to_light: to_arrays(to_light),
            distance: distance.to_array(),
            goes_out: F::bitmask(F::splat(0.0).lt(cosine)),
            ..ShadowPacket4::NOTHING
        };
        (shadow_rays, max_abs(end).lane_max(distance).to_array())
    }
}

/// The grid indices of lights to sample.
type GridIndices = SmallVec<[[u32; 2]; 16]>;

/// Fewer shadow rays than this are traced one by one.
const MIN_PACKET_RAYS: usize = 3;

impl<'a> AreaLight<'a> {
    pub(in crate::render::shade) fn new(
        light_index: u32,
        light: &'a Light,
        area: &'a Area,
        lit: &'a ShadingPoint<'a>,
        arriving: Rgb,
    ) -> Self {
        let arrival = light.arrival(lit.at.point);
        AreaLight {
            light_index,
            light,
            area,
            axes: area.axes_for(arrival.to_light),
            lit,
            arrival,
            arriving,
            hits: None,
            blockers: None,
            is_in_order: false,
            is_attenuated: false,
        }
    }

    /// The space that its lights take, unless they are parallel.
    fn extent(&self) -> Option<LightArea> {
        (!self.light.is_parallel).then(|| LightArea::of(self.light, self.area, &self.axes))
    }

    /// The index of a grid light.
    fn index(&self, [u, v]: [u32; 2]) -> usize {
        u as usize + self.area.sizes[0] as usize * v as usize
    }

    /// The direction and distance to the grid light with this offset from the centre.
    fn arrival(&self, offset: DVec3) -> Arrival {
        let centre = self.light.centre + offset;
        if self.light.is_parallel {
            let to_light = (centre - self.light.points_at()).normalize_or_zero();
            return Arrival {
                to_light,
                distance: (centre - self.lit.at.point).dot(to_light),
            };
        }
        let offset = centre - self.lit.at.point;
        let distance = offset.length();
        Arrival {
            to_light: self.light.normalization.divided(offset, distance),
            distance,
        }
    }

    /// The offsets of up to four grid lights from the centre; missing ones repeat the last.
    #[inline(always)]
    fn offsets(&self, chunk: &[[u32; 2]], scratch: &mut Scratch) -> [DVec3; 4] {
        let mut offsets = [DVec3::ZERO; 4];
        for (lane, &[u, v]) in chunk.iter().enumerate() {
            offsets[lane..].fill(self.offset(u, v, scratch));
        }
        offsets
    }

    /// Counts the shadow rays to this many grid lights, and leaves out their random numbers.
    fn skip(&self, count: usize, scratch: &mut Scratch) {
        scratch.query.rays.shadow += count as u64;
        skip_random(self.area, count, scratch);
    }

    /// The offset of a grid light from the centre. With jitter each call gives another one.
    #[inline(always)]
    fn offset(&self, u: u32, v: u32, scratch: &mut Scratch) -> DVec3 {
        let (mut at_u, mut at_v) = (f64::from(u), f64::from(v));
        if self.area.has_jitter {
            at_u += scratch.random.lights.next_number() - 0.5;
            at_v += scratch.random.lights.next_number() - 0.5;
        }
        self.area.grid_light_offset(&self.axes, at_u, at_v)
    }
}

impl Tracer<'_> {
    /// The light that remains after the shadows of all grid lights.
    ///
    /// As in POV-Ray the atmosphere attenuates the sum behind the last surfaces on the shadow rays along one ray: towards
    /// the centre of the light, or, if the grid was divided, towards a point twice as far from the origin. It is as long
    /// as the last shadow ray of the last part of the grid behind the last surface on it, or, if that part needed none,
    /// ends at that point.
    pub(in crate::render::shade) fn shadowed_area_light(
        &self,
        area_light: &mut AreaLight,
        scratch: &mut Scratch,
    ) -> Rgb {
        let number = area_light.light_index;
        area_light.is_attenuated = self.is_attenuated_by_atmosphere(number);
        let light = self.before_last_segment(area_light, scratch);
        if !area_light.is_attenuated || is_negligible(light) {
            return light;
        }
        let arrival = match scratch.area.is_divided {
            true => area_light.arrival(area_light.light.centre),
            false => area_light.arrival,
        };
        let length = scratch.area.last_segment.take();
        let length = length.unwrap_or(arrival.distance);
        let lit = area_light.lit;
        let segment = ShadowSegment {
            ray: &Ray::new(lit.at.point, arrival.to_light),
            length,
            inside: &lit.path.inside,
            end: SegmentEnd::Light,
        };
        self.through_atmosphere(light, number, &segment, scratch)
    }

    /// The same without the atmosphere behind the last surface on each shadow ray.
    fn before_last_segment(&self, area_light: &mut AreaLight, scratch: &mut Scratch) -> Rgb {
        let [columns, rows] = area_light.area.sizes;
        area_light.hits = self.packet_for(area_light);
        area_light.is_in_order = scratch.random.continues;
        let first = area_light.area.initial_grid_lights();
        if self.is_dark(area_light, scratch) {
            area_light.skip(first.len(), scratch);
            return Rgb::BLACK;
        }
        scratch.area.samples.clear();
        scratch
            .area
            .samples
            .resize(columns as usize * rows as usize, None);
        if area_light.hits.is_some() {
            area_light.blockers = self.area_blockers(area_light, scratch);
            if self.is_clear(area_light) {
                area_light.skip(first.len(), scratch);
                return area_light.arriving;
            }
            let blockers = area_light.blockers.as_ref();
            if !self.world.can_bundle_from_point(blockers)
                || self.is_probably_dark(area_light, scratch)
            {
                area_light.hits = None;
            }
        }
        if area_light.hits.is_some() {
            // POV-Ray divides a part before it samples the next one.
            let may_return = area_light.is_in_order && first.len() < scratch.area.samples.len();
            let before = may_return.then(|| {
                let memory = scratch.query.memory.as_deref().cloned();
                (scratch.random.lights, memory)
            });
            self.sample_grid(area_light, first, scratch);
            let mut known = first
                .iter()
                .map(|&corner| scratch.area.samples[area_light.index(corner)]);
            if let Some(Some(sample)) = known.next()
                && !area_light.is_attenuated
                && known.all(|other| other.is_some_and(|other| other.light == sample.light))
                && is_its_own_mean(sample.light)
            {
                return sample.light;
            }
            if let Some((random, memory)) = before {
                scratch.random.lights = random;
                if let (Some(now), Some(before)) = (scratch.query.memory.as_deref_mut(), memory) {
                    *now = before;
                }
                scratch.area.samples.fill(None);
            }
        }
        self.shadowed_part(area_light, Part::all(area_light.area.sizes), 0, scratch)
    }

    /// The items that may block light from the grid, if they are few.
    fn area_blockers(&self, area_light: &AreaLight, scratch: &mut Scratch) -> Option<AreaBlockers> {
        let hits = area_light.hits.as_ref()?;
        self.world
            .area_blockers(hits, &area_light.extent()?, &mut scratch.query)
    }

    /// True if one object blocks all of the light.
    fn is_dark(&self, area_light: &AreaLight, scratch: &Scratch) -> bool {
        let (Some(hits), Some(light)) = (&area_light.hits, area_light.extent()) else {
            return false;
        };
        let number = area_light.light_index;
        self.world.is_in_umbra(hits, &light, number, &scratch.query)
    }

    /// True if the object that blocked the light last probably blocks all of it: it is tested before anything else.
    fn is_probably_dark(&self, area_light: &AreaLight, scratch: &mut Scratch) -> bool {
        let arrival = area_light.arrival(DVec3::ZERO);
        let ray = Ray::new(area_light.lit.at.point, arrival.to_light);
        let spawn_surface = area_light.lit.spawn_surface.copied();
        let query = shadow_query(self.world, spawn_surface, ray, arrival.distance);
        let (light, scratch) = (area_light.light_index, &mut scratch.query);
        self.world.is_blocked_by_memory(&query, light, scratch)
    }

    /// True if all of the light arrives.
    fn is_clear(&self, area_light: &AreaLight) -> bool {
        let blockers = area_light.blockers.as_ref();
        blockers.is_some_and(AreaBlockers::is_empty)
            && !area_light.is_attenuated
            && is_its_own_mean(area_light.arriving)
    }

    /// The shading point in all four lanes, if shadow rays can be traced as packets. Not in media, which draw random
    /// numbers.
    fn packet_for(&self, area_light: &AreaLight) -> Option<HitPacket4> {
        let lights = &self.world.lights;
        let spawn_surface = area_light.lit.spawn_surface?;
        let is_fit = !self.features.has_media
            && !area_light.light.is_shadowless()
            && !lights.is_projected(area_light.light_index);
        is_fit.then(|| HitPacket4::all_at(area_light.lit.at.point, spawn_surface))
    }

    /// Samples several grid lights, as shadow packets if they are enough.
    fn sample_grid(&self, area_light: &AreaLight, requested: &[[u32; 2]], scratch: &mut Scratch) {
        let Some(hits) = &area_light.hits else {
            return;
        };
        if requested.len() < MIN_PACKET_RAYS {
            for &[u, v] in requested {
                scratch.area.samples[area_light.index([u, v])] = None;
                self.sample_grid_light(area_light, [u, v], scratch);
            }
            return;
        }
        let mut shadow_rays = std::mem::take(&mut scratch.area.shadow_rays);
        shadow_rays.clear();
        if area_light.light.is_parallel {
            for chunk in requested.chunks(4) {
                let offsets = area_light.offsets(chunk, scratch);
                shadow_rays.push(self.parallel_shadow_packet(area_light, &offsets));
            }
        } else {
            with_widest(
                #[inline(always)]
                |lanes| {
                    for chunk in requested.chunks(4) {
                        let offsets = area_light.offsets(chunk, scratch);
                        shadow_rays.push(self.grid_shadow_packet(lanes, area_light, &offsets));
                    }
                },
            );
        }
        let mut depends_on_memory = self.world.occlusion_from_point(
            hits,
            &mut shadow_rays,
            requested.len(),
            (area_light.light_index, area_light.blockers.as_ref()),
            &mut scratch.query,
        );
        for (at, &grid_index) in requested.iter().enumerate() {
            let (shadow_rays, lane) = (&shadow_rays[at / 4], at % 4);
            let (number, distance) = (area_light.light_index, shadow_rays.distance[lane]);
            let known = shadow_rays.occlusion(lane).map(|result| {
                let scratch = &mut scratch.query;
                // The blocker of this ray may be remembered for the next ones.
                depends_on_memory |= result == Occlusion::Opaque;
                if !depends_on_memory || scratch.memory.is_none() {
                    return result;
                }
                let query = shadow_rays.query(hits, lane);
                self.world
                    .occlusion_after_memory(result, &query, number, scratch)
            });
            scratch.area.last_segment = None;
            let light = match known {
                Some(Occlusion::Clear) => area_light.arriving,
                Some(Occlusion::Opaque) => Rgb::BLACK,
                Some(Occlusion::Transmissive) | None => {
                    let shadow_path = ShadowPath {
                        light: number,
                        query: shadow_rays.query(hits, lane),
                        distance,
                        known,
                        inside: &area_light.lit.path.inside,
                        collects: area_light.lit.collects,
                        is_to_grid: true,
                    };
                    self.transmittance(area_light.arriving, &shadow_path, scratch)
                }
            };
            keep_sample(area_light.index(grid_index), light, distance, scratch);
        }
        scratch.area.shadow_rays = shadow_rays;
    }

    /// Shadow rays to four grid lights at a finite distance, with these offsets from the centre.
    #[inline(always)]
    fn grid_shadow_packet(
        &self,
        lanes: SimdLevel,
        area_light: &AreaLight,
        offsets: &[DVec3; 4],
    ) -> ShadowPacket4 {
        let offset = [0, 1, 2].map(|axis| offsets.map(|from_centre| from_centre[axis]));
        let normal = area_light
            .lit
            .spawn_surface
            .map_or(DVec3::ZERO, |left| left.normal);
        let aim = GridAim {
            centre: area_light.light.centre,
            point: area_light.lit.at.point,
            normalization: area_light.light.normalization,
            normal,
            offset: &offset,
        };
        let (mut shadow_rays, size) = lanes.run(aim);
        shadow_rays.t_max = self.world.shadow_t_max_x4(&shadow_rays.distance, &size);
        shadow_rays
    }

    /// Shadow rays to four parallel grid lights with these offsets from the centre.
    fn parallel_shadow_packet(
        &self,
        area_light: &AreaLight,
        offsets: &[DVec3; 4],
    ) -> ShadowPacket4 {
        let spawn_surface = area_light.lit.spawn_surface.copied();
        let mut packet = ShadowPacket4::NOTHING;
        for (lane, &offset) in offsets.iter().enumerate() {
            let arrival = area_light.arrival(offset);
            let ray = Ray::new(area_light.lit.at.point, arrival.to_light);
            let query = shadow_query(self.world, spawn_surface, ray, arrival.distance);
            packet.aim(lane, arrival.to_light, arrival.distance, query.t_max);
            let goes_out = spawn_surface.is_some_and(|left| left.normal.dot(ray.dir) > 0.0);
            packet.goes_out |= u32::from(goes_out) << lane;
        }
        packet
    }

    /// Samples the corners of these parts that are not sampled yet, if shadow rays can be traced as packets.
    fn sample_parts(&self, area_light: &AreaLight, parts: &[Part], scratch: &mut Scratch) {
        if area_light.hits.is_none() {
            return;
        }
        let mut requested = GridIndices::new();
        for &part in parts {
            request_corners(area_light, part, &mut requested, scratch);
        }
        self.sample_grid(area_light, &requested, scratch);
    }

    fn shadowed_part(
        &self,
        area_light: &AreaLight,
        part: Part,
        level: u32,
        scratch: &mut Scratch,
    ) -> Rgb {
        if area_light.is_in_order {
            self.sample_parts(area_light, &[part], scratch);
        }
        // Not `map`, which is not always inlined.
        let [a, b, c, d] = part.corners();
        let mut light = |corner| self.sample_grid_light(area_light, corner, scratch);
        let corners = [light(a), light(b), light(c), light(d)];
        if area_light.is_attenuated {
            note_last_segment(area_light, part, scratch);
            scratch.area.is_divided = level > 0;
        }
        let [low_low, high_low, low_high, high_high] = corners;
        let is_divided = part.can_be_divided()
            && (level < area_light.area.adaptive
                || differ(low_low, high_low)
                || differ(high_low, high_high)
                || differ(high_high, low_high)
                || differ(low_high, low_low));
        let parts = if is_divided {
            let quarters = part.quarters();
            if !area_light.is_in_order && level >= area_light.area.adaptive {
                self.sample_parts(area_light, &quarters, scratch);
            }
            let [a, b, c, d] = quarters;
            let mut light = |quarter| self.shadowed_part(area_light, quarter, level + 1, scratch);
            [light(a), light(b), light(c), light(d)]
        } else {
            corners
        };
        let [a, b, c, d] = parts;
        (a + b + c + d) * 0.25_f64
    }

    /// The light that remains from one grid light, traced once for each shading point.
    fn sample_grid_light(
        &self,
        area_light: &AreaLight,
        grid_index: [u32; 2],
        scratch: &mut Scratch,
    ) -> Rgb {
        if let Some(known) = scratch.area.samples[area_light.index(grid_index)] {
            return known.light;
        }
        let arrival = area_light.arrival(area_light.offset(grid_index[0], grid_index[1], scratch));
        scratch.area.last_segment = None;
        let path = self.shadow_path(area_light.lit, area_light.light_index, &arrival, scratch);
        let light = match path {
            None => Rgb::BLACK,
            Some(_) if area_light.light.is_shadowless() => area_light.arriving,
            Some(shadow_path) => {
                let shadow_path = ShadowPath {
                    is_to_grid: true,
                    ..shadow_path
                };
                self.transmittance(area_light.arriving, &shadow_path, scratch)
            }
        };
        keep_sample(
            area_light.index(grid_index),
            light,
            arrival.distance,
            scratch,
        );
        light
    }

    /// Light of a layer from each grid light at its own position (`area_illumination`). The shadow is still that of all
    /// grid lights together. With jitter the lights are moved again after the shadow test.
    pub(in crate::render::shade) fn illuminate_by_grid(
        &self,
        mut area_light: AreaLight,
        bsdf: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        let light = area_light.light;
        let is_projected = || self.world.lights.is_projected(area_light.light_index);
        if self.quality.has_shadows && (!light.is_shadowless() || is_projected()) {
            area_light.arriving = self.shadowed_area_light(&mut area_light, scratch);
        }
        // No offset is drawn in this case: later random numbers depend on that.
        if is_negligible(area_light.arriving) {
            return Rgb::BLACK;
        }
        let AreaLight { light, lit, .. } = area_light;
        let [columns, rows] = area_light.area.sizes;
        let each = area_light.arriving * (1.0 / (f64::from(columns) * f64::from(rows)));
        let mut sum = Rgb::BLACK;
        for v in 0..rows {
            for u in 0..columns {
                let grid_light = light.grid_light(area_light.offset(u, v, scratch));
                let arrival = grid_light.arrival(lit.at.point);
                let left = each * grid_light.attenuation(lit.at.point, &arrival);
                if is_negligible(left) {
                    continue;
                }
                let cosine = lit.at.normal.dot(arrival.to_light);
                if let Some(side) = bsdf.side(cosine, lit.is_double_illuminated) {
                    let contribution = LightContribution {
                        to_light: arrival.to_light,
                        side,
                        arriving: left,
                        has_highlights: side.is_in_front && !light.is_shadowless(),
                    };
                    sum += self.scattered_below_film(&contribution, &lit.at, bsdf, scratch);
                }
            }
        }
        let irid = &bsdf.finish.irid;
        if irid.amount > 0.0 {
            // A film sees the light as if all of it came from the centre, as in POV-Ray.
            sum *= self.film(irid, &lit.at, light.arrival(lit.at.point).to_light);
        }
        sum
    }
}

/// Leaves out the random numbers of this many grid lights.
fn skip_random(area: &Area, count: usize, scratch: &mut Scratch) {
    if area.has_jitter {
        scratch.random.lights.skip(2 * count);
    }
}

/// Leaves out the random numbers of an area light of which all light arrives.
pub(in crate::render::shade) fn skip_clear(area: &Area, scratch: &mut Scratch) {
    skip_random(area, area.initial_grid_lights().len(), scratch);
}

/// Adds the corners of a part that are not sampled yet to the request. They count as dark until then.
fn request_corners(
    area_light: &AreaLight,
    part: Part,
    requested: &mut GridIndices,
    scratch: &mut Scratch,
) {
    for corner in part.corners() {
        let known = &mut scratch.area.samples[area_light.index(corner)];
        if known.is_none() {
            *known = Some(GridSample::DARK);
            requested.push(corner);
        }
    }
}

/// Keeps the light that remains from a grid light at this distance, whose shadow ray was traced last.
fn keep_sample(index: usize, light: Rgb, distance: f64, scratch: &mut Scratch) {
    let last_segment = scratch.area.last_segment.take().unwrap_or(distance);
    scratch.area.samples[index] = Some(GridSample {
        light,
        last_segment,
        is_used: false,
    });
}

/// Notes the last segment of the last corner of a part that no earlier part used, if there is one.
fn note_last_segment(area_light: &AreaLight, part: Part, scratch: &mut Scratch) {
    scratch.area.last_segment = None;
    for corner in part.corners() {
        let sample = scratch.area.samples[area_light.index(corner)].as_mut();
        if let Some(sample) = sample.filter(|sample| !sample.is_used) {
            sample.is_used = true;
            scratch.area.last_segment = Some(sample.last_segment);
        }
    }
}

/// Tests if the mean of four equal values is bit-identical to the value. It is for numbers that neither overflow nor
/// vanish: four times the value is exact, and three times the value is off by at most half a rounding.
pub(super) fn is_its_own_mean(light: Rgb) -> bool {
    (light + light + light + light) * 0.25_f64 == light
}

fn differ(a: Rgb, b: Rgb) -> bool {
    (a.r - b.r).abs() + (a.g - b.g).abs() + (a.b - b.b).abs() > MAX_DIFFERENCE
}
