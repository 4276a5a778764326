//! A block of pixels at once: what the camera sees at all of them is searched for together, and then, for each light,
//! what stands between it and all the points seen. Everything else goes one pixel at a time, as for a single one.

use super::light::{faces, shadow_query};
use super::surface::facing_normal;
use super::{Sample, Tracer, begin_sample};
use crate::compile::{Hit, Query, Rays, Scratch, Seen, Way};
use crate::math::Ray;
use std::ops::Range;

/// The side of a block in pixels.
pub const BLOCK: u32 = 16;
/// Pixels that lie together are searched for together: eight, in columns and rows.
const GROUP: (u32, u32) = (4, 2);
/// So many points are lit together.
const LIT_TOGETHER: usize = 64;

/// Buffers that a thread keeps between blocks.
#[derive(Debug, Default)]
pub struct BlockScratch {
    single: Scratch,
    places: Vec<(u32, u32)>,
    /// From the camera, one for each place.
    queries: Vec<Query>,
    /// To a light, for the places in `asked`.
    shadows: Vec<Query>,
    hits: Vec<Option<Hit>>,
    /// By pixel and light, what is known to lie between.
    ways: Vec<Option<Way>>,
    asked: Vec<usize>,
    answers: Vec<Way>,
}

impl BlockScratch {
    /// How many rays were followed with it.
    #[must_use]
    pub fn rays(&self) -> Rays {
        self.single.rays
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
        scratch.places.clear();
        for top in rows.clone().step_by(GROUP.1 as usize) {
            for left in columns.clone().step_by(GROUP.0 as usize) {
                for y in top..(top + GROUP.1).min(rows.end) {
                    let right = (left + GROUP.0).min(columns.end);
                    scratch.places.extend((left..right).map(|x| (x, y)));
                }
            }
        }
        if !self.search(size, scratch) {
            for &(x, y) in &scratch.places {
                let sample = self.pixel(
                    f64::from(x),
                    f64::from(y),
                    size.0,
                    size.1,
                    &mut scratch.single,
                );
                take(x, y, sample);
            }
            return;
        }
        let lights = self.world.lights.len();
        scratch.ways.clear();
        scratch.ways.resize(lights * scratch.places.len(), None);
        if self.quality.has_shadows && self.quality.has_light {
            for light in (0u32..).take(lights) {
                self.light_block(light, scratch);
            }
        }
        for (number, &(x, y)) in scratch.places.iter().enumerate() {
            begin_sample(f64::from(x), f64::from(y), &mut scratch.single);
            let path = self.camera_path(scratch.queries[number].ray);
            let ways = &scratch.ways[number * lights..][..lights];
            let sample = self.trace(
                path,
                Some((scratch.hits[number], ways)),
                &mut scratch.single,
            );
            take(x, y, sample);
        }
    }

    /// Searches for what the camera sees; false if its rays do not start in one
    /// point.
    fn search(&self, (width, height): (u32, u32), scratch: &mut BlockScratch) -> bool {
        let camera = &self.world.camera;
        if !camera.has_one_origin() || self.world.lens.is_some() {
            return false;
        }
        scratch.queries.clear();
        for &(x, y) in &scratch.places {
            let Some(ray) = camera.primary_ray(f64::from(x), f64::from(y), width, height) else {
                return false;
            };
            scratch.queries.push(Query {
                ray,
                from: None,
                far: f64::INFINITY,
                seen: Seen::Image,
            });
        }
        self.world
            .nearest_of(&scratch.queries, &mut scratch.single, &mut scratch.hits);
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
        let asked = scratch.asked.chunks(LIT_TOGETHER);
        for (queries, asked) in scratch.shadows.chunks(LIT_TOGETHER).zip(asked) {
            let (single, answers) = (&mut scratch.single, &mut scratch.answers);
            self.world
                .ways_of(queries, light.centre, number, single, answers);
            for (place, way) in asked.iter().zip(&scratch.answers) {
                scratch.ways[place * lights.len() + number as usize] = Some(*way);
            }
        }
    }
}
