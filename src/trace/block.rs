//! A block of pixels at once: what the camera sees at all of them is searched for together, and then, for each light,
//! what stands between it and all the points seen. Everything else goes one pixel at a time, as for a single one.

use super::light::Known;
use super::surface::facing_normal;
use super::{Sample, Tracer, begin_sample};
use crate::compile::{Hit, Query, Rays, Scratch, Way};
use crate::math::Ray;
use glam::{DVec2, DVec3, UVec2};
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
    /// The unit directions of the camera's rays, one for each place.
    dirs: Vec<DVec3>,
    /// To a light, for the places in `sorted`.
    shadows: Vec<Query>,
    hits: Vec<Option<Hit>>,
    /// By pixel and light, what is known of its light there.
    known: Vec<Known>,
    asked: Vec<Asked>,
    /// How many of them the light sees in each cell, or where those of the cell begin.
    cells: Vec<u16>,
    /// The places in the order in which the light sees them.
    sorted: Vec<u16>,
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
        scratch.known.clear();
        scratch.known.resize(lights * places.len(), Known::NOTHING);
        if self.quality.has_shadows && self.quality.has_light {
            for light in (0u32..).take(lights) {
                self.light_block(light, scratch);
            }
        }
        let origin = self.world.camera.location();
        for (number, &(x, y)) in places.iter().enumerate() {
            let single = &mut scratch.single;
            let dir = scratch.dirs[number];
            let known = &scratch.known[number * lights..][..lights];
            let hit = scratch.hits[number].as_ref();
            let sample = self.plain_view(hit, dir, known, single).unwrap_or_else(|| {
                begin_sample(x, y, single);
                self.trace(
                    self.camera_path(Ray::new(origin, dir)),
                    Some((hit.copied(), known)),
                    single,
                )
            });
            take(number, sample, hit);
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
        scratch.dirs.clear();
        for &(x, y) in places {
            let Some(ray) = camera.primary_ray(x, y, width, height) else {
                return false;
            };
            scratch.dirs.push(ray.dir);
        }
        scratch.hits.clear();
        let mut first = 0;
        for &end in &scratch.parts {
            let dirs = &scratch.dirs[first..end];
            self.world.nearest_of(
                camera.location(),
                dirs,
                &mut scratch.single,
                &mut scratch.hits,
            );
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
        scratch.asked.clear();
        for (place, hit) in scratch.hits.iter().enumerate() {
            let Some(hit) = hit else { continue };
            let normal = facing_normal(hit, scratch.dirs[place]);
            let known = self.light_at(number, hit, normal);
            if known.share == 0.0 {
                continue;
            }
            scratch.known[place * lights.len() + number as usize] = known;
            #[allow(clippy::cast_possible_truncation, reason = "a block has few places")]
            scratch.asked.push(Asked {
                place: place as u16,
                cell: 0,
                leaf: hit.departure.leaf,
                to_light: known.arrival.to_light,
            });
        }
        scratch.sort_for_light();
        scratch.shadows.clear();
        for &place in &scratch.sorted {
            let place = usize::from(place);
            if let Some(hit) = &scratch.hits[place] {
                let known = &scratch.known[place * lights.len() + number as usize];
                let query = known.shadow_query(self.world, hit);
                scratch.shadows.push(query);
            }
        }
        let (single, answers) = (&mut scratch.single, &mut scratch.answers);
        answers.clear();
        let mut singly = 0;
        for queries in scratch.shadows.chunks(LIT_TOGETHER) {
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
        for (place, way) in scratch.sorted.iter().zip(&scratch.answers) {
            let known = &mut scratch.known[usize::from(*place) * lights.len() + number as usize];
            known.way = Some(*way);
        }
    }
}

/// A place that a light may light.
#[derive(Clone, Copy, Debug)]
struct Asked {
    place: u16,
    /// Where the light sees it, along a curve that keeps neighbours together.
    cell: u16,
    leaf: u32,
    to_light: DVec3,
}

/// The number of cells on each axis by which a light tells points apart.
const CELLS: u32 = 64;

impl BlockScratch {
    /// Brings the places that are asked about into the order in which the light sees them, if they jump about.
    fn sort_for_light(&mut self) {
        self.sorted.clear();
        let asked = &mut self.asked;
        let changes = asked.windows(2).filter(|pair| pair[0].leaf != pair[1].leaf);
        let jumps = changes.count() * SORTED_BELOW >= asked.len();
        let sum: DVec3 = asked.iter().map(|asked| asked.to_light).sum();
        let Some(axis) = sum.try_normalize().filter(|_| jumps) else {
            self.sorted.extend(asked.iter().map(|asked| asked.place));
            return;
        };
        let (across, up) = axis.any_orthonormal_pair();
        let seen = |asked: &Asked| DVec2::new(asked.to_light.dot(across), asked.to_light.dot(up));
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for asked in &*asked {
            let seen = seen(asked);
            (low, high) = (low.min(seen), high.max(seen));
        }
        let most = f64::from(CELLS) - 1.0;
        let scale = most / (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
        // Counting sort: how many lie in each cell, where each cell begins, and then all into their places.
        self.cells.clear();
        self.cells.resize((CELLS * CELLS) as usize, 0);
        for asked in &mut *asked {
            let cell = ((seen(asked) - low) * scale)
                .as_uvec2()
                .min(UVec2::splat(CELLS - 1));
            asked.cell = interleaved(cell.x, cell.y);
            self.cells[usize::from(asked.cell)] += 1;
        }
        let mut next = 0;
        for count in &mut self.cells {
            (*count, next) = (next, next + *count);
        }
        self.sorted.resize(asked.len(), 0);
        for asked in asked {
            let next = &mut self.cells[usize::from(asked.cell)];
            self.sorted[usize::from(*next)] = asked.place;
            *next += 1;
        }
    }
}

/// The bits of two numbers below [`CELLS`] in turn.
fn interleaved(x: u32, y: u32) -> u16 {
    let spread = |x: u32| {
        let x = (x | x << 4) & 0x0f0f;
        let x = (x | x << 2) & 0x3333;
        (x | x << 1) & 0x5555
    };
    #[allow(clippy::cast_possible_truncation, reason = "twice six bits")]
    let cell = (spread(x) | spread(y) << 1) as u16;
    cell
}

/// A range in pieces of this length; the last may be shorter.
fn split(range: &Range<u32>, length: u32) -> impl Iterator<Item = Range<u32>> + use<> {
    let end = range.end;
    let starts = range.clone().step_by(length as usize);
    starts.map(move |start| start..(start + length).min(end))
}
