//! A block of pixels at once: what the camera sees at all of them is searched for together, and then, for each light,
//! what stands between it and all the points seen. Everything else goes one pixel at a time, as for a single one.

use super::light::{faces, shadow_query};
use super::surface::facing_normal;
use super::{Sample, Tracer, begin_sample};
use crate::compile::{Hit, Query, Rays, Scratch, Seen, Way};
use crate::math::Ray;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// The side of a block in pixels.
pub const BLOCK: u32 = 32;
/// The side of the parts of a block that are searched together.
const SEARCHED: u32 = 16;
/// Pixels that lie together are searched for together: eight, in columns and rows.
const GROUP: (u32, u32) = (4, 2);
/// So many points are lit together.
const LIT_TOGETHER: usize = 64;
/// Points that change from object to object more often than each time after so many are lit in the order in which the
/// light sees them.
const SORTED_BELOW: usize = 12;
/// After points that had nothing in common so many times as many are lit one by one.
const LIT_SINGLY: usize = 3;

/// Buffers that a thread keeps between blocks.
#[derive(Debug, Default)]
pub struct BlockScratch {
    single: Scratch,
    whole: Vec<(f64, f64)>,
    /// Where each part of the places that are searched together ends.
    parts: Vec<usize>,
    /// From the camera, one for each place.
    queries: Vec<Query>,
    /// To a light, for the places in `asked`.
    shadows: Vec<Query>,
    hits: Vec<Option<Hit>>,
    /// By pixel and light, what is known to lie between.
    ways: Vec<Option<Way>>,
    asked: Vec<usize>,
    /// The order in which a light sees points.
    keys: Vec<u32>,
    sorted: Vec<Query>,
    answers: Vec<Way>,
}

impl BlockScratch {
    /// Lists the places of a block: part by part, and there group by group.
    fn lay_out(&mut self, columns: &Range<u32>, rows: &Range<u32>) {
        self.whole.clear();
        self.parts.clear();
        for rows in split(rows, SEARCHED) {
            for columns in split(columns, SEARCHED) {
                for rows in split(&rows, GROUP.1) {
                    for columns in split(&columns, GROUP.0) {
                        let row = |y| columns.clone().map(move |x| (f64::from(x), f64::from(y)));
                        self.whole.extend(rows.clone().flat_map(row));
                    }
                }
                self.parts.push(self.whole.len());
            }
        }
    }

    /// How many rays were followed with it since this was last asked.
    pub fn take_rays(&mut self) -> Rays {
        std::mem::take(&mut self.single.rays)
    }
}

impl Tracer<'_> {
    /// What the camera sees at the whole pixels of a block no larger than [`BLOCK`] on a side, of a picture of `size`
    /// (width, height). `take` gets column, row and sample in any order. To the bit what [`Tracer::pixel`] gives.
    pub fn block(
        &self,
        columns: &Range<u32>,
        rows: &Range<u32>,
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(u32, u32, Sample),
    ) {
        scratch.lay_out(columns, rows);
        let whole = std::mem::take(&mut scratch.whole);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "they were made of such numbers"
        )]
        self.seen_at(&whole, size, scratch, |number, sample, _| {
            let (x, y) = whole[number];
            take(x as u32, y as u32, sample);
        });
        scratch.whole = whole;
    }

    /// What the camera sees at places of a picture of `size`, no more than a block has pixels and such that neighbours
    /// in the list lie near each other; whole numbers are centres of pixels. `take` gets the number of the place, what is
    /// seen, and what was met first if that is known, in any order. To the bit what [`Tracer::pixel`] gives.
    pub fn places(
        &self,
        places: &[(f64, f64)],
        size: (u32, u32),
        scratch: &mut BlockScratch,
        take: impl FnMut(usize, Sample, Option<&Hit>),
    ) {
        scratch.parts.clear();
        let end = places.len();
        let ends = (0..end).step_by((SEARCHED * SEARCHED) as usize).skip(1);
        scratch.parts.extend(ends.chain([end]));
        self.seen_at(places, size, scratch, take);
    }

    /// The same with the parts laid out.
    fn seen_at(
        &self,
        places: &[(f64, f64)],
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample, Option<&Hit>),
    ) {
        if !self.search(places, size, scratch) {
            for (number, &(x, y)) in places.iter().enumerate() {
                let sample = self.pixel(x, y, size.0, size.1, &mut scratch.single);
                take(number, sample, None);
            }
            return;
        }
        let lights = self.world.lights.len();
        scratch.ways.clear();
        scratch.ways.resize(lights * places.len(), None);
        if self.quality.has_shadows && self.quality.has_light {
            for light in (0u32..).take(lights) {
                self.light_block(light, scratch);
            }
        }
        for (number, &(x, y)) in places.iter().enumerate() {
            begin_sample(x, y, &mut scratch.single);
            let path = self.camera_path(scratch.queries[number].ray);
            let ways = &scratch.ways[number * lights..][..lights];
            let hit = scratch.hits[number];
            let sample = self.trace(path, Some((hit, ways)), &mut scratch.single);
            take(number, sample, hit.as_ref());
        }
    }

    /// Searches for what the camera sees; false if its rays do not start in one
    /// point.
    fn search(
        &self,
        places: &[(f64, f64)],
        (width, height): (u32, u32),
        scratch: &mut BlockScratch,
    ) -> bool {
        let camera = &self.world.camera;
        if !camera.has_one_origin() || self.world.lens.is_some() {
            return false;
        }
        scratch.queries.clear();
        for &(x, y) in places {
            let Some(ray) = camera.primary_ray(x, y, width, height) else {
                return false;
            };
            scratch.queries.push(Query {
                ray,
                from: None,
                far: f64::INFINITY,
                seen: Seen::Image,
            });
        }
        scratch.hits.clear();
        let mut first = 0;
        for &end in &scratch.parts {
            let queries = &scratch.queries[first..end];
            self.world
                .nearest_of(queries, &mut scratch.single, &mut scratch.hits);
            first = end;
        }
        true
    }

    /// Finds out what lies between a light and the points that it may light, if its rays start in one point.
    fn light_block(&self, number: u32, scratch: &mut BlockScratch) {
        let lights = &self.world.lights;
        let light = lights.get(number);
        let is_one_point = light.area.is_none() && !light.is_parallel;
        if !is_one_point || light.is_shadowless() || lights.is_projected(number) {
            return;
        }
        scratch.shadows.clear();
        scratch.asked.clear();
        for (place, hit) in scratch.hits.iter().enumerate() {
            let Some(hit) = hit else { continue };
            let surface = &self.world.surfaces[hit.surface as usize];
            let arrival = light.arrival(hit.point);
            let normal = facing_normal(hit, scratch.queries[place].ray.dir);
            if faces(surface, normal.dot(arrival.to_light))
                && lights.of(surface.lights).contains(&number)
                && light.share(hit.point, &arrival) != 0.0
            {
                let ray = Ray::new(hit.point, arrival.to_light);
                let query = shadow_query(self.world, &hit.departure, ray, arrival.distance);
                scratch.shadows.push(query);
                scratch.asked.push(place);
            }
        }
        scratch.sort_for_light();
        let (single, answers) = (&mut scratch.single, &mut scratch.answers);
        answers.clear();
        let mut singly = 0;
        for queries in scratch.sorted.chunks(LIT_TOGETHER) {
            if singly > 0 {
                singly -= 1;
                let ways = queries.iter();
                answers.extend(ways.map(|query| self.world.way(query, number, single)));
                continue;
            }
            let centre = light.centre;
            if !self.world.ways_of(queries, centre, number, single, answers) {
                singly = LIT_SINGLY;
            }
        }
        for (key, way) in scratch.keys.iter().zip(&scratch.answers) {
            let place = scratch.asked[(key & PLACE_OF_KEY) as usize];
            scratch.ways[place * lights.len() + number as usize] = Some(*way);
        }
    }
}

/// The part of a key that is the place in the list before sorting; above it stands the order.
const PLACE_OF_KEY: u32 = BLOCK * BLOCK - 1;
/// The steps on each axis in which a light tells points apart.
const STEPS: f64 = 2047.0;

impl BlockScratch {
    /// Brings the shadow rays into the order in which the light sees where they start, if they jump about.
    fn sort_for_light(&mut self) {
        self.keys.clear();
        self.sorted.clear();
        self.keys.extend((0u32..).take(self.shadows.len()));
        let leaf = |query: &Query| query.from.map(|left| left.leaf);
        let changes = self
            .shadows
            .windows(2)
            .filter(|pair| leaf(&pair[0]) != leaf(&pair[1]));
        if changes.count() * SORTED_BELOW < self.shadows.len() {
            std::mem::swap(&mut self.sorted, &mut self.shadows);
            return;
        }
        let sum: DVec3 = self.shadows.iter().map(|query| query.ray.dir).sum();
        let Some(axis) = sum.try_normalize() else {
            std::mem::swap(&mut self.sorted, &mut self.shadows);
            return;
        };
        let (across, up) = axis.any_orthonormal_pair();
        let seen = |query: &Query| DVec2::new(query.ray.dir.dot(across), query.ray.dir.dot(up));
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for query in &self.shadows {
            let seen = seen(query);
            (low, high) = (low.min(seen), high.max(seen));
        }
        let scale = STEPS / (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
        for (key, query) in self.keys.iter_mut().zip(&self.shadows) {
            let step = ((seen(query) - low) * scale).as_uvec2();
            *key |= interleaved(step.x, step.y) * (BLOCK * BLOCK);
        }
        self.keys.sort_unstable();
        let place = |key: &u32| (key & PLACE_OF_KEY) as usize;
        let sorted = self.keys.iter().map(|key| self.shadows[place(key)]);
        self.sorted.extend(sorted);
    }
}

/// The bits of two numbers of eleven bits in turn.
fn interleaved(x: u32, y: u32) -> u32 {
    let spread = |x: u32| {
        let x = (x | x << 8) & 0x00ff_00ff;
        let x = (x | x << 4) & 0x0f0f_0f0f;
        let x = (x | x << 2) & 0x3333_3333;
        (x | x << 1) & 0x5555_5555
    };
    spread(x) | spread(y) << 1
}

/// A range in pieces of this length; the last may be shorter.
fn split(range: &Range<u32>, length: u32) -> impl Iterator<Item = Range<u32>> + use<> {
    let end = range.end;
    let starts = range.clone().step_by(length as usize);
    starts.map(move |start| start..(start + length).min(end))
}
