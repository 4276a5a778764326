//! Lists of the samples near small boxes, so that lookups of neighbouring points traverse the octree once.

use super::cache::Cache;
use super::cell::{Cell, Cube};
use super::sample::{CacheQuery, IrradianceSample, SampleLanes};
use crate::base::color::Rgb;
use crate::base::math::simd::vec3;
use crate::base::math::simd::{F64x4, SimdKernel, with_widest};
use glam::DVec3;

/// The number of lists of a thread, a power of two.
const LISTS: usize = 1024;
/// The boxes are smaller than the cell of a mean sample of their depth by this power of two. Most smaller ones would be
/// used once.
const FINER: i32 = 1;
/// The levels of boxes: those in which the roundings of coordinates are far below their slack.
const LEVELS: [i32; 2] = [-20, 30];
/// Half the edge of a box in units of that of its cell, with slack for rounding.
const HALF: f64 = 0.5 + 1.0 / 64.0;
/// Slack for rounding of the distance at which a sample is too far from a box.
const SLACK: f64 = 1.0 + 1e-9;
/// The most samples of a list; for more the octree is traversed.
const MAX_COUNT: usize = 256;
/// The samples of a block.
const BLOCK: usize = 4;

/// The weighted mean of the samples that count at a point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    /// The sum of the weights.
    pub weight: f64,
    /// The weighted sum of the light.
    pub sum: Rgb,
}

/// The lists of a thread, by the cell of their box.
#[derive(Clone, Debug, Default)]
pub struct SampleLists(Vec<List>);

/// The samples that a lookup in a box may find, in the order of a lookup.
#[derive(Clone, Debug, Default)]
struct List {
    /// The centre of the box and half its edge, in units of the scene's unit.
    area: [DVec3; 2],
    depth: usize,
    brilliance: f32,
    /// The largest error of lookups.
    error: f64,
    /// The number of samples in the cache that the list was made or checked with.
    samples: usize,
    /// The root of the octree then: its samples are found everywhere.
    root: u32,
    count: usize,
    blocks: Vec<Block>,
}

/// Samples side by side. Free slots have radius 0.
#[derive(Clone, Debug, Default)]
struct Block {
    point: [[f64; BLOCK]; 3],
    normal: [[f64; BLOCK]; 3],
    to_nearest: [[f64; BLOCK]; 3],
    radius: [f64; BLOCK],
    nearest: [f64; BLOCK],
    quality: [f64; BLOCK],
    light: [Rgb; BLOCK],
    /// The cubes in which they are found.
    cubes: [Cube; BLOCK],
}

impl SampleLists {
    /// The weighted mean of the samples at a point. All lookups must be in one cache, or in copies that have grown.
    #[must_use]
    pub fn mean(&mut self, cache: &Cache, query: &CacheQuery) -> Mean {
        let point = query.point / cache.unit();
        let level = cache.mean_level(query.depth) - FINER;
        let cell = Cell::at(point, level.clamp(LEVELS[0], LEVELS[1]));
        if self.0.is_empty() {
            self.0.resize(LISTS, List::default());
        }
        let list = &mut self.0[slot(&cell)];
        if !list.serves(cache, query, point) {
            list.fill(cache, query, point, &cell);
        }
        if list.count > MAX_COUNT {
            return cache.mean(query);
        }
        with_widest(
            #[inline(always)]
            |lanes| {
                lanes.run(MeanKernel {
                    list,
                    query,
                    point,
                    unit: cache.unit(),
                })
            },
        )
    }
}

/// The number of the list of a cell.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a hash"
)]
fn slot(cell: &Cell) -> usize {
    let [x, y, z] = cell.corner.map(|corner| corner as usize);
    (x ^ y << 3 ^ z << 5 ^ (x ^ y ^ z) >> 4) % LISTS
}

impl List {
    /// Returns true if the list has the samples of a lookup, after a look at those that were added since.
    fn serves(&mut self, cache: &Cache, query: &CacheQuery, point: DVec3) -> bool {
        let [centre, half] = self.area;
        let is_made_for = self.root == cache.root()
            && self.depth == query.depth
            && self.brilliance == query.brilliance
            && query.error <= self.error
            && (point - centre).abs().cmple(half).all();
        let mut since = cache.samples().iter().skip(self.samples);
        self.samples = cache.samples().len();
        is_made_for
            && !since.any(|sample| sample.depth == self.depth && self.may_use(sample, cache.unit()))
    }

    /// Returns true if a lookup may find a sample near enough.
    fn may_use(&self, sample: &IrradianceSample, unit: f64) -> bool {
        let [centre, half] = self.area;
        let away = ((sample.point - centre * unit).abs() - half * unit).max(DVec3::ZERO);
        let farthest = sample.radius * self.error * SLACK;
        away.length_squared() <= farthest * farthest
    }

    /// Fills the list for the lookups in a cell.
    fn fill(&mut self, cache: &Cache, query: &CacheQuery, point: DVec3, cell: &Cell) {
        self.area = cell.box_around(HALF);
        self.samples = cache.samples().len();
        self.root = cache.root();
        self.depth = query.depth;
        self.brilliance = query.brilliance;
        self.error = query.error;
        self.count = 0;
        self.blocks.clear();
        let [centre, half] = self.area;
        if !(point - centre).abs().cmple(half).all() {
            // Coordinates so large that cells of this size are rounded away.
            self.area = [point, DVec3::ZERO];
        }
        cache.visit(query.depth, self.area, &mut |number, cube| {
            let sample = &cache.samples()[number as usize];
            if sample.brilliance != query.brilliance || !self.may_use(sample, cache.unit()) {
                return;
            }
            let at = self.count % BLOCK;
            self.count += 1;
            if self.count > MAX_COUNT {
                self.blocks.clear();
                return;
            }
            if at == 0 {
                self.blocks.push(Block::default());
            }
            if let Some(block) = self.blocks.last_mut() {
                for axis in 0..3 {
                    block.point[axis][at] = sample.point[axis];
                    block.normal[axis][at] = sample.normal[axis];
                    block.to_nearest[axis][at] = sample.to_nearest[axis];
                }
                block.radius[at] = sample.radius;
                block.nearest[at] = sample.nearest;
                block.quality[at] = sample.quality;
                block.light[at] = sample.light;
                block.cubes[at] = cube;
            }
        });
    }
}

/// Kernel of [`SampleLists::mean`].
struct MeanKernel<'a> {
    list: &'a List,
    query: &'a CacheQuery,
    /// The point in units of the scene's unit.
    point: DVec3,
    unit: f64,
}

impl SimdKernel for MeanKernel<'_> {
    type Output = Mean;

    #[inline(always)]
    fn run<F: F64x4>(self) -> Mean {
        let mut mean = Mean::default();
        for block in &self.list.blocks {
            let lanes = SampleLanes {
                point: vec3::from_arrays(&block.point),
                normal: vec3::from_arrays(&block.normal),
                to_nearest: vec3::from_arrays(&block.to_nearest),
                radius: F::from_array(&block.radius),
                nearest: F::from_array(&block.nearest),
                quality: F::from_array(&block.quality),
            };
            let weights = lanes.weights(self.query, self.unit);
            if F::bitmask(F::splat(0.0).lt(weights)) == 0 {
                continue;
            }
            for (at, weight) in weights.to_array().into_iter().enumerate() {
                if weight > 0.0 && block.cubes[at].holds(self.point) {
                    mean.weight += weight;
                    mean.sum += block.light[at] * weight;
                }
            }
        }
        mean
    }
}
