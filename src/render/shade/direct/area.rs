//! Light from many lamps: soft shadows, and each lamp by itself with `area_illumination`.

use super::light::{LayerBsdf, LightContribution, ShadingPoint, is_nothing};
use super::transmittance::{ShadowPath, shadow_query};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::simd::vec3::{
    Vec3Lanes, add, divide, dot, from_arrays, max_abs, scale, splat, sub, to_arrays,
};
use crate::base::math::simd::{F64x4, SimdKernel, SimdLevel, with_widest};
use crate::render::shade::Tracer;
use crate::scene::light::{Area, Arrival, Axes, Light, Part};
use crate::world::{HitPacket4, Scratch, ShadowPacket4};
use glam::DVec3;
use smallvec::SmallVec;

/// By this much, summed over the channels, corners must differ for the part between them to be divided.
const DIFFERENCE: f32 = 0.1;

/// The lamps of one light as one point sees them.
pub(in crate::render::shade) struct Lamps<'a> {
    number: u32,
    light: &'a Light,
    area: &'a Area,
    axes: Axes,
    lit: &'a ShadingPoint<'a>,
    /// The distance to the middle of the light.
    distance: f64,
    /// What is to be spread over them.
    arriving: Rgb,
    /// The point, four times, if several lamps can be asked about at once.
    hits: Option<HitPacket4>,
}

/// Points four ways to lamps that stand so far from the middle of a light.
struct Aiming<'a> {
    centre: DVec3,
    point: DVec3,
    /// Of the surface that the ways go out from; zero where there is none.
    normal: DVec3,
    offset: &'a [[f64; 4]; 3],
}

impl SimdKernel for Aiming<'_> {
    /// The ways, and the largest of their lengths and of the coordinates of where they end.
    type Output = (ShadowPacket4, [f64; 4]);

    #[inline(always)]
    fn run<F: F64x4>(self) -> (ShadowPacket4, [f64; 4]) {
        let centre: Vec3Lanes<F> = add(splat(self.centre), from_arrays(self.offset));
        let offset = sub(centre, splat(self.point));
        let distance = dot(offset, offset).sqrt();
        let to_light = divide(offset, distance);
        let end = add(splat(self.point), scale(to_light, distance));
        let cosine = dot(splat(self.normal), to_light);
        let ways = ShadowPacket4 {
            to_light: to_arrays(to_light),
            distance: distance.to_array(),
            goes_out: F::bitmask(F::splat(0.0).lt(cosine)),
            ..ShadowPacket4::NOTHING
        };
        (ways, max_abs(end).lane_max(distance).to_array())
    }
}

/// The indices of lamps that are to be asked about.
type Wanted = SmallVec<[[u32; 2]; 16]>;

/// Fewer lamps than this are asked about one by one.
const MANY: usize = 3;

impl<'a> Lamps<'a> {
    pub(in crate::render::shade) fn new(
        number: u32,
        light: &'a Light,
        area: &'a Area,
        lit: &'a ShadingPoint<'a>,
        arriving: Rgb,
    ) -> Self {
        let arrival = light.arrival(lit.at.point);
        Lamps {
            number,
            light,
            area,
            axes: area.axes_for(arrival.to_light),
            lit,
            distance: arrival.distance,
            arriving,
            hits: None,
        }
    }

    /// The number of a lamp.
    fn index(&self, [u, v]: [u32; 2]) -> usize {
        u as usize + self.area.sizes[0] as usize * v as usize
    }

    /// How the light of a lamp arrives that stands so far from the middle.
    fn arrival(&self, offset: DVec3) -> Arrival {
        let centre = self.light.centre + offset;
        if self.light.is_parallel {
            return Arrival {
                to_light: (centre - self.light.points_at()).normalize_or_zero(),
                distance: self.distance,
            };
        }
        let offset = centre - self.lit.at.point;
        let distance = offset.length();
        Arrival {
            to_light: offset / distance,
            distance,
        }
    }

    /// Where a lamp stands from the middle of the light. With jitter it is somewhere else each time it is asked.
    fn offset(&self, u: u32, v: u32, scratch: &mut Scratch) -> DVec3 {
        let (mut at_u, mut at_v) = (f64::from(u), f64::from(v));
        if self.area.has_jitter {
            at_u += scratch.stream.next_number() - 0.5;
            at_v += scratch.stream.next_number() - 0.5;
        }
        self.area.lamp(&self.axes, at_u, at_v)
    }
}

impl Tracer<'_> {
    /// What is left of light after the shadows of all lamps.
    pub(in crate::render::shade) fn through_area(
        &self,
        lamps: &mut Lamps,
        scratch: &mut Scratch,
    ) -> Rgb {
        let [columns, rows] = lamps.area.sizes;
        scratch.lamps.clear();
        scratch.lamps.resize(columns as usize * rows as usize, None);
        lamps.hits = self.hits_for(lamps);
        if lamps.hits.is_some() {
            let first = lamps.area.first_lamps();
            self.ask(lamps, first, scratch);
            let mut known = first.iter().map(|&lamp| scratch.lamps[lamps.index(lamp)]);
            if let Some(Some(light)) = known.next()
                && known.all(|other| other == Some(light))
                && is_its_own_mean(light)
            {
                return light;
            }
        }
        self.part_of_area(lamps, Part::all(lamps.area.sizes), 0, scratch)
    }

    /// The point, four times, if its ways to several lamps can be asked about at once. With jitter lamps stand elsewhere
    /// each time they are asked about, and media on the ways draw random numbers: both keep POV-Ray's order.
    fn hits_for(&self, lamps: &Lamps) -> Option<HitPacket4> {
        let lights = &self.world.lights;
        let departure = lamps.lit.departure?;
        let is_fit = !lamps.area.has_jitter
            && !self.has_media
            && !lamps.light.is_shadowless()
            && !lights.is_projected(lamps.number)
            && self.world.asks_from_points();
        is_fit.then(|| HitPacket4::all_at(lamps.lit.at.point, departure))
    }

    /// Finds out at once what comes from some lamps.
    fn ask(&self, lamps: &Lamps, wanted: &[[u32; 2]], scratch: &mut Scratch) {
        let Some(hits) = &lamps.hits else {
            return;
        };
        if wanted.len() < MANY {
            for &[u, v] in wanted {
                scratch.lamps[lamps.index([u, v])] = None;
                self.lamp(lamps, [u, v], scratch);
            }
            return;
        }
        let mut ways = std::mem::take(&mut scratch.to_lamps);
        ways.clear();
        if lamps.light.is_parallel {
            let four = |four: &[[u32; 2]]| self.parallel_ways(lamps, four);
            ways.extend(wanted.chunks(4).map(four));
        } else {
            with_widest(
                #[inline(always)]
                |lanes| {
                    for four in wanted.chunks(4) {
                        ways.push(self.four_ways(lanes, lamps, four));
                    }
                },
            );
        }
        let to_lamps = (&mut ways[..], wanted.len());
        self.world.ways_from(hits, to_lamps, scratch);
        for (at, &lamp) in wanted.iter().enumerate() {
            let (ways, lane) = (&ways[at / 4], at % 4);
            let way = ShadowPath {
                light: lamps.number,
                query: ways.query(hits, lane),
                distance: ways.distance[lane],
                known: ways.way(lane),
                inside: &lamps.lit.path.inside,
                collects: lamps.lit.collects,
            };
            scratch.lamps[lamps.index(lamp)] =
                Some(self.transmittance(lamps.arriving, &way, scratch));
        }
        scratch.to_lamps = ways;
    }

    /// The ways to up to four lamps that are near.
    #[inline(always)]
    fn four_ways(&self, lanes: SimdLevel, lamps: &Lamps, wanted: &[[u32; 2]]) -> ShadowPacket4 {
        let mut offset = [[0.0; 4]; 3];
        for lane in 0..4 {
            let [u, v] = wanted[lane.min(wanted.len() - 1)];
            let lamp = lamps.area.lamp(&lamps.axes, f64::from(u), f64::from(v));
            (offset[0][lane], offset[1][lane], offset[2][lane]) = lamp.into();
        }
        let normal = lamps.lit.departure.map_or(DVec3::ZERO, |left| left.normal);
        let aiming = Aiming {
            centre: lamps.light.centre,
            point: lamps.lit.at.point,
            normal,
            offset: &offset,
        };
        let (mut ways, size) = lanes.run(aiming);
        ways.far = self.world.reach_of_four(&ways.distance, &size);
        ways
    }

    /// The ways to up to four lamps that are infinitely far.
    fn parallel_ways(&self, lamps: &Lamps, wanted: &[[u32; 2]]) -> ShadowPacket4 {
        let departure = lamps.lit.departure.copied();
        let mut way = ShadowPacket4::NOTHING;
        for lane in 0..4 {
            let [u, v] = wanted[lane.min(wanted.len() - 1)];
            let arrival = lamps.arrival(lamps.area.lamp(&lamps.axes, f64::from(u), f64::from(v)));
            let ray = Ray::new(lamps.lit.at.point, arrival.to_light);
            let query = shadow_query(self.world, departure, ray, arrival.distance);
            way.aim(lane, arrival.to_light, arrival.distance, query.t_max);
            let goes_out = departure.is_some_and(|left| left.normal.dot(ray.dir) > 0.0);
            way.goes_out |= u32::from(goes_out) << lane;
        }
        way
    }

    fn part_of_area(&self, lamps: &Lamps, part: Part, level: u32, scratch: &mut Scratch) -> Rgb {
        let corners = part.corners().map(|lamp| self.lamp(lamps, lamp, scratch));
        let [low_low, high_low, low_high, high_high] = corners;
        let is_divided = part.can_be_divided()
            && (level < lamps.area.adaptive
                || differ(low_low, high_low)
                || differ(high_low, high_high)
                || differ(high_high, low_high)
                || differ(low_high, low_low));
        let parts = if is_divided {
            let quarters = part.quarters();
            if lamps.hits.is_some() && level >= lamps.area.adaptive {
                let mut wanted = Wanted::new();
                for quarter in quarters {
                    want(lamps, quarter, &mut wanted, scratch);
                }
                self.ask(lamps, &wanted, scratch);
            }
            quarters.map(|quarter| self.part_of_area(lamps, quarter, level + 1, scratch))
        } else {
            corners
        };
        let [a, b, c, d] = parts;
        (a + b + c + d) * 0.25_f64
    }

    /// What comes from one lamp, found out once for each point.
    fn lamp(&self, lamps: &Lamps, lamp: [u32; 2], scratch: &mut Scratch) -> Rgb {
        let index = lamps.index(lamp);
        if let Some(known) = scratch.lamps[index] {
            return known;
        }
        let arrival = lamps.arrival(lamps.offset(lamp[0], lamp[1], scratch));
        let left = self.through_shadows(lamps.arriving, lamps.lit, lamps.number, &arrival, scratch);
        scratch.lamps[index] = Some(left);
        left
    }

    /// What the lamps give to a layer, each from where it is. The shadows are still those of all lamps together. With jitter
    /// the lamps stand elsewhere than they did for the shadows.
    pub(in crate::render::shade) fn light_up_by_lamps(
        &self,
        mut lamps: Lamps,
        coat: &LayerBsdf,
        scratch: &mut Scratch,
    ) -> Rgb {
        if self.quality.has_shadows && !lamps.light.is_shadowless() {
            lamps.arriving = self.through_area(&mut lamps, scratch);
        }
        // No lamp is placed then, which later random numbers show.
        if is_nothing(lamps.arriving) {
            return Rgb::BLACK;
        }
        let Lamps { light, lit, .. } = lamps;
        let [columns, rows] = lamps.area.sizes;
        let each = lamps.arriving * (1.0 / (f64::from(columns) * f64::from(rows)));
        let mut sum = Rgb::BLACK;
        for v in 0..rows {
            for u in 0..columns {
                let lamp = light.lamp(lamps.offset(u, v, scratch));
                let arrival = lamp.arrival(lit.at.point);
                let left = each * lamp.share(lit.at.point, &arrival);
                if is_nothing(left) {
                    continue;
                }
                let cosine = lit.at.normal.dot(arrival.to_light);
                if let Some(side) = coat.side(cosine, lit.is_double_illuminated) {
                    let shining = LightContribution {
                        to_light: arrival.to_light,
                        side,
                        arriving: left,
                        has_highlights: side.is_in_front && !light.is_shadowless(),
                    };
                    sum += self.add_contribution(&shining, &lit.at, coat, scratch);
                }
            }
        }
        sum
    }
}

/// Adds the lamps at the corners of a part that are not wanted yet. They count as dark until they are asked about.
fn want(lamps: &Lamps, part: Part, wanted: &mut Wanted, scratch: &mut Scratch) {
    for lamp in part.corners() {
        let known = &mut scratch.lamps[lamps.index(lamp)];
        if known.is_none() {
            *known = Some(Rgb::BLACK);
            wanted.push(lamp);
        }
    }
}

/// Whether the mean of four of it is the same to the bit: it is for numbers that neither overflow nor vanish, four times
/// which a float holds, and three times which it holds within half a rounding of that.
fn is_its_own_mean(light: Rgb) -> bool {
    (light + light + light + light) * 0.25_f64 == light
}

fn differ(a: Rgb, b: Rgb) -> bool {
    (a.r - b.r).abs() + (a.g - b.g).abs() + (a.b - b.b).abs() > DIFFERENCE
}
